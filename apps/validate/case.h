/// @file A case of the validation: one physical situation whose outcome is known.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "result.h"
#include "toss.h"

namespace cairn::validation {

/// How much is run.
enum class Extent {
    full,  ///< everything
    quick  ///< coarser time steps, smaller and shorter where a case can; for the signs
};

/// Somebody asked to stop.
struct Interrupted {};

/// What a case may use while it runs.
struct Plan {
    Extent extent = Extent::full;
    std::vector<Toss> tosses{};           ///< recorded tosses of a cube to compare with
    std::function<void()> alive = [] {};  ///< to be called often in long loops; @throws Interrupted

    bool isQuick() const { return extent == Extent::quick; }
    /// Steps per second of a convergence study.
    std::vector<double> rates() const {
        return isQuick() ? std::vector<double>{240, 960} : std::vector<double>{240, 960, 3840};
    }
};

/// One case. Its parameters stand in its file and nowhere else.
struct Case {
    std::string_view name;   ///< unique, for --only
    std::string_view group;  ///< heading
    std::string_view title;
    std::string_view source;  ///< formula, derivation or publication of the expected values
    std::string_view setup;   ///< bodies, settings and what is measured
    Result (*run)(const Plan& plan);
};

/// All cases, in the order of the page.
std::span<const Case> allCases();

}  // namespace cairn::validation
