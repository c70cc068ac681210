#include "golden/making.h"

namespace cairn::golden {
namespace {

/// Adds bodies and joints to a scene, a joint between the last body and another or the world.
class Workshop {
  public:
    explicit Workshop(std::string name) : scene_(groundScene(std::move(name))) {}

    std::size_t add(const Shape& shape, const Vec3& position, const Vec3& velocity = Vec3::Zero()) {
        SceneBody body = bodyOf(shape, position);
        body.linear_velocity = velocity;
        scene_.bodies.push_back(body);
        return scene_.bodies.size() - 1;
    }
    std::size_t addTurned(const Shape& shape, const Vec3& position, const Vec3& axis) {
        const std::size_t body = add(shape, position);
        scene_.bodies[body].orientation = Quat::FromTwoVectors(Vec3::UnitZ(), axis);
        return body;
    }
    void join(std::size_t a, std::optional<std::size_t> b, const JointDescription& joint) {
        scene_.joints.push_back({a, b, joint});
    }
    Scene& scene() { return scene_; }

  private:
    Scene scene_;
};

/// A rod, a slack rope, a chain of balls joints and a spring, all from points of the world.
void hangThings(Workshop& shop) {
    const std::size_t pendulum = shop.add(Sphere{0.1}, {0.4, 3, 1});
    shop.join(pendulum, {}, {.kind = JointKind::distance, .anchor = {0.4, 3, 1}, .anchor_b = Vec3(0, 3, 1.4)});
    const std::size_t roped = shop.add(Box{Vec3::Constant(0.2)}, {0, 4, 1.2}, {1, 0, 0});
    shop.join(roped, {},
              {.kind = JointKind::rope, .anchor = {0.1, 4, 1.3}, .anchor_b = Vec3(0, 4, 1.4), .length = 0.4});
    std::optional<std::size_t> above;
    for (int link = 0; link < 6; ++link) {
        const double x = 0.3 * link;
        const std::size_t capsule = shop.addTurned(Capsule{0.05, 0.2}, {x + 0.15, 5, 1}, Vec3::UnitX());
        shop.join(capsule, above, {.kind = JointKind::ball, .anchor = {x, 5, 1}});
        above = capsule;
    }
    // Struck on its way down.
    shop.add(Sphere{0.12}, {0.6, 5.02, 0.7}, {0, 0, 1});
    const std::size_t sprung = shop.add(Sphere{0.1}, {0, 6, 1});
    shop.scene().springs.push_back(
        {.a = sprung, .b = {}, .anchor_b = {0, 6, 1.5}, .stiffness = 200, .damping = 1, .rest_length = 0.4});
}

/// A car whose motors drive it against a stack of boxes.
void buildCar(Workshop& shop) {
    const std::size_t chassis = shop.add(Box{{0.8, 0.4, 0.1}}, {0, 0, 0.2});
    for (const double x : {-0.3, 0.3}) {
        for (const double y : {-0.25, 0.25}) {
            const Vec3 place(x, y, 0.15);
            const std::size_t wheel = shop.addTurned(Cylinder{0.15, 0.08}, place, Vec3::UnitY());
            shop.join(wheel, chassis,
                      {.kind = JointKind::hinge,
                       .anchor = place,
                       .axis = Vec3::UnitY(),
                       .motor = JointMotor{.speed = 20, .limit = 30}});
        }
    }
    for (int i = 0; i < 3; ++i) shop.add(Box{Vec3::Constant(0.2)}, {0.65, 0.02 * i, 0.1 + 0.2 * i});
    shop.add(Box{{0.2, 0.3, 0.1}}, {0, 0, 0.3});
}

/// A trapdoor that falls to its limit, a lift that drives to its limit with a box on it, and a brake.
void buildDoors(Workshop& shop) {
    const std::size_t door = shop.add(Box{{0.6, 0.4, 0.05}}, {0.3, -2, 1});
    shop.join(door, {},
              {.kind = JointKind::hinge, .anchor = {0, -2, 1}, .axis = Vec3::UnitY(), .lower = -0.1, .upper = 0.6});
    shop.add(Sphere{0.1}, {0.3, -2, 1.15});
    const std::size_t lift = shop.add(Box{{0.5, 0.5, 0.1}}, {0, -3, 0.5});
    shop.join(lift, {},
              {.kind = JointKind::slider,
               .anchor = {0, -3, 0.5},
               .axis = Vec3::UnitZ(),
               .lower = 0,
               .upper = 0.3,
               .motor = JointMotor{.speed = 1, .limit = 2000}});
    shop.add(Box{Vec3::Constant(0.2)}, {0, -3, 0.65});
    const std::size_t braked = shop.add(Box{Vec3::Constant(0.3)}, {0, -4, 0.5}, {1, 0, 0});
    shop.join(braked, {},
              {.kind = JointKind::slider,
               .anchor = {0, -4, 0.5},
               .axis = Vec3::UnitX(),
               .motor = JointMotor{.speed = 0, .limit = 50}});
}

/// A beam of two parts whose joint a falling ball breaks, and a loop of four bars with a box on its way.
void buildFrames(Workshop& shop) {
    const std::size_t held = shop.add(Box{{0.5, 0.1, 0.1}}, {0.25, -5, 0.8});
    shop.join(held, {}, {.kind = JointKind::fixed, .anchor = {0, -5, 0.8}});
    const std::size_t end = shop.add(Box{{0.5, 0.1, 0.1}}, {0.75, -5, 0.8});
    shop.join(end, held, {.kind = JointKind::fixed, .anchor = {0.5, -5, 0.8}, .break_force = 400, .break_torque = 100});
    const std::size_t ball = shop.add(Sphere{0.1}, {0.9, -5, 1.1}, {0, 0, -2});
    shop.scene().bodies[ball].material = "iron";

    const std::size_t left = shop.add(Box{{0.05, 0.05, 1}}, {0, -6, 1}, {0.5, 0, 0});
    const std::size_t right = shop.add(Box{{0.05, 0.05, 1}}, {1, -6, 1}, {0.5, 0, 0});
    const std::size_t bar = shop.add(Box{{1, 0.05, 0.05}}, {0.5, -6, 0.5}, {1, 0, 0});
    for (const std::size_t body : {left, right}) shop.scene().bodies[body].angular_velocity = {0, -1, 0};
    const auto hinge = [&](std::size_t a, std::optional<std::size_t> b, const Vec3& anchor) {
        shop.join(a, b, {.kind = JointKind::hinge, .anchor = anchor, .axis = Vec3::UnitY()});
    };
    hinge(left, {}, {0, -6, 1.5});
    hinge(right, {}, {1, -6, 1.5});
    hinge(bar, left, {0, -6, 0.5});
    hinge(bar, right, {1, -6, 0.5});
    shop.add(Box{{0.2, 0.2, 0.7}}, {1.35, -6, 0.35});
}

}  // namespace

Scene mechanism() {
    Workshop shop("mechanism");
    hangThings(shop);
    buildCar(shop);
    buildDoors(shop);
    buildFrames(shop);
    return shop.scene();
}

}  // namespace cairn::golden
