#include "world/division.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "joints/joint_kinds.h"
#include "messages/packing.h"
#include "world/couplings.h"
#include "world/joints.h"
#include "world/parts.h"
#include "world/step_statistics.h"

namespace cairn {

namespace {

void tie(std::vector<BodyPair>& tied, BodyIndex a, BodyIndex b) {
    if (a != Joint::world && b != Joint::world) tied.push_back({a, b});
}

std::vector<BodyPair> tiedBodies(const WorldState& world) {
    std::vector<BodyPair> tied;
    for (const Spring& spring : world.springs) {
        if (spring.present) tie(tied, spring.a, spring.b);
    }
    for (const Joint& joint : world.joints) {
        if (!joint.present) continue;
        if (!entryOf(joint.kind).uses.couples) {
            tie(tied, joint.a, joint.b);
            continue;
        }
        // What is at one end of a coupling is not the same on all ranks: it depends on who is there.
        const Joint& first = world.joints[joint.first];
        const Joint& second = world.joints[joint.second];
        for (const BodyIndex a : {first.a, first.b}) {
            for (const BodyIndex b : {second.a, second.b}) tie(tied, a, b);
        }
    }
    return tied;
}

/// Calls visit(slot) for all slots that lasting things name, those of joints and springs that are gone as well.
template <class Visit>
void forNamed(WorldState& world, const Visit& visit) {
    for (Joint& joint : world.joints) {
        visit(joint.a);
        visit(joint.b);
    }
    for (Spring& spring : world.springs) {
        visit(spring.a);
        visit(spring.b);
    }
    for (DrivenBody& driven : world.driven) visit(driven.body);
}

std::vector<BodyIndex> namedBodies(WorldState& world) {
    std::vector<BodyIndex> named;
    const auto add = [&](BodyIndex i) {
        if (i < world.bodies.slots()) named.push_back(i);
    };
    forNamed(world, add);
    for (const PairException& exception : world.bodies.filter.exceptions()) {
        add(exception.a);
        add(exception.b);
    }
    return named;
}

/// Brings all that names slots or has an entry of each to where they are now, but for what the rest of the step makes
/// anew.
void rearrangeAll(WorldState& world, const SlotMove& move) {
    StepData& data = world.data;
    forNamed(world, [&](BodyIndex& slot) { slot = move(slot); });
    world.ties.forget();
    data.pairs.rearrange(move);
    for (Contact& contact : data.contacts) {
        contact.a = move(contact.a);
        contact.b = move(contact.b);
    }
    rearrange(data.before.way, move, {});
    rearrange(data.carried, move, Carried::not_at_all);
    rearrange(world.events.asleep_before, move, 0);
    // Of a body that was added after the last step nothing is known; one that comes is the same as in the last step.
    rearrange(data.generation, move, 0);
}

/// Everything of a world that is dealt out.
DealtOut dealtOut(WorldState& world, std::vector<BodyPair>& tied, const DetectionRange& range, double speed) {
    StepData& data = world.data;
    return {.bodies = world.bodies,
            .pairs = data.pairs,
            .contacts = data.contacts,
            .joints = world.joints,
            .named = {},
            .begun = nullptr,
            .tied = tied,
            .search = world.broad_phase,
            .range = range,
            .fastest = data.fastest,
            .speed = speed,
            .step = world.steps,
            .executor = world.executor,
            .rearrange = [&world, &tied](const SlotMove& move) {
                rearrangeAll(world, move);
                for (BodyPair& pair : tied) pair = {move(pair.a), move(pair.b)};
            }};
}

void packFault(std::vector<std::byte>& message, const FaultInfo& fault) {
    pack(message, fault.body);
    pack(message, fault.step);
    pack(message, static_cast<std::uint64_t>(fault.what.size()));
    for (const char letter : fault.what) pack(message, letter);
}

FaultInfo unpackFault(Unpacker& in) {
    FaultInfo fault;
    fault.body = in.get<BodyId>();
    fault.step = in.get<std::int64_t>();
    fault.what.resize(in.get<std::uint64_t>());
    for (char& letter : fault.what) letter = in.get<char>();
    return fault;
}

/// Takes over who is inside of the sensors of all ranks, what they counted in the last step, and the faults of all.
void gatherReports(WorldState& world) {
    Ranks& ranks = world.shared->ranks();
    world.statistics = sumOverRanks(ranks, world.statistics);
    std::vector<std::byte> message;
    pack(message, std::uint64_t{world.data.sensed.size()});
    for (const Sensed& one : world.data.sensed) pack(message, one);
    for (const FaultInfo& fault : world.faults) packFault(message, fault);
    world.data.sensed.clear();
    world.faults.clear();
    for (const auto& told : tellAll(ranks, message)) {
        Unpacker in(told);
        for (auto left = in.get<std::uint64_t>(); left > 0; --left) world.data.sensed.push_back(in.get<Sensed>());
        while (!in.isAtEnd()) world.faults.push_back(unpackFault(in));
    }
}

/// Sorts, and leaves one of those that are alike: what is on all ranks is told by all.
template <class List, class Key>
void sortOut(List& list, const Key& key) {
    std::ranges::stable_sort(list, {}, key);
    const auto same = [&](const auto& one, const auto& other) { return key(one) == key(other); };
    list.erase(std::unique(list.begin(), list.end(), same), list.end());
}

/// Brings what was gathered into the order of one rank, with what follows from the bodies and contacts.
void uniteReports(WorldState& world) {
    StepData& data = world.data;
    placeCouplings(world);
    buildBatches(world.bodies.kind, data.contacts, data.batch_scratch, data.batches, world.joints);
    listContacts(world.bodies.kind, data.contacts, data.contacts_of);
    sortOut(data.sensed, [](const Sensed& one) { return std::tuple(one.sensor, one.body); });
    sortOut(world.faults, [](const FaultInfo& fault) { return std::tuple(fault.step, fault.body); });
    measureOverlaps(world);
}

}  // namespace

void settleShared(WorldState& world, const DetectionRange& range, double speed, bool flown) {
    if (world.shared == nullptr) return;
    StepData& data = world.data;
    SharedBodies& shared = *world.shared;
    const bool was_whole = shared.isWhole();
    std::vector<BodyPair> tied = tiedBodies(world);
    DealtOut dealt = dealtOut(world, tied, range, speed);
    const std::vector<BodyIndex> named = was_whole ? namedBodies(world) : std::vector<BodyIndex>();
    dealt.named = named;
    if (flown && notesWays(world.settings)) dealt.begun = &data.before.way;
    const std::uint64_t layout = world.bodies.layoutVersion();
    shared.settle(dealt);
    data.fastest = shared.fastest();
    if (world.bodies.layoutVersion() == layout) return;
    // In a divided world nobody was added or removed since the last step.
    if (!was_whole) data.generation.assign(world.bodies.generation.begin(), world.bodies.generation.end());
    prepareJoints(world);
    if (!flown && world.settings.diagnostics.diagnostics) {
        // Velocities are still those of the last point.
        data.measured.v.assign(world.bodies.v.begin(), world.bodies.v.end());
        data.measured.w.assign(world.bodies.w.begin(), world.bodies.w.end());
    }
    if (world.events.level == EventLevel::none) return;
    // Nobody fell asleep in this step yet, so whoever came asleep was so before.
    for (BodyIndex i = 0; i < world.bodies.slots(); ++i) world.events.asleep_before[i] |= world.bodies.asleep[i];
}

void gatherShared(WorldState& world) {
    if (world.shared == nullptr || world.shared->isWhole()) return;
    StepData& data = world.data;
    std::vector<BodyPair> tied;
    const DetectionRange range;
    const bool was_dealing = isDealing(world);
    world.shared->gather(dealtOut(world, tied, range, 0));
    world.dealt_extents = {};
    // While bodies are dealt out no step was made yet.
    if (!was_dealing) {
        data.generation.assign(world.bodies.generation.begin(), world.bodies.generation.end());
        gatherReports(world);
        uniteReports(world);
    }
    world.lasting.reset();
    ++world.places_version;
}

void unite(WorldState& world) {
    // Those of a pair all come from one rank, in their order.
    std::ranges::stable_sort(world.data.contacts, {}, [](const Contact& c) { return BodyPair{c.a, c.b}; });
    uniteReports(world);
    world.data.pairs.adopt(world.data.contacts);
}

bool isDealing(const WorldState& world) {
    return world.shared != nullptr && world.shared->isDealing();
}

int leastOnAny(const WorldState& world, int here) {
    if (world.shared == nullptr || world.shared->isWhole()) return here;
    return std::ranges::min(gatherAll(world.shared->ranks(), here));
}

void requireWhole(const WorldState& world, std::string_view call) {
    if (world.shared == nullptr || world.shared->isWhole()) return;
    throw InputError(fmt::format(
        "{} needs all bodies, and the world is divided among {} ranks: call World::gather() on all of them first", call,
        world.shared->ranks().size()));
}

}  // namespace cairn
