#include "scene/placed_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/drives.h"

namespace cairn {
namespace {

/// A law of motion in the world's frame, which the group's frame is turned to.
Motion turned(Motion motion, const Quat& q) {
    const auto turn = [&q](Vec3& v) { v = q * v; };
    if (auto* constant = std::get_if<ConstantMotion>(&motion)) {
        turn(constant->velocity);
        turn(constant->spin);
    } else if (auto* sine = std::get_if<SineMotion>(&motion)) {
        turn(sine->amplitude);
        turn(sine->turn);
    } else if (auto* table = std::get_if<TableMotion>(&motion)) {
        std::ranges::for_each(table->displacements, turn);
        std::ranges::for_each(table->turns, turn);
        std::ranges::for_each(table->velocities, turn);
    }
    return motion;
}

SceneBody placed(SceneBody body, const Pose& pose) {
    body.position = pose.toOuter(body.position);
    body.orientation = pose.orientation * body.orientation;
    body.linear_velocity = pose.orientation * body.linear_velocity;
    body.angular_velocity = pose.orientation * body.angular_velocity;
    if (body.motion) body.motion = turned(*body.motion, pose.orientation);
    return body;
}

SceneSpring placed(SceneSpring spring, const Pose& pose) {
    if (!spring.b) spring.anchor_b = pose.toOuter(spring.anchor_b);
    return spring;
}

SceneJoint placed(SceneJoint joint, const Pose& pose) {
    JointDescription& description = joint.joint;
    description.anchor = pose.toOuter(description.anchor);
    if (description.anchor_b) description.anchor_b = pose.toOuter(*description.anchor_b);
    description.axis = pose.orientation * description.axis;
    if (description.axis_2) description.axis_2 = pose.orientation * *description.axis_2;
    return joint;
}

SceneDrive placed(SceneDrive drive, const Pose& pose) {
    if (drivesJoint(drive.what)) return drive;
    drive.start = pose.orientation * drive.start;
    drive.law = turned(drive.law, pose.orientation);
    return drive;
}

bool isIdentity(const Pose& pose) {
    return pose.position.isZero(0) && pose.orientation.vec().isZero(0);
}

/// The same, untouched where nothing is to be moved, so that no number is rounded.
template <class Thing>
Thing placedOf(const Thing& thing, const Pose& pose) {
    return isIdentity(pose) ? thing : placed(thing, pose);
}

void placeBodies(const Scene& group, const Placement& placement, const JsonNode& node, SceneReading& reading) {
    const bool turns = !placement.pose.orientation.vec().isZero(0);
    for (const SceneBody& body : group.bodies) {
        if (turns && !body.locked.empty()) {
            node.fail("turns a body with locked axes, which are those of the world; place it without an orientation");
        }
        SceneBody added = placedOf(body, placement.pose);
        if (!body.name.empty()) {
            added.name = placement.prefix + body.name;
            if (!reading.by_name.emplace(added.name, reading.scene.bodies.size()).second) {
                node.fail(
                    fmt::format("brings a body '{}', whose name another body has; give what is included a "
                                "\"name\", which stands before those of its bodies",
                                added.name));
            }
        }
        reading.scene.bodies.push_back(std::move(added));
    }
}

}  // namespace

void place(const Scene& group, const Placement& placement, const JsonNode& node, SceneReading& reading) {
    const std::size_t first_body = reading.scene.bodies.size();
    const std::size_t first_joint = reading.placed.joints.size();
    placeBodies(group, placement, node, reading);
    for (const SceneException& exception : group.filters.exceptions) {
        reading.scene.filters.exceptions.push_back(
            {exception.a + first_body, exception.b + first_body, exception.touch});
    }
    for (const SceneSpring& spring : group.springs) {
        SceneSpring& added = reading.placed.springs.emplace_back(placedOf(spring, placement.pose));
        added.a += first_body;
        if (added.b) *added.b += first_body;
    }
    for (const SceneJoint& joint : group.joints) {
        SceneJoint& added = reading.placed.joints.emplace_back(placedOf(joint, placement.pose));
        added.a += first_body;
        if (added.b) *added.b += first_body;
        if (added.first) *added.first += first_joint;
        if (added.second) *added.second += first_joint;
    }
    for (const SceneDrive& drive : group.drives) {
        SceneDrive& added = reading.placed.drives.emplace_back(placedOf(drive, placement.pose));
        added.target += drivesJoint(added.what) ? first_joint : first_body;
    }
}

void addPlaced(SceneReading& reading) {
    Scene& scene = reading.scene;
    const std::size_t first_joint = scene.joints.size();
    for (SceneJoint& joint : reading.placed.joints) {
        if (joint.first) *joint.first += first_joint;
        if (joint.second) *joint.second += first_joint;
        scene.joints.push_back(std::move(joint));
    }
    for (SceneDrive& drive : reading.placed.drives) {
        if (drivesJoint(drive.what)) drive.target += first_joint;
        scene.drives.push_back(std::move(drive));
    }
    scene.springs.insert(scene.springs.end(), reading.placed.springs.begin(), reading.placed.springs.end());
    reading.placed = {};
}

}  // namespace cairn
