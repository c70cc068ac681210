#include "record/file_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>

#include "cairn/types.h"

namespace cairn {

namespace {

constexpr std::string_view signature{"\x89HDF\r\n\x1a\n", 8};

// The superblock of versions 2 and 3 with offsets of 8 bytes: signature, version, size of offsets, size of lengths,
// consistency flags, then four offsets of which the third is the end of the file.
// @source HDF5 File Format Specification 3.0, II.A
constexpr std::size_t version_at = 8;
constexpr std::size_t offset_size_at = 9;
constexpr std::size_t flags_at = 11;
constexpr std::size_t end_of_file_at = 28;
constexpr std::size_t superblock_size = 48;

std::uint64_t littleEndian(const char* bytes) {
    std::uint64_t value = 0;
    for (int i = 7; i >= 0; --i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
}

}  // namespace

void requireLength(const std::filesystem::path& path, std::uint64_t length) {
    std::error_code error;
    const std::uint64_t present = std::filesystem::file_size(path, error);
    if (error) throw IoError(fmt::format("{}: cannot be read: {}", path.string(), error.message()));
    if (present < length) {
        throw IoError(fmt::format("{}: is truncated: {} bytes are there, at least {} belong to it", path.string(),
                                  present, length));
    }
}

FileState checkFile(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        throw IoError(fmt::format("{}: is a directory, not a recording", path.string()));
    }
    std::ifstream in(path, std::ios::binary);
    if (!in) throw IoError(fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
    std::array<char, superblock_size> begin{};
    in.read(begin.data(), begin.size());
    const std::string_view read(begin.data(), static_cast<std::size_t>(in.gcount()));
    if (read.empty()) throw IoError(fmt::format("{}: is empty, not a recording", path.string()));
    if (read.substr(0, signature.size()) != signature.substr(0, read.size())) {
        throw IoError(fmt::format("{}: is not an HDF5 file, so not a recording", path.string()));
    }
    requireLength(path, superblock_size);
    const bool known = (begin[version_at] == 2 || begin[version_at] == 3) && begin[offset_size_at] == 8;
    if (!known) return {};  // not written by Cairn; HDF5 can open it, and its missing marker is reported
    // HDF5 itself does not look at the length of files that were not closed.
    requireLength(path, littleEndian(begin.data() + end_of_file_at));
    return {.closed = begin[flags_at] == 0};
}

}  // namespace cairn
