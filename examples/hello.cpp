// A ball falls onto the ground and comes to rest.
#include <cairn/cairn.h>

#include <cstdio>

int main() {
    cairn::World world;
    world.setGravity({0, 0, -10});
    const auto oak = world.addMaterial({.name = "oak", .density = 800});

    cairn::BodyDescription ground{.shape = cairn::HalfSpace{}, .material = oak, .fixed = true};
    cairn::BodyDescription ball{.shape = cairn::Sphere{.radius = 0.1}, .material = oak};
    ball.pose.position = {0, 0, 1};
    world.addBody(ground);
    const auto id = world.addBody(ball);

    while (!world.isAsleep(id)) world.step();
    std::printf("at rest after %.1f s at a height of %.2f m\n", world.time(), world.pose(id).position.z());
}
