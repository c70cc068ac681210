#include "narrow_phase/convex_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "narrow_phase/separation.h"

namespace cairn {

namespace {

/// Cosine of the angle below which a direction of contact counts as that of a face: the face then gives more points,
/// and their heights are as honest. Round
/// shapes have directions of their own between those of faces and edges.
constexpr double aligned_direction = 0.995;

/// Sine of the largest angle between two lines that lie on each other.
constexpr double parallel_tube_sine = 0.1;

/// Planes around a disc that stand for its rim when a polygon is cut to it; they leave it 1 % too large at most.
constexpr int disc_sides = 16;

/// Two shapes, what of them faces the other, and the direction of contact.
struct Meeting {
    const Convex& a;
    const Convex& b;
    double margin;
    Separation separation;  ///< of the cores
    Feature feature_a;
    Feature feature_b;

    double rounding() const { return a.rounding() + b.rounding(); }
    double smallest() const { return std::min(a.smallest(), b.smallest()); }
    double distance() const { return separation.distance - rounding(); }
    /// By how much faces go before edges whose cores are so far apart [m]: it follows how far the surfaces are.
    double bonusAt(double of_cores) const { return faceAxisBonus(of_cores - rounding(), smallest()); }
};

/// Points halfway between the surfaces, with distances in place of heights.
struct ConvexContact {
    Vec3 normal;  ///< from A to B
    FacePoints points;
};

/// A face of one shape, on which the other lies.
struct OnFace {
    const Feature& face;
    const Convex& owner;
    const Convex& other;
    double separation;  ///< of the cores along the face's normal [m]
};

double edgeLength(const Feature& feature) {
    if (feature.disc_radius > 0) return feature.disc_radius;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < feature.corners.size; ++i) {
        const std::size_t next = i + 1 < feature.corners.size ? i + 1 : 0;
        shortest = std::min(shortest, (feature.corners.corners[next] - feature.corners.corners[i]).norm());
    }
    return shortest;
}

/// Planes through the edges of a face, or around a disc.
struct Sides {
    std::size_t size = 0;
    std::array<Plane, ConvexPolygon::capacity> planes;

    explicit Sides(const Feature& face) {
        if (face.disc_radius > 0) {
            addDisc(face);
            return;
        }
        for (std::size_t i = 0; i < face.corners.size; ++i) {
            const std::size_t next = i + 1 < face.corners.size ? i + 1 : 0;
            const Vec3& corner = face.corners.corners[i];
            const Vec3 outward = (face.corners.corners[next] - corner).cross(face.face.normal).normalized();
            planes[size++] = {outward, outward.dot(corner)};
        }
    }

    void addDisc(const Feature& disc) {
        const Vec3 u = (disc.corners.corners[0] - disc.disc_centre).normalized();
        const Vec3 v = disc.face.normal.cross(u);
        for (int i = 0; i < disc_sides; ++i) {
            const double turn = 2 * std::numbers::pi * i / disc_sides;
            const Vec3 outward = std::cos(turn) * u + std::sin(turn) * v;
            planes[size++] = {outward, outward.dot(disc.disc_centre) + disc.disc_radius};
        }
    }
};

bool isInDisc(const Feature& disc, const Vec3& point, double slack) {
    const Vec3 from = point - disc.disc_centre;
    const double height = from.dot(disc.face.normal);
    const double radius = disc.disc_radius + slack;
    return from.squaredNorm() - height * height <= radius * radius;
}

/// Where the rims of two discs in one plane cross. @param discs seen along the normal of the first
void addCrossings(const Feature& disc, const Feature& other, ConvexPolygon& points) {
    const Vec3& normal = disc.face.normal;
    Vec3 towards = other.disc_centre - disc.disc_centre;
    towards -= towards.dot(normal) * normal;
    const double apart = towards.norm();
    const double r = disc.disc_radius;
    const double along = 0.5 * (apart + (r * r - other.disc_radius * other.disc_radius) / apart);
    const double across_squared = r * r - along * along;
    if (!(across_squared > 0)) return;
    const Vec3 middle = disc.disc_centre + along / apart * towards;
    const Vec3 across = std::sqrt(across_squared) / apart * normal.cross(towards);
    for (const Vec3& crossing : {Vec3(middle + across), Vec3(middle - across)}) {
        const double rise = other.face.height(crossing) / other.face.normal.dot(normal);
        points.add(crossing - rise * normal);  // into the plane of the other disc
    }
}

/// Points of the incident disc, which is nearly parallel, that lie on the other: corners of its rim, and, where they do
/// not overlap whole, corners of the other's rim and the crossings of both.
void collectDiscs(const Feature& face, const Feature& incident, ConvexPolygon& points) {
    const double slack = merge_part * std::min(face.disc_radius, incident.disc_radius);
    points.size = 0;
    for (std::size_t i = 0; i < incident.corners.size; ++i) {
        if (isInDisc(face, incident.corners.corners[i], slack)) points.add(incident.corners.corners[i]);
    }
    if (points.size == incident.corners.size) return;
    ConvexPolygon others;
    for (std::size_t i = 0; i < face.corners.size; ++i) {
        const Vec3& corner = face.corners.corners[i];
        const double way = incident.face.height(corner) / incident.face.normal.dot(face.face.normal);
        // Where the discs are far in each other the way along a normal to the other's plane is long, and leads aside.
        const Vec3 across = corner - way * face.face.normal;
        if (isInDisc(incident, across, slack)) others.add(across);
    }
    if (others.size == face.corners.size) points.size = 0;
    for (std::size_t i = 0; i < others.size; ++i) points.add(others.corners[i]);
    if (others.size < face.corners.size) addCrossings(face, incident, points);
}

void collectPoints(const OnFace& on, double margin, FacePoints& points) {
    points.size = 0;
    Feature lying;
    on.other.findFeature(-on.face.face.normal, lying);
    const bool discs = on.face.disc_radius > 0 && lying.disc_radius > 0 &&
                       lying.face.normal.dot(on.face.face.normal) < -aligned_direction;
    double merge = merge_part * edgeLength(on.face);
    if (lying.isFace()) merge = std::min(merge, merge_part * edgeLength(lying));
    const FaceCollector collector{on.face.face, margin + on.other.rounding(), discs ? 100 * merge : merge};
    if (discs) {
        ConvexPolygon common;
        collectDiscs(on.face, lying, common);
        for (std::size_t i = 0; i < common.size; ++i) collector.add(common.corners[i], points);
        return;
    }
    const Sides sides(on.face);
    collectFaceContact(collector, std::span(sides.planes).first(sides.size), lying.corners, points);
}

/// @return false if the points on the face do not tell how far the shapes are apart: they are close beside it
bool addOnFace(const Meeting& meeting, const OnFace& on, ConvexContact& found) {
    collectPoints(on, meeting.margin, found.points);
    const Vec3& normal = on.face.face.normal;
    const double limit = meeting.separation.distance + meeting.bonusAt(meeting.separation.distance);
    bool nearest = false;
    for (std::size_t i = 0; i < found.points.size; ++i) {
        FacePoint& point = found.points.points[i];
        nearest = nearest || point.height <= limit;
        point.height -= on.other.rounding();
        point.point -= (on.other.rounding() + 0.5 * point.height) * normal;
    }
    found.normal = &on.owner == &meeting.a ? normal : Vec3(-normal);
    return nearest;
}

bool isAcceptable(const Meeting& meeting, const OnFace& on) {
    if (!on.face.isFace()) return false;
    const bool straight = !meeting.a.isTube() && !meeting.b.isTube();
    return meeting.separation.distance <= on.separation + meeting.bonusAt(on.separation) ||
           (straight && std::abs(meeting.separation.normal.dot(on.face.face.normal)) > aligned_direction);
}

/// Tries the faces of both shapes, those of A and polygons first.
bool addFaceContact(const Meeting& meeting, ConvexContact& found) {
    const auto along = [](const Feature& face, const Convex& other) {
        return face.isFace() ? face.face.height(other.support(-face.face.normal)) : 0;
    };
    const OnFace on_a{meeting.feature_a, meeting.a, meeting.b, along(meeting.feature_a, meeting.b)};
    const OnFace on_b{meeting.feature_b, meeting.b, meeting.a, along(meeting.feature_b, meeting.a)};
    const bool use_a = isAcceptable(meeting, on_a);
    const bool use_b = isAcceptable(meeting, on_b);
    if (!use_a && !use_b) return false;
    const bool disc_a = meeting.feature_a.disc_radius > 0;
    const bool disc_b = meeting.feature_b.disc_radius > 0;
    bool b_first = !use_a;
    if (use_a && use_b) {
        b_first = disc_a != disc_b ? disc_a : on_b.separation > on_a.separation + meeting.bonusAt(on_a.separation);
    }
    if (addOnFace(meeting, b_first ? on_b : on_a, found)) return true;
    return use_a && use_b && addOnFace(meeting, b_first ? on_a : on_b, found);
}

/// The sides of two tubes that lie beside each other touch at both ends of their common part.
bool addTubes(const Meeting& meeting, ConvexContact& found) {
    const Vec3 u = meeting.a.tubeAxis();
    const Vec3 other = meeting.b.tubeAxis();
    const double cosine = u.dot(other);
    if (!(u.cross(other).norm() <= parallel_tube_sine)) return false;
    const double half_a = 0.5 * edgeLength(meeting.feature_a);
    const double half_b = 0.5 * edgeLength(meeting.feature_b);
    const Vec3 centres = meeting.b.centre() - meeting.a.centre();
    const double begin = std::max(-half_a, centres.dot(u) - half_b * std::abs(cosine));
    const double end = std::min(half_a, centres.dot(u) + half_b * std::abs(cosine));
    if (!(end - begin > 2 * merge_part * std::min(half_a, half_b))) return false;
    // From the axis of A to that of B, at a place along A's.
    const auto across = [&](double t) -> Vec3 { return centres - t * u + (t - centres.dot(u)) / cosine * other; };
    // Tubes that are nearly parallel have this direction in the middle, more exactly than the search knows it.
    Vec3 n = across(0.5 * (begin + end)).stableNormalized();
    if (!((n - meeting.separation.normal).norm() <= 1e-3)) n = meeting.separation.normal;
    const double radii = meeting.a.tubeRadius() + meeting.b.tubeRadius();
    const double beside_limit = std::sqrt(meeting.margin * meeting.smallest());
    const double deepest = meeting.distance() - meeting.bonusAt(meeting.separation.distance);
    found.normal = n;
    found.points.size = 0;
    for (const double t : {begin, end}) {
        const Vec3 apart = across(t);
        const double distance = apart.dot(n) - radii;
        if (!(distance <= meeting.margin && distance >= deepest)) return false;
        if (!((apart - apart.dot(n) * n).norm() <= beside_limit)) return false;
        const Vec3 halfway = meeting.a.centre() + t * u + (meeting.a.tubeRadius() + 0.5 * distance) * n;
        found.points.points[found.points.size++] = {halfway, distance};
    }
    return true;
}

void addSingle(const Meeting& meeting, ConvexContact& found) {
    const Separation& s = meeting.separation;
    found.normal = s.normal;
    found.points.size = 1;
    const Vec3 on_a = s.on_a + meeting.a.rounding() * s.normal;
    const Vec3 on_b = s.on_b - meeting.b.rounding() * s.normal;
    found.points.points[0] = {0.5 * (on_a + on_b), meeting.distance()};
}

void findPoints(const Meeting& meeting, ConvexContact& found) {
    const bool point = meeting.feature_a.corners.size == 1 || meeting.feature_b.corners.size == 1;
    if (!point && addFaceContact(meeting, found)) return;
    if (meeting.feature_a.isLine() && meeting.feature_b.isLine() && addTubes(meeting, found)) return;
    addSingle(meeting, found);
}

}  // namespace

void convexContact(const Convex& a, const Convex& b, const Vec3& origin, double margin, Manifold& manifold) {
    Meeting meeting{a, b, margin, {}, {}, {}};
    if (!separate(a, b, margin + meeting.rounding(), meeting.separation)) return;
    a.findFeature(meeting.separation.normal, meeting.feature_a);
    b.findFeature(-meeting.separation.normal, meeting.feature_b);
    ConvexContact found;
    findPoints(meeting, found);
    manifold.normal = -found.normal;
    for (std::size_t i = 0; i < found.points.size && i < Manifold::capacity; ++i) {
        manifold.add(origin + found.points.points[i].point, found.points.points[i].height);
    }
}

}  // namespace cairn
