#include "world/resolving.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "batches/batch_motion.h"
#include "resolution/contact_law.h"
#include "resolution/energy_gain.h"
#include "world/checks.h"
#include "world/joints.h"
#include "world/pair_laws.h"

namespace cairn {

namespace {

/// Most times that a step is looked through for what its resolution left: each takes an impact that follows from the
/// last one, or goes on with sweeps that were not enough.
constexpr int most_follows = 64;

/// Sweeps go on where bodies would get into each other in this step so that they overlap by more than this multiple of
/// what they may, unless it is less than this part of it that they still get on: what presses for long goes deeper step
/// by step.
constexpr double most_overlap = 1.2, least_way = 0.1;

/// How many contacts away from such a one bodies are resolved with all their contacts: farther where contacts push
/// and have not bounced, since what has bounced is not undone.
constexpr int near_reach = 2, far_reach = 4;

/// What of the batches is left out because it sleeps.
Selecting selectingOf(const WorldState& world) {
    const ResolutionKind resolution = world.settings.resolution.resolution;
    if (resolution == ResolutionKind::none) return Selecting::everything;
    return resolution == ResolutionKind::accelerated_sweeps ? Selecting::awake_parts : Selecting::awake_batches;
}

/// Resolves what is awake, and more of it where that disturbs sleepers.
/// @param without_contacts as in SelectionInput
void resolveChosen(WorldState& world, BodyState& bodies, std::span<const BatchView> batches,
                   std::span<const BodyMotion> without_contacts = {}) {
    StepData& data = world.data;
    const ResolutionSettings& settings = world.settings.resolution;
    // What would keep a body from falling asleep wakes it.
    data.selection.begin({batches, data.contacts, bodies, selectingOf(world), world.settings.sleep.sleep_threshold,
                          world.executor, without_contacts});
    bodies.held = data.selection.held();
    do {
        data.resolution_counts.add(
            world.resolution->resolve({data.selection.chosen(), data.contacts, bodies, settings, world.executor}));
    } while (data.selection.widen());
    data.selection.finish();
}

/// How far the bodies of a contact would get into each other in this step, with the velocities that they have [m];
/// ≤ 0 = not at all.
double wayInto(const Contact& contact, const BodyState& bodies) {
    return (-normalVelocity(contact, bodies) - contact.allowed_closing) * bodies.time_step;
}

/// Whether the resolution moves neither body of a contact, or of a pair.
bool areFixedOrAsleep(const auto& pair, const BodyState& bodies) {
    const auto rests = [&](BodyIndex i) { return bodies.isFixed(i) || bodies.asleep[i] != 0; };
    return rests(pair.a) && rests(pair.b);
}

/// Calls visit(index) for the contacts of those of some pairs that the resolution moves.
template <class Visit>
void forAwake(std::span<const ContactPair> pairs, const BodyState& bodies, const Visit& visit) {
    for (const ContactPair& pair : pairs) {
        if (!pair.touches() || areFixedOrAsleep(pair, bodies)) continue;
        for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) visit(i);
    }
}

/// Whether a contact pushed bodies apart that now part faster than what only comes to rest.
bool hasBounced(const Contact& contact, const BodyState& bodies, const ResolutionSettings& settings) {
    return contact.restitution > 0 && contact.normal.dot(contact.impulse) > 0 &&
           normalVelocity(contact, bodies) > settings.restitution_threshold;
}

/// Takes what a contact gave from the velocities of its bodies, which sleepers must not have while they sleep.
/// @param sleepers theirs
void takeBack(const Contact& contact, const BodyState& bodies, std::span<BodyMotion> sleepers) {
    for (const auto& [i, sign] : {std::pair(contact.a, 1.0), std::pair(contact.b, -1.0)}) {
        if (bodies.isFixed(i)) continue;
        const bool sleeps = bodies.asleep[i] != 0;
        Vec3& v = sleeps ? sleepers[i].v : bodies.v[i];
        Vec3& w = sleeps ? sleepers[i].w : bodies.w[i];
        const Vec3 lever = contact.pointOn(i) - bodies.position[i];
        v -= sign * bodies.mass_inv[i] * contact.impulse;
        w -= sign * (bodies.inertiaInv_W[i] * (lever.cross(contact.impulse) + contact.angular_impulse));
    }
}

/// Goes back to before the resolution of a group's contacts, which then begin with what it found. Where one of them
/// has bounced, or one of those that were added bounces, the impacts follow each other: then the velocities stay, and
/// all begin with nothing. (Bodies at the edge of a group keep what other contacts gave them, so that going back to
/// before an impact would raise the energy.) Sleepers at the edge are held by others as well: they are in balance, and
/// begin with what only the group's contacts hold them against.
void beginAgain(StepData& data, const BodyState& bodies, const FollowedGroup& group) {
    for (const BodyIndex i : group.view.bodies) data.without_contacts[i] = {Vec3::Zero(), Vec3::Zero()};
    for (const std::uint32_t i : group.view.contacts) {
        Contact& contact = data.contacts[i];
        data.resolved.push_back(contact);
        if (group.later) {
            contact.last_impulse.setZero();
            contact.reference_impulse.setZero();
        } else {
            takeBack(contact, bodies, data.without_contacts);
            contact.last_impulse = contact.impulse;
        }
        contact.impulse.setZero();
        contact.angular_impulse.setZero();
    }
}

/// @param resolved the contacts of the group before
void finishAgain(StepData& data, const BodyState& bodies, const FollowedGroup& group,
                 std::span<const Contact> resolved) {
    const auto isHeld = [&](BodyIndex i) { return !bodies.isFixed(i) && bodies.isImmovable(i); };
    for (std::size_t n = 0; n < resolved.size(); ++n) {
        Contact& contact = data.contacts[group.view.contacts[n]];
        contact.last_impulse = resolved[n].last_impulse;
        contact.restitution = resolved[n].restitution;
        if (!group.later) continue;
        contact.impulse += resolved[n].impulse;
        contact.angular_impulse += resolved[n].angular_impulse;
        const bool held = isHeld(contact.a) || isHeld(contact.b);
        contact.reference_impulse = held ? resolved[n].reference_impulse : contact.impulse;
    }
}

/// Whether a group that is resolved again may go back to before.
enum class GoesBack { where_nothing_bounced, never };

/// Resolves groups of contacts once more.
void resolveGroups(WorldState& world, BodyState& bodies, std::span<const BatchView> groups, GoesBack goes_back) {
    StepData& data = world.data;
    // Where impacts follow each other, what sweeps left closing is the next one.
    const bool each_bounces = world.settings.resolution.impacts == Impacts::sequential;
    const double threshold = world.settings.resolution.restitution_threshold;
    data.followed.clear();
    data.resolved.clear();
    data.without_contacts.resize(bodies.size());
    for (const BatchView& view : groups) {
        bool strikes = false;
        bool bounced = false;
        for (const std::uint32_t i : view.contacts) {
            const bool added = std::ranges::binary_search(data.added, i);
            const bool struck =
                added && isImpact(data.contacts[i], normalVelocity(data.contacts[i], bodies), threshold);
            strikes = strikes || struck;
            bounced = bounced || (!added && hasBounced(data.contacts[i], bodies, world.settings.resolution));
        }
        data.followed.push_back({view, strikes || bounced || goes_back == GoesBack::never});
        beginAgain(data, bodies, data.followed.back());
        if (!data.followed.back().later || each_bounces) continue;
        // What sweeps left closing had its bounce.
        for (const std::uint32_t i : view.contacts) {
            if (!strikes || std::ranges::binary_search(data.unresolved, i)) data.contacts[i].restitution = 0;
        }
    }
    resolveChosen(world, bodies, groups, data.without_contacts);
    std::span<const Contact> resolved = data.resolved;
    for (const FollowedGroup& group : data.followed) {
        finishAgain(data, bodies, group, resolved.first(group.view.contacts.size()));
        resolved = resolved.subspan(group.view.contacts.size());
    }
}

/// Lists the groups that went back and have more kinetic energy now than before, though nothing gave them any, and
/// undoes what was done to them.
void undoGains(WorldState& world, const BodyState& bodies, std::span<const BodyMotion> before) {
    StepData& data = world.data;
    data.gained.clear();
    std::span<const Contact> resolved = data.resolved;
    for (const FollowedGroup& group : data.followed) {
        const BatchView& view = group.view;
        const auto contacts = resolved.first(view.contacts.size());
        const auto motions = before.first(view.bodies.size());
        resolved = resolved.subspan(contacts.size());
        before = before.subspan(motions.size());
        if (group.later || !view.joints.empty() || !hasStillSupports(view, data.contacts, bodies)) continue;
        EnergyGain gain;
        double energy = 0;
        for (std::size_t n = 0; n < motions.size(); ++n) {
            const BodyIndex i = view.bodies[n];
            gain.add(bodies, i, motions[n], {bodies.v[i], bodies.w[i]});
            energy += kineticEnergyOf(bodies, i, motions[n]);
        }
        if (!(gain.whole() > energy_rounding * energy)) continue;
        for (std::size_t n = 0; n < motions.size(); ++n) {
            bodies.v[view.bodies[n]] = motions[n].v;
            bodies.w[view.bodies[n]] = motions[n].w;
        }
        for (std::size_t n = 0; n < contacts.size(); ++n) data.contacts[view.contacts[n]] = contacts[n];
        data.gained.push_back(view);
    }
}

/// Likewise. Bodies at the edge of a group keep what other contacts gave them, so that going back to before may raise
/// the energy: where it did, what is missing is added to what was resolved before. (Where impacts are resolved one
/// after the other, what a first resolution took from them may come back.)
void resolveAgain(WorldState& world, BodyState& bodies, std::span<const BatchView> groups) {
    StepData& data = world.data;
    data.motions.clear();
    for (const BatchView& view : groups) {
        for (const BodyIndex i : view.bodies) data.motions.push_back({bodies.v[i], bodies.w[i]});
    }
    resolveGroups(world, bodies, groups, GoesBack::where_nothing_bounced);
    if (world.settings.resolution.impacts == Impacts::sequential) return;
    undoGains(world, bodies, data.motions);
    if (!data.gained.empty()) resolveGroups(world, bodies, data.gained, GoesBack::never);
}

/// Resolves the surroundings of the contacts that were added or left closing. Bodies with joints take no part.
/// @pre data.contacts_of
void resolveFollowed(WorldState& world, BodyState& bodies) {
    StepData& data = world.data;
    applyPairLaws(world, bodies, data.added);
    const auto leads = [&](const Contact& contact) {
        return contact.normal.dot(contact.impulse) > 0 && !hasBounced(contact, bodies, world.settings.resolution);
    };
    data.seeds.clear();
    std::ranges::merge(data.added, data.unresolved, std::back_inserter(data.seeds));
    data.surroundings.find({world.bodies.kind, data.contacts, data.contacts_of, data.jointed}, data.seeds,
                           {near_reach, far_reach, leads});
    resolveAgain(world, bodies, data.surroundings.groups());
}

bool hasJoint(const StepData& data, const Contact& contact) {
    return !data.jointed.empty() && (data.jointed[contact.a] | data.jointed[contact.b]) != 0;
}

/// Resolves the impacts of jointed bodies with all that they are in a batch with, and takes these batches' contacts out
/// of those that were added.
void resolveLaunchedJoints(WorldState& world, BodyState& bodies) {
    StepData& data = world.data;
    const std::vector<std::uint32_t>& batch_of = data.batches.batch_of_contact;
    data.launched.clear();
    for (const std::uint32_t i : data.added) {
        if (hasJoint(data, data.contacts[i])) data.launched.push_back(batch_of[i]);
    }
    if (data.launched.empty()) return;
    std::ranges::sort(data.launched);
    data.launched.erase(std::unique(data.launched.begin(), data.launched.end()), data.launched.end());
    std::erase_if(data.added, [&](std::uint32_t i) { return std::ranges::binary_search(data.launched, batch_of[i]); });
    buildJointBlocks(world);
    keepImpactsOnly(world);
    data.launched_views.clear();
    for (const std::uint32_t batch : data.launched) data.launched_views.push_back(data.views[batch]);
    applyPairLaws(world, bodies);
    resolveAgain(world, bodies, data.launched_views);
    for (const BatchView& view : data.launched_views) addJointImpulses(world, view.joints);
}

/// Whether the bodies of a contact would get too far into each other there.
bool closesTooFar(const Contact& contact, const BodyState& bodies) {
    const double left = most_overlap * contact.allowed_overlap - std::max(0.0, -contact.distance);
    return wayInto(contact, bodies) > std::max(least_way * contact.allowed_overlap, left);
}

/// Lists the contacts at which bodies would get too far into each other, in ascending order.
void listClosing(WorldState& world, const BodyState& bodies) {
    StepData& data = world.data;
    data.closing_of.resize(static_cast<std::size_t>(world.executor.threads()));
    for (std::vector<std::uint32_t>& part : data.closing_of) part.clear();
    const std::span<const ContactPair> pairs = data.pairs.pairs();
    world.executor.forBlocks(pairs.size(), [&](std::size_t begin, std::size_t end, int thread) {
        std::vector<std::uint32_t>& part = data.closing_of[static_cast<std::size_t>(thread)];
        forAwake(pairs.subspan(begin, end - begin), bodies, [&](std::uint32_t i) {
            if (closesTooFar(data.contacts[i], bodies)) part.push_back(i);
        });
    });
    data.closing.clear();
    for (const std::vector<std::uint32_t>& part : data.closing_of) {
        data.closing.insert(data.closing.end(), part.begin(), part.end());
    }
    std::ranges::sort(data.closing);
}

/// Likewise, where only the bodies of data.changed have other velocities since the list was made.
void updateClosing(WorldState& world, const BodyState& bodies) {
    StepData& data = world.data;
    data.asked.clear();
    data.is_asked.resize(data.contacts.size(), 0);
    for (const BodyIndex body : data.changed) {
        for (const std::uint32_t i : data.contacts_of[body]) {
            if (std::exchange(data.is_asked[i], 1) == 0) data.asked.push_back(i);
        }
    }
    std::erase_if(data.closing, [&](std::uint32_t i) { return data.is_asked[i] != 0; });
    const auto others = static_cast<std::ptrdiff_t>(data.closing.size());
    for (const std::uint32_t i : data.asked) {
        data.is_asked[i] = 0;
        const Contact& contact = data.contacts[i];
        if (!areFixedOrAsleep(contact, bodies) && closesTooFar(contact, bodies)) data.closing.push_back(i);
    }
    std::sort(data.closing.begin() + others, data.closing.end());
    std::inplace_merge(data.closing.begin(), data.closing.begin() + others, data.closing.end());
}

/// Finds the contacts that the resolution left closing, but those that were added since and those that it is no use to
/// go on with: what presses a body between two that nothing can stop has no solution. @pre data.closing
void findUnresolved(WorldState& world, const BodyState& bodies) {
    StepData& data = world.data;
    data.unresolved.clear();
    std::ranges::copy_if(data.closing, std::back_inserter(data.unresolved), [&](std::uint32_t i) {
        return !std::ranges::binary_search(data.added, i) && !hasJoint(data, data.contacts[i]);
    });
    data.progress.giveUp(data.unresolved, data.added, data.contacts, [&](std::uint32_t i) {
        return wayInto(data.contacts[i], bodies) / data.contacts[i].allowed_overlap;
    });
}

/// Looks ahead for struck bodies and resolves their impacts, and what sweeps left closing, until there is none, or
/// often enough. @return whether contacts were added
bool followStruck(WorldState& world, BodyState& bodies, const PairsInput& pairs) {
    StepData& data = world.data;
    bool any = false;
    data.progress.begin(world.bodies.kind);
    // Whoever went back would get as deep again by what was foreseen of it.
    MaybeStruck whom{data.fastest, data.stopped, world.bodies.held, {}};
    for (int n = 0; n < most_follows; ++n) {
        const std::size_t known = data.contacts.size();
        data.pairs.followStruck(pairs, whom, data.contacts, data.added);
        const bool grown = data.contacts.size() > known;
        if (grown) listContacts(world.bodies.kind, data.contacts, data.contacts_of);
        if (grown || n == 0) {
            listClosing(world, bodies);
        } else {
            updateClosing(world, bodies);
        }
        findUnresolved(world, bodies);
        if (data.added.empty() && data.unresolved.empty()) break;
        any = any || !data.added.empty();
        resolveFollowed(world, bodies);
        data.progress.join(data.surroundings.groups());
        data.changed.clear();
        for (const BatchView& group : data.surroundings.groups()) {
            data.changed.insert(data.changed.end(), group.bodies.begin(), group.bodies.end());
        }
        whom = {data.fastest, {}, {}, data.changed};
    }
    return any;
}

}  // namespace

void batchContacts(WorldState& world) {
    StepData& data = world.data;
    // The same contacts between the same bodies connect what they connected.
    const bool same = world.joints.empty() && data.batched.joints == 0 && data.batched.layout == data.pairs.layout() &&
                      std::ranges::equal(data.batched.kind, world.bodies.kind);
    if (same && world.checks == Checks::off) return;
    data.batched.joints = world.joints.size();
    data.batched.layout = data.pairs.layout();
    data.batched.kind.assign(world.bodies.kind.begin(), world.bodies.kind.end());
    buildBatches(world.bodies.kind, data.contacts, data.batch_scratch, data.batches, world.joints);
    listContacts(world.bodies.kind, data.contacts, data.contacts_of);
    data.views.resize(data.batches.size());
    for (std::size_t i = 0; i < data.views.size(); ++i) data.views[i] = data.batches[i];
    data.schedule.arrange(data.views);
    if (world.checks != Checks::off) checkBatches(world);
}

void resolveContacts(WorldState& world, BodyState& bodies, const PairsInput& pairs) {
    if (world.part.isFirst()) world.data.resolution_counts = {};
    resolveChosen(world, bodies, world.data.views);
    if (pairs.range.foresight.time > 0 && followStruck(world, bodies, pairs)) batchContacts(world);
}

void findBounced(const WorldState& world, const BodyState& bodies, VelocitiesBefore& before) {
    const ResolutionSettings& settings = world.settings.resolution;
    const double slowest = settings.restitution_threshold * settings.restitution_threshold;
    BodyState earlier = bodies;
    earlier.v = before.forced_v;
    earlier.w = before.w;
    forAwake(world.data.pairs.pairs(), bodies, [&](std::uint32_t n) {
        const Contact& contact = world.data.contacts[n];
        if (contact.restitution == 0) return;
        const double kept = contact.restitution * contact.restitution;
        for (const BodyIndex i : {contact.a, contact.b}) {
            if (bodies.isFixed(i)) continue;
            // An impact with the speed s leaves e·s and loses (1 − e²)s². Most contacts lose enough however slow.
            const double worth = kept * before.forced[i] * before.forced[i];
            if ((1 - kept) * slowest >= worth) continue;
            // Bodies that parted may close again, since a third one struck them later in the step.
            const double closing = normalVelocity(contact, earlier);
            const bool bounced =
                hasBounced(contact, bodies, settings) ||
                (contact.normal.dot(contact.impulse) > 0 && isImpact(contact, closing, settings.restitution_threshold));
            const double parting = std::max(normalVelocity(contact, bodies), -contact.restitution * closing);
            if (bounced && (1 - kept) * parting * parting < worth) before.bounced[i] = 1;
        }
    });
}

void resolveLaunched(WorldState& world, BodyState& bodies, const PairsInput& pairs) {
    StepData& data = world.data;
    data.resolution_counts = {};
    data.added.clear();
    data.unresolved.clear();
    for (std::uint32_t i = 0; i < data.contacts.size(); ++i) {
        if (wayInto(data.contacts[i], bodies) > data.contacts[i].allowed_overlap) data.added.push_back(i);
    }
    if (data.added.empty()) return;
    resolveLaunchedJoints(world, bodies);
    resolveFollowed(world, bodies);
    followStruck(world, bodies, pairs);
}

}  // namespace cairn
