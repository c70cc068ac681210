/// @file What must be known of all bodies of a scene before the first of them is made.
#pragma once

#include <cstddef>
#include <vector>

#include "cairn/scene.h"

namespace cairn {

/// Found by telling all bodies once; takes little memory however many there are.
struct SceneSurvey {
    std::size_t bodies = 0;
    int step_exponent = 0;  ///< what their sizes ask for, as StepExponents; 0 where nobody moves
    /// Whether ranks can get the bodies one by one: nothing that all must know names a body that moves.
    bool can_be_dealt_out = true;
    std::vector<Vec3> places;  ///< of bodies that move [m, W]; of many some, evenly chosen
};

/// The gravity that a scene begins with, or that its law ends with [m/s², W].
Vec3 firstGravity(const Scene& scene);

/// Events in the order in which they happen.
std::vector<SceneEvent> byTime(std::vector<SceneEvent> events);

/// The survey of the bodies of a scene that is there.
SceneSurvey surveyOf(const Scene& scene);

}  // namespace cairn
