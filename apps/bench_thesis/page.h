/// @file The report as one HTML file that needs nothing else.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiment.h"

namespace cairn::thesis {

/// @param report as in results.json @param out folder of the pictures, which are put into the page
/// @return nothing if the program was built without the page @throws IoError
std::optional<std::string> makePage(const Json& report, const std::filesystem::path& out);

}  // namespace cairn::thesis
