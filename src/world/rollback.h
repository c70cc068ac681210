/// @file The state of a world for rollback. What steps never change stands in a part that the world and all kept states
/// share until it changes, so that keeping one copies little more than what moves.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "world/world_state.h"

namespace cairn {

/// What only calls from outside and faults change; whoever changes it clears WorldState::lasting.
struct LastingPart {
    MaterialTable materials;
    BodyArrays bodies;  ///< the fields that calls change; the others are empty
    PairFilter filter;
    std::uint64_t next_number = 0;
};

/// The rest, with the part that it shares.
struct RollbackData {
    std::shared_ptr<const LastingPart> lasting;
    Settings settings;
    BodyArrays bodies;  ///< the fields that steps change; the others are empty
    std::vector<Spring> springs;
    std::vector<Joint> joints;
    Vec3 gravity, global_acceleration;
    std::optional<GravityLaw> gravity_law;
    std::vector<DrivenBody> driven;
    std::optional<FrameMotion> frame;
    bool launched = false, sized = false;
    NextPart next_part;
    std::int32_t step_exponent = 0;
    std::int64_t steps = 0, steps_at_start = 0;
    double time = 0, time_at_start = 0;
    std::vector<std::uint32_t> contact_generation;  ///< StepData::generation
    std::vector<Contact> contacts;
    std::vector<Sensed> sensed;
    Batches batches;
    Statistics statistics;
    std::vector<FaultInfo> faults;
    EventLevel event_level = EventLevel::none;
    std::vector<Event> events;
};

/// Overwrites what was kept, whose memory is used again.
void keepRollback(WorldState& world, RollbackData& kept);

/// What the user watches the world with is no part of its state and stays.
void loadRollback(const RollbackData& kept, WorldState& world);

}  // namespace cairn
