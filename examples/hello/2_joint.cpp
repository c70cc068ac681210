// An iron ball on a rope swings into the pyramid.
#include <cairn/cairn.h>

#include <cstdio>

int main() {
    cairn::World world;
    world.setGravity({0, 0, -10});
    const auto oak = world.addMaterial({.name = "oak", .density = 800});
    const auto iron = world.addMaterial({.name = "iron", .density = 7800});
    world.addBody({.shape = cairn::HalfSpace{}, .material = oak, .fixed = true});

    cairn::BodyId top;
    for (int layer = 0; layer < 4; ++layer) {
        for (int i = layer; i < 4; ++i) {
            cairn::BodyDescription box{.shape = cairn::Box{{0.2, 0.2, 0.2}}, .material = oak};
            box.pose.position = {0.21 * i - 0.105 * layer, 0, 0.1 + 0.2 * layer};
            top = world.addBody(box);
        }
    }

    cairn::BodyDescription ball{.shape = cairn::Sphere{.radius = 0.15}, .material = iron};
    ball.pose.position = {-2.3, 0, 2.5};
    const auto id = world.addBody(ball);
    const auto rope = world.addJoint(
        {.kind = cairn::JointKind::rope, .a = id, .anchor = ball.pose.position, .anchor_b = cairn::Vec3(-0.3, 0, 2.5)});

    do world.step();
    while (world.linearVelocity(id).z() < 0);
    const double pull = world.joint(rope).force.norm() / (10 * world.mass(id));
    std::printf("after %.2f s the rope bears %.2f times the weight of the ball\n", world.time(), pull);

    while (world.time() < 3) world.step();
    std::printf("after %.0f s the top box lies %.1f m away\n", world.time(),
                (world.pose(top).position - cairn::Vec3(0.315, 0, 0.7)).norm());
}
