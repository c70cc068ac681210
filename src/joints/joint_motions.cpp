#include "joints/joint_motions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/tolerances.h"

namespace cairn {

namespace {

/// Cosine of the middle turn below which three turns after each other no longer say how a body stands.
constexpr double least_cosine = 1e-3;

/// Which of the three turns comes first, in the middle and last.
struct TurnOrder {
    Eigen::Index first, middle, last;
    double sign;  ///< −1 where they are left-handed
};

bool isFree(const Joint& joint, Eigen::Index axis) {
    const auto along = static_cast<JointAlong>(3 + axis);
    return std::ranges::any_of(joint.free, [&](const FreeAxis& free) { return free.along == along; });
}

TurnOrder orderOf(const Joint& joint) {
    const std::array<bool, 3> free{isFree(joint, 0), isFree(joint, 1), isFree(joint, 2)};
    const auto count = std::ranges::count(free, true);
    if (count == 1 && free[1]) return {1, 2, 0, 1};
    if (count == 1 && free[2]) return {2, 0, 1, 1};
    if (count == 2 && !free[0]) return {1, 0, 2, -1};
    if (count == 2 && !free[2]) return {0, 2, 1, -1};
    return {0, 1, 2, 1};
}

void displacements(const JointPlacement& at, const Mat3& frame, SixMotions& motions) {
    for (Eigen::Index i = 0; i < 3; ++i) {
        const Vec3 direction = frame.col(i);
        motions[static_cast<std::size_t>(i)] = {direction.dot(at.apart), linearRow(at, direction)};
    }
}

}  // namespace

Vec3 anyAcross(const Vec3& axis) {
    Eigen::Index smallest = 0;
    axis.cwiseAbs().minCoeff(&smallest);
    return axis.cross(Vec3::Unit(smallest)).normalized();
}

JointPlacement placementOf(const Joint& joint, const Pose& a, const Pose& b) {
    JointPlacement at;
    at.orientation_a = a.orientation;
    at.orientation_b = b.orientation;
    at.arm_a = a.orientation * joint.anchor_a;
    at.arm_b = b.orientation * joint.anchor_b;
    at.apart = a.position + at.arm_a - b.position - at.arm_b;
    at.axis_a = a.orientation * joint.axis_a;
    at.axis_b = b.orientation * joint.axis_b;
    at.side_1 = b.orientation * anyAcross(joint.axis_b);
    at.side_2 = at.axis_b.cross(at.side_1);
    return at;
}

double nearestTurn(double angle, double to) {
    constexpr double turn_around = 2 * std::numbers::pi;
    return angle - turn_around * std::round((angle - to) / turn_around);
}

JointMotion lengthOf(const JointPlacement& at) {
    const double length = at.apart.norm();
    const Vec3 direction = length > 0 ? Vec3(at.apart / length) : Vec3(Vec3::UnitZ());
    return {length, {direction, at.arm_a.cross(direction), -at.arm_b.cross(direction)}};
}

JointMotion angleOf(const Joint& joint, const JointPlacement& at, const FreeAxis& axis) {
    const Quat turn = turnInB(joint, at);
    const double angle = 2 * std::atan2(Vec3(turn.vec()).dot(joint.axis_b), turn.w());
    return {nearestTurn(angle, axis.position), angularRow(at.axis_b)};
}

JointMotion displacementOf(const JointPlacement& at) {
    return {at.axis_b.dot(at.apart), linearRow(at, at.axis_b)};
}

/// With q = (v, w) and p = v·n the twist about n is 2·atan2(p, w); q̇ = ½·ω·q gives its rate.
JointMotion twistOf(const Joint& joint, const JointPlacement& at) {
    const Quat turn = turnInB(joint, at);
    const Vec3 v = turn.vec();
    const double p = v.dot(joint.axis_b);
    const double w = turn.w();
    const double square = std::max(p * p + w * w, least_cosine * least_cosine);
    const Vec3 direction = (w * w * joint.axis_b + w * v.cross(joint.axis_b) + p * v) / square;
    return {nearestTurn(2 * std::atan2(p, w), 0), angularRow(at.orientation_b * direction)};
}

JointMotion swingOf(const JointPlacement& at) {
    const Vec3 across = at.axis_b.cross(at.axis_a);
    const double sine = across.norm();
    const Vec3 direction = sine > tiny_part ? Vec3(across / sine) : at.side_1;
    return {std::atan2(sine, at.axis_b.dot(at.axis_a)), angularRow(direction)};
}

/// The rates of the three turns are the components of the angular velocity along the reciprocals of their axes.
SixMotions cardanMotions(const Joint& joint, const JointPlacement& at) {
    SixMotions motions;
    const Mat3 frame_b = (at.orientation_b * joint.frame).toRotationMatrix();
    const Mat3 frame_a = (at.orientation_a * joint.rest.conjugate() * joint.frame).toRotationMatrix();
    displacements(at, frame_b, motions);
    const auto [i, j, k, sign] = orderOf(joint);
    const Mat3 turn = frame_b.transpose() * frame_a;
    const double first = std::atan2(-sign * turn(j, k), turn(k, k));
    const double middle = std::atan2(turn(i, k), std::hypot(turn(i, i), turn(i, j)));
    const double last = std::atan2(-sign * turn(i, j), turn(i, i));
    const Vec3 axis_first = frame_b.col(i);
    const Vec3 axis_last = frame_a.col(k);
    const Vec3 across = axis_last.cross(axis_first);
    const double cosine = std::max(across.norm(), least_cosine);
    const Vec3 axis_middle = across / cosine;
    const auto set = [&](Eigen::Index axis, double angle, const Vec3& direction) {
        motions[static_cast<std::size_t>(3 + axis)] = {angle, angularRow(direction)};
    };
    set(i, first, axis_middle.cross(axis_last) / cosine);
    set(j, sign * middle, sign * axis_middle);
    set(k, last, axis_first.cross(axis_middle) / cosine);
    for (const FreeAxis& axis : joint.free) {
        JointMotion& motion = motions[static_cast<std::size_t>(axis.along)];
        if (axis.along >= JointAlong::turn_x) motion.position = nearestTurn(motion.position, axis.position);
    }
    return motions;
}

SixMotions vectorMotions(const Joint& joint, const JointPlacement& at) {
    SixMotions motions;
    const Mat3 frame = (at.orientation_b * joint.frame).toRotationMatrix();
    displacements(at, frame, motions);
    const Quat turn = turnInB(joint, at);
    const double sine = turn.vec().norm();
    const double sign = turn.w() < 0 ? -1 : 1;
    const double per_sine = sine > tiny_part ? 2 * std::atan2(sine, sign * turn.w()) / sine : 2;
    const Vec3 vector = joint.frame.conjugate() * Vec3(sign * per_sine * turn.vec());
    for (Eigen::Index i = 0; i < 3; ++i) {
        motions[static_cast<std::size_t>(3 + i)] = {vector[i], angularRow(frame.col(i))};
    }
    return motions;
}

}  // namespace cairn
