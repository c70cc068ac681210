#include "world/saved_joints.h"

#include <algorithm>
#include <cmath>

#include "joints/joint_kinds.h"
#include "world/saved_fields.h"

namespace cairn {

namespace {

bool isUnit(const Vec3& v) {
    return std::abs(v.squaredNorm() - 1) < 1e-6;
}

bool isUnit(const Quat& q) {
    return std::abs(q.coeffs().squaredNorm() - 1) < 1e-6;
}

bool isSound(const FreeAxis& axis) {
    const bool placed = axis.along <= JointAlong::turn_z && axis.lower <= axis.upper && std::isfinite(axis.position);
    const bool driven = std::isfinite(axis.motor_speed) && isFiniteAndNotNegative(axis.motor_limit) &&
                        std::isfinite(axis.servo_position) && std::isfinite(axis.servo_speed) &&
                        isFiniteAndNotNegative(axis.servo_stiffness) && isFiniteAndNotNegative(axis.servo_damping) &&
                        axis.servo_limit >= 0;
    const bool held = isFiniteAndNotNegative(axis.spring_stiffness) && std::isfinite(axis.spring_rest) &&
                      isFiniteAndNotNegative(axis.damping) && isFiniteAndNotNegative(axis.friction) &&
                      isFiniteAndNotNegative(axis.rotor_inertia);
    return placed && driven && held && axis.restitution >= 0 && axis.restitution <= 1;
}

/// Whether the free axes are those that the kind has, each once.
bool hasAxesOf(const JointKindEntry& kind, const std::vector<FreeAxis>& axes) {
    if (!std::ranges::all_of(axes, [](const FreeAxis& axis) { return isSound(axis); })) return false;
    if (!kind.uses.free_axes) {
        return std::ranges::equal(axes, kind.free, {}, [](const FreeAxis& axis) { return axis.along; });
    }
    std::vector<JointAlong> along;
    for (const FreeAxis& axis : axes) along.push_back(axis.along);
    std::ranges::sort(along);
    return std::ranges::adjacent_find(along) == along.end();
}

/// Whether addJoint() could have made it, or a setter changed it so.
bool isSound(const Joint& joint, const BodyStorage& bodies) {
    if (joint.kind > body_locks || joint.locked >= 1U << 6U) return false;
    const JointKindEntry& kind = entryOf(joint.kind);
    const auto exists = [&](BodyIndex i) { return i < bodies.slots() && bodies.kind[i] != BodyKind::hole; };
    const bool known = exists(joint.a) && (joint.b == Joint::world || exists(joint.b)) &&
                       (joint.a != joint.b || kind.uses.couples) && hasAxesOf(kind, joint.free);
    const bool placed = joint.anchor_a.allFinite() && joint.anchor_b.allFinite() && isUnit(joint.axis_a) &&
                        isUnit(joint.axis_b) && isUnit(joint.rest) && isUnit(joint.frame) &&
                        std::isfinite(joint.lead) && joint.cone >= 0;
    return known && placed && isFiniteAndNotNegative(joint.length) && joint.break_force > 0 && joint.break_torque > 0 &&
           std::isfinite(joint.ratio) && std::isfinite(joint.offset);
}

/// Whether a coupling is about axes that there are.
bool isCoupledSoundly(const Joint& joint, const std::vector<Joint>& joints) {
    const auto has = [&](std::uint32_t slot, std::uint32_t axis) {
        return slot < joints.size() && joints[slot].present && axis < joints[slot].free.size();
    };
    return has(joint.first, joint.first_axis) && has(joint.second, joint.second_axis);
}

}  // namespace

bool isFiniteAndNotNegative(double value) {
    return value >= 0 && std::isfinite(value);
}

void loadJoints(ByteReader& in, const BodyStorage& bodies, std::vector<Joint>& joints) {
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
        Joint& joint = joints.emplace_back();
        jointFields(in, joint);
        if (joint.present && !isSound(joint, bodies)) in.refuse("a joint that no world has");
    }
    for (const Joint& joint : joints) {
        if (!joint.present || !entryOf(joint.kind).uses.couples) continue;
        if (!isCoupledSoundly(joint, joints)) in.refuse("a coupling of joints that there are not");
    }
}

}  // namespace cairn
