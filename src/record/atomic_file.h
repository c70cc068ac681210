/// @file Files that are replaced as a whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace cairn {

/// Writes beside the file first, makes that durable, then takes the file's place, which the operating system does at
/// once or not at all. @throws IoError; the file is then as it was
void replaceFile(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// @throws IoError
std::vector<std::byte> readFile(const std::filesystem::path& file);

}  // namespace cairn
