#include "joints/joint_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/tolerances.h"

namespace cairn {

namespace {

/// A joint seen in W.
struct Frame {
    Vec3 arm_a, arm_b;  ///< from the centres of mass to the anchors
    Vec3 apart;         ///< anchor of A − anchor of B
    Vec3 axis_a, axis_b;
    Vec3 side_1, side_2;  ///< across axis_b, turning with B: rows of one step and the next mean the same
};

/// Any unit vector across a unit vector, the same one for the same vector.
Vec3 across(const Vec3& axis) {
    Eigen::Index smallest = 0;
    axis.cwiseAbs().minCoeff(&smallest);
    return axis.cross(Vec3::Unit(smallest)).normalized();
}

Frame frameOf(const Joint& joint, const Pose& a, const Pose& b) {
    Frame f;
    f.arm_a = a.orientation * joint.anchor_a;
    f.arm_b = b.orientation * joint.anchor_b;
    f.apart = a.position + f.arm_a - b.position - f.arm_b;
    f.axis_a = a.orientation * joint.axis_a;
    f.axis_b = b.orientation * joint.axis_b;
    f.side_1 = b.orientation * across(joint.axis_b);
    f.side_2 = f.axis_b.cross(f.side_1);
    return f;
}

/// The velocity of A's anchor relative to the point of B where it is, along a direction that turns with B.
JointRow linearRow(const Frame& f, const Vec3& direction) {
    return {direction, f.arm_a.cross(direction), -(f.arm_b + f.apart).cross(direction)};
}

JointRow angularRow(const Vec3& direction) {
    return {Vec3::Zero(), direction, -direction};
}

/// How A turned from its rest relative to B, in W or in B's frame.
Quat turnInB(const Joint& joint, const Pose& a, const Pose& b) {
    return b.orientation.conjugate() * a.orientation * joint.rest.conjugate();
}

void add(JointBlock& block, const JointRow& row, double error) {
    block.rows[block.size] = row;
    block.error[block.size] = error;
    ++block.size;
}

/// The anchors are on each other.
void addPoint(const Frame& f, JointBlock& block) {
    for (Eigen::Index k = 0; k < 3; ++k) {
        const Vec3 direction = Vec3::Unit(k);
        // With both arms to their own anchors, as the error is the anchors' distance.
        add(block, {direction, f.arm_a.cross(direction), -f.arm_b.cross(direction)}, f.apart[k]);
    }
}

void addAxes(const Frame& f, JointBlock& block) {
    const Vec3 tilt = f.axis_b.cross(f.axis_a);
    for (const Vec3& direction : {f.side_1, f.side_2}) add(block, angularRow(direction), direction.dot(tilt));
}

void addOrientation(const Joint& joint, const Pose& a, const Pose& b, JointBlock& block) {
    const Quat turn = turnInB(joint, a, b);
    const Vec3 tilt = b.orientation * Vec3(turn.vec()) * (turn.w() < 0 ? -2.0 : 2.0);
    for (Eigen::Index k = 0; k < 3; ++k) add(block, angularRow(Vec3::Unit(k)), tilt[k]);
}

void addBeside(const Frame& f, JointBlock& block) {
    for (const Vec3& direction : {f.side_1, f.side_2}) {
        add(block, linearRow(f, direction), direction.dot(f.apart));
    }
}

/// Along the line between the anchors; where they meet every direction will do.
JointMotion lengthOf(const Frame& f) {
    const double length = f.apart.norm();
    const Vec3 direction = length > tiny_length ? Vec3(f.apart / length) : Vec3(Vec3::UnitZ());
    return {length, {direction, f.arm_a.cross(direction), -f.arm_b.cross(direction)}};
}

JointMotion angleOf(const Joint& joint, const Frame& f, const Pose& a, const Pose& b) {
    const Quat turn = turnInB(joint, a, b);
    const double angle = 2 * std::atan2(Vec3(turn.vec()).dot(joint.axis_b), turn.w());
    // Of the angles that are the same the one nearest to the middle of the limits.
    const bool limited = std::isfinite(joint.lower) && std::isfinite(joint.upper);
    const double middle = limited ? 0.5 * (joint.lower + joint.upper) : 0;
    constexpr double turn_around = 2 * std::numbers::pi;
    return {angle - turn_around * std::round((angle - middle) / turn_around), angularRow(f.axis_b)};
}

JointMotion motionIn(const Joint& joint, const Frame& f, const Pose& a, const Pose& b) {
    if (joint.kind == JointKind::hinge) return angleOf(joint, f, a, b);
    if (joint.kind == JointKind::slider) return {f.axis_b.dot(f.apart), linearRow(f, f.axis_b)};
    return lengthOf(f);
}

/// Bounds of the position, which become bounds of the rate: what is within them may come as far as they are.
void addLimits(const JointMotion& motion, double lower, double upper, double time_step, JointBlock& block) {
    BoundRow& bound = block.bound[block.bounds++];
    bound = {};
    bound.row = motion.row;
    bound.to_lower = lower - motion.position;
    bound.to_upper = upper - motion.position;
    bound.lowest = std::min(bound.to_lower, 0.0) / time_step;
    bound.highest = std::max(bound.to_upper, 0.0) / time_step;
    bound.strongest = Joint::infinite;
}

void addMotor(const JointMotion& motion, const Joint& joint, double time_step, JointBlock& block) {
    BoundRow& bound = block.bound[block.bounds++];
    bound = {};
    bound.row = motion.row;
    bound.lowest = bound.highest = joint.motor_speed;
    bound.strongest = joint.motor_limit * time_step;
    bound.is_motor = true;
}

}  // namespace

JointMotion motionOf(const Joint& joint, const Pose& a, const Pose& b) {
    return motionIn(joint, frameOf(joint, a, b), a, b);
}

void evaluate(const Joint& joint, const Pose& a, const Pose& b, double time_step, JointBlock& block) {
    const Frame f = frameOf(joint, a, b);
    block.a = joint.a;
    block.b = joint.b;
    block.size = block.bounds = 0;
    block.impulse = {};
    block.arm_a = f.arm_a;
    const JointMotion motion = motionIn(joint, f, a, b);
    switch (joint.kind) {
        case JointKind::distance:
            add(block, motion.row, motion.position - joint.length);
            break;
        case JointKind::rope:
            addLimits(motion, -Joint::infinite, joint.length, time_step, block);
            break;
        case JointKind::ball:
            addPoint(f, block);
            break;
        case JointKind::hinge:
            addPoint(f, block);
            addAxes(f, block);
            break;
        case JointKind::slider:
            addOrientation(joint, a, b, block);
            addBeside(f, block);
            break;
        case JointKind::fixed:
            addPoint(f, block);
            addOrientation(joint, a, b, block);
            break;
    }
    // The motor first, so that a limit has the last word.
    if (joint.hasMotor()) addMotor(motion, joint, time_step, block);
    const bool moves = joint.kind == JointKind::hinge || joint.kind == JointKind::slider;
    if (moves && (std::isfinite(joint.lower) || std::isfinite(joint.upper))) {
        addLimits(motion, joint.lower, joint.upper, time_step, block);
    }
}

void reportImpulses(const JointBlock& block, Joint& joint) {
    Vec3 linear = Vec3::Zero();
    Vec3 angular = Vec3::Zero();
    const auto sum = [&](const JointRow& row, double impulse) {
        linear += impulse * row.linear;
        angular += impulse * row.angular_a;
    };
    for (std::uint32_t i = 0; i < block.size; ++i) sum(block.rows[i], block.impulse[i]);
    for (std::uint32_t i = 0; i < block.bounds; ++i) sum(block.bound[i].row, block.bound[i].impulse);
    joint.impulse += linear;
    joint.angular_impulse += angular - block.arm_a.cross(linear);
}

}  // namespace cairn
