/// The part of World that moves bodies, its frame and its gravity by laws.
#include <fmt/core.h>

#include "cairn/world.h"
#include "world/limits.h"
#include "world/motions.h"
#include "world/stillness.h"
#include "world/world_state.h"

namespace cairn {

namespace {

/// @throws InputError for a dynamic body
void requireFixed(const BodyStorage& bodies, BodyIndex i) {
    if (bodies.kind[i] == BodyKind::fixed) return;
    throw InputError(
        fmt::format("body {} is moved by forces; only a fixed body moves by a law: make it one with World::setFixed "
                    "first",
                    i));
}

/// @throws InputError for a body with a joint
void requireUnjointed(WorldState& w, BodyIndex i) {
    w.ties.list(w.springs, w.joints, w.bodies.slots());
    for (const std::uint32_t slot : w.ties.jointsOf(i)) {
        if (!w.joints[slot].present || (w.joints[slot].a != i && w.joints[slot].b != i)) continue;
        throw InputError(
            fmt::format("body {} has a joint; one that moves by a law takes none: remove the joint, or let "
                        "a motor move it",
                        i));
    }
}

}  // namespace

void World::setMotion(BodyId id, const Motion& motion, const Vec3& pivot) {
    beginChange(*state_, "World::setMotion");
    WorldState& w = *state_;
    const BodyIndex i = w.bodies.indexOf(id);
    requireFixed(w.bodies, i);
    requireUnjointed(w, i);
    if (!(pivot.allFinite() && pivot.cwiseAbs().maxCoeff() <= distance_limit)) {
        throw InputError(
            fmt::format("the pivot of a motion is ({}, {}, {}) m; every component must be finite and "
                        "within ±{} m",
                        pivot.x(), pivot.y(), pivot.z(), distance_limit));
    }
    DrivenBody driven{i, w.time, w.bodies.shapePose(i), pivot, std::make_shared<const MotionCurve>(motion)};
    removeLaw(w, i);
    addLaw(w, std::move(driven));
}

void World::stopMotion(BodyId id) {
    beginChange(*state_, "World::stopMotion");
    WorldState& w = *state_;
    const BodyIndex i = w.bodies.indexOf(id);
    removeLaw(w, i);
}

std::optional<Motion> World::motion(BodyId id) const {
    const DrivenBody* driven = lawOf(*state_, state_->bodies.indexOf(id));
    if (driven == nullptr) return {};
    return driven->curve->motion();
}

void World::setSurfaceVelocity(BodyId id, const Vec3& velocity) {
    beginChange(*state_, "World::setSurfaceVelocity");
    WorldState& w = *state_;
    const BodyIndex i = w.bodies.indexOf(id);
    requireFixed(w.bodies, i);
    if (!(velocity.allFinite() && velocity.cwiseAbs().maxCoeff() <= speed_limit)) {
        throw InputError(
            fmt::format("the velocity of a surface is ({}, {}, {}) m/s; every component must be finite and "
                        "within ±{} m/s",
                        velocity.x(), velocity.y(), velocity.z(), speed_limit));
    }
    w.lasting.reset();
    w.bodies.surface_velocity[i] = velocity;
}

Vec3 World::surfaceVelocity(BodyId id) const {
    return state_->bodies.surface_velocity[state_->bodies.indexOf(id)];
}

void World::setGravity(const Vec3& gravity, const std::optional<Motion>& law) {
    beginChange(*state_, "World::setGravity");
    WorldState& w = *state_;
    std::optional<GravityLaw> new_law;
    if (law) {
        new_law = {w.time, gravity, std::make_shared<const MotionCurve>(*law)};
        if (new_law->curve->turns()) throw InputError("a law of gravity turns; give one without spin or turns");
    }
    validate(w.settings, lastingGravity(gravity, new_law) + w.global_acceleration);
    // Gravity may pass any value while it changes, since nobody falls asleep then.
    Settings changing = w.settings;
    changing.sleep.sleeping = false;
    validate(changing, gravity + w.global_acceleration);
    const bool stays = gravity == w.gravity && !w.gravity_law && !new_law;
    w.gravity = gravity;
    w.gravity_law = std::move(new_law);
    if (!stays) w.wakeAll();
}

Vec3 World::gravity() const {
    return state_->gravity;
}

std::optional<Motion> World::gravityLaw() const {
    if (!state_->gravity_law) return {};
    return state_->gravity_law->curve->motion();
}

void World::setFrameMotion(const std::optional<Motion>& motion) {
    beginChange(*state_, "World::setFrameMotion");
    WorldState& w = *state_;
    if (!motion) {
        w.frame.reset();
        return;
    }
    auto curve = std::make_shared<const MotionCurve>(*motion);
    if (curve->turns()) {
        throw InputError("the frame of a world does not turn; give a motion without spin or turns");
    }
    w.frame = FrameMotion{w.time, std::move(curve)};
    w.wakeAll();
}

std::optional<Motion> World::frameMotion() const {
    if (!state_->frame) return {};
    return state_->frame->curve->motion();
}

}  // namespace cairn
