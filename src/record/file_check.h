/// @file Tells truncated and foreign files from HDF5 files before HDF5 opens them, for a clear message.
#pragma once

#include <cstdint>
#include <filesystem>

namespace cairn {

/// What the beginning of an HDF5 file says.
struct FileState {
    bool closed = true;  ///< its writer closed it; if not it is being written, or its writer was killed
};

/// @throws IoError if the file is missing, unreadable, empty, no HDF5 file, or shorter than it says
FileState checkFile(const std::filesystem::path& path);

/// @param length [bytes] that the file must have at least @throws IoError if it is shorter
void requireLength(const std::filesystem::path& path, std::uint64_t length);

}  // namespace cairn
