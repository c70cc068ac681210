/// @file The validation as one HTML file that needs nothing else.
#pragma once

#include <optional>
#include <string>

#include "result.h"

namespace cairn::validation {

/// @param report as in validation.json @return nothing if the program was built without the page
std::optional<std::string> makePage(const Json& report);

}  // namespace cairn::validation
