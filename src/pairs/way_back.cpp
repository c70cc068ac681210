#include "pairs/way_back.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "body/roundness.h"
#include "math/rotation.h"
#include "math/tolerances.h"
#include "narrow_phase/approach.h"

namespace cairn {

namespace {

/// The correction may press bodies deeper than flights: into each other by this part of what the deeper of them was in
/// others before.
constexpr double most_shared = 0.9;

/// Whoever overlaps by more than this multiple began so.
constexpr double most_grown = 10;

/// Overlaps that grow by less than this part are those of before: they may do so in every step.
constexpr double rounding = 1e-6;

/// The part is found when the overlap then is less than the largest by this part of that, or after so many rounds.
constexpr double part_tolerance = 0.05;
constexpr int most_rounds = 8;

/// Fewest pairs worth a thread of their own: most are not asked.
constexpr std::size_t asked_grain = 512;

/// Two bodies on their ways.
class PairOnWay {
  public:
    PairOnWay(const WaysInput& input, const BodyPair& pair)
        : bodies_(input.bodies), a_(input, pair.a), b_(input, pair.b) {}

    /// What the one flew that got farther.
    double part() const { return std::max(a_.way.part, b_.way.part); }

    /// How deep they are in each other after a part of their flights [m]; 0 = not at all.
    double depthAt(double part) const {
        return overlapDepth(bodies_.shape[a_.body], shapePose(a_, part), bodies_.shape[b_.body], shapePose(b_, part));
    }

    /// After what part they are so deep in each other first; part() if never.
    double firstPart(double depth) const {
        // Who went back before stands still from there on.
        const double both = std::min(a_.way.part, b_.way.part);
        for (const auto& [begin, end] : {std::pair(0.0, both), std::pair(both, part())}) {
            if (!(begin < end)) continue;
            const auto met = timeOfOverlap(moving(a_, begin, end), moving(b_, begin, end), end - begin, depth);
            if (met) return std::min(part(), begin + *met);
        }
        return part();
    }

  private:
    struct Body {
        Body(const WaysInput& input, BodyIndex i)
            : body(i), now{input.bodies.position[i], input.bodies.orientation[i]} {
            if (mayGoBack(input, i)) {
                way = input.ways[i];
            } else {
                way = {.begin = now, .part = 0};
            }
        }
        BodyIndex body;
        Pose now;
        BodyWay way;
    };
    struct Flown {
        Vec3 way;   ///< [m, W]
        Vec3 turn;  ///< rotation vector [W]
    };

    Pose shapePose(const Body& body, double part) const {
        const Pose pose = poseOnWay(body.now, body.way, part);
        return pose.toOuter(Pose{bodies_.p_BS[body.body], bodies_.R_BS[body.body]});
    }
    double radius(const Body& body) const {
        return std::isfinite(bodies_.r_max[body.body]) ? bodies_.r_max[body.body] : 0;
    }
    Flown flownBy(const Body& body, double from, double to) const {
        if (!(from < body.way.part)) return {Vec3::Zero(), Vec3::Zero()};
        const Pose begin = poseOnWay(body.now, body.way, from);
        const Pose end = poseOnWay(body.now, body.way, to);
        return {end.position - begin.position, toRotationVector(end.orientation * begin.orientation.conjugate())};
    }
    /// Between two parts, evenly. @param to no farther than either flew, or from both
    MovingShape moving(const Body& body, double from, double to) const {
        MovingShape shape{bodies_.shape[body.body], shapePose(body, from),
                          poseOnWay(body.now, body.way, from).position};
        const auto [way, turn] = flownBy(body, from, to);
        shape.v = way / (to - from);
        shape.w = turn / (to - from);
        shape.turning = shape.w.norm() * radius(body);
        return shape;
    }

    const BodyStorage& bodies_;
    Body a_, b_;
};

/// A part of flights, with the overlap after it.
struct PartAndDepth {
    double part, depth;
};

/// The last part with no more than an overlap. @param begin with no more @param end with more
double lastPart(const PairOnWay& pair, PartAndDepth begin, PartAndDepth end, double most) {
    for (int n = 0; n < most_rounds && most - begin.depth > part_tolerance * most; ++n) {
        const double guess = begin.depth > 0 ? (most - begin.depth) / (end.depth - begin.depth) : 0.5;
        const double part = begin.part + (end.part - begin.part) * std::clamp(guess, 0.05, 0.95);
        const PartAndDepth between{part, pair.depthAt(part)};
        (between.depth > most ? end : begin) = between;
    }
    return begin.part;
}

/// What the bodies of a pair may fly of their flights; pair.part() = all that they flew.
/// @param passes whether they flew so far past each other that they may be apart again
double partFor(const PairOnWay& pair, double most, bool passes) {
    const double now = pair.depthAt(pair.part());
    if (!passes && !(now > most)) return pair.part();
    const double before = pair.depthAt(0);
    if (passes && before < most) {
        const double first = pair.firstPart(std::max(most, clearly_deeper * before));
        if (first < pair.part()) return first;
    }
    const double allowed = std::max(most, before);
    if (!(now > (1 + rounding) * allowed)) return pair.part();
    return lastPart(pair, {0, before}, {pair.part(), now}, allowed);
}

/// How far points of two bodies flew past each other at most [m].
double flownPast(const BodyStorage& b, const Flights& flights, const BodyPair& pair) {
    return (b.linear_step[pair.a] - b.linear_step[pair.b]).norm() + flights.turned[pair.a] + flights.turned[pair.b];
}

}  // namespace

double turnedWay(const BodyStorage& bodies, BodyIndex i, const Quat& before) {
    const double reach = bodies.r_max[i];
    if (!std::isfinite(reach)) return 0;
    const Quat& now = bodies.orientation[i];
    const Roundness round = roundnessOf(bodies, i);
    if (round == Roundness::everywhere) return 0;
    if (round == Roundness::about_axis) {
        const Vec3 axis = bodies.R_BS[i] * Vec3::UnitZ();
        return reach * (now * axis - before * axis).norm();
    }
    const double cosine = now.dot(before);
    return 2 * reach * std::sqrt(std::max(0.0, 1 - cosine * cosine));
}

bool mayGoBack(const WaysInput& input, BodyIndex i) {
    const BodyStorage& bodies = input.bodies;
    if (bodies.kind[i] != BodyKind::dynamic) return false;
    if (!input.stuck.empty() && input.stuck[i] != 0) return false;
    return input.ways[i].part > 0 && (input.jointed.empty() || input.jointed[i] == 0);
}

namespace {

/// Calls look(pair, part) for all pairs that may have to go back, each thread with its part of what is found.
template <class Look>
void forPairs(const WaysInput& input, std::vector<std::vector<TooDeep>>& found, const Look& look) {
    found.resize(static_cast<std::size_t>(input.executor.threads()));
    for (std::vector<TooDeep>& part : found) part.clear();
    input.executor.forBlocks(
        input.pairs.size(),
        [&](std::size_t begin, std::size_t end, int thread) {
            std::vector<TooDeep>& part = found[static_cast<std::size_t>(thread)];
            for (const ContactPair& pair : input.pairs.subspan(begin, end - begin)) {
                if (input.back.empty() || (input.back[pair.a] | input.back[pair.b]) != 0) look(pair, part);
            }
        },
        asked_grain);
}

bool mayGoBack(const WaysInput& input, const ContactPair& pair) {
    return pair.isTested() && (mayGoBack(input, pair.a) || mayGoBack(input, pair.b));
}

}  // namespace

void findStuck(const WaysInput& input, std::vector<std::uint8_t>& stuck) {
    stuck.assign(input.bodies.slots(), 0);
    for (const ContactPair& pair : input.pairs) {
        const auto contacts = pair.contactsIn(input.contacts);
        const auto isFar = [](const Contact& c) { return c.distance < -most_grown * c.allowed_overlap; };
        if (std::ranges::none_of(contacts, isFar)) continue;
        const double before = PairOnWay(input, pair).depthAt(0);
        if (before > most_grown * contacts.front().allowed_overlap) stuck[pair.a] = stuck[pair.b] = 1;
    }
}

void measureFlights(const WaysInput& input, Flights& flights) {
    const BodyStorage& b = input.bodies;
    flights.turned.resize(b.slots());
    flights.flew.resize(b.slots());
    input.executor.forBlocks(b.slots(), [&](std::size_t begin, std::size_t end, int) {
        for (auto i = static_cast<BodyIndex>(begin); i < end; ++i) {
            if (!input.back.empty() && input.back[i] == 0) continue;
            const BodyWay& way = input.ways[i];
            flights.flew[i] = way.part > 0 ? 1 : 0;
            flights.turned[i] = way.part > 0 ? turnedWay(b, i, way.begin.orientation) : 0;
        }
    });
    if (!input.back.empty()) return;
    flights.smallest = std::numeric_limits<double>::infinity();
    double farthest = 0;
    for (BodyIndex i = 0; i < b.slots(); ++i) {
        if (b.kind[i] == BodyKind::hole) continue;
        flights.smallest = std::min(flights.smallest, b.r_min[i]);
        farthest = std::max(farthest, b.linear_step[i].norm() + flights.turned[i]);
    }
    flights.far = 2 * farthest > surely_below * flights.smallest;
}

void findTooDeep(const WaysInput& input, const Flights& flights, std::vector<std::vector<TooDeep>>& found) {
    const BodyStorage& b = input.bodies;
    forPairs(input, found, [&](const ContactPair& pair, std::vector<TooDeep>& part) {
        // Most pairs sleep, or only are near each other.
        if ((flights.flew[pair.a] | flights.flew[pair.b]) == 0 || (!flights.far && !pair.touches())) return;
        const bool deep = std::ranges::any_of(pair.contactsIn(input.contacts), &isDeeperThanFlown<Contact>);
        const bool fast = flights.far && flownPast(b, flights, pair) > std::min(b.r_min[pair.a], b.r_min[pair.b]);
        if ((!deep && !fast) || !mayGoBack(input, pair)) return;
        const double most = most_flown_overlap * input.range.overlapOf(b.r_min[pair.a], b.r_min[pair.b]);
        const PairOnWay on_way(input, pair);
        const double flown = partFor(on_way, most, fast);
        if (flown < on_way.part()) part.push_back({pair, flown});
    });
}

void findPressed(const WaysInput& input, std::span<const MovedBody> moved, std::vector<std::vector<TooDeep>>& found) {
    const BodyStorage& b = input.bodies;
    forPairs(input, found, [&](const ContactPair& pair, std::vector<TooDeep>& part) {
        const MovedBody& one = moved[pair.a];
        const MovedBody& other = moved[pair.b];
        if (!(one.way + other.way > 0)) return;
        const double allowed = input.range.overlapOf(b.r_min[pair.a], b.r_min[pair.b]);
        const double most = std::max({most_flown_overlap, most_shared * one.deepest, most_shared * other.deepest});
        // They are no deeper than they were by more than they moved.
        const double way = one.way + other.way + one.unsure + other.unsure;
        double deepest = way;
        for (const Contact& contact : pair.contactsIn(input.contacts))
            deepest = std::max(deepest, way - contact.distance);
        if (!(deepest > most * allowed) || !mayGoBack(input, pair)) return;
        const PairOnWay on_way(input, pair);
        const double pushed = partFor(on_way, most * allowed, false);
        if (pushed < on_way.part()) part.push_back({pair, pushed});
    });
}

void limitToDepths(const WaysInput& input, std::span<const MovedBody> moved, std::span<Contact> contacts) {
    input.executor.forBlocks(
        input.pairs.size(),
        [&](std::size_t begin, std::size_t end, int) {
            for (const ContactPair& pair : input.pairs.subspan(begin, end - begin)) {
                if (!pair.touches() || !(moved[pair.a].way + moved[pair.b].way > 0)) continue;
                // Who came back to where it was found is as deep as was found, to the last bit.
                if (input.bodies.isWhereDetected(pair.a) && input.bodies.isWhereDetected(pair.b)) continue;
                const auto known = contacts.subspan(pair.first, pair.count);
                if (std::ranges::none_of(known, &isDeeperThanFlown<Contact>)) continue;
                const double depth = PairOnWay(input, pair).depthAt(1);
                for (Contact& contact : known) contact.distance = std::max(contact.distance, -depth);
            }
        },
        asked_grain);
}

}  // namespace cairn
