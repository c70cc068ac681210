#include "world/moment.h"

#include <tuple>

#include "world/detection.h"

namespace cairn {

namespace {

// A new array of the bodies belongs into one of the two lists below; linear_step, which every step computes anew, is in
// neither. 27 arrays and the holes are vectors.
static_assert(sizeof(BodyStorage) == 28 * sizeof(std::vector<Vec3>) + sizeof(std::size_t));

/// Arrays that steps change, of the bodies or of a moment.
template <class Part>
auto movingArrays(Part& p) {
    return std::tie(p.position, p.orientation, p.v, p.w, p.inertiaInv_W, p.force, p.torque, p.asleep, p.resting,
                    p.woken, p.motion, p.supports);
}

/// Arrays that steps never change, of the bodies or of a lasting part.
template <class Part>
auto lastingArrays(Part& p) {
    return std::tie(p.kind, p.generation, p.shape, p.material, p.name, p.p_BS, p.R_BS, p.mass, p.mass_inv, p.r_max,
                    p.inertia_B, p.inertiaInv_B, p.constant_force, p.constant_torque);
}

/// Members that a moment has under the names of the world.
template <class Part>
auto sharedNames(Part& p) {
    return std::tie(p.springs, p.joints, p.gravity, p.global_acceleration, p.steps, p.steps_at_start, p.time,
                    p.time_at_start, p.memory, p.statistics, p.faults);
}

std::shared_ptr<const LastingPart> lastingPartOf(const WorldState& world) {
    auto part = std::make_shared<LastingPart>();
    part->materials = world.materials;
    lastingArrays(*part) = lastingArrays(world.bodies);
    return part;
}

}  // namespace

void keepMoment(WorldState& world, MomentState& moment) {
    if (world.lasting == nullptr) world.lasting = lastingPartOf(world);
    moment.lasting = world.lasting;
    moment.settings = world.settings;
    movingArrays(moment) = movingArrays(world.bodies);
    sharedNames(moment) = sharedNames(world);
    moment.contact_generation = world.data.generation;
    moment.contacts = world.data.contacts;
    moment.batches = world.data.batches;
    moment.event_level = world.events.level;
    moment.events = world.events.events;
}

void loadMoment(const MomentState& moment, WorldState& world) {
    world.applySettings(moment.settings);
    if (world.lasting != moment.lasting) {
        world.materials = moment.lasting->materials;
        lastingArrays(world.bodies) = lastingArrays(*moment.lasting);
        world.bodies.linear_step.assign(world.bodies.slots(), Vec3::Zero());
        world.bodies.adoptSlots();
        world.lasting = moment.lasting;
    }
    movingArrays(world.bodies) = movingArrays(moment);
    sharedNames(world) = sharedNames(moment);
    world.data.generation = moment.contact_generation;
    world.data.contacts = moment.contacts;
    world.data.batches = moment.batches;
    world.events.level = moment.event_level;
    world.events.events = moment.events;
    // What the last step left for viewers is that of another step.
    world.data.bounds.clear();
    forgetPlaces(world.data.still);
    world.data.contacts_of.begin.clear();
    world.ties.forget();
    world.data.near_pairs.forget();
    world.trace.correction.clear();
    world.trace.shock_stage.clear();
}

}  // namespace cairn
