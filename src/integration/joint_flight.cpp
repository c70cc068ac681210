#include "integration/joint_flight.h"

#include <algorithm>
#include <cmath>

#include "joints/joint_kinds.h"
#include "math/rotation.h"

namespace cairn {

namespace {

// Errors are told in radians and as parts of the reach of the smaller body: of 10 cm, these are 1e-12, 1e-10 and 1e-9
// m.

/// Errors of a flight that are left alone: far below any use, above rounding.
constexpr double good_enough = 1e-11;

/// Errors of the positions that are left to the next flight.
constexpr double remains = 1e-9;

/// Errors at the start that are rounding of earlier steps; they go away with those of the flight.
constexpr double leftover = 1e-8;

constexpr int most_iterations = 12;

/// Part of a body's weight that a contact bears at least if it is one on which the body rests.
constexpr double resting_part = 1e-3;

/// Errors beyond this are taken back in parts, so that nothing is thrown into its neighbours.
constexpr double large_error = 1e-2;
constexpr double part_of_large = 0.2;

bool isAwake(const BodyStorage& bodies, std::span<const BodyIndex> group) {
    return std::ranges::any_of(group, [&](BodyIndex i) { return bodies.asleep[i] == 0; });
}

/// @param errors of all rows, block after block
double largestOf(std::span<const JointBlock> blocks, std::span<const double> errors) {
    double largest = 0;
    auto error = errors.begin();
    for (const JointBlock& block : blocks) {
        for (std::uint32_t i = 0; i < block.size; ++i) {
            largest = std::max(largest, std::abs(*error++) / unitOf(block, i));
        }
    }
    return largest;
}

/// Errors of all rows, block after block.
void collectErrors(std::span<const JointBlock> blocks, std::vector<double>& errors) {
    errors.clear();
    for (const JointBlock& block : blocks) {
        errors.insert(errors.end(), block.error.begin(), block.error.begin() + block.size);
    }
}

/// What a distance to a bound must at least be after a flight: what it was, if it was beyond before.
double allowed(double at_start, double unit) {
    return at_start < -leftover * unit ? at_start : 0;
}

/// How far ropes and limits are passed.
double largestBeyond(std::span<const JointBlock> blocks) {
    double largest = 0;
    for (const JointBlock& block : blocks) {
        for (std::uint32_t i = 0; i < block.bounds; ++i) {
            if (block.bound[i].is_motor) continue;
            const double beyond = std::max(-block.bound[i].to_upper, block.bound[i].to_lower);
            largest = std::max(largest, beyond / unitOf(block, block.bound[i]));
        }
    }
    return largest;
}

void evaluateAll(std::span<const std::uint32_t> group, std::span<const Joint> joints, const BodyStorage& bodies,
                 double time_step, std::span<JointBlock> blocks) {
    for (std::size_t i = 0; i < group.size(); ++i) {
        evaluate(joints, group[i], bodies, time_step, blocks[i]);
    }
}

/// How fast what turns with the free axes does so before the step.
void saveRotors(std::span<Joint> joints, const BodyStorage& bodies) {
    for (Joint& joint : joints) {
        if (!isActive(joint, bodies.kind)) continue;
        for (std::size_t i = 0; i < joint.free.size(); ++i) {
            if (!(joint.free[i].rotor_inertia > 0)) continue;
            const JointMotion motion = motionOf(joint, i, poseOf(bodies, joint.a), poseOf(bodies, joint.b));
            joint.free[i].rotor_speed = rateOf(motion.row, joint.a, joint.b, bodies);
        }
    }
}

/// Angles are known up to whole turns, and counted on from where they are expected. What turns slowly is expected where
/// it is.
void foreseeTurns(std::span<Joint> joints, const BodyStorage& bodies, double time_step) {
    constexpr double slowly = 1;  // [rad] in a step
    for (Joint& joint : joints) {
        if (joint.free.empty() || !isActive(joint, bodies.kind)) continue;
        const Vec3 other = joint.b == Joint::world ? Vec3(Vec3::Zero()) : Vec3(bodies.w[joint.b]);
        if (!((bodies.w[joint.a] - other).norm() * time_step > slowly)) continue;
        for (std::size_t i = 0; i < joint.free.size(); ++i) {
            if (!isAngle(joint.free[i].along)) continue;
            const JointMotion motion = motionOf(joint, i, poseOf(bodies, joint.a), poseOf(bodies, joint.b));
            joint.free[i].position = motion.position + time_step * rateOf(motion.row, joint.a, joint.b, bodies);
        }
    }
}

}  // namespace

bool JointFlight::isResting(const Contact& contact, const BodyStorage& bodies, const Motion& motion) {
    // A body of the last step may be gone.
    if (contact.b >= bodies.slots()) return false;
    const double gained = motion.acceleration.norm() * motion.time_step;
    const double largest_inverse = std::max(bodies.mass_inv[contact.a], bodies.mass_inv[contact.b]);
    if (!(contact.impulse.norm() * largest_inverse > resting_part * gained)) return false;
    const auto speed = [&](BodyIndex i) -> Vec3 {
        return bodies.v[i] + bodies.w[i].cross(contact.pointOn(i) - bodies.position[i]);
    };
    const double parting = contact.normal.dot(speed(contact.a) - speed(contact.b));
    return parting <= gained;
}

void JointFlight::saveKicks(std::span<const Joint> joints, const JointGroups& groups, std::size_t group,
                            const BodyStorage& bodies, const Motion& motion) {
    const auto pushed = [&](BodyIndex i) { return pushed_[i] != 0; };
    if (!motion.integration.exact_flight || std::ranges::any_of(groups.bodiesOf(group), pushed)) return;
    // What friction or a servo holds would be moved by half of what they take back only afterwards.
    const auto isHeld = [&](std::uint32_t j) {
        return std::ranges::any_of(joints[j].free, [](const FreeAxis& axis) { return axis.resists(); });
    };
    if (std::ranges::any_of(groups.jointsOf(group), isHeld)) return;
    for (std::uint32_t k = groups.body_begin[group]; k < groups.body_begin[group + 1]; ++k) {
        const Vec3 acceleration = accelerationOf(bodies, groups.bodies[k], motion.acceleration, motion.sleep);
        start_[k].half_kick = 0.5 * motion.time_step * acceleration;
    }
}

void JointFlight::begin(std::span<Joint> joints, const JointGroups& groups, const BodyStorage& bodies,
                        const Motion& motion) {
    if (groups.size() == 0) return;
    saveRotors(joints, bodies);
    pushed_.assign(bodies.slots(), 0);
    for (const Contact& contact : motion.contacts) {
        if (isResting(contact, bodies, motion)) pushed_[contact.a] = pushed_[contact.b] = 1;
    }
    start_.resize(groups.bodies.size());
    blocks_.resize(groups.joints.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (!isAwake(bodies, groups.bodiesOf(g))) continue;
        for (std::uint32_t k = groups.body_begin[g]; k < groups.body_begin[g + 1]; ++k) {
            const BodyIndex i = groups.bodies[k];
            start_[k] = {{bodies.position[i], bodies.orientation[i]}, {bodies.v[i], bodies.w[i]}, Vec3::Zero()};
        }
        saveKicks(joints, groups, g, bodies, motion);
        const std::span<const std::uint32_t> of_group = groups.jointsOf(g);
        evaluateAll(of_group, joints, bodies, motion.time_step,
                    std::span(blocks_).subspan(groups.joint_begin[g], of_group.size()));
    }
    foreseeTurns(joints, bodies, motion.time_step);
}

void JointFlight::finish(std::span<Joint> joints, const JointGroups& groups, BodyStorage& bodies,
                         const Motion& motion) {
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (!isAwake(bodies, groups.bodiesOf(g))) continue;
        const std::span<const BodyIndex> of_group = groups.bodiesOf(g);
        fly({groups.jointsOf(g), of_group, std::span(start_).subspan(groups.body_begin[g], of_group.size()),
             std::span(blocks_).subspan(groups.joint_begin[g], groups.jointsOf(g).size()), motion.time_step},
            joints, bodies);
    }
}

void JointFlight::setMasses(const Flight& flight, const BodyStorage& bodies) {
    response_.resize(flight.bodies.size());
    for (std::size_t k = 0; k < flight.bodies.size(); ++k) {
        const BodyIndex i = flight.bodies[k];
        response_[k] = {bodies.mass_inv[i], toWorldInertia(bodies.inertiaInv_B[i], flight.start[k].pose.orientation)};
    }
}

void JointFlight::fly(const Flight& flight, std::span<Joint> joints, BodyStorage& bodies) {
    setMasses(flight, bodies);
    system_.begin(flight.bodies, flight.blocks, JointSystem::Rows::rigid);
    system_.factorise(response_);
    velocity_.resize(flight.bodies.size());
    for (std::size_t k = 0; k < velocity_.size(); ++k) {
        velocity_[k] = flight.start[k].velocity;
        velocity_[k].v += flight.start[k].half_kick;
    }
    moveAgain(flight, bodies);
    collectErrors(flight.blocks, start_error_);
    if (!(largestOf(flight.blocks, start_error_) > leftover)) std::fill(start_error_.begin(), start_error_.end(), 0.0);
    received_.assign(system_.rows(), 0);
    now_.resize(flight.joints.size());
    double left = 0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        evaluateAll(flight.joints, joints, bodies, flight.time_step, now_);
        collectErrors(now_, impulses_);
        for (std::size_t i = 0; i < impulses_.size(); ++i) impulses_[i] -= start_error_[i];
        const double error = largestOf(now_, impulses_);
        left = error;
        if (!std::isfinite(error)) break;
        for (double& impulse : impulses_) impulse /= -flight.time_step;
        system_.solve(impulses_);
        if (error > good_enough) {
            system_.addImpulses(impulses_, velocity_);
            for (std::size_t i = 0; i < impulses_.size(); ++i) received_[i] += impulses_[i];
        }
        const double beyond = keepBounds(flight);
        if (!(error > good_enough || beyond > good_enough)) break;
        moveAgain(flight, bodies);
    }
    if (!(left <= large_error)) flyWithout(flight, bodies);
    report(flight, bodies, joints);
    // The velocity stage gives the whole kick.
    for (std::size_t k = 0; k < flight.bodies.size(); ++k) bodies.v[flight.bodies[k]] -= flight.start[k].half_kick;
    moveBack(flight, joints, bodies);
}

/// Where no impulses lead to joints that hold (bodies that turn too far in one step), the velocities stay as they are
/// and moveBack() does what it can.
void JointFlight::flyWithout(const Flight& flight, BodyStorage& bodies) {
    for (std::size_t k = 0; k < velocity_.size(); ++k) {
        velocity_[k] = flight.start[k].velocity;
        velocity_[k].v += flight.start[k].half_kick;
    }
    std::fill(received_.begin(), received_.end(), 0.0);
    for (JointBlock& block : flight.blocks) {
        for (BoundRow& bound : block.bound) bound.impulse = 0;
    }
    moveAgain(flight, bodies);
}

void JointFlight::report(const Flight& flight, const BodyStorage& bodies, std::span<Joint> joints) const {
    system_.report(received_);
    for (const JointBlock& block : flight.blocks) reportImpulses(block, bodies, joints[block.joint]);
}

void JointFlight::moveAgain(const Flight& flight, BodyStorage& bodies) const {
    for (std::size_t k = 0; k < flight.bodies.size(); ++k) {
        const BodyIndex i = flight.bodies[k];
        bodies.position[i] = flight.start[k].pose.position;
        bodies.orientation[i] = flight.start[k].pose.orientation;
        bodies.v[i] = velocity_[k].v;
        bodies.w[i] = velocity_[k].w;
        bodies.inertiaInv_W[i] = response_[k].inertia_inv;
        advancePosition(bodies, i, flight.time_step);
    }
}

/// Pushes back what passed a rope or a limit in flight; what was beyond it before is left to moveBack().
/// @return the largest distance beyond [rad, or a part of the reach]
double JointFlight::keepBounds(const Flight& flight) {
    double largest = 0;
    for (std::size_t k = 0; k < flight.blocks.size(); ++k) {
        JointBlock& block = flight.blocks[k];
        for (std::uint32_t i = 0; i < block.bounds; ++i) {
            BoundRow& bound = block.bound[i];
            if (bound.is_motor) continue;
            const double unit = unitOf(block, bound);
            const double above = allowed(bound.to_upper, unit) - now_[k].bound[i].to_upper;
            const double below = allowed(-bound.to_lower, unit) + now_[k].bound[i].to_lower;
            const bool at_upper = bound.impulse < 0 || (bound.impulse == 0 && above > good_enough * unit);
            const bool at_lower = bound.impulse > 0 || (bound.impulse == 0 && below > good_enough * unit);
            if (!at_upper && !at_lower) continue;
            const double per_impulse = system_.respondAlong(block, bound.row);
            if (!(per_impulse > 0)) continue;
            const double step = (at_upper ? -above : below) / (flight.time_step * per_impulse);
            const double sum = bound.impulse + step;
            const double impulse = at_upper ? std::min(sum, 0.0) : std::max(sum, 0.0);
            addResponse(impulse - bound.impulse);
            bound.impulse = impulse;
            largest = std::max(largest, (at_upper ? above : below) / unit);
        }
    }
    return largest;
}

void JointFlight::addResponse(double impulse) {
    for (std::size_t k = 0; k < velocity_.size(); ++k) {
        velocity_[k].v += impulse * system_.changes()[k].v;
        velocity_[k].w += impulse * system_.changes()[k].w;
    }
    for (std::size_t i = 0; i < received_.size(); ++i) received_[i] += impulse * system_.reactions()[i];
}

/// Newton's method on the positions alone.
void JointFlight::moveBack(const Flight& flight, std::span<const Joint> joints, BodyStorage& bodies) {
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        evaluateAll(flight.joints, joints, bodies, flight.time_step, now_);
        collectErrors(now_, impulses_);
        const double error = std::max(largestOf(now_, impulses_), largestBeyond(now_));
        if (!(error > remains) || !std::isfinite(error)) return;
        const double part = error > large_error ? std::max(part_of_large, large_error / error) : 1;
        for (std::size_t k = 0; k < flight.bodies.size(); ++k) {
            response_[k].inertia_inv = bodies.inertiaInv_W[flight.bodies[k]];
            velocity_[k] = {};
        }
        system_.begin(flight.bodies, now_, JointSystem::Rows::rigid);
        system_.factorise(response_);
        for (double& impulse : impulses_) impulse *= -part;
        system_.solve(impulses_);
        system_.addImpulses(impulses_, velocity_);
        received_.assign(system_.rows(), 0);
        for (JointBlock& block : now_) {
            for (std::uint32_t i = 0; i < block.bounds; ++i) pushBack(block, block.bound[i], part);
        }
        displace(flight, bodies);
        if (error > large_error) return;
    }
}

/// Moves a rope or a limit that is passed back to its end. @param part of the way
void JointFlight::pushBack(const JointBlock& block, const BoundRow& bound, double part) {
    if (bound.is_motor || (bound.to_upper >= 0 && bound.to_lower <= 0)) return;
    const double moved = system_.rateOf(block, bound.row, velocity_);
    const double wanted = part * (bound.to_upper < 0 ? bound.to_upper : bound.to_lower);
    const double per_impulse = system_.respondAlong(block, bound.row);
    if (per_impulse > 0) addResponse((wanted - moved) / per_impulse);
}

void JointFlight::displace(const Flight& flight, BodyStorage& bodies) const {
    for (std::size_t k = 0; k < flight.bodies.size(); ++k) {
        const BodyIndex i = flight.bodies[k];
        bodies.position[i] += velocity_[k].v;
        bodies.orientation[i] = (fromRotationVector(velocity_[k].w) * bodies.orientation[i]).normalized();
        bodies.inertiaInv_W[i] = toWorldInertia(bodies.inertiaInv_B[i], bodies.orientation[i]);
    }
}

}  // namespace cairn
