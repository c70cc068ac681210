/// The part of SceneRun that saves and restores.
#include <utility>

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

/// What a run is besides its scene and its world.
struct Progress {
    std::vector<BodyId> ids;
    std::size_t next_event = 0;
};

void saveProgress(const std::vector<BodyId>& ids, std::size_t next_event, ByteWriter& out) {
    out.put(std::uint64_t{next_event});
    out.put(std::uint64_t{ids.size()});
    for (const BodyId id : ids) {
        out.put(id.index);
        out.put(id.generation);
    }
}

Progress loadProgress(ByteReader& in, const SceneSource& source) {
    Progress progress;
    progress.next_event = in.get<std::uint64_t>();
    const auto count = in.get<std::uint64_t>();
    if (count != source.survey().bodies) in.refuse("another number of bodies than the scene has");
    if (progress.next_event > source.scene().events.size()) in.refuse("more events than the scene has");
    progress.ids.resize(count);
    for (BodyId& id : progress.ids) {
        id.index = in.get<std::uint32_t>();
        id.generation = in.get<std::uint32_t>();
    }
    return progress;
}

struct CommonOfRun {
    Progress progress;
    SavedPart world;
};

CommonOfRun loadCommon(const SavedPart& common, const SceneSource& source) {
    ByteReader in(common.bytes, FrameKind::run_common, common.source);
    CommonOfRun loaded{loadProgress(in, source), {{}, common.source}};
    in.getArray(loaded.world.bytes);
    in.finish();
    return loaded;
}

}  // namespace

std::vector<std::byte> SceneRun::save() const {
    std::vector<std::byte> snapshot;
    ByteWriter out(snapshot, FrameKind::scene_run);
    out.putText(formatScene(source_));
    saveProgress(ids_, next_event_, out);
    out.putArray(std::span<const std::byte>(world_.save()));
    out.finish();
    return snapshot;
}

SceneRun SceneRun::restore(std::span<const std::byte> snapshot, std::string_view source) {
    ByteReader in(snapshot, FrameKind::scene_run, std::string(source));
    SceneSource scene = parseScene(in.getText(), source);
    Progress progress = loadProgress(in, scene);
    std::vector<std::byte> world;
    in.getArray(world);
    in.finish();
    return {std::move(scene), World::restore(world), std::move(progress.ids), progress.next_event};
}

std::vector<std::byte> SceneRun::saveCommon() const {
    const std::vector<std::byte> world = world_.saveCommon();
    std::vector<std::byte> common;
    ByteWriter out(common, FrameKind::run_common);
    saveProgress(ids_, next_event_, out);
    out.putArray(std::span<const std::byte>(world));
    out.finish();
    return common;
}

SceneRun SceneRun::restoreParts(SceneSource source, const SavedPart& common, const ReadPart& read) {
    CommonOfRun loaded = loadCommon(common, source);
    return {std::move(source), World::restoreParts(loaded.world, read), std::move(loaded.progress.ids),
            loaded.progress.next_event};
}

SceneRun SceneRun::restoreParts(SceneSource source, const SavedPart& common, const ReadPart& read, Ranks& ranks,
                                const Partition& partition) {
    CommonOfRun loaded = loadCommon(common, source);
    return {std::move(source), World::restoreParts(loaded.world, read, ranks, partition),
            std::move(loaded.progress.ids), loaded.progress.next_event};
}

}  // namespace cairn
