#include "world/motions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "batches/batch_motion.h"
#include "integration/integration.h"
#include "math/rotation.h"

namespace cairn {

namespace {

/// Simulated time after so many steps, as stepWorld() reckons it.
double timeAfter(const WorldState& world, std::int64_t steps) {
    return world.time_at_start + static_cast<double>(steps - world.steps_at_start) / world.settings.steps_per_second;
}

/// The shape's frame of a body by its law. @param time [s]
Pose poseAt(const DrivenBody& driven, double time) {
    const Excursion excursion = driven.curve->at(time - driven.start);
    const Quat turn = fromRotationVector(excursion.turn);
    const Quat orientation = (turn * driven.pose.orientation).normalized();
    const Vec3 pivot = driven.pose.toOuter(driven.pivot) + excursion.displacement;
    return {pivot - orientation * driven.pivot, orientation};
}

/// The rotation vector that leads from one orientation to another, over the shorter way.
Vec3 rotationBetween(const Quat& from, const Quat& to) {
    Quat turn = to * from.conjugate();
    if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
    const double sine = turn.vec().norm();
    // Twice the angle over its sine; where both vanish their quotient does not.
    const double factor = sine < 1e-9 ? 2.0 : 2 * std::atan2(sine, turn.w()) / sine;
    return factor * turn.vec();
}

/// Wakes the batches that touch a body that moves: what sleeps would be left behind, and slow bodies would lose their
/// velocity by falling asleep.
void wakeCarried(WorldState& world) {
    StepData& data = world.data;
    BodyState bodies = world.bodies.state();
    bodies.surface = data.surface;
    data.carried.assign(bodies.size(), Carried::not_at_all);
    std::vector<Carried> carried(data.batches.size(), Carried::not_at_all);
    const auto carries = [&](BodyIndex i) {
        if (!bodies.isFixed(i) || isAtRest(bodies, i)) return Carried::not_at_all;
        const DrivenBody* driven = lawOf(world, i);
        return driven == nullptr || driven->curve->isEven() ? Carried::evenly : Carried::unevenly;
    };
    for (std::size_t i = 0; i < data.contacts.size(); ++i) {
        const Contact& contact = data.contacts[i];
        Carried& batch = carried[data.batches.batch_of_contact[i]];
        batch = std::max({batch, carries(contact.a), carries(contact.b)});
    }
    for (std::size_t batch = 0; batch < carried.size(); ++batch) {
        if (carried[batch] == Carried::not_at_all) continue;
        for (const BodyIndex body : data.batches[batch].bodies) {
            data.carried[body] = carried[batch];
            bodies.wake(body, WakeReason::changed);
        }
    }
}

/// Finds how surfaces move as their bodies stand now.
void turnSurfaces(WorldState& world) {
    const BodyStorage& b = world.bodies;
    std::vector<Vec3>& surface = world.data.surface;
    surface.clear();
    if (std::ranges::all_of(b.surface_velocity, [](const Vec3& v) { return v.isZero(0); })) return;
    surface.resize(b.slots(), Vec3::Zero());
    for (BodyIndex i = 0; i < b.slots(); ++i) {
        if (b.kind[i] == BodyKind::fixed) surface[i] = b.shapePose(i).orientation * b.surface_velocity[i];
    }
}

/// What bodies feel in a frame that moves: the opposite of its mean acceleration from step to step, so that a world
/// whose ground moves and one whose frame does agree.
Vec3 frameAcceleration(const WorldState& world) {
    if (!world.frame) return Vec3::Zero();
    const auto at = [&](std::int64_t steps) {
        return world.frame->curve->at(std::max(0.0, timeAfter(world, steps) - world.frame->start)).displacement;
    };
    const double step = world.settings.timeStep();
    return -(at(world.steps + 1) - 2 * at(world.steps) + at(world.steps - 1)) / (step * step);
}

/// Gravity in the step that comes after so many: at its middle, so that a velocity gets what the law's integral has.
Vec3 gravityIn(const WorldState& world, std::int64_t steps) {
    const GravityLaw& law = *world.gravity_law;
    const double middle = timeAfter(world, steps) + 0.5 * world.settings.timeStep();
    return law.gravity + law.curve->at(std::max(0.0, middle - law.start)).displacement;
}

}  // namespace

void moveByLaw(WorldState& world) {
    BodyStorage& b = world.bodies;
    for (const DrivenBody& driven : world.driven) {
        if (world.part.isLast()) {
            b.setShapePose(driven.body, poseAt(driven, timeAfter(world, world.steps)));
            continue;
        }
        // Evenly within a step.
        const BodyIndex i = driven.body;
        const Pose shape = b.shapeInBody(i);
        Pose pose{b.position[i] + b.v[i] * world.part.length, b.orientation[i]};
        if (!b.w[i].isZero(0)) rotateUniformly(pose.orientation, b.w[i], world.part.length);
        b.setShapePose(i, pose.toOuter(shape));
    }
}

void advanceLaws(WorldState& world) {
    BodyStorage& b = world.bodies;
    const double step = world.settings.timeStep();
    for (const DrivenBody& driven : world.driven) {
        if (!world.part.isLast()) break;
        const BodyIndex i = driven.body;
        const Pose next = poseAt(driven, timeAfter(world, world.steps + 1)).toOuter(b.shapeInBody(i).inverse());
        b.v[i] = (next.position - b.position[i]) / step;
        b.w[i] =
            driven.curve->turns() ? Vec3(rotationBetween(b.orientation[i], next.orientation) / step) : Vec3::Zero();
    }
    world.data.carried.clear();
    turnSurfaces(world);
    if (isDrivenByLaws(world)) wakeCarried(world);
    if (world.frame_acceleration.isZero(0) || !world.part.isFirst()) return;
    for (BodyIndex i = 0; i < b.slots(); ++i) {
        if (b.kind[i] == BodyKind::dynamic) b.force[i] += b.mass[i] * world.frame_acceleration;
    }
}

void beginLaws(WorldState& world) {
    world.frame_acceleration = frameAcceleration(world);
    if (!world.frame_acceleration.isZero(0)) world.wakeAll();
    if (!world.gravity_law) return;
    const Vec3 gravity = gravityIn(world, world.steps - 1);
    if (gravity == world.gravity) return;
    world.gravity = gravity;
    world.wakeAll();
}

Vec3 lastingGravity(const Vec3& gravity, const std::optional<GravityLaw>& law) {
    if (!law) return gravity;
    const std::optional<double> end = law->curve->end();
    return end ? Vec3(law->gravity + law->curve->at(*end).displacement) : Vec3::Zero();
}

bool isGravityChanging(const WorldState& world) {
    if (!world.gravity_law) return false;
    const std::optional<double> end = world.gravity_law->curve->end();
    return !end || timeAfter(world, world.steps) < world.gravity_law->start + *end;
}

void addLaw(WorldState& world, DrivenBody driven) {
    const auto place = std::ranges::upper_bound(world.driven, driven.body, {}, &DrivenBody::body);
    world.driven.insert(place, std::move(driven));
}

void removeLaw(WorldState& world, BodyIndex body) {
    if (lawOf(world, body) == nullptr) return;
    std::erase_if(world.driven, [&](const DrivenBody& driven) { return driven.body == body; });
    world.bodies.v[body].setZero();
    world.bodies.w[body].setZero();
}

void requireNoLaw(const WorldState& world, BodyIndex body) {
    if (lawOf(world, body) == nullptr) return;
    throw InputError(fmt::format("body {} moves by a law; stop it with World::stopMotion first", body));
}

const DrivenBody* lawOf(const WorldState& world, BodyIndex body) {
    const auto found = std::ranges::lower_bound(world.driven, body, {}, &DrivenBody::body);
    return found == world.driven.end() || found->body != body ? nullptr : &*found;
}

bool isDrivenByLaws(const WorldState& world) {
    return !world.driven.empty() || !world.data.surface.empty();
}

}  // namespace cairn
