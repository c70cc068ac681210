#include "world/moment.h"

#include <tuple>

namespace cairn {

namespace {

/// Copies the fields that the same thing changes.
void copyFields(Change change, const BodyArrays& from, BodyArrays& to) {
    forEachBodyField([&](const auto& field) {
        if (field.change == change) to.*field.array = from.*field.array;
    });
}

/// Members that a moment has under the names of the world.
template <class Part>
auto sharedNames(Part& p) {
    return std::tie(p.springs, p.joints, p.gravity, p.gravity_law, p.global_acceleration, p.driven, p.frame, p.steps,
                    p.steps_at_start, p.time, p.time_at_start, p.statistics, p.faults);
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

void keepMoment(WorldState& world, MomentState& moment) {
    if (world.lasting == nullptr) world.lasting = lastingPartOf(world);
    moment.lasting = world.lasting;
    moment.settings = world.settings;
    copyFields(Change::steps, world.bodies, moment.bodies);
    sharedNames(moment) = sharedNames(world);
    moment.contact_generation = world.data.generation;
    moment.contacts = world.data.contacts;
    moment.sensed = world.data.sensed;
    moment.batches = world.data.batches;
    moment.event_level = world.events.level;
    moment.events = world.events.events;
}

void loadMoment(const MomentState& moment, WorldState& world) {
    world.applySettings(moment.settings);
    if (world.lasting != moment.lasting) {
        world.materials = moment.lasting->materials;
        copyFields(Change::calls, moment.lasting->bodies, world.bodies);
        world.bodies.linear_step.assign(world.bodies.slots(), Vec3::Zero());
        world.bodies.filter = moment.lasting->filter;
        world.bodies.adoptSlots(moment.lasting->next_number);
        world.lasting = moment.lasting;
    }
    copyFields(Change::steps, moment.bodies, world.bodies);
    sharedNames(world) = sharedNames(moment);
    world.data.generation = moment.contact_generation;
    world.data.contacts = moment.contacts;
    world.data.sensed = moment.sensed;
    world.data.batches = moment.batches;
    world.events.level = moment.event_level;
    world.events.events = moment.events;
    // What the last step left for viewers is that of another step.
    world.data.pairs.adopt(world.data.contacts);
    world.data.contacts_of.begin.clear();
    world.ties.forget();
    world.index.forget();
    world.trace.correction.clear();
    world.trace.shock_stage.clear();
}

}  // namespace cairn
