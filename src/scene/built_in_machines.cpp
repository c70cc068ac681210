/// Built-in scenes of machines that handle stones.
#include <cmath>
#include <numbers>

#include "scene/built_in_tools.h"

namespace cairn {
namespace {

CompoundPart boxPart(const Vec3& size, const Vec3& position, const Quat& orientation = Quat::Identity()) {
    return {Box{tidy(size)}, {tidy(position), tidy(orientation)}, {}, {}};
}

/// What drives a hinge through angles.
void addDrivenHinge(Scene& scene, std::size_t a, std::size_t b, const Vec3& anchor, const Vec3& axis,
                    std::vector<std::pair<double, double>> angles) {
    JointDescription hinge{.kind = JointKind::hinge, .anchor = tidy(anchor), .axis = axis};
    hinge.servo = JointServo{.stiffness = 4e7, .damping = 4e6, .limit = 4e6};
    scene.joints.push_back({a, b, hinge});
    TableMotion table;
    for (const auto& [time, angle] : angles) {
        table.times.push_back(time);
        table.displacements.emplace_back(angle, 0, 0);
    }
    SceneDrive drive{DriveOf::position, scene.joints.size() - 1};
    drive.law = std::move(table);
    scene.drives.push_back(std::move(drive));
}

/// An excavator whose arm moves in the x–z plane while its house looks along x.
class Excavator {
  public:
    explicit Excavator(Scene& scene) : scene_(&scene) {}

    void build() {
        for (const double y : {-0.85, 0.85}) addFixed(Box{{3, 0.5, 0.6}}, {foot.x(), y, 0.3}, "track");
        addFixed(Box{{1.4, 1.2, 0.3}}, {foot.x(), 0, 0.5}, "carriage");
        const std::size_t carriage = scene_->bodies.size() - 1;
        const std::size_t house = addHouse();
        const std::size_t boom = addBoom();
        const std::size_t stick = addLink(elbow, wrist, 0.22, "stick");
        const std::size_t bucket = addBucket();
        addDrivenHinge(*scene_, house, carriage, foot, Vec3::UnitZ(),
                       {{0, 0}, {5.4, 0}, {7.2, 1.15}, {8.6, 1.15}, {10, 0}});
        addDrivenHinge(*scene_, boom, house, shoulder, Vec3::UnitY(),
                       {{0, 0}, {1.2, 0}, {2.6, 0.46}, {4.1, 0.34}, {5.4, -0.16}, {10, -0.16}});
        addDrivenHinge(*scene_, stick, boom, elbow, Vec3::UnitY(),
                       {{0, 0}, {1.2, -0.5}, {2.6, -0.5}, {4.1, 0.25}, {5.4, 0.25}, {7.2, -0.1}, {10, -0.1}});
        addDrivenHinge(
            *scene_, bucket, stick, wrist, Vec3::UnitY(),
            {{0, 0}, {1.2, -0.5}, {2.6, -0.3}, {4.1, 0.9}, {5.4, 1.35}, {7.2, 1.35}, {8.3, -0.7}, {10, -0.7}});
    }

  private:
    const Vec3 foot{-2.6, 0, 0.65};
    const Vec3 shoulder{-1.9, 0, 1.35};
    const Vec3 bend{-0.8, 0, 3.0};
    const Vec3 elbow{0.9, 0, 3.3};
    const Vec3 wrist{1.9, 0, 1.5};

    void addFixed(const Shape& shape, const Vec3& position, std::string name) {
        SceneBody body = dynamicBody(shape, "iron", position);
        body.name = body.name.empty() && name == "track" ? (position.y() < 0 ? "right track" : "left track") : name;
        body.fixed = true;
        scene_->bodies.push_back(body);
    }

    std::size_t add(Compound compound, const Vec3& position, const char* material, const char* name) {
        SceneBody body = dynamicBody(compound, material, position);
        body.name = name;
        scene_->bodies.push_back(body);
        return scene_->bodies.size() - 1;
    }

    std::size_t addHouse() {
        const Compound house{{boxPart({2.2, 1.7, 0.7}, {-0.3, 0, 0.4}), boxPart({0.9, 0.7, 1.0}, {0.35, 0.5, 1.2}),
                              boxPart({0.9, 1.7, 0.35}, {-0.95, 0, 0.9})}};
        return add(house, foot, "paint", "house");
    }

    /// The part of a link between two points of the x–z plane, in a frame at an origin.
    static CompoundPart beam(const Vec3& from, const Vec3& to, double thickness, const Vec3& origin) {
        const Vec3 way = to - from;
        const Quat turn = aboutAxis(Vec3::UnitY(), -std::atan2(way.z(), way.x()));
        return boxPart({way.norm() + 0.5 * thickness, 0.8 * thickness, thickness}, 0.5 * (from + to) - origin, turn);
    }

    std::size_t addBoom() {
        return add({{beam(shoulder, bend, 0.34, bend), beam(bend, elbow, 0.28, bend)}}, bend, "paint", "boom");
    }

    std::size_t addLink(const Vec3& from, const Vec3& to, double thickness, const char* name) {
        const Vec3 middle = 0.5 * (from + to);
        return add({{beam(from, to, thickness, middle)}}, middle, "paint", name);
    }

    /// Open towards the machine, hung up at its upper edge.
    std::size_t addBucket() {
        constexpr double wide = 0.9;
        constexpr double thick = 0.05;
        Compound bucket;
        const auto plate = [&](const Vec3& from, const Vec3& to) {
            const Vec3 way = to - from;
            const Quat turn = aboutAxis(Vec3::UnitY(), -std::atan2(way.z(), way.x()));
            bucket.parts.push_back(boxPart({way.norm() + thick, wide, thick}, 0.5 * (from + to), turn));
        };
        // Its profile from the lip behind the hinge round to the cutting edge.
        const Vec3 profile[] = {{-0.12, 0, 0}, {0.3, 0, -0.12}, {0.42, 0, -0.45}, {0.22, 0, -0.75}, {-0.18, 0, -0.86}};
        for (std::size_t i = 0; i + 1 < std::size(profile); ++i) plate(profile[i], profile[i + 1]);
        for (const double y : {-0.5 * wide, 0.5 * wide}) {
            std::vector<Vec3> points;
            for (const Vec3& p : profile) {
                for (const double side : {-0.5 * thick, 0.5 * thick}) points.emplace_back(p.x(), y + side, p.z());
            }
            bucket.parts.push_back({ConvexHull(std::move(points)), {}, {}, {}});
        }
        for (const double y : {-0.36, -0.12, 0.12, 0.36}) {
            bucket.parts.push_back(boxPart({0.2, 0.07, 0.05}, {-0.27, y, -0.885}, aboutAxis(Vec3::UnitY(), -0.27)));
        }
        return add(bucket, wrist, "iron", "bucket");
    }

    Scene* scene_;
};

/// Where things stand along the way of the stones.
constexpr double drum_radius = 1.1;
constexpr double drum_length = 3.0;

/// A drum of staves about z with lifters inside; its lower end is closed.
Compound drumShape() {
    constexpr int staves = 24;
    constexpr double thick = 0.1;
    Compound drum;
    for (int i = 0; i < staves; ++i) {
        const Quat turn = aboutAxis(Vec3::UnitZ(), 2 * std::numbers::pi * i / staves);
        const double wide = 2 * (drum_radius + thick) * std::tan(std::numbers::pi / staves);
        drum.parts.push_back(boxPart({thick, wide, drum_length}, turn * Vec3(drum_radius + 0.5 * thick, 0, 0), turn));
        if (i % 4 == 0) {
            drum.parts.push_back(boxPart({0.16, 0.06, drum_length}, turn * Vec3(drum_radius - 0.08, 0, 0), turn));
        }
    }
    drum.parts.push_back(
        {Cylinder{drum_radius + thick, thick}, {Vec3(0, 0, -0.5 * (drum_length + thick)), Quat::Identity()}, {}, {}});
    return drum;
}

SceneBody machinePart(const Shape& shape, const Vec3& position, const Quat& orientation, const char* material,
                      const char* name) {
    SceneBody body = dynamicBody(shape, material, position);
    body.orientation = tidy(orientation);
    body.fixed = true;
    body.name = name;
    return body;
}

/// A belt up a slope in the x–z plane, with boards along it. @param from, to the middles of its ends [m, W]
void addConveyor(Scene& scene, const Vec3& from, const Vec3& to) {
    constexpr double wide = 2.1;
    const Vec3 way = to - from;
    const Quat about = aboutAxis(Vec3::UnitZ(), way.x() < 0 ? std::numbers::pi : 0);
    const Quat turn = about * aboutAxis(Vec3::UnitY(), -std::atan2(way.z(), std::abs(way.x())));
    const Pose pose{0.5 * (from + to), turn};
    const auto add = [&](const Vec3& size, const Vec3& place, const char* material, const char* name) {
        scene.bodies.push_back(machinePart(Box{tidy(size)}, pose.toOuter(place), turn, material, name));
    };
    add({way.norm(), wide, 0.12}, Vec3::Zero(), "rubber", "belt");
    scene.bodies.back().surface_velocity = {1.2, 0, 0};
    add({way.norm(), 0.08, 0.55}, {0, -0.5 * wide - 0.04, 0.16}, "paint", "right board");
    add({way.norm(), 0.08, 0.55}, {0, 0.5 * wide + 0.04, 0.16}, "paint", "left board");
    add({0.08, wide, 0.55}, {-0.5 * way.norm() - 0.04, 0, 0.16}, "paint", "foot board");
    for (const double part : {0.12, 0.88}) {
        const Vec3 top = from + part * way;
        const double height = top.z() - 0.1;
        scene.bodies.push_back(machinePart(Box{tidy(Vec3(0.14, 1.7, height))}, {top.x(), 0, 0.5 * height},
                                           Quat::Identity(), "iron", part < 0.5 ? "lower leg" : "upper leg"));
    }
}

}  // namespace

Scene excavatorScene(std::string name) {
    Scene scene = emptyScene(std::move(name), 10, {0, 0, -9.81});
    scene.materials = {{"iron", 7874}, {"paint", 3000}, {"granite", 2800}};
    scene.default_pair = {.restitution = 0.05, .static_friction = 0.6, .kinetic_friction = 0.5};
    scene.bodies.push_back(ground());
    Excavator(scene).build();
    SplitMix64 random(1974);
    addStones(scene, {{Vec3(2.5, 0, 0.2), Quat::Identity()}, 9, 11, 6, 0.16, "granite"}, random);
    return scene;
}

Scene drumScene(std::string name) {
    Scene scene = emptyScene(std::move(name), 14, {0, 0, -9.81});
    scene.materials = {{"rubber", 1200}, {"paint", 3000}, {"iron", 7874}, {"granite", 2800}};
    scene.default_pair = {.restitution = 0.1, .static_friction = 0.6, .kinetic_friction = 0.5};
    scene.bodies.push_back(ground());
    // The drum's open end looks against x and down, to the foot of the belt.
    const Vec3 centre(2.1, 0, 2.45);
    const Quat tilt = aboutAxis(Vec3::UnitY(), -0.5 * std::numbers::pi - 0.2);
    SceneBody drum = machinePart(drumShape(), centre, tilt, "iron", "drum");
    drum.motion = ConstantMotion{.spin = tidy(Vec3(tilt * Vec3(0, 0, 1.2)))};
    scene.bodies.push_back(drum);
    addConveyor(scene, {1.15, 0, 0.35}, {-4.2, 0, 2.3});
    SplitMix64 random(1969);
    const Quat level = tilt * aboutAxis(Vec3::UnitY(), 0.5 * std::numbers::pi);
    addStones(scene, {{centre - Vec3(0, 0, 0.5), level}, 11, 6, 6, 0.12, "granite"}, random);
    return scene;
}

}  // namespace cairn
