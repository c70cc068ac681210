/// @file Motion clamping: bodies that got too deep into each other, or flew through each other, whatever was foreseen
/// and resolved, go back to where they were not.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Takes back bodies until no two are deeper in each other than allowed in a fall, unless they were before.
/// @pre the pairs were detected where bodies are now, and are so again then
void clampMotion(WorldState& world, const PairsInput& pairs);

/// Takes back on their ways bodies that the correction pressed too deep into others, until there are none. @pre bodies
/// are where they were detected, but for what the correction moved them since @return whether it moved any
bool clampCorrection(WorldState& world, const DetectionRange& range);

/// Lets contacts be no deeper than their bodies really are. @pre contacts follow what the correction did
void measureCorrected(WorldState& world, const DetectionRange& range);

/// Takes back bodies that the completion of their flights moved too deep into others. @param before it
void clampCompletion(WorldState& world, const DetectionRange& range, const PosesBefore& before);

}  // namespace cairn
