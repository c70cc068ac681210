#include "record/force_lines.h"

#include <algorithm>

#include "geometry/body_mass.h"

namespace cairn {

namespace {

Vec3 centreOf(const SceneBody& body, const Scene& scene) {
    if (body.fixed) return Vec3::Zero();
    const auto material = std::ranges::find(scene.materials, body.material, &Material::name);
    const double density = material != scene.materials.end() ? material->density : 1;
    return bodyMass(body.shape, density, {body.mass, body.centre_of_mass, body.inertia}).body_in_shape.position;
}

void append(std::vector<float>& out, const Vec3& v) {
    for (int i = 0; i < 3; ++i) out.push_back(static_cast<float>(v[i]));
}

}  // namespace

/// On a body, at a point.
struct ForceLines::Force {
    std::size_t body;
    std::int32_t other;
    Vec3 point;
    Vec3 force;
    double normal;
    bool of_joint;
};

ForceLines::ForceLines(const Scene& scene, double steps_per_second)
    : scene_(&scene), steps_per_second_(steps_per_second) {
    for (const SceneBody& body : scene.bodies) centres_.push_back(centreOf(body, scene));
}

void ForceLines::of(const Frame& frame, VtkLines& lines) const {
    lines.clear();
    for (std::size_t i = 0; i < frame.contact_a.size(); ++i) {
        const auto a = static_cast<std::size_t>(frame.contact_a[i]);
        const auto b = static_cast<std::size_t>(frame.contact_b[i]);
        if (std::max(a, b) >= centres_.size()) throw IoError("the recording is damaged: contacts of no body");
        const Vec3 force = frame.contact_impulse[i] * steps_per_second_;
        if (force.isZero(0)) continue;
        const double normal = force.dot(frame.contact_normal[i]);
        const Vec3& point = frame.contact_point[i];
        add(frame, {a, static_cast<std::int32_t>(b), point, force, normal, false}, lines);
        add(frame, {b, static_cast<std::int32_t>(a), point, -force, normal, false}, lines);
    }
    for (std::size_t i = 0; i < frame.joint_force.size(); ++i) {
        const SceneJoint& joint = scene_->joints[i];
        const Vec3& force = frame.joint_force[i];
        // Gears and their like act through the two joints that they join; broken joints hold nothing.
        if (joint.first || !force.allFinite()) continue;
        const auto b = joint.b ? static_cast<std::int32_t>(*joint.b) : -1;
        add(frame, {joint.a, b, frame.joint_point[i], force, force.norm(), true}, lines);
        if (!joint.b) continue;
        add(frame, {*joint.b, static_cast<std::int32_t>(joint.a), frame.joint_point[i], -force, force.norm(), true},
            lines);
    }
}

void ForceLines::add(const Frame& frame, const Force& force, VtkLines& lines) const {
    if (scene_->bodies[force.body].fixed || !frame.position[force.body].allFinite()) return;
    append(lines.points, frame.position[force.body] + frame.orientation[force.body] * centres_[force.body]);
    append(lines.points, force.point);
    append(lines.vector, force.force);
    lines.force.push_back(static_cast<float>(force.force.norm()));
    lines.normal_force.push_back(static_cast<float>(force.normal));
    lines.body.push_back(static_cast<std::int32_t>(force.body));
    lines.other.push_back(force.other);
    lines.joint.push_back(force.of_joint ? 1 : 0);
}

}  // namespace cairn
