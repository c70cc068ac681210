/// @file How the cost of a step grows with the number of bodies: time and memory per body.
#pragma once

#include "common.h"

namespace cairn::bench {

/// How the growth is measured.
struct ScalingOptions {
    std::vector<std::int64_t> sizes;          ///< bodies, about; empty = scalingSizes()
    SettingOverrides overrides;               ///< of all runs
    std::vector<Variant> variants;            ///< beside the plain one
    std::vector<std::int64_t> threads = {1};  ///< each is measured, beginning with the same state
    std::size_t repetitions = 3;              ///< of each run
    Extent extent = Extent::full;
    Progress progress;
};

/// The numbers of bodies that are measured unless others are asked for.
const std::vector<std::int64_t>& scalingSizes();

/// Heaps of equal depth, so that a body has as many contacts in a large one as in a small one: "one" is a wide pit, so
/// that its bodies soon are one batch; "many" are pits of 512 bodies each. Nobody sleeps.
Scene scalingScene(const std::string& layout, std::int64_t bodies);

/// @throws InputError, Interrupted
Outcome runScaling(const ScalingOptions& options);

}  // namespace cairn::bench
