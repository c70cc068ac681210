#include "pairs/foreseen.h"

#include <algorithm>
#include <cmath>

#include "geometry/surface_data.h"
#include "math/rotation.h"
#include "narrow_phase/approach.h"
#include "narrow_phase/convex.h"

namespace cairn {

namespace {

/// A body that moves by less than this part of its inner radius in a time step, or by less than it is allowed to
/// overlap, cannot get far into another one.
constexpr double least_way = 0.01;

/// A body that ends within this multiple of the overlap that it is allowed from where it was foreseen is left alone:
/// what it may overlap there is for the correction.
constexpr double least_stroke = 3;

/// What touches a surface has its middle before it by about its inner radius: with a way of less than this part of
/// that, it is not through the surface in the end.
constexpr double crossing_part = 0.5;

MovingShape movingShape(const BodyStorage& bodies, BodyIndex i, const BodyAhead* ahead) {
    MovingShape shape{bodies.shape[i], bodies.shapePose(i), bodies.position[i]};
    if (ahead == nullptr) return shape;
    shape.v = bodies.v[i];
    shape.w = bodies.w[i];
    shape.turning = ahead->turning;
    return shape;
}

/// The pose of a body's shape after a time, without what gravity adds, which whatever carries a body takes away again.
Pose poseAfter(const BodyStorage& bodies, BodyIndex i, const BodyAhead& ahead, double time) {
    const Pose now = bodies.shapePose(i);
    const Vec3 centre = bodies.position[i] + bodies.v[i] * time;
    if (ahead.turning == 0) return {centre + (now.position - bodies.position[i]), now.orientation};
    const Quat turn = fromRotationVector(bodies.w[i] * time);
    return {centre + turn * (now.position - bodies.position[i]), turn * now.orientation};
}

}  // namespace

void lookAhead(const BodyStorage& bodies, const DetectionRange& range, BodyIndex i, BodyAhead& ahead) {
    const Foresight& foresight = range.foresight;
    ahead.way = ahead.now;
    ahead.v = bodies.v[i];
    ahead.w = bodies.w[i];
    ahead.turning = 0;
    ahead.reach = 0;
    if (foresight.time == 0 || bodies.asleep[i] != 0) return;
    if (bodies.kind[i] == BodyKind::dynamic) ahead.v += foresight.fall;
    const bool ball = std::holds_alternative<Sphere>(bodies.shape[i]) && bodies.p_BS[i].isZero(0);
    if (!ball) ahead.turning = bodies.w[i].norm() * bodies.r_max[i];
    const double reach = foresight.time * (ahead.v.norm() + ahead.turning);
    const double r_min = bodies.r_min[i];
    if (!(reach > std::min(least_way * r_min, range.overlapOf(r_min, r_min)))) return;
    ahead.reach = reach;
    const Vec3 way = ahead.v * foresight.time;
    const double turned = ahead.turning * foresight.time;
    ahead.way = ahead.now.grown(turned);
    ahead.way.lower += way.cwiseMin(0);
    ahead.way.upper += way.cwiseMax(0);
}

Bounds searchedBounds(const BodyStorage& bodies, const DetectionRange& range, BodyIndex i, BodyAhead& ahead) {
    Bounds grown = boundsOf(bodies.shape[i], bodies.shapePose(i));
    const double r_min = bodies.r_min[i];
    const double margin = std::isfinite(r_min) ? range.marginOf(r_min, r_min) : 0;
    grown.lower.array() -= margin;
    grown.upper.array() += margin;
    if (range.foresight.time == 0) return grown;
    ahead.now = grown;
    lookAhead(bodies, range, i, ahead);
    return ahead.way;
}

bool flies(const BodyStorage& bodies, BodyIndex i) {
    return bodies.kind[i] == BodyKind::dynamic && bodies.asleep[i] == 0;
}

bool movesFar(const BodyStorage& bodies, const DetectionRange& range, BodyIndex i, const Vec3& v, const Vec3& w) {
    const double least = least_stroke * range.overlapOf(bodies.r_min[i], bodies.r_min[i]);
    return range.foresight.time * (v.norm() + w.norm() * bodies.r_max[i]) > least;
}

bool isStruck(const BodyStorage& bodies, const DetectionRange& range, BodyIndex i, const BodyAhead& ahead) {
    return flies(bodies, i) && movesFar(bodies, range, i, bodies.v[i] - ahead.v, bodies.w[i] - ahead.w) &&
           movesFar(bodies, range, i, bodies.v[i], bodies.w[i]);
}

bool PairAhead::wouldMeet() const {
    const double depth = range_.overlapOf(bodies_.r_min[pair_.a], bodies_.r_min[pair_.b]);
    const bool both = a_.reach > 0 && b_.reach > 0;
    if (both && a_.way.overlaps(b_.way) && meetsWith(&a_, &b_, depth)) return true;
    if (a_.reach > 0 && a_.way.overlaps(b_.now) && meetsWith(&a_, nullptr, depth)) return true;
    return b_.reach > 0 && b_.way.overlaps(a_.now) && meetsWith(nullptr, &b_, depth);
}

/// @param a, b how the bodies move; null = it stays
bool PairAhead::meetsWith(const BodyAhead* a, const BodyAhead* b, double depth) const {
    const Vec3 together = (a != nullptr ? a->v : Vec3(Vec3::Zero())) - (b != nullptr ? b->v : Vec3(Vec3::Zero()));
    const double turning = (a != nullptr ? a->turning : 0) + (b != nullptr ? b->turning : 0);
    const double way = range_.foresight.time * (together.norm() + turning);
    // Bodies that come closer by less than this either overlap at the end or only graze each other.
    if (way > std::min(bodies_.r_min[pair_.a], bodies_.r_min[pair_.b])) {
        return timeOfOverlap(movingShape(bodies_, pair_.a, a), movingShape(bodies_, pair_.b, b), range_.foresight.time,
                             depth)
            .has_value();
    }
    const auto end = [&](BodyIndex i, const BodyAhead* ahead) {
        return ahead != nullptr ? poseAfter(bodies_, i, *ahead, range_.foresight.time) : bodies_.shapePose(i);
    };
    return overlapDepth(bodies_.shape[pair_.a], end(pair_.a, a), bodies_.shape[pair_.b], end(pair_.b, b)) > depth;
}

double PairAhead::way() const {
    if (!isAny()) return 0;
    const double together = range_.foresight.time * ((a_.v - b_.v).norm() + a_.turning + b_.turning);
    return std::max({a_.reach, b_.reach, together});
}

bool PairAhead::closes(const Vec3& point, const Vec3& normal, double distance) const {
    const auto along = [&](const BodyAhead& ahead, BodyIndex i) {
        const Vec3 lever = point - bodies_.position[i];
        return normal.dot(ahead.v + bodies_.w[i].cross(lever));
    };
    const double of_a = -along(a_, pair_.a);
    const double of_b = along(b_, pair_.b);
    return distance < range_.foresight.time * std::max({of_a + of_b, of_a, of_b});
}

void PairAhead::forEachAtEnd(Manifold& manifold, FunctionRef<void(const AtEnd&)> use) const {
    const double time = range_.foresight.time;
    const double depth = range_.overlapOf(bodies_.r_min[pair_.a], bodies_.r_min[pair_.b]);
    if (forEachAfter(time, depth, manifold, use)) return;
    // Those that overlap little at the end, or are past each other, may have met on the way.
    if (!(way() > std::min(bodies_.r_min[pair_.a], bodies_.r_min[pair_.b]))) return;
    const auto moving = [&](BodyIndex i, const BodyAhead& ahead) {
        return movingShape(bodies_, i, ahead.reach > 0 ? &ahead : nullptr);
    };
    const double now = overlapDepth(bodies_.shape[pair_.a], bodies_.shapePose(pair_.a), bodies_.shape[pair_.b],
                                    bodies_.shapePose(pair_.b));
    const double deeper = std::max(depth, clearly_deeper * now);
    const auto met = timeOfOverlap(moving(pair_.a, a_), moving(pair_.b, b_), time, deeper);
    if (met && *met > 0) forEachAfter(*met, depth / 2, manifold, use);
}

/// Calls use() for where the bodies overlap after a time by more than a depth. @return whether there is such a place,
/// in which they do not part
bool PairAhead::forEachAfter(double time, double depth, Manifold& manifold, FunctionRef<void(const AtEnd&)> use) const {
    const auto back = [&](BodyIndex i, const BodyAhead& ahead, const Vec3& point) -> Vec3 {
        if (!(ahead.reach > 0)) return point;
        const Vec3 lever = point - (bodies_.position[i] + bodies_.v[i] * time);
        if (ahead.turning == 0) return bodies_.position[i] + lever;
        // The velocity at the lever of halfway leads along the chord of the turn, that of now along its tangent.
        return bodies_.position[i] + fromRotationVector(bodies_.w[i] * (time / 2)).conjugate() * lever;
    };
    bool any = false;
    const auto look = [&](const Manifold& found) {
        for (std::size_t k = 0; k < found.size; ++k) {
            const auto& [place, distance, triangle] = found.points[k];
            if (!(distance < -depth)) continue;
            const Vec3 on_a = back(pair_.a, a_, place);
            const Vec3 on_b = back(pair_.b, b_, place);
            const auto velocity = [&](BodyIndex i, const Vec3& point) -> Vec3 {
                return bodies_.v[i] + bodies_.w[i].cross(point - bodies_.position[i]);
            };
            const double closing = found.normal.dot(velocity(pair_.a, on_a) - velocity(pair_.b, on_b));
            // Those that part were closer before: where they are now is for the correction.
            if (!(closing < 0)) continue;
            any = true;
            const Vec3 half = (on_a - on_b) / 2;
            const Vec3 slide = half - half.dot(found.normal) * found.normal;
            use(AtEnd{(on_a + on_b) / 2, slide, found.normal, distance - closing * time});
        }
    };
    forEachManifold(bodies_.shape[pair_.a], afterTime(pair_.a, a_, time), bodies_.shape[pair_.b],
                    afterTime(pair_.b, b_, time), 0, manifold, look);
    return any;
}

Pose PairAhead::afterTime(BodyIndex i, const BodyAhead& ahead, double time) const {
    return ahead.reach > 0 ? poseAfter(bodies_, i, ahead, time) : bodies_.shapePose(i);
}

Pose PairAhead::endOf(BodyIndex i, const BodyAhead& ahead) const {
    return afterTime(i, ahead, range_.foresight.time);
}

/// With what gravity adds.
Pose PairAhead::fallenEndOf(BodyIndex i, const BodyAhead& ahead) const {
    Pose end = endOf(i, ahead);
    end.position += (ahead.v - bodies_.v[i]) * range_.foresight.time;
    return end;
}

bool PairAhead::passesFar(BodyIndex solid) const {
    return way() > crossing_part * bodies_.r_min[solid];
}

/// Where the middle of a part passes through the surface.
struct PairAhead::Crossing {
    Vec3 point;       ///< that meets the surface, where the part is now [m, W]
    Vec3 normal;      ///< unit, to the part [W]
    double distance;  ///< of the ball at the end of the step [m]
};

PairAhead::OverSurface PairAhead::overSurface() const {
    if (surfaceOf(bodies_.shape[pair_.a]) != nullptr) return {pair_.b, pair_.a, b_, a_};
    return {pair_.a, pair_.b, a_, b_};
}

/// @param now, end of the part [W]
std::optional<PairAhead::Crossing> PairAhead::crossingOf(const OverSurface& pair, const Shape& part, const Pose& now,
                                                         const Pose& end) const {
    const Pose ground_now = bodies_.shapePose(pair.ground);
    const Vec3 middle = convexOf(part, now, Vec3::Zero()).centre();
    const Vec3 from = ground_now.toInner(middle);
    const Vec3 to = fallenEndOf(pair.ground, pair.ground_ahead).toInner(convexOf(part, end, Vec3::Zero()).centre());
    const double way = (to - from).norm();
    const double thick = smallestRadius(part);
    if (!(way > crossing_part * thick)) return {};
    const LocalRay ray{from, (to - from) / way};
    const std::optional<LocalHit> hit = castRay(*surfaceOf(bodies_.shape[pair.ground]), ray, way);
    if (!hit) return {};
    const Vec3 normal = ground_now.orientation * hit->normal;
    const double behind = (way - hit->distance) * hit->normal.dot(ray.direction);
    return Crossing{middle - thick * normal, normal, behind - thick};
}

void PairAhead::forEachCrossing(FunctionRef<void(const Vec3&, const Vec3&, double)> use) const {
    const OverSurface pair = overSurface();
    const double to_a = pair.solid == pair_.a ? 1 : -1;
    const auto look = [&](const Shape& part, const Pose& now, const Pose& end) {
        const std::optional<Crossing> found = crossingOf(pair, part, now, end);
        if (!found) return;
        const auto velocity = [&](BodyIndex i, const BodyAhead& ahead) -> Vec3 {
            return ahead.v + bodies_.w[i].cross(found->point - bodies_.position[i]);
        };
        const Vec3 relative = velocity(pair.solid, pair.solid_ahead) - velocity(pair.ground, pair.ground_ahead);
        const double closing = found->normal.dot(relative);
        if (!(closing < 0)) return;
        use(found->point, to_a * found->normal, found->distance - closing * range_.foresight.time);
    };
    const Pose now = bodies_.shapePose(pair.solid);
    const Pose end = fallenEndOf(pair.solid, pair.solid_ahead);
    const auto* compound = std::get_if<Compound>(&bodies_.shape[pair.solid]);
    if (compound == nullptr) return look(bodies_.shape[pair.solid], now, end);
    for (const CompoundPart& part : compound->parts) {
        look(part.shape, now.toOuter(part.pose), end.toOuter(part.pose));
    }
}

}  // namespace cairn
