/// @file Stage 3: bounds, near pairs, contacts.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Finds all contacts of the bodies where they are now. @param margin [m]
void detectContacts(const BodyStorage& bodies, const MaterialTable& materials, BroadPhase& broad_phase, double margin,
                    const Executor& executor, StepData& data);

}  // namespace cairn
