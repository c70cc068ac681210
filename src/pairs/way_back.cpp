#include "pairs/way_back.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "narrow_phase/approach.h"

namespace cairn {

namespace {

/// Bodies may get into each other by this part of the smaller one's smallest extent, or by this multiple of the overlap
/// that they are allowed, if that is more: less is for the correction.
constexpr double least_overlap = 0.03;
constexpr double most_overlap = 2;

/// Whoever overlaps by more than this multiple began so.
constexpr double most_grown = 10;

/// Overlaps that grow by less than this part are those of before: they may do so in every step.
constexpr double rounding = 1e-6;

/// The place is found when the overlap there is less than the largest by this part of that, or after so many rounds.
constexpr double place_tolerance = 0.05;
constexpr int most_rounds = 8;

/// Fewest pairs worth a thread of their own: most are not asked.
constexpr std::size_t asked_grain = 512;

/// Two bodies on their ways.
class PairOnWay {
  public:
    PairOnWay(const WaysInput& input, const BodyPair& pair)
        : bodies_(input.bodies), a_(input, pair.a), b_(input, pair.b) {}

    /// How far the one got that got farther.
    double place() const { return std::max(a_.way.place, b_.way.place); }

    /// How deep they are in each other at a place of their ways [m]; 0 = not at all.
    double depthAt(double place) const {
        double depth = 0;
        Manifold manifold;
        const auto look = [&](const Manifold& found) {
            for (std::size_t k = 0; k < found.size; ++k) depth = std::max(depth, -found.points[k].distance);
        };
        forEachManifold(bodies_.shape[a_.body], shapePose(a_, place), bodies_.shape[b_.body], shapePose(b_, place), 0,
                        manifold, look);
        return depth;
    }

    /// How far points of them flew past each other at most [m].
    double passed() const {
        const auto [way_a, turn_a] = flownBy(a_);
        const auto [way_b, turn_b] = flownBy(b_);
        return (way_a - way_b).norm() + turn_a.norm() * radius(a_) + turn_b.norm() * radius(b_);
    }

    /// Where they are so deep in each other first while they fly; place() if nowhere.
    double firstPlace(double depth) const {
        const auto met = timeOfOverlap(moving(a_), moving(b_), 1, depth);
        return met ? std::min(place(), BodyWay::begun + *met) : place();
    }

  private:
    struct Body {
        Body(const WaysInput& input, BodyIndex i)
            : body(i), now{input.bodies.position[i], input.bodies.orientation[i]} {
            if (mayGoBack(input, i)) {
                way = input.ways[i];
            } else {
                way = {now, now, Vec3::Zero(), BodyWay::detected};
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

    Pose shapePose(const Body& body, double place) const {
        const Pose pose = poseOnWay(body.now, body.way, place);
        return pose.toOuter(Pose{bodies_.p_BS[body.body], bodies_.R_BS[body.body]});
    }
    double radius(const Body& body) const {
        return std::isfinite(bodies_.r_max[body.body]) ? bodies_.r_max[body.body] : 0;
    }
    Flown flownBy(const Body& body) const {
        const Pose begin = poseOnWay(body.now, body.way, BodyWay::begun);
        const Eigen::AngleAxisd turn(body.now.orientation * begin.orientation.conjugate());
        const double angle = turn.angle() > std::numbers::pi ? turn.angle() - 2 * std::numbers::pi : turn.angle();
        return {body.now.position - begin.position, angle * turn.axis()};
    }
    MovingShape moving(const Body& body) const {
        const Pose begin = poseOnWay(body.now, body.way, BodyWay::begun);
        MovingShape shape{bodies_.shape[body.body], shapePose(body, BodyWay::begun), begin.position};
        const auto [way, turn] = flownBy(body);
        shape.v = way;
        shape.w = turn;
        shape.turning = turn.norm() * radius(body);
        return shape;
    }

    const BodyStorage& bodies_;
    Body a_, b_;
};

/// A place of a way, with the overlap there.
struct PlaceAndDepth {
    double place, depth;
};

/// The last place with no more than an overlap. @param begin where there is less @param end where there is more
double lastPlace(const PairOnWay& pair, PlaceAndDepth begin, PlaceAndDepth end, double most) {
    for (int n = 0; n < most_rounds && most - begin.depth > place_tolerance * most; ++n) {
        const double guess = begin.depth > 0 ? (most - begin.depth) / (end.depth - begin.depth) : 0.5;
        const double place = begin.place + (end.place - begin.place) * std::clamp(guess, 0.05, 0.95);
        const PlaceAndDepth between{place, pair.depthAt(place)};
        (between.depth > most ? end : begin) = between;
    }
    return begin.place;
}

/// To where the bodies of a pair go back; BodyWay::flown = they stay.
double placeFor(const PairOnWay& pair, double most, bool passes) {
    if (passes && pair.depthAt(BodyWay::begun) < most) {
        const double first = pair.firstPlace(most);
        return first < pair.place() ? first : BodyWay::flown;
    }
    const PlaceAndDepth now{pair.place(), pair.depthAt(BodyWay::flown)};
    if (!(now.depth > most)) return BodyWay::flown;
    const PlaceAndDepth before{BodyWay::detected, pair.depthAt(BodyWay::detected)};
    const double allowed = std::max(most, before.depth);
    if (!(now.depth > (1 + rounding) * allowed)) return BodyWay::flown;
    if (pair.place() <= BodyWay::begun) return lastPlace(pair, before, now, allowed);
    const PlaceAndDepth begun{BodyWay::begun, pair.depthAt(BodyWay::begun)};
    if (begun.depth > (1 + rounding) * allowed) return lastPlace(pair, before, begun, allowed);
    return lastPlace(pair, begun, now, allowed);
}

}  // namespace

bool mayGoBack(const WaysInput& input, BodyIndex i) {
    const BodyStorage& bodies = input.bodies;
    if (bodies.kind[i] != BodyKind::dynamic) return false;
    if (!input.stuck.empty() && input.stuck[i] != 0) return false;
    return input.ways[i].place > BodyWay::detected && (input.jointed.empty() || input.jointed[i] == 0);
}

void findStuck(const WaysInput& input, std::vector<std::uint8_t>& stuck) {
    stuck.assign(input.bodies.slots(), 0);
    for (const ContactPair& pair : input.pairs) {
        if (!pair.touches()) continue;
        const auto contacts = input.contacts.subspan(pair.first, pair.count);
        const auto isFar = [](const Contact& c) { return c.distance < -most_grown * c.allowed_overlap; };
        if (std::ranges::none_of(contacts, isFar)) continue;
        const double before = PairOnWay(input, pair).depthAt(BodyWay::detected);
        if (before > most_grown * contacts.front().allowed_overlap) stuck[pair.a] = stuck[pair.b] = 1;
    }
}

void findTooDeep(const WaysInput& input, std::vector<std::vector<TooDeep>>& found) {
    const BodyStorage& b = input.bodies;
    found.resize(static_cast<std::size_t>(input.executor.threads()));
    for (std::vector<TooDeep>& part : found) part.clear();
    const auto look = [&](const ContactPair& pair, std::vector<TooDeep>& part) {
        if (!input.back.empty() && (input.back[pair.a] | input.back[pair.b]) == 0) return;
        const double r_min = std::min(b.r_min[pair.a], b.r_min[pair.b]);
        const double most =
            std::max(least_overlap * 2 * r_min, most_overlap * input.range.overlapOf(b.r_min[pair.a], b.r_min[pair.b]));
        const auto contacts =
            pair.touches() ? input.contacts.subspan(pair.first, pair.count) : std::span<const Contact>();
        const bool deep = std::ranges::any_of(contacts, [&](const Contact& c) { return c.distance < -most; });
        const bool fast = (b.linear_step[pair.a] - b.linear_step[pair.b]).norm() > r_min;
        if (!deep && !fast) return;
        if (!pair.isTested() || (!mayGoBack(input, pair.a) && !mayGoBack(input, pair.b))) return;
        const PairOnWay on_way(input, pair);
        const double place = placeFor(on_way, most, on_way.place() > BodyWay::begun && on_way.passed() > r_min);
        if (place < on_way.place()) part.push_back({pair, place});
    };
    input.executor.forBlocks(
        input.pairs.size(),
        [&](std::size_t begin, std::size_t end, int thread) {
            std::vector<TooDeep>& part = found[static_cast<std::size_t>(thread)];
            for (std::size_t n = begin; n < end; ++n) look(input.pairs[n], part);
        },
        asked_grain);
}

}  // namespace cairn
