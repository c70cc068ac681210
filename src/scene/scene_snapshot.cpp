/// The part of SceneRun that saves and restores.
#include "cairn/scene.h"
#include "world/snapshot.h"

namespace cairn {

SceneRun::SceneRun(Scene scene, World world, std::vector<BodyId> ids, std::size_t next_event)
    : scene_(std::move(scene)), world_(std::move(world)), ids_(std::move(ids)), next_event_(next_event) {
    takeDrives();
}

std::vector<std::byte> SceneRun::save() const {
    std::vector<std::byte> snapshot;
    ByteWriter out(snapshot, FrameKind::scene_run);
    out.putText(formatScene(scene_));
    out.put(std::uint64_t{next_event_});
    out.put(std::uint64_t{ids_.size()});
    for (const BodyId id : ids_) {
        out.put(id.index);
        out.put(id.generation);
    }
    out.putArray(std::span<const std::byte>(world_.save()));
    out.finish();
    return snapshot;
}

SceneRun SceneRun::restore(std::span<const std::byte> snapshot, std::string_view source) {
    ByteReader in(snapshot, FrameKind::scene_run, std::string(source));
    Scene scene = parseScene(in.getText(), source);
    const auto next_event = in.get<std::uint64_t>();
    const auto count = in.get<std::uint64_t>();
    if (count != scene.bodies.size()) in.refuse("another number of bodies than the scene has");
    if (next_event > scene.events.size()) in.refuse("more events than the scene has");
    std::vector<BodyId> ids(count);
    for (BodyId& id : ids) {
        id.index = in.get<std::uint32_t>();
        id.generation = in.get<std::uint32_t>();
    }
    std::vector<std::byte> world;
    in.getArray(world);
    in.finish();
    return {std::move(scene), World::restore(world), std::move(ids), next_event};
}

}  // namespace cairn
