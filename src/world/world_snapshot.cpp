/// The part of World that saves and restores.
#include "cairn/world.h"
#include "world/division.h"
#include "world/rollback.h"
#include "world/snapshot.h"
#include "world/snapshot_parts.h"
#include "world/world_state.h"

namespace cairn {

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
    if (!isDivided()) throw InputError("World::savePart is for a world that is divided; use World::save");
    std::vector<std::byte> part;
    ByteWriter out(part, FrameKind::world_part);
    cairn::savePart(*state_, out);
    out.finish();
    return part;
}

World World::restoreParts(std::span<const SavedPart> parts) {
    if (parts.empty()) throw InputError("a world needs the parts of all ranks; there are none");
    std::vector<ByteReader> readers;
    for (const SavedPart& part : parts) readers.emplace_back(part.bytes, FrameKind::world_part, part.source);
    std::unique_ptr<WorldState> state = loadParts(readers);
    for (const ByteReader& reader : readers) reader.finish();
    return World(std::move(state));
}

World World::restore(std::span<const std::byte> snapshot) {
    ByteReader in(snapshot, FrameKind::world, "snapshot");
    std::unique_ptr<WorldState> state = loadWorld(in);
    in.finish();
    return World(std::move(state));
}

void World::load(std::span<const std::byte> snapshot) {
    requireWhole(*state_, "World::load");
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
    requireWhole(*state_, "World::load");
    if (state.state_ == nullptr) throw InputError("the state is empty; fill it with World::keep() first");
    loadRollback(*state.state_, *state_);
}

}  // namespace cairn
