/// @file The validation: every case, measured, written as a page and as JSON.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "case.h"

namespace cairn::validation {

/// How the validation is run.
struct ValidateOptions {
    std::filesystem::path out;      ///< folder; made if it does not exist; empty = nothing is written
    std::vector<std::string> only;  ///< names of cases or groups, empty = all; what was stored of the others stays
    Extent extent = Extent::full;
    std::vector<std::filesystem::path> tosses{};  ///< recorded tosses for the case "cube-toss"
    std::function<void(const std::string&)> began = [](const std::string&) {};     ///< a case by its name
    std::function<void(const std::string&)> finished = [](const std::string&) {};  ///< a line about it
    std::function<bool()> interrupted = [] { return false; };
};

/// What came out.
struct ValidateOutcome {
    Json report;                      ///< as in validation.json
    std::filesystem::path json;       ///< empty if nothing was written
    std::filesystem::path page;       ///< empty if the page was not built in
    std::vector<std::string> missed;  ///< the targets that are not met
    std::size_t cases = 0;
    std::size_t passed = 0;  ///< of the cases
};

/// Runs the cases and writes validation.json, index.html, validation.md and a page for each case in the folder
/// validation. @throws InputError for an unknown name,
/// IoError, Interrupted
ValidateOutcome runValidation(const ValidateOptions& options);

}  // namespace cairn::validation
