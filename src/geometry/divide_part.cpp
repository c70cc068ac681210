/// Finds the plane that divides a part best.
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/convex_part.h"

namespace cairn {

namespace {

/// How much cutting off-centre costs beside the error, both as parts of what is divided: of planes that leave the same
/// error, as all of those through a ring, the middle one lets the next cuts lower it.
constexpr double balance_weight = 0.02;

constexpr int places = 8;              ///< along an axis, planes between them
constexpr int refinements = 2;         ///< of the best place, each by half
constexpr std::size_t most_edges = 4;  ///< that stand back farthest, whose planes are tried
constexpr double same_direction = 0.999;
constexpr double least_side = 1e-6;  ///< of the volume: smaller sides are no division
constexpr std::size_t most_hull_points = 20000;
constexpr std::size_t estimated_from = 300;  ///< points of a part whose planes are compared by estimates first
constexpr std::size_t best_estimates = 6;    ///< planes that are then compared exactly

struct Candidate {
    CuttingPlane plane;
    double step = 0;  ///< to the next plane of its axis [m]; 0 = it does not move
};

struct Division {
    double cost = std::numeric_limits<double>::infinity();
    Candidate candidate;
    // Of exact ones:
    std::vector<ConvexPart> parts{};
    std::vector<Vec3> points{};  ///< that the cut adds
};

/// How the hulls of pieces are found.
enum class Hulls : std::uint8_t { exact, estimated };

std::vector<Vec3> placesOf(const Polyhedron& solid, const Points& points) {
    std::vector<Vec3> result;
    for (const std::uint32_t i : pointsOf(solid)) result.push_back(points[i]);
    return result;
}

/// The error is a little too small and may be below zero; the corners are some points that are far out.
ConvexPart estimatedPart(Polyhedron solid, const Points& points) {
    ConvexPart part;
    part.corners = farthestOf(placesOf(solid, points));
    part.volume = volumeOf(solid, points);
    part.error = volumeWithin(part.corners) - part.volume;
    part.solid = std::move(solid);
    return part;
}

class Divider {
  public:
    Divider(const ConvexPart& part, const PartScale& scale, Points& points)
        : part_(part), scale_(scale), points_(points) {}

    std::vector<ConvexPart> divide() {
        const bool is_large = pointsOf(part_.solid).size() > estimated_from;
        const std::optional<HullData> hull = hullOf(is_large ? farthestOf(part_.corners) : part_.corners);
        if (!hull) return {};
        addEdgePlanes(*hull);
        addAxisPlanes(*hull);
        if (is_large) {
            findBest(Hulls::estimated);
            keepBestEstimates();
        }
        Division best = findBest(Hulls::exact);
        points_.insert(points_.end(), best.points.begin(), best.points.end());
        return std::move(best.parts);
    }

  private:
    void addEdgePlanes(const HullData& hull);
    void addAxisPlanes(const HullData& hull);
    void addPlane(const Vec3& normal, const Vec3& through);
    void addAlong(const Vec3& axis, int stride);
    std::vector<ConvexPart> partsOf(const CuttingPlane& plane, Hulls hulls);
    Division findBest(Hulls hulls);
    void attempt(const Candidate& candidate, Hulls hulls, Division& best);
    void keepBestEstimates();

    const ConvexPart& part_;
    const PartScale& scale_;
    Points& points_;
    std::vector<Candidate> candidates_;
    std::vector<Division> attempts_;  ///< that divide
};

void Divider::addPlane(const Vec3& normal, const Vec3& through) {
    const CuttingPlane plane{normal, normal.dot(through)};
    for (const Candidate& other : candidates_) {
        const double cosine = other.plane.normal.dot(normal);
        const double apart = plane.offset - std::copysign(other.plane.offset, cosine * other.plane.offset);
        if (std::abs(cosine) > 1 - 1e-12 && std::abs(apart) <= scale_.tolerance) return;
    }
    candidates_.push_back({plane, 0});
}

/// The planes of the faces at the edges that stand back farthest from the hull, and those between the faces.
void Divider::addEdgePlanes(const HullData& hull) {
    struct Deep {
        double depth;
        ReflexEdge edge;
    };
    std::vector<Deep> deep;
    for (const ReflexEdge& edge : reflexEdges(part_.solid, points_)) {
        const Vec3 middle = 0.5 * (points_[edge.from] + points_[edge.to]);
        double depth = std::numeric_limits<double>::infinity();
        for (const HullFace& face : hull.faces) depth = std::min(depth, face.offset - face.normal.dot(middle));
        deep.push_back({depth * (points_[edge.from] - points_[edge.to]).norm(), edge});
    }
    const std::size_t count = std::min(most_edges, deep.size());
    std::partial_sort(deep.begin(), deep.begin() + static_cast<std::ptrdiff_t>(count), deep.end(),
                      [](const Deep& a, const Deep& b) {
                          return std::tie(b.depth, a.edge.from, a.edge.to) < std::tie(a.depth, b.edge.from, b.edge.to);
                      });
    for (std::size_t i = 0; i < count; ++i) {
        const ReflexEdge& edge = deep[i].edge;
        addPlane(edge.first, points_[edge.from]);
        addPlane(edge.second, points_[edge.from]);
        addPlane((edge.first - edge.second).normalized(), points_[edge.from]);
    }
}

void Divider::addAlong(const Vec3& axis, int stride) {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -lower;
    for (const Vec3& corner : part_.corners) {
        lower = std::min(lower, axis.dot(corner));
        upper = std::max(upper, axis.dot(corner));
    }
    const double step = (upper - lower) / places;
    for (int i = stride; i < places; i += stride)
        candidates_.push_back({{axis, lower + i * step}, 0.5 * stride * step});
}

/// Planes across the axes of the frame, and across those of the hull where they are others.
void Divider::addAxisPlanes(const HullData& hull) {
    const Mat3 axes = hull.mass.axes.toRotationMatrix();
    for (Eigen::Index k = 0; k < 3; ++k) addAlong(Vec3::Unit(k), 1);
    for (Eigen::Index k = 0; k < 3; ++k) {
        if (axes.col(k).cwiseAbs().maxCoeff() < same_direction) addAlong(axes.col(k), 2);
    }
}

/// @return none if the plane does not divide the part
std::vector<ConvexPart> Divider::partsOf(const CuttingPlane& plane, Hulls hulls) {
    auto [before, behind] = cut(part_.solid, plane, scale_.tolerance, points_);
    std::vector<ConvexPart> parts;
    for (Polyhedron* side : {&before, &behind}) {
        if (!(volumeOf(*side, points_) > least_side * part_.volume)) return {};
        auto pieces = connectedPieces(*side, points_, scale_.least);
        if (!pieces) return {};
        for (Polyhedron& piece : *pieces) {
            if (hulls == Hulls::estimated) {
                parts.push_back(estimatedPart(std::move(piece), points_));
            } else if (auto made = makePart(std::move(piece), points_)) {
                parts.push_back(std::move(*made));
            }
        }
    }
    return parts;
}

/// Tries all candidates and then planes beside the best.
Division Divider::findBest(Hulls hulls) {
    attempts_.clear();
    Division best;
    for (const Candidate& candidate : candidates_) attempt(candidate, hulls, best);
    for (int i = 0; i < refinements && best.candidate.step > 0; ++i) {
        Candidate nearer = best.candidate;
        nearer.step *= 0.5;
        const double middle = nearer.plane.offset;
        best.candidate.step = nearer.step;
        for (const double side : {-1.0, 1.0}) {
            nearer.plane.offset = middle + side * nearer.step;
            attempt(nearer, hulls, best);
        }
    }
    return best;
}

/// Estimates are too small, of parallel planes all about alike: the best planes of several normals are worth an exact
/// look.
void Divider::keepBestEstimates() {
    std::ranges::stable_sort(attempts_, {}, &Division::cost);
    candidates_.clear();
    for (const Division& division : attempts_) {
        const Vec3& normal = division.candidate.plane.normal;
        const auto isParallel = [&](const Candidate& other) {
            return std::abs(other.plane.normal.dot(normal)) > same_direction;
        };
        if (std::ranges::any_of(candidates_, isParallel)) continue;
        candidates_.push_back({division.candidate.plane, 0});
        if (candidates_.size() == best_estimates) return;
    }
}

void Divider::attempt(const Candidate& candidate, Hulls hulls, Division& best) {
    const std::size_t before = points_.size();
    std::vector<ConvexPart> parts = partsOf(candidate.plane, hulls);
    std::vector<Vec3> added(points_.begin() + static_cast<std::ptrdiff_t>(before), points_.end());
    points_.resize(before);
    if (parts.empty()) return;
    double error = 0;
    double balance = 0;
    for (const ConvexPart& part : parts) {
        error += part.error;
        Vec3 middle = Vec3::Zero();
        for (const Vec3& corner : part.corners) middle += corner;
        const double height = candidate.plane.normal.dot(middle) / static_cast<double>(part.corners.size());
        balance += height > candidate.plane.offset ? part.volume : -part.volume;
    }
    const double cost = error + balance_weight * std::abs(balance);
    attempts_.push_back({cost, candidate});
    // Rounding decides nothing: of planes that cost the same the first is taken.
    if (!(cost < best.cost - 1e-9 * part_.volume)) return;
    best = attempts_.back();
    if (hulls == Hulls::estimated) return;
    best.parts = std::move(parts);
    best.points = std::move(added);
}

}  // namespace

std::optional<HullData> hullOf(std::vector<Vec3> points) {
    if (points.size() > most_hull_points) {
        // The corners of the hulls of some points are among them all.
        std::vector<Vec3> corners;
        for (std::size_t begin = 0; begin < points.size(); begin += most_hull_points / 2) {
            const auto first = points.begin() + static_cast<std::ptrdiff_t>(begin);
            const std::size_t count = std::min(most_hull_points / 2, points.size() - begin);
            const std::vector<Vec3> some(first, first + static_cast<std::ptrdiff_t>(count));
            const std::optional<HullData> hull = hullOf(some);
            const std::vector<Vec3>& kept = hull ? hull->corners : some;
            corners.insert(corners.end(), kept.begin(), kept.end());
        }
        if (corners.size() < points.size()) return hullOf(std::move(corners));
    }
    try {
        return buildHull(std::move(points));
    } catch (const InputError&) {
        return {};
    }
}

std::optional<ConvexPart> makePart(Polyhedron solid, const Points& points) {
    std::optional<HullData> hull = hullOf(placesOf(solid, points));
    if (!hull) return {};
    ConvexPart part;
    part.volume = volumeOf(solid, points);
    part.error = std::max(0.0, hull->mass.volume - part.volume);
    part.corners = std::move(hull->corners);
    part.solid = std::move(solid);
    return part;
}

std::vector<ConvexPart> divide(const ConvexPart& part, const PartScale& scale, Points& points) {
    return Divider(part, scale, points).divide();
}

}  // namespace cairn
