#include "world/rollback.h"

#include <tuple>

namespace cairn {

namespace {

/// Copies the fields that the same thing changes.
void copyFields(Change change, const BodyArrays& from, BodyArrays& to) {
    forEachBodyField([&](const auto& field) {
        if (field.change == change) to.*field.array = from.*field.array;
    });
}

/// Members that a kept state has under the names of the world.
template <class Part>
auto sharedNames(Part& p) {
    return std::tie(p.springs, p.joints, p.gravity, p.gravity_law, p.global_acceleration, p.driven, p.frame, p.steps,
                    p.steps_at_start, p.time, p.time_at_start, p.launched, p.next_part, p.sized, p.step_exponent,
                    p.statistics, p.faults);
}

std::shared_ptr<const LastingPart> lastingPartOf(const WorldState& world) {
    auto part = std::make_shared<LastingPart>();
    part->materials = world.materials;
    copyFields(Change::calls, world.bodies, part->bodies);
    part->filter = world.bodies.filter;
    part->next_number = world.bodies.nextNumber();
    return part;
}

}  // namespace

void keepRollback(WorldState& world, RollbackData& kept) {
    if (world.lasting == nullptr) world.lasting = lastingPartOf(world);
    kept.lasting = world.lasting;
    kept.settings = world.settings;
    copyFields(Change::steps, world.bodies, kept.bodies);
    sharedNames(kept) = sharedNames(world);
    kept.contact_generation = world.data.generation;
    kept.contacts = world.data.contacts;
    kept.sensed = world.data.sensed;
    kept.batches = world.data.batches;
    kept.event_level = world.events.level;
    kept.events = world.events.events;
}

void loadRollback(const RollbackData& kept, WorldState& world) {
    world.applySettings(kept.settings);
    if (world.lasting != kept.lasting) {
        world.materials = kept.lasting->materials;
        copyFields(Change::calls, kept.lasting->bodies, world.bodies);
        world.bodies.filter = kept.lasting->filter;
        world.bodies.adoptSlots(kept.lasting->next_number);
        world.lasting = kept.lasting;
    }
    copyFields(Change::steps, kept.bodies, world.bodies);
    sharedNames(world) = sharedNames(kept);
    world.data.generation = kept.contact_generation;
    world.data.contacts = kept.contacts;
    world.data.sensed = kept.sensed;
    world.data.batches = kept.batches;
    world.events.level = kept.event_level;
    world.events.events = kept.events;
    // What the last step left for viewers is that of another step.
    world.data.pairs.adopt(world.data.contacts);
    world.data.contacts_of.begin.clear();
    world.ties.forget();
    world.index.forget();
    world.trace.correction.clear();
    world.trace.shock_stage.clear();
}

}  // namespace cairn
