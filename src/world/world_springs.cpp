/// The part of World that manages springs.
#include <fmt/core.h>

#include <cmath>

#include "cairn/world.h"
#include "world/stillness.h"
#include "world/world_state.h"

namespace cairn {

namespace {

/// @throws InputError unless the value is finite and at least 0
void requireNotNegative(double value, std::string_view what, std::string_view unit) {
    if (value >= 0 && std::isfinite(value)) return;
    throw InputError(fmt::format("{} of a spring is {} {}; it must be finite and at least 0", what, value, unit));
}

void requireFinite(const Vec3& anchor, std::string_view what) {
    if (anchor.allFinite()) return;
    throw InputError(
        fmt::format("{} of a spring is ({}, {}, {}) m; it must be finite", what, anchor.x(), anchor.y(), anchor.z()));
}

/// @throws StaleIdError
Spring& springOf(std::vector<Spring>& springs, SpringId id) {
    if (id.index < springs.size() && springs[id.index].present && springs[id.index].generation == id.generation) {
        return springs[id.index];
    }
    throw StaleIdError(fmt::format("spring id {}:{} is not in the world: it was removed, or one of its bodies was",
                                   id.index, id.generation));
}

/// @param anchor [m, frame of the body's pose, or W] @return [m, B or W]
Vec3 anchorInBody(const BodyStorage& bodies, BodyIndex i, const Vec3& anchor) {
    return i == Spring::world_point ? anchor : bodies.shapeInBody(i).toOuter(anchor);
}

void wakeEnds(BodyStorage& bodies, const Spring& spring) {
    const BodyState state = bodies.state();
    state.wake(spring.a, WakeReason::changed);
    if (spring.b != Spring::world_point) state.wake(spring.b, WakeReason::changed);
}

}  // namespace

SpringId World::addSpring(const SpringDescription& d) {
    beginChange(*state_, "World::addSpring");
    WorldState& w = *state_;
    const BodyIndex a = w.bodies.indexOf(d.a);
    const BodyIndex b = d.b ? w.bodies.indexOf(*d.b) : Spring::world_point;
    if (a == b) throw InputError("a spring needs two different bodies, or one body and a point");
    const bool b_moves = b != Spring::world_point && w.bodies.kind[b] == BodyKind::dynamic;
    if (w.bodies.kind[a] != BodyKind::dynamic && !b_moves) {
        throw InputError("a spring between bodies that cannot move has no effect; one of them must be dynamic");
    }
    requireFinite(d.anchor_a, "anchor_a");
    requireFinite(d.anchor_b, "anchor_b");
    requireNotNegative(d.stiffness, "stiffness", "N/m");
    requireNotNegative(d.damping, "damping", "N·s/m");
    requireNotNegative(d.rest_length, "rest_length", "m");
    std::uint32_t slot = 0;
    while (slot < w.springs.size() && w.springs[slot].present) ++slot;
    if (slot == w.springs.size()) w.springs.emplace_back();
    Spring& spring = w.springs[slot];
    spring = {.present = true,
              .generation = spring.generation,
              .a = a,
              .b = b,
              .anchor_a = anchorInBody(w.bodies, a, d.anchor_a),
              .anchor_b = anchorInBody(w.bodies, b, d.anchor_b),
              .stiffness = d.stiffness,
              .damping = d.damping,
              .rest_length = d.rest_length};
    w.ties.forget();
    wakeEnds(w.bodies, spring);
    return {slot, spring.generation};
}

void World::removeSpring(SpringId id) {
    beginChange(*state_, "World::removeSpring");
    Spring& spring = springOf(state_->springs, id);
    wakeEnds(state_->bodies, spring);
    spring.present = false;
    ++spring.generation;
}

void World::setSpringAnchor(SpringId id, const Vec3& anchor_b) {
    beginChange(*state_, "World::setSpringAnchor");
    Spring& spring = springOf(state_->springs, id);
    requireFinite(anchor_b, "anchor_b");
    spring.anchor_b = anchorInBody(state_->bodies, spring.b, anchor_b);
    wakeEnds(state_->bodies, spring);
}

}  // namespace cairn
