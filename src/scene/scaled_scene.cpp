#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cairn/scene.h"
#include "joints/joint_kinds.h"
#include "scene/scaled_shape.h"

namespace cairn {
namespace {

/// What values of each unit are multiplied by.
class Factors {
  public:
    explicit Factors(const Scales& scales) : length(scales.length), time(scales.time), mass(scales.mass) {}

    double length, time, mass;
    double area = length * length;
    double volume = area * length;
    double rate = 1 / time;  ///< 1/s, and rad/s
    double speed = length / time;
    double acceleration = speed / time;
    double impulse = mass * speed;
    double force = mass * acceleration;
    double torque = force * length;  ///< N·m, and N·m/rad
    double inertia = mass * area;
    double density = mass / volume;
};

/// @param unit of the law's values, which are metres where something moves
Motion scaledMotion(const Motion& motion, double unit, const Factors& by) {
    struct Scaler {
        double unit;
        double time;
        Motion operator()(ConstantMotion law) const {
            law.velocity *= unit / time;
            law.spin /= time;
            return law;
        }
        Motion operator()(SineMotion law) const {
            law.amplitude *= unit;
            law.frequency /= time;
            return law;
        }
        Motion operator()(TableMotion law) const {
            for (double& t : law.times) t *= time;
            for (Vec3& d : law.displacements) d *= unit;
            for (Vec3& v : law.velocities) v *= unit / time;
            return law;
        }
    };
    return std::visit(Scaler{unit, by.time}, motion);
}

void scale(std::optional<Motion>& motion, double unit, const Factors& by) {
    if (motion) motion = scaledMotion(*motion, unit, by);
}

template <class Value>
void scale(std::optional<Value>& value, double factor) {
    if (value) *value *= factor;
}

std::vector<Vec3> scaledPoints(std::span<const Vec3> points, double length) {
    std::vector<Vec3> scaled(points.begin(), points.end());
    for (Vec3& p : scaled) p *= length;
    return scaled;
}

Shape scaledShape(const Shape& shape, const Factors& by);

/// Each kind of shape.
struct ShapeScaler {
    const Factors& by;

    Shape operator()(const Sphere& s) const { return Sphere{s.radius * by.length}; }
    Shape operator()(const Box& s) const { return Box{s.size * by.length}; }
    Shape operator()(const Capsule& s) const { return Capsule{s.radius * by.length, s.length * by.length}; }
    Shape operator()(const Cylinder& s) const { return Cylinder{s.radius * by.length, s.length * by.length}; }
    Shape operator()(const HalfSpace& s) const { return HalfSpace{s.normal, s.offset * by.length}; }
    Shape operator()(const ConvexHull& s) const { return ConvexHull(scaledPoints(s.points(), by.length)); }
    Shape operator()(const Mesh& s) const {
        return Mesh(scaledPoints(s.vertices(), by.length), {s.triangles().begin(), s.triangles().end()}, s.sides());
    }
    Shape operator()(const HeightField& s) const {
        std::vector<double> heights(s.heights().begin(), s.heights().end());
        for (double& h : heights) h *= by.length;
        return HeightField(s.columns(), std::move(heights), s.spacing() * by.length);
    }
    Shape operator()(Compound s) const {
        for (CompoundPart& part : s.parts) {
            part.shape = scaledShape(part.shape, by);
            part.pose.position *= by.length;
            scale(part.mass, by.mass);
            scale(part.density, by.density);
        }
        if (s.solid) {
            s.solid->volume *= by.volume;
            s.solid->centre *= by.length;
            s.solid->inertia *= by.volume * by.area;
        }
        s.tree.reset();
        return s;
    }
};

Shape scaledShape(const Shape& shape, const Factors& by) {
    return std::visit(ShapeScaler{by}, shape);
}

void scaleBody(SceneBody& body, const Factors& by) {
    body.shape = scaledShape(body.shape, by);
    scale(body.mass, by.mass);
    scale(body.centre_of_mass, by.length);
    scale(body.inertia, by.inertia);
    body.position *= by.length;
    body.linear_velocity *= by.speed;
    body.angular_velocity *= by.rate;
    body.linear_damping *= by.rate;
    body.angular_damping *= by.rate;
    scale(body.motion, by.length, by);
    body.pivot *= by.length;
    body.surface_velocity *= by.speed;
}

/// What JointAxis and, for their one free axis, JointDescription have.
template <class Axis>
void scaleAxis(Axis& axis, bool is_angle, const Factors& by) {
    const double position = is_angle ? 1 : by.length;
    const double force = is_angle ? by.torque : by.force;
    scale(axis.lower, position);
    scale(axis.upper, position);
    if (axis.motor) {
        axis.motor->speed *= position * by.rate;
        axis.motor->limit *= force;
    }
    if (axis.servo) {
        axis.servo->position *= position;
        axis.servo->speed *= position * by.rate;
        axis.servo->stiffness *= force / position;
        axis.servo->damping *= force / position * by.time;
        axis.servo->limit *= force;
    }
    if (axis.spring) {
        axis.spring->stiffness *= force / position;
        axis.spring->rest *= position;
    }
    axis.damping *= force / position * by.time;
    axis.friction *= force;
    axis.rotor_inertia *= is_angle ? by.inertia : by.mass;
}

/// Which way an axis of a joint leads. An axis that the joint has not is refused where the scene is used.
bool isAngleOf(const JointDescription& joint, std::size_t axis) {
    const JointKindEntry& kind = entryOf(joint.kind);
    if (kind.uses.free_axes) return axis < joint.axes.size() && isAngle(joint.axes[axis].along);
    return axis < kind.free.size() && isAngle(kind.free[axis]);
}

double positionUnit(const Scene& scene, std::size_t joint, std::size_t axis, const Factors& by) {
    return joint < scene.joints.size() && isAngleOf(scene.joints[joint].joint, axis) ? 1 : by.length;
}

void scaleJoint(SceneJoint& joint, const Scene& scene, const Factors& by) {
    JointDescription& d = joint.joint;
    d.anchor *= by.length;
    scale(d.anchor_b, by.length);
    scale(d.length, by.length);
    scale(d.lead, by.length);
    scaleAxis(d, isAngleOf(d, 0), by);
    for (std::size_t i = 0; i < d.axes.size(); ++i) scaleAxis(d.axes[i], isAngleOf(d, i), by);
    d.break_force *= by.force;
    d.break_torque *= by.torque;
    if (!joint.first || !joint.second) return;
    d.ratio *= positionUnit(scene, *joint.second, d.second_axis, by);
    d.ratio /= positionUnit(scene, *joint.first, d.first_axis, by);
}

void scaleSpring(SceneSpring& spring, const Factors& by) {
    spring.anchor_a *= by.length;
    spring.anchor_b *= by.length;
    spring.stiffness *= by.force / by.length;
    spring.damping *= by.impulse / by.length;
    spring.rest_length *= by.length;
}

double unitOf(const SceneDrive& drive, const Scene& scene, const Factors& by) {
    switch (drive.what) {
        case DriveOf::position:
            return positionUnit(scene, drive.target, drive.axis, by);
        case DriveOf::speed:
            return positionUnit(scene, drive.target, drive.axis, by) * by.rate;
        case DriveOf::force:
            return by.force;
        case DriveOf::torque:
            return by.torque;
    }
    return 1;
}

void scaleDrive(SceneDrive& drive, const Scene& scene, const Factors& by) {
    const double unit = unitOf(drive, scene, by);
    drive.start *= unit;
    drive.law = scaledMotion(drive.law, unit, by);
}

/// Each kind of event.
struct ActionScaler {
    const Factors& by;

    void operator()(SetGravity& action) const { action.gravity *= by.acceleration; }
    void operator()(SetVelocity& action) const { action.velocity *= by.speed; }
    void operator()(GiveImpulse& action) const { action.impulse *= by.impulse; }
    void operator()(SetForce& action) const { action.force *= by.force; }
    void operator()(SetTorque& action) const { action.torque *= by.torque; }
    void operator()(RemoveBody&) const {}
};

void scalePair(PairProperties& pair, const Factors& by) {
    pair.rolling_friction *= by.length;
    pair.spinning_friction *= by.length;
}

void scaleLaw(PairLaw& law, const Factors& by) {
    for (double& speed : law.restitution.speeds) speed *= by.speed;
    for (double& speed : law.friction.speeds) speed *= by.speed;
}

double factorOfUnit(std::string_view unit, const Factors& by) {
    if (unit == "m") return by.length;
    if (unit == "m/s") return by.speed;
    if (unit == "1/s") return by.rate;
    return 1;
}

/// A given setting by its unit. Whole numbers stay so where nothing changes.
void scaleSetting(std::pair<std::string, SettingValue>& setting, const Factors& by) {
    for (const SettingField& field : settingFields()) {
        const double factor = factorOfUnit(field.unit, by);
        if (field.name != setting.first || factor == 1) continue;
        Settings checked;
        setField(checked, setting.first, setting.second);
        const auto* whole = std::get_if<std::int64_t>(&setting.second);
        const double value = whole ? static_cast<double>(*whole) : std::get<double>(setting.second);
        setting.second = value * factor;
    }
}

void requireScale(double value, std::string_view what) {
    if (std::isfinite(value) && value > 0) return;
    throw InputError(fmt::format("the scale of {} is {}; it must be finite and above 0", what, value));
}

}  // namespace

Shape scaledShape(const Shape& shape, double factor) {
    requireScale(factor, "lengths");
    return scaledShape(shape, Factors({factor, 1, factor * factor * factor}));
}

Scene scaled(Scene scene, const Scales& scales) {
    requireScale(scales.length, "lengths");
    requireScale(scales.time, "times");
    requireScale(scales.mass, "masses");
    const Factors by(scales);
    scene.duration *= by.time;
    scene.gravity *= by.acceleration;
    scale(scene.gravity_law, by.acceleration, by);
    for (SceneEvent& event : scene.events) {
        event.time *= by.time;
        std::visit(ActionScaler{by}, event.action);
    }
    for (Material& material : scene.materials) material.density *= by.density;
    scalePair(scene.default_pair, by);
    for (auto& [names, pair] : scene.pairs) scalePair(pair, by);
    for (auto& [names, law] : scene.pair_laws) scaleLaw(law, by);
    scale(scene.frame_motion, by.length, by);
    for (SceneBody& body : scene.bodies) scaleBody(body, by);
    for (SceneSpring& spring : scene.springs) scaleSpring(spring, by);
    for (SceneJoint& joint : scene.joints) scaleJoint(joint, scene, by);
    for (SceneDrive& drive : scene.drives) scaleDrive(drive, scene, by);
    for (auto& setting : scene.settings) scaleSetting(setting, by);
    return scene;
}

}  // namespace cairn
