/// @file A moment of a world for rollback. What steps never change stands in a part that the world and all moments
/// share until it changes, so that keeping a moment copies little more than what moves.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "world/world_state.h"

namespace cairn {

/// What only calls from outside and faults change; whoever changes it clears WorldState::lasting.
struct LastingPart {
    MaterialTable materials;
    // The arrays of BodyStorage with these names.
    std::vector<BodyKind> kind;
    std::vector<std::uint32_t> generation;
    std::vector<Shape> shape;
    std::vector<std::uint32_t> material;
    std::vector<std::string> name;
    std::vector<Vec3> p_BS;
    std::vector<Quat> R_BS;
    std::vector<double> mass, mass_inv, r_max;
    std::vector<Vec3> inertia_B, inertiaInv_B, constant_force, constant_torque;
};

/// The rest, with the part that it shares.
struct MomentState {
    std::shared_ptr<const LastingPart> lasting;
    Settings settings;
    // The arrays of BodyStorage with these names.
    std::vector<Vec3> position, v, w, force, torque;
    std::vector<Quat> orientation;
    std::vector<Mat3> inertiaInv_W;
    std::vector<std::uint8_t> asleep;
    std::vector<std::uint8_t> resting;
    std::vector<WakeReason> woken;
    std::vector<double> motion;
    std::vector<std::int32_t> supports;

    std::vector<Spring> springs;
    std::vector<Joint> joints;
    Vec3 gravity, global_acceleration;
    std::int64_t steps = 0, steps_at_start = 0;
    double time = 0, time_at_start = 0;
    std::vector<std::uint32_t> contact_generation;  ///< StepData::generation
    std::vector<Contact> contacts;
    Batches batches;
    ContactMemory memory;
    Statistics statistics;
    std::vector<FaultInfo> faults;
    EventLevel event_level = EventLevel::none;
    std::vector<Event> events;
};

/// Overwrites a moment, whose memory is used again.
void keepMoment(WorldState& world, MomentState& moment);

/// What the user watches the world with is no part of its state and stays.
void loadMoment(const MomentState& moment, WorldState& world);

}  // namespace cairn
