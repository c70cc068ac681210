/// @file The report as one HTML file that needs nothing else.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "experiment.h"

namespace cairn::thesis {

/// Puts a report into a built page that has a place for it, here and in the validation.
/// @return nothing if the page was not built
std::optional<std::string> fillPage(std::span<const unsigned char> built, const Json& report);

/// @param report as in results.json @param out folder of the pictures, which are put into the page
/// @return nothing if the program was built without the page @throws IoError
std::optional<std::string> makePage(const Json& report, const std::filesystem::path& out);

}  // namespace cairn::thesis
