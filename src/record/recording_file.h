/// @file Files of recordings, as they are created and opened: written by one, read by many at the same time.
#pragma once

#include <filesystem>
#include <string_view>

#include "record/file_check.h"
#include "record/file_driver.h"
#include "record/hdf5_handle.h"

namespace cairn::hdf5 {

/// A new file that others may read while it grows. @throws IoError unless the state tells the error
File createFile(const std::filesystem::path& path, const FileDriver& driver, WriteState& state);

/// @throws IoError if it is damaged
File openFile(const std::filesystem::path& path, const FileState& state);

/// @param format that the file must say it has, in its version @throws IoError for another
void requireFormat(const File& file, const std::filesystem::path& path, std::string_view format);

/// @throws IoError if a write failed
void requireWritten(const WriteState& state, const std::filesystem::path& path, std::string_view what);

/// A number that is at least zero; 0 if the file has no such attribute.
std::uint64_t numberAttribute(const File& file, const std::filesystem::path& path, const char* name);

}  // namespace cairn::hdf5
