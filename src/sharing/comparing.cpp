/// The part of SharedBodies that finds out whether bodies of different ranks come near each other, and which must be
/// together. Only those that another rank may reach are looked at closely.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "messages/packing.h"
#include "sharing/body_records.h"
#include "sharing/shared_bodies.h"

namespace cairn {

namespace {

/// Covers are larger than what a detection searches by this part of the body's smallest extent, so that they last for
/// some steps. The larger, the more bodies stand in one group that do not touch.
constexpr double slack = 0.1;

/// … and by its way in the time that follows [s].
constexpr double time_ahead = 1.0 / 60;

/// Where no other rank is, realms are larger by the way of the fastest body in this time [s].
constexpr double free_time_ahead = 0.25;

/// Groups that are larger than what was searched are searched for farther away, so often; then everywhere.
constexpr int most_zones = 3;

/// Realms of two ranks that overlap do so by the mean radius of a body's cover, times this.
constexpr double radii_beside = 4;

/// Balls that hold all that is computed otherwise are larger by the rounding of both.
constexpr double rounding = 1.001;

Bounds cubeAround(const Vec3& place, double radius) {
    return Bounds{place, place}.grown(radius);
}

/// The radius of a ball around the centre that holds all that a detection searches. @param way as wayOf()
double radiusOf(const DetectionRange& range, double r_max, double r_min, double way) {
    return rounding * (r_max + range.marginOf(r_min, r_min) + way);
}

void extend(Bounds& bounds, const Vec3& way) {
    bounds.lower += way.cwiseMin(0);
    bounds.upper += way.cwiseMax(0);
}

/// What is known of the bodies of a rank together.
struct Extents {
    Bounds box = emptyBounds();  ///< around their covers [m, W]
    double r_max = 0;            ///< largest [m]
    double r_min = 0;            ///< largest [m]
    double v_squared = 0;        ///< largest of their centres [m²/s²]
    double radii = 0;            ///< sum of those of balls around covers [m]
    std::size_t count = 0;
};

}  // namespace

/// How far a point of any body here gets until the next detection, struck or not [m].
double SharedBodies::wayOf(const DealtOut& world) const {
    const Foresight& foresight = world.range.foresight;
    if (foresight.time == 0) return 0;
    return foresight.time * std::max(world.speed + foresight.fall.norm(), covered_speed_);
}

/// Where a detection searches a body, and where it may be followed to if it is struck.
Bounds SharedBodies::reachOf(const DealtOut& world, BodyIndex i) const {
    BodyAhead ahead;
    Bounds reach = searchedBounds(world.bodies, world.range, i, ahead);
    if (world.range.foresight.time == 0) return reach;
    include(reach, ahead.now.grown(covered_speed_ * world.range.foresight.time));
    return reach;
}

/// Where it will be reaching for some time.
Bounds SharedBodies::coverOf(const DealtOut& world, BodyIndex i) const {
    const Bounds reach = reachOf(world, i);
    Bounds cover = reach.grown(slack * (reach.upper - reach.lower).minCoeff());
    extend(cover, time_ahead * world.bodies.v[i]);
    return cover;
}

/// A ball around the centre of any body here holds its cover with this radius [m].
double SharedBodies::largestCover(const DealtOut& world) const {
    const double radius = radiusOf(world.range, largest_r_max_, largest_r_min_, wayOf(world));
    return (1 + 2 * slack) * radius + time_ahead * largest_v_;
}

/// A cover, or more, that is quickly told. @param way as wayOf()
Bounds SharedBodies::roughCoverOf(const DealtOut& world, BodyIndex i, double way) const {
    const BodyStorage& bodies = world.bodies;
    const double radius = radiusOf(world.range, bodies.r_max[i], bodies.r_min[i], way);
    Bounds cover = cubeAround(bodies.position[i], (1 + 2 * slack) * radius);
    extend(cover, time_ahead * bodies.v[i]);
    return cover;
}

/// Whether what a body reaches is within its cover, or within the realm of this rank and no other.
/// @param way as wayOf() @param cover null = none
bool SharedBodies::isCovered(const DealtOut& world, BodyIndex i, double way, const Bounds* cover) const {
    const BodyStorage& bodies = world.bodies;
    const auto isWithin = [&](const Bounds& place) {
        return (cover != nullptr && cover->contains(place)) || realms_.isFree(place);
    };
    // A ball is quickly told, and within for most.
    const double radius = radiusOf(world.range, bodies.r_max[i], bodies.r_min[i], way);
    return isWithin(cubeAround(bodies.position[i], radius)) || isWithin(reachOf(world, i));
}

/// Whether a body may meet one of another rank that it was not compared with. @pre is_compared_
bool SharedBodies::hasLeft(const DealtOut& world) const {
    const BodyStorage& bodies = world.bodies;
    const double way = wayOf(world);
    for (std::size_t n = 0; n < near_.size(); ++n) {
        const BodyIndex i = near_slots_[n];
        if (isOwn(bodies, i) && !isCovered(world, i, way, &near_[n].cover)) return true;
    }
    const Bounds core = realms_.core().grown(-radiusOf(world.range, largest_r_max_, largest_r_min_, way));
    std::atomic<bool> any = false;
    world.executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (core.contains({bodies.position[i], bodies.position[i]}) || !isOwn(bodies, i) || is_near_[i] != 0)
                continue;
            if (isCovered(world, i, way, nullptr)) continue;
            any.store(true, std::memory_order_relaxed);
            return;
        }
    });
    return any.load(std::memory_order_relaxed);
}

/// Agrees on realms, and tells other ranks of the bodies that these may reach. To be called by all of them.
void SharedBodies::compare(const DealtOut& world) {
    std::vector<std::byte> message;
    const Reach own = reachOfAll(world);
    packBounds(message, own.box);
    pack(message, own.beside);
    std::vector<Reach> reach;
    for (const auto& told : tellAll(ranks_, message)) {
        Unpacker in(told);
        const Bounds box = unpackBounds(in);
        reach.push_back({box, in.get<double>()});
    }
    realms_ = Realms(reach, static_cast<std::size_t>(ranks_.rank()), free_time_ahead * covered_speed_);
    tellNear(world);
    is_compared_ = true;
}

/// Around the covers of all bodies of this rank. Realms overlap by so much that most bodies that go to another rank are
/// in its realm.
Reach SharedBodies::reachOfAll(const DealtOut& world) {
    const BodyStorage& bodies = world.bodies;
    const double way = wayOf(world);
    std::vector<Extents> of_threads(static_cast<std::size_t>(world.executor.threads()));
    world.executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int thread) {
        Extents all;
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (!isOwn(bodies, i)) continue;
            include(all.box, roughCoverOf(world, i, way));
            all.radii += radiusOf(world.range, bodies.r_max[i], bodies.r_min[i], way);
            ++all.count;
            all.r_max = std::max(all.r_max, bodies.r_max[i]);
            all.r_min = std::max(all.r_min, bodies.r_min[i]);
            all.v_squared = std::max(all.v_squared, bodies.v[i].squaredNorm());
        }
        of_threads[static_cast<std::size_t>(thread)] = all;
    });
    Reach reach;
    double radii = 0;
    std::size_t count = 0;
    largest_r_max_ = 0;
    largest_r_min_ = 0;
    largest_v_ = 0;
    for (const Extents& all : of_threads) {
        include(reach.box, all.box);
        radii += all.radii;
        count += all.count;
        largest_r_max_ = std::max(largest_r_max_, all.r_max);
        largest_r_min_ = std::max(largest_r_min_, all.r_min);
        largest_v_ = std::max(largest_v_, rounding * std::sqrt(all.v_squared));
    }
    if (count > 0) reach.beside = radii_beside * radii / static_cast<double>(count);
    return reach;
}

/// Lets every rank know the bodies whose covers reach into its realm.
void SharedBodies::tellNear(const DealtOut& world) {
    const BodyStorage& bodies = world.bodies;
    const auto own = static_cast<std::size_t>(ranks_.rank());
    near_.clear();
    near_slots_.clear();
    is_near_.assign(bodies.slots(), 0);
    Ranks::Messages out(static_cast<std::size_t>(ranks_.size()));
    const double way = wayOf(world);
    const Bounds core = realms_.core().grown(-largestCover(world));
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (core.contains({bodies.position[i], bodies.position[i]}) || !isOwn(bodies, i)) continue;
        if (!realms_.reachesOthers(roughCoverOf(world, i, way))) continue;
        const CoveredBody body{bodies.homeOf(i), coverOf(world, i)};
        if (!realms_.reachesOthers(body.cover)) continue;
        near_.push_back(body);
        near_slots_.push_back(i);
        is_near_[i] = 1;
        for (std::size_t to = 0; to < out.size(); ++to) {
            if (to == own || !realms_.all()[to].overlaps(body.cover)) continue;
            pack(out[to], body.home);
            packBounds(out[to], body.cover);
        }
    }
    others_.clear();
    for (const auto& told : ranks_.exchange(std::move(out))) {
        for (Unpacker in(told); !in.isAtEnd();) {
            const auto home = in.get<BodyIndex>();
            others_.push_back({home, unpackBounds(in)});
        }
    }
}

/// Finds the groups that bodies of two ranks are in or that may belong elsewhere, and who has them. To be called by all
/// ranks. @return whether there are any on any rank
bool SharedBodies::findMoving(const DealtOut& world) {
    const BodyStorage& bodies = world.bodies;
    groups_.meet(near_, others_, world.search, world.executor);
    std::vector<BodyIndex> some;
    for (const std::uint32_t n : groups_.met()) some.push_back(near_slots_[n]);
    for (BodyIndex i = 0; goHome(world.step) && i < bodies.slots(); ++i) {
        if (isOwn(bodies, i) && ownerOf(bodies.homeOf(i), bodies.position[i], world.step) != ranks_.rank()) {
            some.push_back(i);
        }
    }
    const auto any = gatherAll(ranks_, static_cast<std::uint8_t>(some.empty() ? 0 : 1));
    if (std::ranges::find(any, 1) == any.end()) return false;
    findGroupsOf(world, some);
    groups_.joinAcross(ranks_);
    findOwners(world);
    return true;
}

/// Calls visit(a, b) for the bodies of this rank that touched in the last step or belong together otherwise.
template <class Visit>
void SharedBodies::forJoined(const DealtOut& world, const Visit& visit) const {
    const auto visitOwn = [&](BodyIndex a, BodyIndex b) {
        if (isOwn(world.bodies, a) && isOwn(world.bodies, b)) visit(a, b);
    };
    for (const Contact& contact : world.contacts) visitOwn(contact.a, contact.b);
    for (const BodyPair& pair : world.tied) visitOwn(pair.a, pair.b);
}

/// Finds the groups of some bodies of this rank, which are in around_ with others then.
void SharedBodies::findGroupsOf(const DealtOut& world, std::span<const BodyIndex> some) {
    Bounds zone = emptyBounds();
    for (const BodyIndex i : some) include(zone, coverOf(world, i));
    // Most groups are small.
    zone = zone.grown(largestCover(world));
    for (int zones = 1;; ++zones) {
        findGroups(world, zone);
        std::vector<std::uint8_t> of_group(around_.slots.size(), 0);
        for (const BodyIndex i : some) of_group[groups_.groupOf(around_.index[i])] = 1;
        around_.moves.resize(of_group.size());
        for (BodyIndex n = 0; n < of_group.size(); ++n) around_.moves[n] = of_group[groups_.groupOf(n)];
        const std::optional<Bounds> farther = isCutBy(world, zone);
        if (!farther) return;
        zone = zones < most_zones ? *farther : Bounds();
    }
}

/// Finds the groups of those bodies of this rank whose covers are in a zone.
void SharedBodies::findGroups(const DealtOut& world, const Bounds& zone) {
    const BodyStorage& bodies = world.bodies;
    around_.bodies.clear();
    around_.slots.clear();
    around_.index.assign(bodies.slots(), no_slot);
    const double way = wayOf(world);
    std::vector<Vec3> positions;
    const Bounds nearby = zone.grown(largestCover(world));
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (!nearby.contains({bodies.position[i], bodies.position[i]}) || !isOwn(bodies, i)) continue;
        if (!roughCoverOf(world, i, way).overlaps(zone)) continue;
        const Bounds cover = coverOf(world, i);
        if (!cover.overlaps(zone)) continue;
        around_.index[i] = static_cast<BodyIndex>(around_.slots.size());
        around_.slots.push_back(i);
        around_.bodies.push_back({bodies.homeOf(i), cover});
        positions.push_back(bodies.position[i]);
    }
    std::vector<BodyPair> joined;
    forJoined(world, [&](BodyIndex a, BodyIndex b) {
        const BodyPair pair{around_.index[a], around_.index[b]};
        if (pair.a != no_slot && pair.b != no_slot) joined.push_back(pair);
    });
    groups_.find({around_.bodies, positions, joined, world.search, world.executor});
}

/// Whether a group that moves may have bodies that were not found, as it reaches the border of the zone or is joined
/// with what is outside. @return a zone that has more of it
std::optional<Bounds> SharedBodies::isCutBy(const DealtOut& world, const Bounds& zone) const {
    Bounds farther = zone;
    bool is_cut = false;
    const auto reach = [&](const Bounds& place) {
        if (zone.contains(place)) return;
        include(farther, place);
        is_cut = true;
    };
    for (std::size_t n = 0; n < around_.bodies.size(); ++n) {
        if (around_.moves[n] != 0) reach(around_.bodies[n].cover);
    }
    const auto moves = [&](BodyIndex i) { return around_.index[i] != no_slot && around_.moves[around_.index[i]] != 0; };
    forJoined(world, [&](BodyIndex a, BodyIndex b) {
        if (moves(a) && around_.index[b] == no_slot) reach(coverOf(world, b));
        if (moves(b) && around_.index[a] == no_slot) reach(coverOf(world, a));
    });
    return is_cut ? std::optional(farther) : std::nullopt;
}

/// Tells who gets the bodies of the groups that move.
void SharedBodies::findOwners(const DealtOut& world) {
    for (BodyIndex n = 0; n < around_.slots.size(); ++n) {
        if (around_.moves[n] == 0) continue;
        const BodyIndex group = groups_.groupOf(n);
        const int owner = ownerOf(groups_.nameOf(group), groups_.middleOf(group), world.step);
        owner_[around_.slots[n]] = static_cast<std::uint32_t>(owner);
        // Whoever stays, near what goes, is known to the new owner only in its realm.
        is_compared_ = is_compared_ && realms_.all()[static_cast<std::size_t>(owner)].contains(around_.bodies[n].cover);
    }
}

/// Gives back the memory that finding groups took.
void SharedBodies::forgetGroups() {
    groups_ = NearGroups();
    around_ = Around();
}

}  // namespace cairn
