/// @file The validation's results as Markdown, as in docs/validation.md.
#pragma once

#include <string>

#include "result.h"

namespace cairn::validation {

/// @param report as in validation.json
std::string toMarkdown(const Json& report);

}  // namespace cairn::validation
