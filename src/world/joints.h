/// @file What the stages of a step do with joints.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Begins a step: joints have received nothing in it so far.
void beginJointImpulses(WorldState& world);

/// Finds the groups of joints and the pairs that may not touch, and wakes groups of which a part is awake.
void prepareJoints(WorldState& world);

/// Wakes the sleeping bodies of every group of which a body is awake: they sleep and wake together.
void wakeJointed(WorldState& world);

/// Rows of all joints where their bodies are now, batch after batch, and which of them are whose.
void buildJointBlocks(WorldState& world);

/// Leaves what joints keep at any time, and limits: what acts along free axes acts later in the step.
void keepImpactsOnly(WorldState& world);

/// Adds what the rows of some joints received in a resolution to the impulses of the step.
void addJointImpulses(WorldState& world, std::span<const JointBlock> blocks);

/// To be called when the impacts before the flight are measured: what joints received there is not to be measured
/// again.
void bookJointImpulses(WorldState& world);

/// A joint supports both its bodies like a contact in the direction of gravity.
void countJointSupports(const WorldState& world, std::span<std::int32_t> supports);

/// Puts the groups to sleep of which every body hardly moves.
void letJointedSleep(WorldState& world);

/// Notes the impulses of the resolution and removes the joints that were loaded too much.
void finishJoints(WorldState& world);

/// Whether a motor, a servo or a spring may add energy.
bool hasMotors(const WorldState& world);

}  // namespace cairn
