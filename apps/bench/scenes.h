/// @file Cairn's own scenes: time with its parts, and overlaps.
#pragma once

#include "common.h"

namespace cairn::bench {

/// How the scenes are measured.
struct ScenesOptions {
    std::vector<std::string> scenes;          ///< empty = benchScenes()
    SettingOverrides overrides;               ///< of all runs
    std::vector<Variant> variants;            ///< beside the plain one
    std::vector<std::int64_t> threads = {1};  ///< each is measured
    std::size_t repetitions = 3;              ///< of each run, taken in turns
    double longest = 1e7;                     ///< scenes end then [s]
    Extent extent = Extent::full;
    Progress progress;
};

/// The scenes that are measured unless others are asked for. "pile:N" is heap:N for ten seconds with sleeping off: what
/// it costs while it falls, and once it lies still.
const std::vector<std::string>& benchScenes();

/// @throws InputError, Interrupted
Outcome runScenes(const ScenesOptions& options);

}  // namespace cairn::bench
