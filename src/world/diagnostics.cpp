#include "world/diagnostics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "activity/sleeping.h"
#include "integration/integration.h"
#include "joints/joint_kinds.h"
#include "messages/packing.h"
#include "resolution/contact_law.h"
#include "world/totals.h"

namespace cairn {

namespace {

using Fold = DiagnosticsField::Fold;

template <auto Member>
double& scalar(Diagnostics& d) {
    return d.*Member;
}
template <auto Member, int Axis>
double& component(Diagnostics& d) {
    return (d.*Member)[Axis];
}

constexpr std::array<DiagnosticsField, 34> diagnostics_fields = {{
    {"momentum_x", "N·s", Fold::newest, component<&Diagnostics::momentum, 0>},
    {"momentum_y", "N·s", Fold::newest, component<&Diagnostics::momentum, 1>},
    {"momentum_z", "N·s", Fold::newest, component<&Diagnostics::momentum, 2>},
    {"angular_momentum_x", "N·m·s", Fold::newest, component<&Diagnostics::angular_momentum, 0>},
    {"angular_momentum_y", "N·m·s", Fold::newest, component<&Diagnostics::angular_momentum, 1>},
    {"angular_momentum_z", "N·m·s", Fold::newest, component<&Diagnostics::angular_momentum, 2>},
    {"fixed_impulse_x", "N·s", Fold::sum, component<&Diagnostics::fixed_impulse, 0>},
    {"fixed_impulse_y", "N·s", Fold::sum, component<&Diagnostics::fixed_impulse, 1>},
    {"fixed_impulse_z", "N·s", Fold::sum, component<&Diagnostics::fixed_impulse, 2>},
    {"fixed_angular_impulse_x", "N·m·s", Fold::sum, component<&Diagnostics::fixed_angular_impulse, 0>},
    {"fixed_angular_impulse_y", "N·m·s", Fold::sum, component<&Diagnostics::fixed_angular_impulse, 1>},
    {"fixed_angular_impulse_z", "N·m·s", Fold::sum, component<&Diagnostics::fixed_angular_impulse, 2>},
    {"force_impulse_x", "N·s", Fold::sum, component<&Diagnostics::force_impulse, 0>},
    {"force_impulse_y", "N·s", Fold::sum, component<&Diagnostics::force_impulse, 1>},
    {"force_impulse_z", "N·s", Fold::sum, component<&Diagnostics::force_impulse, 2>},
    {"force_angular_impulse_x", "N·m·s", Fold::sum, component<&Diagnostics::force_angular_impulse, 0>},
    {"force_angular_impulse_y", "N·m·s", Fold::sum, component<&Diagnostics::force_angular_impulse, 1>},
    {"force_angular_impulse_z", "N·m·s", Fold::sum, component<&Diagnostics::force_angular_impulse, 2>},
    {"momentum_error", "N·s", Fold::largest, scalar<&Diagnostics::momentum_error>},
    {"angular_momentum_error", "N·m·s", Fold::largest, scalar<&Diagnostics::angular_momentum_error>},
    {"energy", "J", Fold::newest, scalar<&Diagnostics::energy>},
    {"energy_flight", "J", Fold::sum, scalar<&Diagnostics::energy_flight>},
    {"energy_forces", "J", Fold::sum, scalar<&Diagnostics::energy_forces>},
    {"energy_damping", "J", Fold::sum, scalar<&Diagnostics::energy_damping>},
    {"energy_friction", "J", Fold::sum, scalar<&Diagnostics::energy_friction>},
    {"energy_restitution", "J", Fold::sum, scalar<&Diagnostics::energy_restitution>},
    {"energy_joints", "J", Fold::sum, scalar<&Diagnostics::energy_joints>},
    {"energy_drives", "J", Fold::sum, scalar<&Diagnostics::energy_drives>},
    {"energy_correction", "J", Fold::sum, scalar<&Diagnostics::energy_correction>},
    {"energy_sleep", "J", Fold::sum, scalar<&Diagnostics::energy_sleep>},
    {"energy_error", "J", Fold::sum, scalar<&Diagnostics::energy_error>},
    {"signorini", "J", Fold::largest, scalar<&Diagnostics::signorini>},
    {"de_saxce", "J", Fold::largest, scalar<&Diagnostics::de_saxce>},
    {"dissipation", "J", Fold::largest, scalar<&Diagnostics::dissipation>},
}};

Vec3 accelerationOf(const WorldState& world) {
    return world.gravity + world.global_acceleration;
}

/// Sums the work of gravity, its damping and the frame. A force's work is its impulse times the mean of the velocities
/// before and after.
void sumForces(const WorldState& world, MeasuredSums& sums) {
    const BodyStorage& b = world.bodies;
    const MeasuredData& data = world.data.measured;
    const SleepSettings& sleep = world.settings.sleep;
    const Vec3 step = accelerationOf(world) * world.part.length;
    const Vec3 frame_step = world.frame_acceleration * world.part.length;
    for (BodyIndex i = 0; i < b.slots(); ++i) {
        if (b.kind[i] != BodyKind::dynamic || b.asleep[i] != 0) continue;
        const double work = b.gravity_factor[i] * b.mass[i] * step.dot(0.5 * (data.v[i] + b.v[i]));
        sums.flight.add(work);
        sums.drives.add(b.mass[i] * frame_step.dot(0.5 * (data.v[i] + b.v[i])));
        const double part = gravityPartOf(b, i, data.v[i], data.w[i], sleep);
        if (part < 1) sums.damping.add(-sleep.damping * work);
    }
}

/// What a contact did, in its coordinates.
struct ContactWork {
    Vec3 impulse;    ///< on A [N·s]
    Vec3 before;     ///< ϑA − ϑB before the resolution [m/s]
    Vec3 after;      ///< and after it [m/s]
    double turning;  ///< work of its angular impulse [J]
};

/// Of a body's surface over the body at a contact [m/s, W].
Vec3 surfaceVelocity(const WorldState& world, const Contact& c, BodyIndex body) {
    if (world.data.surface.empty()) return Vec3::Zero();
    const Vec3& surface = world.data.surface[body];
    return surface - c.normal.dot(surface) * c.normal;
}

ContactWork workOf(const WorldState& world, const Contact& c) {
    const BodyStorage& b = world.bodies;
    const MeasuredData& data = world.data.measured;
    const Mat3 to_contact = contactBasis(c.normal).transpose();
    const Vec3 surface = surfaceVelocity(world, c, c.a) - surfaceVelocity(world, c, c.b);
    const auto at = [&](std::span<const Vec3> v, std::span<const Vec3> w) -> Vec3 {
        const Vec3 r_a = c.pointOn(c.a) - b.position[c.a];
        const Vec3 r_b = c.pointOn(c.b) - b.position[c.b];
        return to_contact * (v[c.a] + w[c.a].cross(r_a) - v[c.b] - w[c.b].cross(r_b) + surface);
    };
    const Vec3 turning = 0.5 * (data.w[c.a] + b.w[c.a] - data.w[c.b] - b.w[c.b]);
    return {to_contact * c.impulse, at(data.v, data.w), at(b.v, b.w), c.angular_impulse.dot(turning)};
}

void addResiduals(const ContactWork& work, const Contact& c, const ResolutionSettings& settings, MeasuredSums& sums) {
    const Vec3& lambda = work.impulse;
    const double wanted = ContactLaw::separatingSpeed(settings, c, work.before[0]);
    const double normal = work.after[0] - wanted;
    const double slip = std::sqrt(work.after[1] * work.after[1] + work.after[2] * work.after[2]);
    const double tangential = std::sqrt(lambda[1] * lambda[1] + lambda[2] * lambda[2]);
    const double mu = c.kinetic_friction;
    const double sliding = lambda[1] * work.after[1] + lambda[2] * work.after[2];
    sums.signorini = std::max(sums.signorini, std::abs(lambda[0] * normal));
    sums.de_saxce = std::max(sums.de_saxce, std::abs(lambda[0] * (normal + mu * slip) + sliding));
    sums.dissipation = std::max(sums.dissipation, std::abs(mu * std::abs(lambda[0]) - tangential) * slip);
}

void sumContacts(const WorldState& world, MeasuredSums& sums) {
    const BodyStorage& b = world.bodies;
    for (const Contact& c : world.data.contacts) {
        if (c.impulse.isZero(0) && c.angular_impulse.isZero(0)) continue;
        const ContactWork work = workOf(world, c);
        const Vec3 mean = 0.5 * (work.before + work.after);
        sums.restitution.add(work.impulse[0] * mean[0]);
        sums.friction.add(work.impulse[1] * mean[1] + work.impulse[2] * mean[2] + work.turning);
        addResiduals(work, c, world.settings.resolution, sums);
        const bool a_moves = b.kind[c.a] == BodyKind::dynamic;
        if (a_moves == (b.kind[c.b] == BodyKind::dynamic)) continue;
        const double sign = a_moves ? 1 : -1;
        sums.fixed.add(sign * c.impulse);
        sums.fixed_angular.add(sign * (c.pointOn(a_moves ? c.a : c.b).cross(c.impulse) + c.angular_impulse));
        const BodyIndex wall = a_moves ? c.b : c.a;
        const Vec3 at_wall =
            b.v[wall] + b.w[wall].cross(c.pointOn(wall) - b.position[wall]) + surfaceVelocity(world, c, wall);
        sums.drives.add(sign * (c.impulse.dot(at_wall) + c.angular_impulse.dot(b.w[wall])));
    }
}

void sumJoints(const WorldState& world, MeasuredSums& sums) {
    const BodyStorage& b = world.bodies;
    sums.has_joints = !world.data.broken.empty();
    for (const Joint& joint : world.joints) {
        if (!isActive(joint, b.kind)) continue;
        sums.has_joints = true;
        if (entryOf(joint.kind).uses.couples) {
            sums.fixed.add(-joint.fixed_impulse);
            sums.fixed_angular.add(-joint.fixed_angular_impulse);
            continue;
        }
        const bool a_moves = isMovable(b.kind, joint.a);
        if (a_moves == isMovable(b.kind, joint.b)) continue;
        const double sign = a_moves ? 1 : -1;
        const Vec3 anchor = b.position[joint.a] + b.orientation[joint.a] * joint.anchor_a;
        const Vec3 impulse = joint.impulse - joint.booked_impulse;
        const Vec3 angular_impulse = joint.angular_impulse - joint.booked_angular_impulse;
        sums.fixed.add(sign * impulse);
        sums.fixed_angular.add(sign * (anchor.cross(impulse) + angular_impulse));
    }
}

/// Sums what this rank has at a point.
void sumOwn(const WorldState& world, MeasuredSums& sums) {
    sums.kinetic = kineticEnergyOf(world.bodies);
    sums.potential = potentialEnergyOf(world.bodies, accelerationOf(world));
    sums.momentum = linearMomentumOf(world.bodies);
    sums.angular_momentum = angularMomentumOf(world.bodies);
    if (sums.point == Measured::forces) sumForces(world, sums);
    if (sums.point != Measured::resolution) return;
    sumContacts(world, sums);
    sumJoints(world, sums);
}

/// Calls visit(sum) for all sums.
template <class Visit>
void forSums(MeasuredSums& sums, const Visit& visit) {
    for (ExactSum* sum : {&sums.kinetic, &sums.potential, &sums.flight, &sums.damping, &sums.drives, &sums.friction,
                          &sums.restitution}) {
        visit(*sum);
    }
    for (ExactVectorSum* sum : {&sums.momentum, &sums.angular_momentum, &sums.fixed, &sums.fixed_angular}) {
        sum->forAxes(visit);
    }
}

/// Adds what other ranks summed at the same points.
void addOthers(Ranks& ranks, std::vector<MeasuredSums>& own) {
    std::vector<std::byte> message;
    for (MeasuredSums& sums : own) {
        forSums(sums, [&](const ExactSum& sum) { pack(message, sum); });
        pack(message, sums.signorini);
        pack(message, sums.de_saxce);
        pack(message, sums.dissipation);
        pack(message, sums.has_joints);
    }
    const Ranks::Messages told = tellAll(ranks, message);
    for (std::size_t rank = 0; rank < told.size(); ++rank) {
        if (rank == static_cast<std::size_t>(ranks.rank())) continue;
        Unpacker in(told[rank]);
        for (MeasuredSums& sums : own) {
            forSums(sums, [&](ExactSum& sum) { sum.add(in.getSum()); });
            sums.signorini = std::max(sums.signorini, in.get<double>());
            sums.de_saxce = std::max(sums.de_saxce, in.get<double>());
            sums.dissipation = std::max(sums.dissipation, in.get<double>());
            sums.has_joints = in.get<bool>() || sums.has_joints;
        }
    }
}

/// Energy and momentum of all bodies.
struct StepTotals {
    double kinetic;         ///< [J]
    double energy;          ///< kinetic and potential [J]
    Vec3 momentum;          ///< [N·s, W]
    Vec3 angular_momentum;  ///< about the origin [N·m·s, W]
};

StepTotals totalsOf(const MeasuredSums& sums) {
    const double kinetic = sums.kinetic.rounded();
    return {kinetic, kinetic + sums.potential.rounded(), sums.momentum.rounded(), sums.angular_momentum.rounded()};
}

void accountResolution(const MeasuredSums& sums, double change, Diagnostics& d) {
    const double friction = sums.friction.rounded();
    const double restitution = sums.restitution.rounded();
    const double drives = sums.drives.rounded();
    d.energy_friction += friction;
    d.energy_restitution += restitution;
    d.energy_drives += drives;
    if (sums.has_joints) d.energy_joints += change - friction - restitution - drives;
    d.fixed_impulse += sums.fixed.rounded();
    d.fixed_angular_impulse += sums.fixed_angular.rounded();
    d.signorini = std::max(d.signorini, sums.signorini);
    d.de_saxce = std::max(d.de_saxce, sums.de_saxce);
    d.dissipation = std::max(d.dissipation, sums.dissipation);
}

/// Splits the change of the kinetic energy among gravity, its damping, the frame and all other forces.
void accountForces(const MeasuredSums& sums, double change, Diagnostics& d) {
    const double gravity = sums.flight.rounded();
    const double damped = sums.damping.rounded();
    const double driven = sums.drives.rounded();
    d.energy_flight += gravity;
    d.energy_damping += damped;
    d.energy_drives += driven;
    d.energy_forces += change - gravity - damped - driven;
}

/// Puts on its account what happened up to a point.
void account(const MeasuredSums& sums, const StepTotals& last, const StepTotals& now, Diagnostics& d) {
    switch (sums.point) {
        case Measured::begin:
            break;
        case Measured::laws:
            // What is high or low got another potential energy from a gravity that changed.
            d.energy_drives += now.energy - last.energy;
            break;
        case Measured::positions:
            d.energy_flight += now.energy - last.energy;
            break;
        case Measured::correction:
            d.energy_correction += now.energy - last.energy;
            // Pairs of bodies pay with equal and opposite impulses: what is left came from fixed bodies.
            d.fixed_impulse += now.momentum - last.momentum;
            break;
        case Measured::forces:
            accountForces(sums, now.kinetic - last.kinetic, d);
            d.force_impulse += now.momentum - last.momentum;
            d.force_angular_impulse += now.angular_momentum - last.angular_momentum;
            break;
        case Measured::damping:
            d.energy_damping += now.kinetic - last.kinetic;
            d.force_impulse += now.momentum - last.momentum;
            d.force_angular_impulse += now.angular_momentum - last.angular_momentum;
            break;
        case Measured::resolution:
            accountResolution(sums, now.kinetic - last.kinetic, d);
            break;
        case Measured::completion:
            // The second half of the motion under the forces.
            d.energy_flight += now.energy - last.energy;
            d.force_angular_impulse += now.angular_momentum - last.angular_momentum;
            break;
        case Measured::sleep:
            d.energy_sleep = now.energy - last.energy;
            break;
    }
}

void finish(WorldState& world) {
    std::vector<MeasuredSums>& sums = world.data.measured.sums;
    if (world.shared != nullptr) addOthers(world.shared->ranks(), sums);
    Diagnostics& d = world.statistics.diagnostics;
    const StepTotals begin = totalsOf(sums.front());
    StepTotals now = begin;
    for (const MeasuredSums& point : sums) {
        const StepTotals last = std::exchange(now, totalsOf(point));
        account(point, last, now, d);
    }
    d.momentum = now.momentum;
    d.angular_momentum = now.angular_momentum;
    d.momentum_error = (now.momentum - begin.momentum - d.fixed_impulse - d.force_impulse).norm();
    d.angular_momentum_error =
        (now.angular_momentum - begin.angular_momentum - d.fixed_angular_impulse - d.force_angular_impulse).norm();
    d.energy = now.energy;
    const double explained = d.energy_flight + d.energy_forces + d.energy_damping + d.energy_friction +
                             d.energy_restitution + d.energy_joints + d.energy_drives + d.energy_correction +
                             d.energy_sleep;
    d.energy_error = now.energy - begin.energy - explained;
}

}  // namespace

std::span<const DiagnosticsField> diagnosticsFields() {
    return diagnostics_fields;
}

void measure(WorldState& world, Measured point) {
    MeasuredData& data = world.data.measured;
    if (point == Measured::begin) data.sums.clear();
    MeasuredSums& sums = data.sums.emplace_back();
    sums.point = point;
    // What all ranks have, as long as the world is whole, the first one tells.
    const bool is_told = world.shared == nullptr || !world.shared->isWhole() || world.shared->ranks().rank() == 0;
    if (is_told) sumOwn(world, sums);
    data.v.assign(world.bodies.v.begin(), world.bodies.v.end());
    data.w.assign(world.bodies.w.begin(), world.bodies.w.end());
    if (point == Measured::sleep) finish(world);
}

}  // namespace cairn
