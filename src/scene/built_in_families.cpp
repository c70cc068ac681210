#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "scene/built_in_tools.h"

namespace cairn {
namespace {

/// Contacts of stacks that are meant to stand: nothing bounces, little slides.
constexpr PairProperties standing_pair{.restitution = 0, .static_friction = 0.5, .kinetic_friction = 0.5};

/// The seesaw of the catapults. Its plank rests with the loaded end (towards −x) on the ground.
struct Seesaw {
    static constexpr double length = 2;
    static constexpr double width = 0.4;
    static constexpr double thickness = 0.03;
    static constexpr double fulcrum_height = 0.3;

    /// Of the plank; its origin is the plank's centre.
    Pose pose;

    Seesaw() {
        pose.orientation = aboutAxis(Vec3::UnitY(), -std::asin(2 * fulcrum_height / length));
        pose.position = Vec3(0, 0, fulcrum_height) + pose.orientation * Vec3(0, 0, thickness / 2);
    }
    /// A point above the plank. @param x along it @param height above its upper face [m]
    Vec3 above(double x, double y, double height) const { return pose.toOuter({x, y, thickness / 2 + height}); }

    void addTo(Scene& scene) const {
        // A square bar standing on its edge; its lower half is in the ground.
        const double edge = fulcrum_height * std::numbers::sqrt2;
        SceneBody fulcrum = fixedBox({edge, width, edge}, Vec3::Zero());
        fulcrum.name = "fulcrum";
        fulcrum.orientation = tidy(aboutAxis(Vec3::UnitY(), std::numbers::pi / 4));
        scene.bodies.push_back(fulcrum);
        SceneBody plank = dynamicBody(Box{{length, width, thickness}}, "oak", pose.position);
        plank.name = "plank";
        plank.orientation = tidy(pose.orientation);
        scene.bodies.push_back(plank);
    }
};

/// One layer of the load of a catapult.
struct LoadLayer {
    int columns;  ///< along the plank
    int rows;     ///< across
};

/// Puts layers of boxes on the loaded end, each box turned a little about the plank's normal.
/// @param gap between the plank and the lowest layer [m]
void addLoad(Scene& scene, const Seesaw& seesaw, double size, double gap, std::initializer_list<LoadLayer> layers) {
    constexpr double centre = -0.8;
    constexpr double twist = 0.08;
    const double spacing = 1.12 * size;  // a box turned by 0.08 is 1.08 times as wide
    double height = gap + size / 2;
    int count = 0;
    for (const LoadLayer& layer : layers) {
        for (int row = 0; row < layer.rows; ++row) {
            for (int column = 0; column < layer.columns; ++column, ++count) {
                const double x = centre + (column - 0.5 * (layer.columns - 1)) * spacing;
                const double y = (row - 0.5 * (layer.rows - 1)) * spacing;
                SceneBody box = dynamicBody(Box{Vec3::Constant(size)}, "oak", seesaw.above(x, y, height));
                const double angle = count % 2 == 0 ? twist : -twist;
                box.orientation = tidy(seesaw.pose.orientation * aboutAxis(Vec3::UnitZ(), angle));
                scene.bodies.push_back(box);
            }
        }
        height += size;
    }
}

}  // namespace

Scene catapultScene(std::string name) {
    Scene scene = emptyScene(std::move(name), 4, {0, 0, -10});
    scene.default_pair = {.restitution = 0.25, .static_friction = 0.5, .kinetic_friction = 0.5};
    scene.bodies.push_back(ground());
    const Seesaw seesaw;
    seesaw.addTo(scene);
    if (scene.name == "catapult7") {
        addLoad(scene, seesaw, 0.1, 0, {{2, 2}, {1, 2}, {1, 1}});
    } else {
        addLoad(scene, seesaw, 0.064, 0.05, {{3, 3}, {2, 2}, {1, 2}});
    }
    SceneBody weight = dynamicBody(Box{Vec3::Constant(0.2)}, "oak", {0.8, 0, 4});
    weight.name = "weight";
    scene.bodies.push_back(weight);
    return scene;
}

Scene cradleScene(std::string name, int balls, int moving) {
    constexpr double radius = 0.05;
    constexpr double gap = 0.1;
    Scene scene = emptyScene(std::move(name), 2, Vec3::Zero());
    scene.default_pair = {.restitution = 1, .static_friction = 0, .kinetic_friction = 0};
    // The impact goes from ball to ball; resolved at all contacts at once it would spread over the row.
    scene.settings = {{"resolution", std::string("impulse_queue")}};
    for (int i = 0; i < balls; ++i) {
        SceneBody ball = dynamicBody(Sphere{radius}, "iron", {2 * radius * i - (i < moving ? gap : 0), 0, 0});
        if (i < moving) ball.linear_velocity = {1, 0, 0};
        scene.bodies.push_back(ball);
    }
    return scene;
}

Scene swingingCradleScene(std::string name, int balls, int moving) {
    constexpr double radius = 0.05;
    constexpr double length = 1;
    constexpr double angle = 0.3;
    Scene scene = emptyScene(std::move(name), 20, {0, 0, -9.81});
    scene.default_pair = {.restitution = 1, .static_friction = 0, .kinetic_friction = 0};
    for (int i = 0; i < balls; ++i) {
        const Vec3 pivot(2 * radius * i, 0, length);
        const double turn = i < moving ? angle : 0;
        const Vec3 rod = length * Vec3(-std::sin(turn), 0, -std::cos(turn));
        SceneBody ball = dynamicBody(Sphere{radius}, "iron", pivot + rod);
        ball.orientation = tidy(aboutAxis(Vec3::UnitY(), turn));
        scene.bodies.push_back(ball);
        JointDescription hinge{.kind = JointKind::hinge, .anchor = tidy(pivot), .axis = Vec3::UnitY()};
        scene.joints.push_back({static_cast<std::size_t>(i), {}, hinge});
    }
    // Every impact must keep its energy: none is too slow to bounce, nothing is moved apart, nothing is damped.
    scene.preset = Preset::accuracy;
    scene.settings = {{"steps_per_second", 3840.0},
                      {"resolution", std::string("impulse_queue")},
                      {"exact_flight", true},
                      {"correction", std::string("none")},
                      {"restitution_threshold", 1e-9},
                      {"resolution_threshold", 1e-10},
                      {"iterations", 0.0},
                      {"sleeping", false},
                      {"damping", 0.0}};
    return scene;
}

Scene towerScene(std::string name, int boxes) {
    constexpr double size = 0.1;
    Scene scene = emptyScene(std::move(name), 60, {0, 0, -10});
    scene.default_pair = standing_pair;
    scene.bodies.push_back(ground());
    for (int i = 0; i < boxes; ++i) {
        scene.bodies.push_back(dynamicBody(Box{Vec3::Constant(size)}, "oak", {0, 0, (i + 0.5) * size}));
    }
    return scene;
}

Scene wallScene(std::string name, int rows) {
    Scene scene = emptyScene(std::move(name), 60, {0, 0, -10});
    scene.default_pair = standing_pair;
    scene.bodies.push_back(ground());
    addWall(scene, rows, 0, 0.1);
    return scene;
}

}  // namespace cairn
