#include "joints/joint_kinds.h"

#include <algorithm>
#include <array>

namespace cairn {

namespace {

using enum JointAlong;

/// The anchors are on each other.
void keepPoint(const Joint&, const JointPlacement& at, JointBlock& block) {
    for (Eigen::Index k = 0; k < 3; ++k) {
        const Vec3 direction = Vec3::Unit(k);
        // With both arms to their own anchors, as the error is the anchors' distance.
        add(block, {direction, at.arm_a.cross(direction), -at.arm_b.cross(direction)}, at.apart[k]);
    }
}

void keepAxes(const JointPlacement& at, JointBlock& block) {
    const Vec3 tilt = at.axis_b.cross(at.axis_a);
    for (const Vec3& direction : {at.side_1, at.side_2}) add(block, angularRow(direction), direction.dot(tilt));
}

void keepOrientation(const Joint& joint, const JointPlacement& at, JointBlock& block) {
    const Quat turn = turnInB(joint, at);
    const Vec3 tilt = at.orientation_b * Vec3(turn.vec()) * (turn.w() < 0 ? -2.0 : 2.0);
    for (Eigen::Index k = 0; k < 3; ++k) add(block, angularRow(Vec3::Unit(k)), tilt[k]);
}

void keepBeside(const JointPlacement& at, JointBlock& block) {
    for (const Vec3& direction : {at.side_1, at.side_2}) {
        add(block, linearRow(at, direction), direction.dot(at.apart));
    }
}

void keepLength(const Joint& joint, const JointPlacement& at, JointBlock& block) {
    const JointMotion motion = lengthOf(at);
    add(block, motion.row, motion.position - joint.length);
}

/// A rope's only condition is a bound.
void keepNothing(const Joint&, const JointPlacement&, JointBlock&) {}

void keepHinge(const Joint& joint, const JointPlacement& at, JointBlock& block) {
    keepPoint(joint, at, block);
    keepAxes(at, block);
}

void keepSlider(const Joint& joint, const JointPlacement& at, JointBlock& block) {
    keepOrientation(joint, at, block);
    keepBeside(at, block);
}

void keepFixed(const Joint& joint, const JointPlacement& at, JointBlock& block) {
    keepPoint(joint, at, block);
    keepOrientation(joint, at, block);
}

/// All axes that are not free.
void keepOthers(const Joint& joint, const JointPlacement& at, JointBlock& block) {
    const SixMotions motions = cardanMotions(joint, at);
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const auto isThis = [&](const FreeAxis& axis) { return static_cast<std::size_t>(axis.along) == i; };
        if (std::ranges::none_of(joint.free, isThis)) add(block, motions[i].row, motions[i].position);
    }
}

void keepScrew(const Joint& joint, const JointPlacement& at, JointBlock& block) {
    const SixMotions motions = cardanMotions(joint, at);
    const JointMotion& along = motions[static_cast<std::size_t>(x)];
    const JointMotion& about = motions[static_cast<std::size_t>(turn_x)];
    for (const JointAlong other : {y, z, turn_y, turn_z}) {
        const JointMotion& motion = motions[static_cast<std::size_t>(other)];
        add(block, motion.row, motion.position);
    }
    add(block,
        {along.row.linear, along.row.angular_a - joint.lead * about.row.angular_a,
         along.row.angular_b - joint.lead * about.row.angular_b},
        along.position - joint.lead * about.position);
}

bool isLocked(const Joint& joint, Eigen::Index along) {
    return ((joint.locked >> along) & 1) != 0;
}

/// Of what may turn about one axis of the world that axis stays where it was. What may turn about two has no place to
/// come back to: only its angular velocity is kept.
void keepTurnsLocked(const Joint& joint, const JointPlacement& at, JointBlock& block) {
    const std::array<bool, 3> locked{isLocked(joint, 3), isLocked(joint, 4), isLocked(joint, 5)};
    const auto count = std::ranges::count(locked, true);
    if (count == 3) return keepOrientation(joint, at, block);
    Vec3 tilt = Vec3::Zero();
    if (count == 2) {
        const Vec3 free = Vec3::Unit(std::ranges::find(locked, false) - locked.begin());
        tilt = free.cross(turnInB(joint, at) * free);
    }
    for (Eigen::Index i = 0; i < 3; ++i) {
        if (isLocked(joint, 3 + i)) add(block, angularRow(Vec3::Unit(i)), tilt[i]);
    }
}

void keepLocked(const Joint& joint, const JointPlacement& at, JointBlock& block) {
    for (Eigen::Index i = 0; i < 3; ++i) {
        if (isLocked(joint, i)) add(block, linearRow(at, Vec3::Unit(i)), at.apart[i]);
    }
    keepTurnsLocked(joint, at, block);
}

JointMotion moveLength(const Joint&, const JointPlacement& at, const FreeAxis&) {
    return lengthOf(at);
}

JointMotion moveSlider(const Joint&, const JointPlacement& at, const FreeAxis&) {
    return displacementOf(at);
}

JointMotion moveCardan(const Joint& joint, const JointPlacement& at, const FreeAxis& axis) {
    return cardanMotions(joint, at)[static_cast<std::size_t>(axis.along)];
}

JointMotion moveBall(const Joint& joint, const JointPlacement& at, const FreeAxis& axis) {
    return vectorMotions(joint, at)[static_cast<std::size_t>(axis.along)];
}

constexpr std::array<JointAlong, 3> free_ball = {turn_x, turn_y, turn_z};
constexpr std::array<JointAlong, 1> free_hinge = {turn_x};
constexpr std::array<JointAlong, 1> free_slider = {x};
constexpr std::array<JointAlong, 2> free_universal = {turn_x, turn_y};
constexpr std::array<JointAlong, 3> free_planar = {y, z, turn_x};
constexpr std::array<JointAlong, 2> free_cylindrical = {x, turn_x};

constexpr std::array<JointKindEntry, 15> kinds_in_order = {{
    {"distance", "distance", {.length = true}, {}, keepLength, moveLength},
    {"rope", "rope", {.length = true}, {}, keepNothing, moveLength},
    {"ball", "ball joint", {.second_axis = true, .cone = true, .axes = true}, free_ball, keepPoint, moveBall},
    {"hinge", "hinge", {.axis = true, .torque = true, .own_axis = true}, free_hinge, keepHinge, angleOf},
    {"slider", "slider", {.axis = true, .torque = true, .own_axis = true}, free_slider, keepSlider, moveSlider},
    {"fixed", "fixed joint", {.torque = true}, {}, keepFixed, moveLength},
    {"universal",
     "universal joint",
     {.axis = true, .second_axis = true, .torque = true, .axes = true},
     free_universal,
     keepOthers,
     moveCardan},
    {"planar",
     "planar joint",
     {.axis = true, .second_axis = true, .torque = true, .axes = true},
     free_planar,
     keepOthers,
     moveCardan},
    {"cylindrical",
     "cylindrical joint",
     {.axis = true, .torque = true, .axes = true},
     free_cylindrical,
     keepOthers,
     moveCardan},
    {"screw",
     "screw",
     {.axis = true, .lead = true, .torque = true, .own_axis = true},
     free_hinge,
     keepScrew,
     moveCardan},
    {"generic",
     "generic joint",
     {.axis = true, .second_axis = true, .torque = true, .axes = true, .free_axes = true},
     {},
     keepOthers,
     moveCardan},
    {"gear", "gear", {.couples = true}, {}, nullptr, nullptr},
    {"rack", "rack", {.couples = true}, {}, nullptr, nullptr},
    {"mimic", "mimic", {.couples = true}, {}, nullptr, nullptr},
    {"locked", "body with locked axes", {}, {}, keepLocked, moveLength},
}};

static_assert(kinds_in_order.size() == static_cast<std::size_t>(body_locks) + 1);

}  // namespace

std::span<const JointKindEntry> jointKinds() {
    return std::span(kinds_in_order).first(static_cast<std::size_t>(body_locks));
}

const JointKindEntry& entryOf(JointKind kind) {
    return kinds_in_order[static_cast<std::size_t>(kind)];
}

}  // namespace cairn
