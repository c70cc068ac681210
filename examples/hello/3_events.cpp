// The events of the run tell what the ball strikes, and which boxes wake.
#include <cairn/cairn.h>

#include <cstdio>
#include <set>
#include <string>

int main() {
    cairn::World world;
    world.setGravity({0, 0, -10});
    const auto oak = world.addMaterial({.name = "oak", .density = 800});
    const auto iron = world.addMaterial({.name = "iron", .density = 7800});
    world.addBody({.shape = cairn::HalfSpace{}, .material = oak, .fixed = true});

    for (int layer = 0; layer < 4; ++layer) {
        for (int i = layer; i < 4; ++i) {
            cairn::BodyDescription box{.shape = cairn::Box{{0.2, 0.2, 0.2}}, .material = oak, .asleep = true};
            box.pose.position = {0.21 * i - 0.105 * layer, 0, 0.1 + 0.2 * layer};
            box.name = "box " + std::to_string(i - layer + 1) + " of layer " + std::to_string(layer + 1);
            world.addBody(box);
        }
    }

    cairn::BodyDescription ball{.shape = cairn::Sphere{.radius = 0.15}, .material = iron, .name = "ball"};
    ball.pose.position = {-2.3, 0, 2.5};
    const auto id = world.addBody(ball);
    world.addJoint(
        {.kind = cairn::JointKind::rope, .a = id, .anchor = ball.pose.position, .anchor_b = cairn::Vec3(-0.3, 0, 2.5)});

    world.setEventLevel(cairn::EventLevel::changes);
    std::set<cairn::BodyId> woken;
    while (world.time() < 2) {
        world.step();
        for (const auto& event : world.events()) {
            if (event.kind == cairn::EventKind::woke && event.a != id) woken.insert(event.a);
            if (event.kind == cairn::EventKind::contact_begun && event.b == id)
                std::printf("%.2f s: the ball touches %s with %.0f N s\n", world.time(), world.name(event.a).c_str(),
                            event.impulse.norm());
        }
    }
    std::printf("boxes that woke: %zu\n", woken.size());
}
