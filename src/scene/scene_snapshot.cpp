/// The part of SceneRun that saves and restores.
#include <optional>

#include "cairn/scene.h"
#include "scene/scene_survey.h"
#include "world/snapshot.h"

namespace cairn {

SceneRun::SceneRun(SceneSource source, World world, std::vector<BodyId> ids, std::size_t next_event)
    : source_(std::move(source)),
      world_(std::move(world)),
      events_(byTime(scene().events)),
      ids_(std::move(ids)),
      next_event_(next_event) {
    takeDrives();
}

namespace {

/// What a run is besides its world.
struct Head {
    Scene scene;
    std::vector<BodyId> ids;
    std::size_t next_event = 0;
};

void saveHead(const SceneSource& source, const std::vector<BodyId>& ids, std::size_t next_event, ByteWriter& out) {
    out.putText(formatScene(source));
    out.put(std::uint64_t{next_event});
    out.put(std::uint64_t{ids.size()});
    for (const BodyId id : ids) {
        out.put(id.index);
        out.put(id.generation);
    }
}

Head loadHead(ByteReader& in, std::string_view source) {
    Head head;
    head.scene = parseScene(in.getText(), source);
    const auto next_event = in.get<std::uint64_t>();
    const auto count = in.get<std::uint64_t>();
    if (count != head.scene.bodies.size()) in.refuse("another number of bodies than the scene has");
    if (next_event > head.scene.events.size()) in.refuse("more events than the scene has");
    head.next_event = next_event;
    head.ids.resize(count);
    for (BodyId& id : head.ids) {
        id.index = in.get<std::uint32_t>();
        id.generation = in.get<std::uint32_t>();
    }
    return head;
}

}  // namespace

std::vector<std::byte> SceneRun::save() const {
    std::vector<std::byte> snapshot;
    ByteWriter out(snapshot, FrameKind::scene_run);
    saveHead(source_, ids_, next_event_, out);
    out.putArray(std::span<const std::byte>(world_.save()));
    out.finish();
    return snapshot;
}

SceneRun SceneRun::restore(std::span<const std::byte> snapshot, std::string_view source) {
    ByteReader in(snapshot, FrameKind::scene_run, std::string(source));
    Head head = loadHead(in, source);
    std::vector<std::byte> world;
    in.getArray(world);
    in.finish();
    return {std::move(head.scene), World::restore(world), std::move(head.ids), head.next_event};
}

std::vector<std::byte> SceneRun::savePart() const {
    const std::vector<std::byte> world = world_.savePart();
    std::vector<std::byte> part;
    ByteWriter out(part, FrameKind::run_part);
    if (world_.ranks()->rank() == 0) saveHead(source_, ids_, next_event_, out);
    out.putArray(std::span<const std::byte>(world));
    out.finish();
    return part;
}

SceneRun SceneRun::restoreParts(std::span<const SavedPart> parts) {
    std::optional<Head> head;
    std::vector<SavedPart> worlds;
    for (const SavedPart& part : parts) {
        ByteReader in(part.bytes, FrameKind::run_part, part.source);
        if (!head) head = loadHead(in, part.source);
        SavedPart& world = worlds.emplace_back(SavedPart{{}, part.source});
        in.getArray(world.bytes);
        in.finish();
    }
    if (!head) throw InputError("a run needs the parts of all ranks; there are none");
    return {std::move(head->scene), World::restoreParts(worlds), std::move(head->ids), head->next_event};
}

}  // namespace cairn
