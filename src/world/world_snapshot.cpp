/// The part of World that saves and restores.
#include <utility>

#include "cairn/world.h"
#include "world/division.h"
#include "world/rollback.h"
#include "world/snapshot.h"
#include "world/snapshot_parts.h"
#include "world/stillness.h"
#include "world/world_state.h"

namespace cairn {

namespace {

/// Some of the ranks that a world was divided among.
struct RankRange {
    std::size_t begin, end;
};

/// @param common behind what loadDivided() read @param shared as that of loadParts()
std::unique_ptr<WorldState> readParts(ByteReader& common, const DividedWorld& divided, RankRange range,
                                      const ReadPart& read, std::unique_ptr<SharedBodies> shared) {
    std::vector<SavedPart> parts;
    for (std::size_t rank = range.begin; rank < range.end; ++rank) parts.push_back(read(rank));
    std::vector<ByteReader> readers;
    for (const SavedPart& part : parts) readers.emplace_back(part.bytes, FrameKind::world_part, part.source);
    std::unique_ptr<WorldState> state = loadParts(common, divided, readers, std::move(shared));
    for (const ByteReader& reader : readers) reader.finish();
    common.finish();
    return state;
}

}  // namespace

World::World(std::unique_ptr<WorldState> state) : state_(std::move(state)) {}

std::vector<std::byte> World::save() const {
    std::vector<std::byte> snapshot;
    saveTo(snapshot);
    return snapshot;
}

void World::saveTo(std::vector<std::byte>& buffer) const {
    requireWhole(*state_, "World::saveTo");
    ByteWriter out(buffer, FrameKind::world);
    saveWorld(*state_, out);
    out.finish();
}

std::vector<std::byte> World::savePart() const {
    std::vector<std::byte> part;
    savePart([&](std::span<const std::byte> page) { part.insert(part.end(), page.begin(), page.end()); });
    return part;
}

void World::savePart(const std::function<void(std::span<const std::byte>)>& append) const {
    if (!isDivided()) throw InputError("World::savePart is for a world that is divided; use World::save");
    writeFrame(FrameKind::world_part, append, [&](ByteWriter& out) { cairn::savePart(*state_, out); });
}

std::vector<std::byte> World::saveCommon() const {
    if (!isDivided()) throw InputError("World::saveCommon is for a world that is divided; use World::save");
    std::vector<std::byte> common;
    ByteWriter out(common, FrameKind::world_common);
    cairn::saveCommon(*state_, out);
    out.finish();
    return common;
}

World World::restoreParts(const SavedPart& common, const ReadPart& read) {
    ByteReader in(common.bytes, FrameKind::world_common, common.source);
    const DividedWorld divided = loadDivided(in);
    return World(readParts(in, divided, {0, divided.ranks}, read, nullptr));
}

World World::restoreParts(const SavedPart& common, const ReadPart& read, Ranks& ranks, const Partition& partition) {
    ByteReader in(common.bytes, FrameKind::world_common, common.source);
    const DividedWorld divided = loadDivided(in);
    if (!divided.can_stay_divided) {
        World world = restoreParts(common, read);
        world.share(ranks, partition);
        return world;
    }
    const auto first = [&](int rank) {
        return std::size_t{divided.ranks} * static_cast<std::size_t>(rank) / static_cast<std::size_t>(ranks.size());
    };
    return World(readParts(in, divided, {first(ranks.rank()), first(ranks.rank() + 1)}, read,
                           std::make_unique<SharedBodies>(ranks, partition)));
}

World World::restore(std::span<const std::byte> snapshot) {
    ByteReader in(snapshot, FrameKind::world, "snapshot");
    std::unique_ptr<WorldState> state = loadWorld(in);
    in.finish();
    return World(std::move(state));
}

void World::load(std::span<const std::byte> snapshot) {
    beginChange(*state_, "World::load");
    World loaded = restore(snapshot);
    // What the user watches the world with is no part of its state.
    loaded.setChecks(state_->checks);
    loaded.setTracing(state_->trace.tracing);
    loaded.state_->bodies.succeed(state_->bodies);
    loaded.state_->shared = std::move(state_->shared);
    *this = std::move(loaded);
}

RollbackState::RollbackState() = default;
RollbackState::~RollbackState() = default;
RollbackState::RollbackState(RollbackState&&) noexcept = default;
RollbackState& RollbackState::operator=(RollbackState&&) noexcept = default;

void World::keep(RollbackState& state) const {
    requireWhole(*state_, "World::keep");
    if (state.state_ == nullptr) state.state_ = std::make_unique<RollbackData>();
    keepRollback(*state_, *state.state_);
}

void World::load(const RollbackState& state) {
    beginChange(*state_, "World::load");
    if (state.state_ == nullptr) throw InputError("the state is empty; fill it with World::keep() first");
    loadRollback(*state.state_, *state_);
}

}  // namespace cairn
