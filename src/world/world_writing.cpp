/// The part of World that writes the state of bodies, of one as of many.
#include <fmt/core.h>

#include "activity/sleeping.h"
#include "cairn/world.h"
#include "geometry/geometry.h"
#include "world/limits.h"
#include "world/locks.h"
#include "world/motions.h"
#include "world/requirements.h"
#include "world/stillness.h"
#include "world/world_state.h"

namespace cairn {

namespace {

/// @throws InputError unless every body has its value
void requireEqualLengths(std::size_t ids, std::size_t values, std::string_view what) {
    if (ids == values) return;
    throw InputError(fmt::format("{} bodies were given {} of {}; give one for each body", ids, values, what));
}

/// What a call writes to dynamic bodies.
struct Written {
    std::string_view kind;  ///< what a fixed body does not take
    std::string_view name;  ///< of one value
    std::string_view unit;
    double limit;  ///< of every component
};

constexpr Written written_velocity{"velocity", "linear velocity", "m/s", speed_limit};
constexpr Written written_spin{"velocity", "angular velocity", "rad/s", speed_limit};
constexpr Written written_force{"force", "force", "N", load_limit};
constexpr Written written_torque{"torque", "torque", "N·m", load_limit};
constexpr Written written_impulse{"impulse", "impulse", "N·s", load_limit};
constexpr Written written_angular_impulse{"impulse", "angular impulse", "N·m·s", load_limit};

/// Writes a vector to each of some dynamic bodies and wakes them, or to none of them if one is refused.
template <class Write>
void writeVectors(BodyStorage& bodies, std::span<const BodyId> ids, std::span<const Vec3> values,
                  const Written& written, Write write) {
    requireEqualLengths(ids.size(), values.size(), written.name);
    for (std::size_t k = 0; k < ids.size(); ++k) {
        dynamicIndex(bodies, ids[k], written.kind);
        requireWithin(values[k], written.limit, written.name, written.unit);
    }
    const BodyState state = bodies.state();
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const BodyIndex i = bodies.slotOf(ids[k].index);
        write(i, values[k]);
        state.wake(i, WakeReason::changed);
    }
}

}  // namespace

void World::setPose(BodyId id, const Pose& pose) {
    beginChange(*state_, "World::setPose");
    setPoses({&id, 1}, {&pose, 1});
}

void World::setPoses(std::span<const BodyId> ids, std::span<const Pose> poses) {
    beginChange(*state_, "World::setPoses");
    BodyStorage& b = state_->bodies;
    requireEqualLengths(ids.size(), poses.size(), "pose");
    for (std::size_t k = 0; k < ids.size(); ++k) {
        b.indexOf(ids[k]);
        requireWithin(poses[k].position, distance_limit, "position", "m");
        requireRotation(poses[k].orientation);
        requireNoLaw(*state_, ids[k].index);
    }
    state_->launched = true;
    ++state_->places_version;
    const BodyState state = b.state();
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const BodyIndex i = ids[k].index;
        b.setShapePose(i, {poses[k].position, requireRotation(poses[k].orientation)});
        b.updateMassProperties(i);
        moveLocks(*state_, i);
        state.wake(i, WakeReason::changed);
    }
}

void World::setLinearVelocity(BodyId id, const Vec3& v) {
    beginChange(*state_, "World::setLinearVelocity");
    setLinearVelocities({&id, 1}, {&v, 1});
}

void World::setLinearVelocities(std::span<const BodyId> ids, std::span<const Vec3> v) {
    beginChange(*state_, "World::setLinearVelocities");
    BodyStorage& b = state_->bodies;
    state_->launched = true;
    writeVectors(b, ids, v, written_velocity, [&](BodyIndex i, const Vec3& value) { b.v[i] = value; });
}

void World::setAngularVelocity(BodyId id, const Vec3& w) {
    beginChange(*state_, "World::setAngularVelocity");
    setAngularVelocities({&id, 1}, {&w, 1});
}

void World::setAngularVelocities(std::span<const BodyId> ids, std::span<const Vec3> w) {
    beginChange(*state_, "World::setAngularVelocities");
    BodyStorage& b = state_->bodies;
    state_->launched = true;
    writeVectors(b, ids, w, written_spin, [&](BodyIndex i, const Vec3& value) { b.w[i] = value; });
}

void World::setFixed(BodyId id, bool fixed) {
    beginChange(*state_, "World::setFixed");
    BodyStorage& b = state_->bodies;
    const BodyIndex i = b.indexOf(id);
    if (!fixed && !isSolid(b.shape[i])) {
        throw InputError(fmt::format("a {} has no mass and stays fixed", shapeName(b.shape[i])));
    }
    requireNoLaw(*state_, i);
    if (!fixed && !b.surface_velocity[i].isZero(0)) {
        throw InputError(fmt::format(
            "the surface of body {} runs, so it stays fixed; stop it with World::setSurfaceVelocity first", i));
    }
    state_->lasting.reset();
    b.state().wake(i, WakeReason::changed);
    b.kind[i] = fixed ? BodyKind::fixed : BodyKind::dynamic;
    b.v[i].setZero();
    b.w[i].setZero();
    b.motion[i] = initialMotion(state_->settings.sleep);
    b.supports[i] = -1;
    b.updateMassProperties(i);
}

void World::wake(BodyId id) {
    beginChange(*state_, "World::wake");
    wake(std::span<const BodyId>(&id, 1));
}

void World::wake(std::span<const BodyId> ids) {
    beginChange(*state_, "World::wake");
    BodyStorage& b = state_->bodies;
    for (const BodyId id : ids) b.indexOf(id);
    const BodyState state = b.state();
    for (const BodyId id : ids) state.wake(id.index, WakeReason::changed);
}

void World::applyForce(BodyId id, const Vec3& force) {
    beginChange(*state_, "World::applyForce");
    applyForces({&id, 1}, {&force, 1});
}

void World::applyForces(std::span<const BodyId> ids, std::span<const Vec3> forces) {
    beginChange(*state_, "World::applyForces");
    BodyStorage& b = state_->bodies;
    writeVectors(b, ids, forces, written_force, [&](BodyIndex i, const Vec3& value) { b.force[i] += value; });
}

void World::applyForceAt(BodyId id, const Vec3& force, const Vec3& point) {
    beginChange(*state_, "World::applyForceAt");
    BodyStorage& b = state_->bodies;
    const BodyIndex i = dynamicIndex(b, id, written_force.kind);
    requireWithin(force, load_limit, "force", "N");
    requireWithin(point, distance_limit, "point", "m");
    b.force[i] += force;
    b.torque[i] += (point - b.position[i]).cross(force);
    b.state().wake(i, WakeReason::changed);
}

void World::applyTorque(BodyId id, const Vec3& torque) {
    beginChange(*state_, "World::applyTorque");
    applyTorques({&id, 1}, {&torque, 1});
}

void World::applyTorques(std::span<const BodyId> ids, std::span<const Vec3> torques) {
    beginChange(*state_, "World::applyTorques");
    BodyStorage& b = state_->bodies;
    writeVectors(b, ids, torques, written_torque, [&](BodyIndex i, const Vec3& value) { b.torque[i] += value; });
}

void World::applyImpulse(BodyId id, const Vec3& impulse) {
    beginChange(*state_, "World::applyImpulse");
    applyImpulses({&id, 1}, {&impulse, 1});
}

void World::applyImpulses(std::span<const BodyId> ids, std::span<const Vec3> impulses) {
    beginChange(*state_, "World::applyImpulses");
    BodyStorage& b = state_->bodies;
    state_->launched = true;
    writeVectors(b, ids, impulses, written_impulse,
                 [&](BodyIndex i, const Vec3& value) { b.v[i] += value * b.mass_inv[i]; });
}

void World::applyImpulseAt(BodyId id, const Vec3& impulse, const Vec3& point) {
    beginChange(*state_, "World::applyImpulseAt");
    BodyStorage& b = state_->bodies;
    const BodyIndex i = dynamicIndex(b, id, written_impulse.kind);
    requireWithin(point, distance_limit, "point", "m");
    applyImpulse(id, impulse);
    b.w[i] += b.inertiaInv_W[i] * (point - b.position[i]).cross(impulse);
}

void World::applyAngularImpulse(BodyId id, const Vec3& impulse) {
    beginChange(*state_, "World::applyAngularImpulse");
    applyAngularImpulses({&id, 1}, {&impulse, 1});
}

void World::applyAngularImpulses(std::span<const BodyId> ids, std::span<const Vec3> impulses) {
    beginChange(*state_, "World::applyAngularImpulses");
    BodyStorage& b = state_->bodies;
    state_->launched = true;
    writeVectors(b, ids, impulses, written_angular_impulse,
                 [&](BodyIndex i, const Vec3& value) { b.w[i] += b.inertiaInv_W[i] * value; });
}

void World::setConstantForce(BodyId id, const Vec3& force) {
    setConstantForces({&id, 1}, {&force, 1});
}

void World::setConstantForces(std::span<const BodyId> ids, std::span<const Vec3> forces) {
    BodyStorage& b = state_->bodies;
    state_->lasting.reset();
    writeVectors(b, ids, forces, written_force, [&](BodyIndex i, const Vec3& value) { b.constant_force[i] = value; });
}

void World::setConstantTorque(BodyId id, const Vec3& torque) {
    setConstantTorques({&id, 1}, {&torque, 1});
}

void World::setConstantTorques(std::span<const BodyId> ids, std::span<const Vec3> torques) {
    BodyStorage& b = state_->bodies;
    state_->lasting.reset();
    writeVectors(b, ids, torques, written_torque,
                 [&](BodyIndex i, const Vec3& value) { b.constant_torque[i] = value; });
}

}  // namespace cairn
