// The same as a scene, recorded to a file.
#include <cairn/cairn.h>

#include <cstdio>

/// A body of a scene: everything else as it is by default.
cairn::SceneBody body(const cairn::Shape& shape, const char* material, const cairn::Vec3& position) {
    cairn::SceneBody result;
    result.shape = shape;
    result.material = material;
    result.position = position;
    return result;
}

int main() {
    cairn::Scene scene;
    scene.name = "pyramid";
    scene.duration = 3;
    scene.gravity = {0, 0, -10};
    scene.materials = {{.name = "oak", .density = 800}, {.name = "iron", .density = 7800}};

    scene.bodies.push_back(body(cairn::HalfSpace{}, "oak", {0, 0, 0}));
    scene.bodies.back().fixed = true;
    for (int layer = 0; layer < 4; ++layer)
        for (int i = layer; i < 4; ++i)
            scene.bodies.push_back(
                body(cairn::Box{{0.2, 0.2, 0.2}}, "oak", {0.21 * i - 0.105 * layer, 0, 0.1 + 0.2 * layer}));
    const cairn::Vec3 start(-2.3, 0, 2.5);
    scene.bodies.push_back(body(cairn::Sphere{.radius = 0.15}, "iron", start));
    scene.joints.push_back({.a = scene.bodies.size() - 1, .b = {}, .joint = {.kind = cairn::JointKind::rope}});
    scene.joints.back().joint.anchor = start;
    scene.joints.back().joint.anchor_b = cairn::Vec3(-0.3, 0, 2.5);

    const auto settings = cairn::settingsFor(scene);
    cairn::SceneRun run(scene, settings);
    cairn::RecordingWriter recording("pyramid.h5", scene, settings);
    recording.append(cairn::captureFrame(run, {}));
    for (int frame = 1; frame <= 90; ++frame) recording.append(cairn::captureFrame(run, run.simulationStep()));
    recording.close();
    std::printf("pyramid.h5: 91 frames of %zu bodies\n", scene.bodies.size());
}
