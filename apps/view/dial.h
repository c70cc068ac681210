/// @file The dial between the two presets.
#pragma once

#include <optional>

#include "cairn/scene.h"

namespace cairn::view {

/// Both ends of the dial for a scene.
struct DialEnds {
    Settings performance;
    Settings accuracy;
};

/// @throws InputError as settingsFor
DialEnds dialEnds(const Scene& scene);

/// Settings between the presets. Numbers that are positive at both ends follow a geometric series, steps per second in
/// multiples of 30 so that simulation steps stay whole; switches, choices and limits of which one end is "unlimited"
/// are those of the nearer end. The threads are kept.
/// @param value 0 = performance, 1 = accuracy @param now settings whose threads are kept
Settings settingsAt(const DialEnds& ends, double value, const Settings& now);

/// True if both settings are equal apart from the threads.
bool sameApartFromThreads(const Settings& a, const Settings& b);

}  // namespace cairn::view
