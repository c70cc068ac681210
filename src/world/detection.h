/// @file Stage 3: bounds, near pairs, contacts.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Finds all contacts of the bodies where they are now. Pairs that did not move since the last detection keep those
/// that they had. @param margin [m] @throws InputError beyond most_contacts
void detectContacts(const BodyStorage& bodies, const MaterialTable& materials, BroadPhase& broad_phase, double margin,
                    const Executor& executor, StepData& data);

/// Finds anew the contacts of the bodies that the correction displaced by more than a way [m]: it may have pushed them
/// into others that they did not touch. @pre after detectContacts() @return whether there is such a body
bool detectDisplaced(const BodyStorage& bodies, const MaterialTable& materials, BroadPhase& broad_phase, double way,
                     const Executor& executor, StepData& data);

/// Bodies that were displaced after the detection have contacts that changed with them: they are found anew next time,
/// wherever the bodies are then.
void forgetDisplaced(const BodyStorage& bodies, StillBodies& still);

/// To be called when contacts would be others though their bodies did not move: all are found anew.
void forgetPlaces(StillBodies& still);

}  // namespace cairn
