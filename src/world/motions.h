/// @file Bodies that move by a law, and the frame and the gravity of the world where they do.
#pragma once

#include "world/world_state.h"

namespace cairn {

/// Stage 1: finds gravity and what the motion of the frame gives all bodies in this step, and wakes them where gravity
/// changed or the frame gives any.
void beginLaws(WorldState& world);

/// Stage 2: puts the bodies that move by a law where the end of the step finds them.
void moveByLaw(WorldState& world);

/// Stage 6: gives them the velocities that bring them to where the next step ends, so that what sticks to them goes
/// exactly their way, and wakes the batches that touch those that move. Adds the forces of a moving frame.
void advanceLaws(WorldState& world);

/// The law of a body, or none.
const DrivenBody* lawOf(const WorldState& world, BodyIndex body);

void addLaw(WorldState& world, DrivenBody driven);
/// Stops a body that moves by a law, if it does.
void removeLaw(WorldState& world, BodyIndex body);
/// @throws InputError for a body that moves by a law
void requireNoLaw(const WorldState& world, BodyIndex body);

/// Gravity after all that its law does, or as it is without a law; zero where the law never ends [m/s², W].
Vec3 lastingGravity(const Vec3& gravity, const std::optional<GravityLaw>& law);
/// Whether gravity follows a law that has not ended.
bool isGravityChanging(const WorldState& world);

/// Whether bodies get energy from laws.
bool isDrivenByLaws(const WorldState& world);

}  // namespace cairn
