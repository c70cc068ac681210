/// @file The kept rows: state hashes of the golden scenes.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "golden/scenes.h"

namespace cairn::golden {

/// What the kept hashes are of: other compilers and flags may round otherwise.
inline constexpr std::string_view kept_build = "GNU 12, x86-64, -O3 -DNDEBUG -ffp-contract=off, one thread";

/// What a row is about.
struct RowKey {
    std::string scene;
    std::string preset;
    std::int64_t step = 0;

    friend auto operator<=>(const RowKey&, const RowKey&) = default;
};

/// "stacks5, performance, step 24".
std::string describe(const RowKey& key);

/// Hashes by what they are of; hexadecimal, "0x" and sixteen digits.
using Rows = std::map<RowKey, std::string>;

/// Runs a scene and adds its rows.
void addRows(const GoldenScene& scene, Kind kind, Rows& rows);

/// @throws IoError, or nlohmann::json::exception if it is not such a file
Rows readRows(const std::filesystem::path& file);
/// One row a line, scenes and settings in the order of the table. @throws IoError
void writeRows(const Rows& rows, const std::filesystem::path& file);

}  // namespace cairn::golden
