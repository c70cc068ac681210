#include "pairs/pair_table.h"

#include <algorithm>

#include "math/arrays.h"
#include "narrow_phase/narrow_phase.h"
#include "pairs/same_point.h"
#include "pairs/warm_start.h"
#include "pairs/way_back.h"

namespace cairn {

namespace {

/// Fewest pairs worth a thread of their own: most are far from each other, or known.
constexpr std::size_t pair_grain = 256;

/// Whether another contact of the pair is at the same place; the deeper of the two stays.
bool mergeInto(std::span<FoundContact> others, const FoundContact& found, double size) {
    for (FoundContact& other : others) {
        if (!isSameAtOnce(other, found, size)) continue;
        if (found.distance < other.distance) {
            other.point = found.point;
            other.normal = found.normal;
            other.distance = found.distance;
        }
        return true;
    }
    return false;
}

/// Appends the contacts that two bodies have where they are, and those that they would have on their ways.
/// @return whether they are near enough for any
bool collideNear(const BodyStorage& bodies, const BodyPair& pair, const DetectionRange& range, const PairAhead& ahead,
                 Manifold& manifold, std::vector<FoundContact>& contacts) {
    const std::size_t first = contacts.size();
    const double size = std::min(bodies.r_max[pair.a], bodies.r_max[pair.b]);
    const double allowed_overlap = range.overlapOf(bodies.r_min[pair.a], bodies.r_min[pair.b]);
    const double margin = range.marginOf(bodies.r_min[pair.a], bodies.r_min[pair.b]);
    bool touches = false;
    bool reached = false;
    const auto add = [&](const Manifold& found) {
        reached = reached || found.size > 0;
        // Within one manifold points are apart already.
        const std::size_t earlier = contacts.size() - first;
        for (std::size_t k = 0; k < found.size; ++k) {
            const Vec3& point = found.points[k].point;
            const double distance = found.points[k].distance;
            const double apart = distance - margin;
            touches = touches || apart <= 0;
            if (apart > 0 && !ahead.closes(point, found.normal, apart)) continue;
            const double closing = apart > 0 ? apart / range.foresight.time : 0;
            const FoundContact contact{pair.a, pair.b, point, found.normal, distance, allowed_overlap, closing};
            if (mergeInto(std::span(contacts).subspan(first, earlier), contact, size)) continue;
            appendTightly(contacts, contact);
        }
    };
    forEachManifold(bodies.shape[pair.a], bodies.shapePose(pair.a), bodies.shape[pair.b], bodies.shapePose(pair.b),
                    margin + ahead.way(), manifold, add);
    const bool foreseen = !touches && contacts.size() > first;
    if (foreseen && !ahead.wouldMeet()) contacts.resize(first);
    return reached;
}

/// Appends the contacts with triangles that the middle of a body, or of a part of it, would pass through.
/// @pre ahead.mayCross()
void collideCrossed(const BodyStorage& bodies, const BodyPair& pair, const DetectionRange& range,
                    const PairAhead& ahead, std::vector<FoundContact>& contacts) {
    const double allowed_overlap = range.overlapOf(bodies.r_min[pair.a], bodies.r_min[pair.b]);
    ahead.forEachCrossing([&](const Vec3& point, const Vec3& normal, double distance) {
        const double gap = std::max(0.0, distance);
        appendTightly(contacts, {pair.a, pair.b, point, normal, gap, allowed_overlap, gap / range.foresight.time});
    });
}

/// Appends the contacts of one pair. @return whether its bodies may meet elsewhere, too
bool collidePair(const BodyStorage& bodies, const BodyPair& pair, const DetectionRange& range, const PairAhead& ahead,
                 Manifold& manifold, std::vector<FoundContact>& contacts) {
    const bool reached = collideNear(bodies, pair, range, ahead, manifold, contacts);
    if (ahead.mayCross()) collideCrossed(bodies, pair, range, ahead, contacts);
    return reached;
}

/// Finds what keeps the bodies of a pair apart and what it does not have yet: contacts that would be found with the
/// velocities of now, and those of the places where the bodies overlap in the end all the same, since they turn other
/// sides to each other. A contact that the pair has in such a place is tightened.
/// @param n index of the pair @param known its contacts @param part out: what was found
void findMissing(const BodyStorage& bodies, const BodyPair& pair, std::size_t n, const DetectionRange& range,
                 const PairAhead& ahead, Manifold& manifold, std::span<const Contact> known, FoundContacts& part) {
    std::vector<FoundContact>& contacts = part.found;
    const std::size_t first = contacts.size();
    const bool reached = collidePair(bodies, pair, range, ahead, manifold, contacts);
    const double size = std::min(bodies.r_max[pair.a], bodies.r_max[pair.b]);
    const auto isKnown = [&](const FoundContact& found) {
        return std::ranges::any_of(known, [&](const Contact& c) { return isSameAtOnce(c, found, size); });
    };
    contacts.erase(std::remove_if(contacts.begin() + static_cast<std::ptrdiff_t>(first), contacts.end(), isKnown),
                   contacts.end());
    if (!reached || !ahead.isAny()) return;
    const double allowed_overlap = range.overlapOf(bodies.r_min[pair.a], bodies.r_min[pair.b]);
    ahead.forEachAtEnd(manifold, [&](const PairAhead::AtEnd& met) {
        const auto isSame = [&](const auto& c) {
            const Vec3 between = c.point - met.point;
            const Vec3 further = c.slide - met.slide;
            const double on_a_or_b = std::min((between + further).squaredNorm(), (between - further).squaredNorm());
            const double apart = on_a_or_b + size * size * (c.normal - met.normal).squaredNorm();
            return apart < same_at_end * same_at_end * size * size;
        };
        const double gap = std::max(0.0, met.distance);
        const double closing = gap / range.foresight.time;
        const auto same = std::ranges::find_if(known, isSame);
        if (same != known.end()) {
            const auto place = static_cast<std::uint32_t>(same - known.begin());
            part.tighten({n, place, closing}, same->allowed_closing);
            return;
        }
        if (std::ranges::any_of(std::span(contacts).subspan(first), isSame)) return;
        appendTightly(contacts, {pair.a, pair.b, met.point, met.normal, gap, allowed_overlap, closing, met.slide});
    });
}

/// Whether one of two bodies can move and neither filters nor joints keep them from touching. @param excluded sorted
bool mayTouch(const BodyStorage& bodies, std::span<const BodyPair> excluded, const BodyPair& pair) {
    const auto [a, b] = std::pair(bodies.kind[pair.a], bodies.kind[pair.b]);
    if (a == BodyKind::hole || b == BodyKind::hole || (a == BodyKind::fixed && b == BodyKind::fixed)) return false;
    if (bodies.areKeptApart(pair.a, pair.b)) return false;
    return excluded.empty() || !std::ranges::binary_search(excluded, pair);
}

}  // namespace

void PairTable::beginStep(const BodyStorage& bodies, std::span<const std::uint32_t> generation) {
    others_.assign(bodies.slots(), 0);
    bool any = false;
    for (BodyIndex i = 0; i < generation.size(); ++i) {
        if (generation[i] == bodies.generation[i]) continue;
        others_[i] = 1;
        any = true;
    }
    if (any) neighbours_.drop(others_);
}

void PairTable::detect(const PairsInput& input, std::vector<Contact>& contacts) {
    BodyStorage& bodies = input.bodies;
    if (!std::ranges::equal(excluded_, input.excluded)) {
        excluded_.assign(input.excluded.begin(), input.excluded.end());
        askAll();
    }
    findUnmoved(input);
    findBounds(input);
    parts_.resize(static_cast<std::size_t>(input.executor.threads()));
    neighbours_.update({bodies.kind, bounds_, bodies.v, unmoved_}, input.broad_phase, input.executor);
    for (FoundContacts& part : parts_) part.clear();
    forParts(input.executor, [&](FoundContacts& part) { detectPairs(input, contacts, part); });
    join(input, contacts);
    known_ = true;
}

void PairTable::detectBack(const PairsInput& input, std::span<const std::uint8_t> back,
                           std::vector<Contact>& contacts) {
    BodyStorage& bodies = input.bodies;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        unmoved_[i] = back[i] == 0 ? 1 : 0;
        if (back[i] != 0) findBoundsOf(bodies, i);
    }
    neighbours_.update({bodies.kind, bounds_, bodies.v, unmoved_}, input.broad_phase, input.executor);
    for (FoundContacts& part : parts_) part.clear();
    forParts(input.executor, [&](FoundContacts& part) { detectPairsBack(input, contacts, back, part); });
    join(input, contacts);
}

bool PairTable::foundDeep() const {
    return std::ranges::any_of(parts_, [](const FoundContacts& part) { return part.deep; });
}

/// Makes the contacts of what the threads found, and notes where bodies were then.
void PairTable::join(const PairsInput& input, std::vector<Contact>& contacts) {
    addFirst(input.executor);
    const std::size_t before = contacts.size();
    joiner_.join(input.bodies, input.materials, input.executor, parts_, contacts);
    const bool others = std::ranges::any_of(parts_, [](const FoundContacts& part) { return part.others; });
    if (others || contacts.size() != before) ++layout_;
    BodyStorage& bodies = input.bodies;
    input.executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (bodies.kind[i] == BodyKind::hole) continue;
            bodies.detected_position[i] = bodies.position[i];
            bodies.detected_orientation[i] = bodies.orientation[i];
        }
    });
}

void PairTable::followStruck(const PairsInput& input, const MaybeStruck& whom, std::vector<Contact>& contacts,
                             std::vector<std::uint32_t>& added) {
    added.clear();
    DetectionRange range = range_;
    // The velocities have it by now.
    range.foresight.fall.setZero();
    if (!findStruck(input, range, whom)) return;
    neighbours_.update({input.bodies.kind, bounds_, input.bodies.v, unmoved_}, input.broad_phase, input.executor);
    for (FoundContacts& part : parts_) part.clear();
    forParts(input.executor, [&](FoundContacts& part) { followPairs(input, range, contacts, part); });
    const auto hasNothing = [](const FoundContacts& part) { return part.grown.empty() && part.tightened.empty(); };
    if (std::ranges::all_of(parts_, hasNothing)) return;
    forParts(input.executor, [&](FoundContacts& part) { addGrown(part); });
    addFirst(input.executor);
    for (const FoundContacts& part : parts_) {
        for (const FoundContacts::Grown& grown : part.grown) {
            const ContactPair& pair = pairs()[grown.pair];
            for (std::uint32_t i = pair.count - grown.count; i < pair.count; ++i) added.push_back(pair.first + i);
        }
    }
    joiner_.join(input.bodies, input.materials, input.executor, parts_, contacts);
    ++layout_;
    for (const FoundContacts& part : parts_) {
        for (const FoundContacts::Tightened& tightened : part.tightened) {
            const std::uint32_t i = pairs()[tightened.pair].first + tightened.place;
            contacts[i].allowed_closing = tightened.allowed_closing;
            added.push_back(i);
        }
    }
    std::ranges::sort(added);
}

/// Compares every body with where it was detected last.
void PairTable::findUnmoved(const PairsInput& input) {
    const BodyStorage& bodies = input.bodies;
    // What nobody moves towards depends on how it is looked for, not on how far ahead.
    const bool alike = input.range.looksAlike(range_);
    const bool known = known_ && alike;
    if (!alike) ahead_.clear();
    range_ = input.range;
    unmoved_.resize(bodies.slots());
    input.executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (bodies.kind[i] == BodyKind::hole) continue;
            unmoved_[i] = known && bodies.isWhereDetected(static_cast<BodyIndex>(i)) ? 1 : 0;
        }
    });
    // What was found of them elsewhere is not known here.
    for (const BodyIndex i : came_) unmoved_[i] = 0;
    came_.clear();
}

void PairTable::findBounds(const PairsInput& input) {
    const BodyStorage& bodies = input.bodies;
    bounds_.resize(bodies.slots());
    ahead_.resize(bodies.slots());
    settled_.resize(bodies.slots());
    input.executor.forBlocks(bodies.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            // What is awake may have been stopped or pushed since, and who fell asleep was seen to move a little.
            const bool same = range_.foresight.time == 0 || (bodies.asleep[i] != 0 && ahead_[i].isStill());
            settled_[i] = asks_all_ ? 0 : unmoved_[i];
            if (bodies.kind[i] == BodyKind::hole || (unmoved_[i] != 0 && same)) continue;
            findBoundsOf(bodies, i);
            if (ahead_[i].reach > 0) settled_[i] = 0;
        }
    });
    asks_all_ = false;
}

/// Whoever flew far may have met others on the way.
void PairTable::findBoundsOf(const BodyStorage& bodies, BodyIndex i) {
    bounds_[i] = searchedBounds(bodies, range_, i, ahead_[i]);
    if (range_.foresight.time == 0 || !(bodies.linear_step[i].norm() > bodies.r_min[i])) return;
    const Vec3 begun = bodies.position[i] - bodies.linear_step[i];
    bounds_[i].lower = bounds_[i].lower.cwiseMin((begun.array() - bodies.r_max[i]).matrix());
    bounds_[i].upper = bounds_[i].upper.cwiseMax((begun.array() + bodies.r_max[i]).matrix());
}

/// Divides the pairs into parts, one per thread. @param work called with a part
template <class Work>
void PairTable::forParts(const Executor& executor, const Work& work) {
    executor.forBlocks(
        pairs().size(),
        [&](std::size_t begin, std::size_t end, int thread) {
            FoundContacts& part = parts_[static_cast<std::size_t>(thread)];
            part.pair_begin = begin;
            part.pair_end = end;
            work(part);
        },
        pair_grain);
}

/// Looks ahead once more for the bodies that were struck, from where they are. @return whether there are any
bool PairTable::findStruck(const PairsInput& input, const DetectionRange& range, const MaybeStruck& whom) {
    const std::size_t slots = input.bodies.slots();
    struck_.assign(slots, 0);
    unmoved_.assign(slots, 1);
    if (whom.changed) {
        for (const BodyIndex i : *whom.changed) follow(input, range, whom, i);
    } else {
        input.executor.forBlocks(slots, [&](std::size_t begin, std::size_t end, int) {
            for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) follow(input, range, whom, i);
        });
    }
    return std::ranges::find(struck_, 1) != struck_.end();
}

/// Likewise for one body, if it was struck.
void PairTable::follow(const PairsInput& input, const DetectionRange& range, const MaybeStruck& whom, BodyIndex i) {
    const BodyStorage& bodies = input.bodies;
    // Whoever went back does so in every step if the smallest part of its velocity that leads there stays.
    const auto isOneOf = [&](std::span<const std::uint8_t> some) { return !some.empty() && some[i] != 0; };
    const bool stopped = isOneOf(whom.stopped) || isOneOf(whom.held);
    if (!(stopped ? flies(bodies, i) : isStruck(bodies, range, i, ahead_[i]))) return;
    struck_[i] = 1;
    unmoved_[i] = 0;
    lookAhead(bodies, range, i, ahead_[i]);
    const Bounds reached = ahead_[i].now.grown(whom.fastest * range.foresight.time);
    ahead_[i].way.lower = ahead_[i].way.lower.cwiseMax(reached.lower);
    ahead_[i].way.upper = ahead_[i].way.upper.cwiseMin(reached.upper);
    // What was found for the way foreseen stays.
    bounds_[i].lower = bounds_[i].lower.cwiseMin(ahead_[i].way.lower);
    bounds_[i].upper = bounds_[i].upper.cwiseMax(ahead_[i].way.upper);
}

/// Finds what each pair with a struck body lacks to keep the two apart. @param part in: its pairs; out: what was found
void PairTable::followPairs(const PairsInput& input, const DetectionRange& range, std::span<const Contact> contacts,
                            FoundContacts& part) {
    const BodyStorage& bodies = input.bodies;
    Manifold manifold;
    for (std::size_t n = part.pair_begin; n < part.pair_end; ++n) {
        const ContactPair& pair = pairs()[n];
        if ((struck_[pair.a] | struck_[pair.b]) == 0 || !ahead_[pair.a].way.overlaps(ahead_[pair.b].way)) continue;
        if (!mayTouch(bodies, input.excluded, pair)) continue;
        const auto known = pair.contactsIn(contacts);
        const std::size_t begin = part.found.size();
        findMissing(bodies, pair, n, range, {bodies, range, pair, ahead_}, manifold, known, part);
        if (part.found.size() == begin) continue;
        part.grown.push_back({n, static_cast<std::uint32_t>(part.found.size() - begin)});
    }
}

/// Puts what was found behind the contacts of its pairs.
void PairTable::addGrown(FoundContacts& part) {
    auto grown = part.grown.begin();
    std::size_t begin = 0;
    for (std::size_t n = part.pair_begin; n < part.pair_end; ++n) {
        ContactPair& pair = neighbours_.pairs()[n];
        const std::size_t first = part.count;
        if (pair.touches()) part.add(pair.first, pair.count, true);
        pair.first = static_cast<std::uint32_t>(first);
        if (grown == part.grown.end() || grown->pair != n) continue;
        part.add(begin, grown->count, false);
        begin += grown->count;
        pair.count = (pair.touches() ? pair.count : 0) + grown->count;
        pair.ahead = true;
        ++grown;
    }
}

/// @param part out: what was found
void PairTable::detectPair(const PairsInput& input, std::span<const Contact> last, PairState state, Manifold& manifold,
                           ContactPair& pair, FoundContacts& part) {
    const bool settled = state == PairState::settled;
    // Most pairs are only near each other, and this is quickly told.
    if (!settled && !bounds_[pair.a].overlaps(bounds_[pair.b])) {
        // What is not written need not leave the processor's cache.
        if (pair.count != 0) pair.count = 0;
        if (pair.ahead) pair.ahead = false;
        return;
    }
    if (!settled && !mayTouch(input.bodies, input.excluded, pair)) {
        pair.count = ContactPair::untested;
        return;
    }
    const std::size_t first = part.count;
    const bool ahead = !settled && range_.foresight.time > 0 && (ahead_[pair.a].reach > 0 || ahead_[pair.b].reach > 0);
    const bool unmoved = (unmoved_[pair.a] & unmoved_[pair.b]) != 0;
    const bool known = settled || (unmoved && pair.isTested() && !ahead && !pair.ahead);
    pair.ahead = ahead;
    if (known) {
        part.add(pair.first, pair.count, true);
    } else {
        const auto before = pair.contactsIn(last);
        const std::size_t begin = part.found.size();
        collidePair(input.bodies, pair, range_, {input.bodies, range_, pair, ahead_}, manifold, part.found);
        const auto found = std::span(part.found).subspan(begin);
        const double patch = squaredPatchOf(found);
        for (FoundContact& contact : found) contact.squared_patch = patch;
        inheritImpulses(input.bodies, before, found, part.left);
        const bool went_back = state == PairState::went_back;
        pair.ahead = keepAhead(input.bodies, range_, part.left, went_back, part.found) || ahead;
        part.deep =
            part.deep || std::ranges::any_of(std::span(part.found).subspan(begin), &isDeeperThanFlown<FoundContact>);
        pair.count = static_cast<std::uint32_t>(part.found.size() - begin);
        part.add(begin, pair.count, false);
    }
    pair.first = static_cast<std::uint32_t>(first);
}

/// @param part in: its pairs; out: what was found of them
void PairTable::detectPairs(const PairsInput& input, std::span<const Contact> last, FoundContacts& part) {
    Manifold manifold;
    for (ContactPair& pair : neighbours_.pairs().subspan(part.pair_begin, part.pair_end - part.pair_begin)) {
        const bool settled = (settled_[pair.a] & settled_[pair.b]) != 0 && pair.isTested() && !pair.ahead;
        // Where nobody moves this is told without a look at the bodies.
        if (settled && pair.count == 0) continue;
        const std::uint32_t before = pair.touches() ? pair.count : 0;
        detectPair(input, last, settled ? PairState::settled : PairState::moved, manifold, pair, part);
        part.others = part.others || (pair.touches() ? pair.count : 0) != before;
    }
}

/// Likewise, of those with a body that went back.
void PairTable::detectPairsBack(const PairsInput& input, std::span<const Contact> last,
                                std::span<const std::uint8_t> back, FoundContacts& part) {
    Manifold manifold;
    for (ContactPair& pair : neighbours_.pairs().subspan(part.pair_begin, part.pair_end - part.pair_begin)) {
        const std::uint32_t before = pair.touches() ? pair.count : 0;
        if ((back[pair.a] | back[pair.b]) != 0 || !pair.isTested()) {
            detectPair(input, last, PairState::went_back, manifold, pair, part);
        } else {
            const std::size_t first = part.count;
            part.add(pair.first, before, true);
            pair.first = static_cast<std::uint32_t>(first);
        }
        part.others = part.others || (pair.touches() ? pair.count : 0) != before;
    }
}

/// Makes the pairs' first contacts, which count from those of their thread on, indices of all contacts.
void PairTable::addFirst(const Executor& executor) {
    executor.forBlocks(
        parts_.size(),
        [&](std::size_t begin, std::size_t end, int) {
            std::size_t first = 0;
            for (std::size_t t = 0; t < begin; ++t) first += parts_[t].count;
            for (std::size_t t = begin; t < end; first += parts_[t++].count) {
                if (first == 0) continue;
                const FoundContacts& part = parts_[t];
                for (ContactPair& pair :
                     neighbours_.pairs().subspan(part.pair_begin, part.pair_end - part.pair_begin)) {
                    pair.first += static_cast<std::uint32_t>(first);
                }
            }
        },
        1);
}

}  // namespace cairn
