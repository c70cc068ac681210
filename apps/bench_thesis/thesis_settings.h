/// @file The presets of the thesis, as its experiments change them.
#pragma once

#include <cstdint>

#include "cairn/settings.h"

namespace cairn::thesis {

/// What an experiment changes of the thesis's settings.
enum class Variant {
    plain,        ///< nothing
    undamped,     ///< §5.3: gravity damping off
    greedy,       ///< §5.4: unlimited iterations, no shock propagation, highest closing speed first
    latest_first  ///< §5.4: the same with the contact that began to close last
};

/// The settings of the benchmarks. @param preset Preset::thesis or Preset::thesis_accuracy @param threads ≥ 1
/// @source thesis §5.1, §5.3, §5.4, §5.5
Settings thesisSettings(Preset preset, std::int64_t threads, Variant variant = Variant::plain);

}  // namespace cairn::thesis
