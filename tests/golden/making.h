/// @file How the golden scenes that are not built in are made.
#pragma once

#include <array>
#include <string>

#include "golden/scenes.h"

namespace cairn::golden {

/// The half-space below z = 0, the materials oak and iron, gravity; no other bodies.
Scene groundScene(std::string name);
/// A dynamic body of oak.
SceneBody bodyOf(const Shape& shape, const Vec3& position);
/// What an action gives, in a scene whose values were multiplied. @param N·s
inline Vec3 impulse(const Vec3& newton_seconds, const Scales& by) {
    return newton_seconds * (by.mass * by.length / by.time);
}
/// A number that looks random, from −1 to 1, for each index.
double scatter(std::size_t index);
/// One of the six kinds of shapes that move, in turn.
Shape anyShape(std::size_t index, double size);
/// Likewise an orientation.
Quat scatteredOrientation(std::size_t index);

// Whole scenes (mixed_scenes.cpp).
Scene mixedHeap();
Scene rollingFriction();
Scene zeroGravity();
Scene settlingStacks();
Scene changingPile();
extern const std::array<Action, 1> throw_ball;
extern const std::array<Action, 8> change_bodies;

/// Every kind of joint, with limits, motors, a loop, a spring and a joint that breaks (mechanism.cpp).
Scene mechanism();

// What follows functions of time, and surfaces of triangles (law_scenes.cpp).
/// Stacks and balls under gravity that is a sine.
Scene swayingGravity();
/// Solids of all kinds, one of them of many parts, on a height field and on a mesh that is shaken.
Scene terrain();

// On either side of where the engine changes its way of working (border_scenes.cpp).
/// A slab that bodies slide and roll on, as one batch. @param columns of a box, a box and a ball: nine contacts each
/// @param balls one contact each; the slab has four
Scene crowdedSlab(std::string name, int columns, int balls);
/// Balls that roll on a slab, as one batch of 100 contacts. @param sliding how many of them slide
Scene rollingBalls(std::string name, int sliding);
/// Forty bodies as one batch, boxes and balls on a slab. @param asleep how many of them sleep, the slab among them
Scene partlyAsleep(std::string name, int asleep);
/// A pyramid of more than 320 contacts that a ball is shot at.
Scene pyramid();
/// The same with a joint between two of its boxes.
Scene jointedPyramid();

}  // namespace cairn::golden
