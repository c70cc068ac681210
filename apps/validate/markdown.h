/// @file The validation's results as Markdown: the overview of docs/validation.md and the pages in docs/validation.
#pragma once

#include <string>

#include "result.h"

namespace cairn::validation {

/// The table of all cases, with links to their pages in the folder "validation" beside it.
/// @param report as in validation.json
std::string overviewMarkdown(const Json& report);

/// The page of one case: what is measured, and every quantity. @param c of the report's cases
std::string caseMarkdown(const Json& c);

}  // namespace cairn::validation
