#include "joints/joint_rows.h"

#include <algorithm>
#include <cmath>

#include "joints/joint_axes.h"
#include "joints/joint_kinds.h"

namespace cairn {

namespace {

void beginBlock(const Joint& joint, JointBlock& block) {
    block.a = joint.a;
    block.b = joint.b;
    block.size = block.bounds = block.redundant = 0;
    block.impulse = {};
    block.bound.clear();
    block.ends.clear();
}

/// The smaller body decides; a coupling has those of the joints that it couples, of which one stands for both.
double reachOf(const Joint& joint, const BodyStorage& bodies) {
    double reach = Joint::infinite;
    for (const BodyIndex i : {joint.a, joint.b}) {
        if (isMovable(bodies.kind, i)) reach = std::min(reach, bodies.r_max[i]);
    }
    return reach < Joint::infinite ? reach : 1;
}

double unitOf(const Vec3& linear, double reach) {
    return linear.isZero(0) ? 1 : reach;
}

/// The axis after which limits of a ball's turn about its axis are reckoned: without the swing.
bool isTwist(const Joint& joint, const FreeAxis& axis) {
    return joint.kind == JointKind::ball && axis.along == JointAlong::turn_x;
}

/// Drives first, so that a limit has the last word.
void addFreeAxes(const Joint& joint, const JointPlacement& at, double time_step, JointBlock& block) {
    const JointKindEntry& entry = entryOf(joint.kind);
    for (std::size_t i = 0; i < joint.free.size(); ++i) {
        const FreeAxis& axis = joint.free[i];
        const JointMotion motion = entry.motion(joint, at, axis);
        block.position[i] = motion.position;
        addDrives(motion, axis, time_step, block);
        if (!axis.isLimited()) continue;
        addLimits(isTwist(joint, axis) ? twistOf(joint, at) : motion, axis.lower, axis.upper, time_step, block);
        block.bound.back().restitution = axis.restitution;
    }
    if (joint.cone < Joint::infinite) addLimits(swingOf(at), -Joint::infinite, joint.cone, time_step, block);
    if (joint.kind == JointKind::rope) addLimits(lengthOf(at), -Joint::infinite, joint.length, time_step, block);
}

/// The position of the second joint less that which the first one asks for must be zero.
void evaluateCoupling(const Joint& joint, std::span<const Joint> joints, const BodyStorage& bodies, JointBlock& block) {
    beginBlock(joint, block);
    block.arm_a.setZero();
    double error = -joint.offset;
    const auto addOf = [&](const Joint& coupled, std::size_t axis, double factor) {
        const JointMotion motion = motionOf(coupled, axis, poseOf(bodies, coupled.a), poseOf(bodies, coupled.b));
        error += factor * motion.position;
        block.ends.push_back({coupled.a, factor * motion.row.linear, factor * motion.row.angular_a});
        block.ends.push_back({coupled.b, -factor * motion.row.linear, factor * motion.row.angular_b});
    };
    addOf(joints[joint.first], joint.first_axis, -joint.ratio);
    addOf(joints[joint.second], joint.second_axis, 1);
    add(block, {}, error);
}

/// What a coupling gives to bodies that cannot move and to the world.
void addToFixed(const JointBlock& block, const BodyStorage& bodies, Joint& joint) {
    for (const RowEnd& end : block.ends) {
        if (isMovable(bodies.kind, end.body)) continue;
        const Vec3 linear = block.impulse[0] * end.linear;
        joint.fixed_impulse += linear;
        joint.fixed_angular_impulse += poseOf(bodies, end.body).position.cross(linear) + block.impulse[0] * end.angular;
    }
}

}  // namespace

double unitOf(const JointBlock& block, std::uint32_t row) {
    // The error of a coupling is one of its second joint.
    return unitOf(block.ends.empty() ? block.rows[row].linear : block.ends[2].linear, block.reach);
}

double unitOf(const JointBlock& block, const BoundRow& bound) {
    return unitOf(bound.row.linear, block.reach);
}

JointMotion motionOf(const Joint& joint, std::size_t axis, const Pose& a, const Pose& b) {
    const JointPlacement at = placementOf(joint, a, b);
    if (axis < joint.free.size()) return entryOf(joint.kind).motion(joint, at, joint.free[axis]);
    return lengthOf(at);
}

double rateOf(const JointRow& row, BodyIndex a, BodyIndex b, const BodyStorage& bodies) {
    const bool two = b != Joint::world;
    const Vec3 v_b = two ? bodies.v[b] : Vec3(Vec3::Zero());
    const Vec3 w_b = two ? bodies.w[b] : Vec3(Vec3::Zero());
    return row.linear.dot(bodies.v[a] - v_b) + row.angular_a.dot(bodies.w[a]) + row.angular_b.dot(w_b);
}

void evaluate(const Joint& joint, const Pose& a, const Pose& b, double time_step, JointBlock& block) {
    const JointPlacement at = placementOf(joint, a, b);
    beginBlock(joint, block);
    block.arm_a = at.arm_a;
    entryOf(joint.kind).keep(joint, at, block);
    addFreeAxes(joint, at, time_step, block);
}

void evaluate(std::span<const Joint> joints, std::uint32_t slot, const BodyStorage& bodies, double time_step,
              JointBlock& block) {
    const Joint& joint = joints[slot];
    block.joint = slot;
    block.reach = reachOf(joint, bodies);
    if (entryOf(joint.kind).uses.couples) return evaluateCoupling(joint, joints, bodies, block);
    evaluate(joint, poseOf(bodies, joint.a), poseOf(bodies, joint.b), time_step, block);
}

void reportImpulses(const JointBlock& block, const BodyStorage& bodies, Joint& joint) {
    Vec3 linear = Vec3::Zero();
    Vec3 angular = Vec3::Zero();
    const auto sum = [&](const JointRow& row, double impulse) {
        linear += impulse * row.linear;
        angular += impulse * row.angular_a;
    };
    for (std::uint32_t i = 0; i < block.size; ++i) sum(block.rows[i], block.impulse[i]);
    for (std::uint32_t i = 0; i < block.bounds; ++i) sum(block.bound[i].row, block.bound[i].impulse);
    if (!block.ends.empty()) {
        const RowEnd& end = block.ends.front();
        sum({end.linear, end.angular, {}}, block.impulse[0]);
        joint.coupled_impulse += block.impulse[0];
        addToFixed(block, bodies, joint);
    }
    joint.impulse += linear;
    joint.angular_impulse += angular - block.arm_a.cross(linear);
}

}  // namespace cairn
