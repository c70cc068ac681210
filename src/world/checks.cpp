#include "world/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "batches/batch_motion.h"
#include "math/rotation.h"
#include "world/joints.h"
#include "world/motions.h"
#include "world/totals.h"

namespace cairn {

namespace {

/// Largest error of what is normalised in every step.
constexpr double unit_error = 1e-9;
/// Largest relative error of an inverse inertia in W, which follows the orientation.
constexpr double inertia_error = 1e-6;
/// Part of the kinetic energy that the resolution of a step may add: it resolves contacts one by one, and a contact of
/// bodies whose masses differ by a million is only nearly resolved.
constexpr double energy_error = 1e-4;

[[noreturn]] void fail(const WorldState& world, const std::string& what) {
    throw InvariantError(fmt::format("time step {}: {}", world.steps, what));
}

[[noreturn]] void failBody(const WorldState& world, BodyIndex i, const std::string& what) {
    const std::string& name = world.bodies.name[i];
    fail(world, fmt::format("body {}{} {}", i, name.empty() ? "" : fmt::format(" '{}'", name), what));
}

void checkInertia(const WorldState& world, BodyIndex i) {
    const BodyStorage& b = world.bodies;
    const Mat3& inverse = b.inertiaInv_W[i];
    const double scale = inverse.cwiseAbs().maxCoeff();
    if (!((inverse - inverse.transpose()).cwiseAbs().maxCoeff() <= unit_error * scale)) {
        failBody(world, i, "has an inertia that is not symmetric");
    }
    const Mat3 expected = toWorldInertia(b.inertiaInv_B[i], b.orientation[i]);
    if (!((inverse - expected).cwiseAbs().maxCoeff() <= inertia_error * scale)) {
        failBody(world, i, "has an inertia that does not follow its orientation");
    }
}

void checkBody(const WorldState& world, BodyIndex i) {
    const BodyStorage& b = world.bodies;
    if (!b.position[i].allFinite()) failBody(world, i, "has a position that is not finite");
    if (!b.v[i].allFinite() || !b.w[i].allFinite()) failBody(world, i, "has a velocity that is not finite");
    if (!(std::abs(b.orientation[i].norm() - 1) <= unit_error)) {
        failBody(world, i, fmt::format("has an orientation of length {}, not 1", b.orientation[i].norm()));
    }
    if (b.kind[i] == BodyKind::dynamic) checkInertia(world, i);
    const bool still = b.v[i].isZero(0) && b.w[i].isZero(0);
    const bool may_move = b.kind[i] == BodyKind::dynamic || lawOf(world, i) != nullptr;
    if (!still && (!may_move || b.asleep[i] != 0)) {
        failBody(world, i, b.kind[i] == BodyKind::fixed ? "is fixed but moves" : "sleeps but moves");
    }
}

std::string titleOf(std::size_t index, const Contact& c) {
    return fmt::format("contact {} of bodies {} and {}", index, c.a, c.b);
}

void checkBodiesOf(const WorldState& world, std::size_t index) {
    const Contact& c = world.data.contacts[index];
    const BodyStorage& b = world.bodies;
    const bool known = c.a < c.b && c.b < b.slots() && b.kind[c.a] != BodyKind::hole && b.kind[c.b] != BodyKind::hole;
    if (!known) fail(world, titleOf(index, c) + " names bodies that are not in the world");
}

void checkContact(const WorldState& world, std::size_t index) {
    const std::vector<Contact>& contacts = world.data.contacts;
    const Contact& c = contacts[index];
    // Written only when it is needed: that takes longer than all checks together.
    const auto title = [&] { return titleOf(index, c); };
    checkBodiesOf(world, index);
    if (!(std::abs(c.normal.norm() - 1) <= unit_error)) {
        fail(world, fmt::format("{} has a normal of length {}, not 1", title(), c.normal.norm()));
    }
    if (!c.point.allFinite() || !std::isfinite(c.distance) || !c.impulse.allFinite()) {
        fail(world, title() + " is not finite");
    }
    if (index == 0) return;
    const Contact& last = contacts[index - 1];
    if (c.a < last.a || (c.a == last.a && c.b < last.b)) fail(world, title() + " is out of order");
}

}  // namespace

void checkBatches(const WorldState& world) {
    const Batches& batches = world.data.batches;
    const std::vector<Contact>& contacts = world.data.contacts;
    if (batches.batch_of_contact.size() != contacts.size() || batches.contacts.size() != contacts.size()) {
        fail(world, "batches hold another number of contacts than there are");
    }
    std::vector<std::uint32_t> batch_of_body(world.bodies.slots(), UINT32_MAX);
    for (std::uint32_t batch = 0; batch < batches.size(); ++batch) {
        for (const BodyIndex body : batches[batch].bodies) {
            if (batch_of_body[body] != UINT32_MAX) failBody(world, body, "is in two batches");
            batch_of_body[body] = batch;
        }
        for (const std::uint32_t contact : batches[batch].contacts) {
            if (batches.batch_of_contact[contact] != batch) fail(world, fmt::format("contact {} is lost", contact));
        }
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        checkBodiesOf(world, i);
        for (const BodyIndex body : {contacts[i].a, contacts[i].b}) {
            if (world.bodies.kind[body] != BodyKind::dynamic) continue;
            if (batch_of_body[body] != batches.batch_of_contact[i]) {
                failBody(world, body, "is in another batch than its contact");
            }
        }
    }
}

bool mustKeepEnergy(WorldState& world) {
    if (hasMotors(world) || isDrivenByLaws(world)) return false;
    const ResolutionSettings& settings = world.settings.resolution;
    const bool bounded = settings.resolution == ResolutionKind::accelerated_sweeps;
    if (bounded || settings.restitution_law != RestitutionLaw::newton) return true;
    const std::vector<Contact>& contacts = world.data.contacts;
    const BodyState bodies = world.bodies.state();
    // The impact may reach what bounces by way of other contacts.
    const bool bounces =
        std::ranges::any_of(contacts, [](const Contact& c) { return c.restitution > 0 && c.static_friction > 0; });
    const bool strikes = std::ranges::any_of(
        contacts, [&](const Contact& c) { return normalVelocity(c, bodies) < -settings.restitution_threshold; });
    return !(bounces && strikes);
}

void checkEnergy(const WorldState& world, double before) {
    // Resolutions stop when contacts close slowly enough; what is left is less than gravity gives in one step.
    const double speed = (world.gravity + world.global_acceleration).norm() * world.settings.timeStep();
    double mass = 0;
    for (BodyIndex i = 0; i < world.bodies.slots(); ++i) {
        const double factor = std::max(1.0, std::abs(world.bodies.gravity_factor[i]));
        if (world.bodies.kind[i] == BodyKind::dynamic) mass += factor * factor * world.bodies.mass[i];
    }
    const double after = kineticEnergyOf(world.bodies).rounded();
    if (after <= before * (1 + energy_error) + 0.5 * mass * speed * speed) return;
    fail(world, fmt::format("the resolution raised the kinetic energy from {} to {} J", before, after));
}

void checkState(const WorldState& world) {
    for (BodyIndex i = 0; i < world.bodies.slots(); ++i) {
        if (world.bodies.kind[i] != BodyKind::hole) checkBody(world, i);
    }
    for (std::size_t i = 0; i < world.data.contacts.size(); ++i) checkContact(world, i);
}

}  // namespace cairn
