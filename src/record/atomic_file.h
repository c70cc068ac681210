/// @file Files that are replaced as a whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace cairn {

/// Appends bytes to a file that is being written.
using AppendBytes = std::function<void(std::span<const std::byte>)>;

/// Writes beside the file first, makes that durable, then takes the file's place, which the operating system does at
/// once or not at all. @param write what the file is to have @throws IoError; the file is then as it was
void replaceFile(const std::filesystem::path& file, const std::function<void(const AppendBytes&)>& write);
void replaceFile(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// @throws IoError
std::vector<std::byte> readFile(const std::filesystem::path& file);

}  // namespace cairn
