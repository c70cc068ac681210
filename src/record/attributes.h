/// @file Attributes of HDF5 objects and texts.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cairn/settings.h"
#include "record/hdf5_handle.h"

namespace cairn::hdf5 {

/// @param object a file, group or data set @param path of the file, for messages @throws IoError
void writeAttribute(hid_t object, const std::filesystem::path& path, const char* name, const SettingValue& value);
/// None if there is no such attribute or it is of another kind. @throws IoError if it cannot be read
std::optional<SettingValue> readAttribute(hid_t object, const std::filesystem::path& path, const char* name);
/// All attributes, in the order in which they were written, as text. @throws IoError
std::vector<std::pair<std::string, std::string>> readAttributes(const Group& group, const std::filesystem::path& path);
/// A group that remembers the order of its attributes. @throws IoError
Group createGroup(const File& file, const std::filesystem::path& path, const char* name);

/// Writes a text of any length as a compressed data set of one string. @throws IoError
void writeText(const File& file, const std::filesystem::path& path, const char* name, const std::string& text);
/// @throws IoError if it is missing or not such a text
std::string readText(const File& file, const std::filesystem::path& path, const char* name);

}  // namespace cairn::hdf5
