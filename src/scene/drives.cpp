#include "scene/drives.h"

#include <fmt/format.h>

#include "joints/joint_kinds.h"

namespace cairn {
namespace {

/// The axis of a joint that a drive is about: its own, or one of several.
template <class Visit>
auto withAxis(const JointDescription& joint, std::size_t axis, const Visit& visit) {
    return entryOf(joint.kind).uses.own_axis ? visit(joint) : visit(joint.axes[axis]);
}

bool hasAxis(const JointDescription& joint, std::size_t axis) {
    return entryOf(joint.kind).uses.own_axis ? axis == 0 : axis < joint.axes.size();
}

/// Whether a quantity changes within a step or did in the step before, so that bodies at rest are left asleep.
bool changes(const MotionCurve& curve, double time, double step) {
    const Vec3 now = curve.at(time).displacement;
    return time < step || curve.at(time + step).displacement != now || curve.at(time - step).displacement != now;
}

JointServo driven(JointServo servo, const SceneDrive& drive, double value, double rate) {
    (drive.what == DriveOf::position ? servo.position : servo.speed) = value;
    if (drive.what == DriveOf::position) servo.speed = rate;
    return servo;
}

/// @param value at the end of the step @param rate its mean over the step
void driveJoint(const SceneDrive& drive, const JointDescription& joint, JointId id, double value, double rate,
                World& world) {
    if (!entryOf(joint.kind).uses.own_axis) {
        JointAxis axis = joint.axes[drive.axis];
        if (axis.servo) axis.servo = driven(*axis.servo, drive, value, rate);
        if (axis.motor) axis.motor->speed = value;
        world.setJointAxis(id, drive.axis, axis);
    } else if (joint.servo) {
        world.setJointServo(id, driven(*joint.servo, drive, value, rate));
    } else {
        world.setJointMotor(id, {value, joint.motor->limit});
    }
}

}  // namespace

void requireFunction(const Motion& law, const Vec3& start) {
    if (MotionCurve(law).turns()) throw InputError("its law turns; a function of time has displacements only");
    if (const auto* table = std::get_if<TableMotion>(&law)) {
        if (!table->velocities.empty()) {
            throw InputError("its table has velocities; that of a function of time has values only");
        }
        if (table->displacements.front() != start) throw InputError("it does not start with its table");
    }
}

void requireDrive(const SceneDrive& drive, const Scene& scene) {
    requireFunction(drive.law, drive.start);
    if (!drivesJoint(drive.what)) {
        if (drive.target >= scene.bodies.size()) throw InputError("its body does not exist");
        if (scene.bodies[drive.target].fixed) throw InputError("its body is fixed, so no force moves it");
        return;
    }
    if (drive.target >= scene.joints.size()) throw InputError("its joint does not exist");
    const JointDescription& joint = scene.joints[drive.target].joint;
    if (!hasAxis(joint, drive.axis)) {
        throw InputError(fmt::format(
            "its joint has nothing that drives a free axis {}; give that axis a servo or a motor", drive.axis));
    }
    const bool servo = withAxis(joint, drive.axis, [](const auto& axis) { return axis.servo.has_value(); });
    const bool motor = withAxis(joint, drive.axis, [](const auto& axis) { return axis.motor.has_value(); });
    if (drive.what == DriveOf::position && !servo) throw InputError("its axis has no servo, which a position needs");
    if (!servo && !motor) throw InputError("its axis has neither servo nor motor, one of which a speed needs");
}

void applyDrive(const SceneDrive& drive, const MotionCurve& curve, const Scene& scene, std::span<const BodyId> ids,
                World& world) {
    const double time = world.time();
    const double step = world.settings().timeStep();
    if (!changes(curve, time, step)) return;
    const auto value = [&](double t) { return Vec3(drive.start + curve.at(t).displacement); };
    if (drivesJoint(drive.what)) {
        // The first joints of a world are numbered as they were added.
        const JointId id{static_cast<std::uint32_t>(drive.target), 0};
        if (!world.contains(id)) return;
        const double end = value(time + step).x();
        driveJoint(drive, scene.joints[drive.target].joint, id, end, (end - value(time).x()) / step, world);
        return;
    }
    const BodyId id = ids[drive.target];
    if (!world.contains(id)) return;
    const Vec3 mean = value(time + step / 2);
    if (drive.what == DriveOf::force) {
        world.setConstantForce(id, mean);
    } else {
        world.setConstantTorque(id, mean);
    }
}

}  // namespace cairn
