// Ten boxes are stacked to a pyramid and come to rest.
#include <cairn/cairn.h>

#include <cstdio>

int main() {
    cairn::World world;
    world.setGravity({0, 0, -10});
    const auto oak = world.addMaterial({.name = "oak", .density = 800});
    world.addBody({.shape = cairn::HalfSpace{}, .material = oak, .fixed = true});

    for (int layer = 0; layer < 4; ++layer) {
        for (int i = layer; i < 4; ++i) {
            cairn::BodyDescription box{.shape = cairn::Box{{0.2, 0.2, 0.2}}, .material = oak};
            box.pose.position = {0.21 * i - 0.105 * layer, 0, 0.1 + 0.2 * layer};
            world.addBody(box);
        }
    }

    while (world.statistics().asleep < 10) world.step();
    const auto& last = world.statistics();
    std::printf("%d boxes at rest after %.1f s, with %d contacts\n", static_cast<int>(last.asleep), world.time(),
                static_cast<int>(last.contacts));
}
