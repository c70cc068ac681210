/// Finds corners and faces of a hull with Qhull; everything else is computed from them.
#include <fmt/core.h>
#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <set>

#include "geometry/hull_data.h"
#include "geometry/principal_axes.h"
#include "geometry/shape_entry.h"
#include "geometry/tetrahedron_sums.h"

namespace cairn {

namespace {

/// Points nearer to a plane than this part of their extent are in it: decimal fractions of a flat face must not break
/// it into slivers.
constexpr double flat_part = 1e-8;

constexpr std::size_t most_points = 100000;

using Loop = std::vector<std::uint32_t>;

/// @throws InputError as ConvexHull, but for flat points
void checkPoints(const std::vector<Vec3>& points) {
    if (points.size() > most_points) {
        throw InputError(fmt::format("a hull has {} points; at most {} are allowed", points.size(), most_points));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3& p = points[i];
        if (p.allFinite() && p.cwiseAbs().maxCoeff() <= largest_dimension) continue;
        throw InputError(
            fmt::format("point {} of a hull is ({}, {}, {}); every component must be finite and within ±{} m", i, p.x(),
                        p.y(), p.z(), largest_dimension));
    }
    std::set<std::array<double, 3>> distinct;
    for (std::size_t i = 0; i < points.size() && distinct.size() < 4; ++i) {
        distinct.insert({points[i].x(), points[i].y(), points[i].z()});
    }
    if (distinct.size() < 4) {
        throw InputError(
            fmt::format("a hull has {} points, of which {} differ; it needs at least four that are not in "
                        "one plane",
                        points.size(), distinct.size()));
    }
}

/// The points' smallest extent in any direction across their largest one. @throws InputError if they are flat
void checkExtent(const std::vector<Vec3>& points, double extent) {
    const Vec3& first = points.front();
    const auto farther = [](const auto& measure) {
        return [&measure](const Vec3& p, const Vec3& q) { return measure(p) < measure(q); };
    };
    const auto fromFirst = [&](const Vec3& p) { return (p - first).squaredNorm(); };
    const Vec3 line = (*std::max_element(points.begin(), points.end(), farther(fromFirst)) - first).stableNormalized();
    const auto fromLine = [&](const Vec3& p) { return (p - first).cross(line).squaredNorm(); };
    const Vec3 across = *std::max_element(points.begin(), points.end(), farther(fromLine)) - first;
    const Vec3 normal = line.cross(across).stableNormalized();
    double thickness = 0;
    if (normal.allFinite()) {
        for (const Vec3& p : points) thickness = std::max(thickness, std::abs((p - first).dot(normal)));
    }
    if (thickness >= smallest_dimension && thickness > 10 * flat_part * extent) return;
    throw InputError(
        fmt::format("the {} points of a hull are in one plane or line (within {} m); a solid needs one that is not, at "
                    "least {} m away",
                    points.size(), thickness, std::max(smallest_dimension, 10 * flat_part * extent)));
}

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Owns the state of Qhull.
class Qhull {
  public:
    Qhull() { qh_zero(&state_, nullptr); }
    ~Qhull() {
        qh_freeqhull(&state_, qh_ALL);
        int left = 0;
        int bytes = 0;
        qh_memfreeshort(&state_, &left, &bytes);
    }
    Qhull(const Qhull&) = delete;
    Qhull& operator=(const Qhull&) = delete;

    /// The corners of each face, in either sense, as indices of the points. @throws InputError with Qhull's message
    std::vector<Loop> faces(std::vector<double>& coordinates, double flat) {
        const std::unique_ptr<std::FILE, CloseFile> messages(std::tmpfile());
        if (!messages) throw IoError("no temporary file could be made for the messages of the hull builder");
        std::string command = fmt::format("qhull C-{:.17g}", flat);
        const int error = qh_new_qhull(&state_, 3, static_cast<int>(coordinates.size() / 3), coordinates.data(), 0,
                                       command.data(), nullptr, messages.get());
        if (error != 0) throw InputError("no hull can be built around the points: " + firstLine(messages.get()));
        std::vector<Loop> result;
        for (facetT* facet = state_.facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
            setT* corners = qh_facet3vertex(&state_, facet);
            Loop loop;
            for (int i = 0; i < qh_setsize(&state_, corners); ++i) {
                const auto* vertex = static_cast<vertexT*>(SETelem_(corners, i));
                loop.push_back(static_cast<std::uint32_t>(qh_pointid(&state_, vertex->point)));
            }
            qh_settempfree(&state_, &corners);
            result.push_back(std::move(loop));
        }
        return result;
    }

  private:
    static std::string firstLine(std::FILE* file) {
        std::array<char, 256> text{};
        std::rewind(file);
        if (std::fgets(text.data(), static_cast<int>(text.size()), file) == nullptr) return "no reason given";
        std::string line = text.data();
        while (!line.empty() && line.back() == '\n') line.pop_back();
        return line;
    }

    qhT state_{};
};

/// Twice the area of a loop times its unit normal.
Vec3 areaOf(const std::vector<Vec3>& points, const Loop& loop) {
    Vec3 area = Vec3::Zero();
    const Vec3& first = points[loop[0]];
    for (std::size_t i = 2; i < loop.size(); ++i) {
        area += (points[loop[i - 1]] - first).cross(points[loop[i]] - first);
    }
    return area;
}

/// Renumbers the loops by corners, turns them counter-clockwise and begins each with its lowest corner.
void keepCorners(HullData& hull, std::vector<Loop>& loops) {
    std::vector<std::uint32_t> number(hull.points.size(), 0);
    Vec3 inside = Vec3::Zero();
    for (const Loop& loop : loops) {
        for (const std::uint32_t i : loop) number[i] = 1;
    }
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] == 0) continue;
        number[i] = static_cast<std::uint32_t>(hull.corners.size());
        hull.corners.push_back(hull.points[i]);
        inside += hull.points[i];
    }
    inside /= static_cast<double>(hull.corners.size());
    for (Loop& loop : loops) {
        if (areaOf(hull.points, loop).dot(hull.points[loop[0]] - inside) < 0) std::reverse(loop.begin(), loop.end());
        for (std::uint32_t& i : loop) i = number[i];
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    }
    std::sort(loops.begin(), loops.end());
}

void addFaces(HullData& hull, const std::vector<Loop>& loops) {
    for (const Loop& loop : loops) {
        HullFace face{};
        face.normal = areaOf(hull.corners, loop).stableNormalized();
        face.offset = -std::numeric_limits<double>::infinity();
        for (const std::uint32_t i : loop) face.offset = std::max(face.offset, face.normal.dot(hull.corners[i]));
        face.begin = static_cast<std::uint32_t>(hull.loops.size());
        hull.loops.insert(hull.loops.end(), loop.begin(), loop.end());
        face.end = static_cast<std::uint32_t>(hull.loops.size());
        hull.faces.push_back(face);
    }
}

void addMass(HullData& hull) {
    Vec3 inside = Vec3::Zero();
    for (const Vec3& corner : hull.corners) inside += corner;
    inside /= static_cast<double>(hull.corners.size());
    TetrahedronSums sums;
    for (const HullFace& face : hull.faces) {
        const auto loop = hull.loop(face);
        const Vec3 a = hull.corners[loop[0]] - inside;
        for (std::size_t i = 2; i < loop.size(); ++i) {
            sums.add(a, hull.corners[loop[i - 1]] - inside, hull.corners[loop[i]] - inside);
        }
    }
    const PrincipalInertia inertia = principalInertia(sums.inertia());
    hull.mass = {sums.volume(), inertia.moments, inside + sums.centre(), inertia.axes};
}

}  // namespace

HullData buildHull(std::vector<Vec3> points) {
    checkPoints(points);
    Bounds bounds{points[0], points[0]};
    for (const Vec3& p : points) bounds = {bounds.lower.cwiseMin(p), bounds.upper.cwiseMax(p)};
    const double extent = (bounds.upper - bounds.lower).maxCoeff();
    checkExtent(points, extent);
    HullData hull;
    hull.points = std::move(points);
    // About their middle, so that nothing is lost far from the origin.
    const Vec3 middle = 0.5 * (bounds.lower + bounds.upper);
    std::vector<double> coordinates;
    for (const Vec3& p : hull.points) {
        const Vec3 from = p - middle;
        coordinates.insert(coordinates.end(), from.begin(), from.end());
    }
    std::vector<Loop> loops = Qhull().faces(coordinates, flat_part * extent);
    keepCorners(hull, loops);
    addFaces(hull, loops);
    addMass(hull);
    for (const Vec3& corner : hull.corners) hull.radius = std::max(hull.radius, (corner - hull.mass.centre).norm());
    hull.smallest = hull.radius;
    for (const HullFace& face : hull.faces) {
        hull.smallest = std::min(hull.smallest, face.offset - face.normal.dot(hull.mass.centre));
    }
    return hull;
}

}  // namespace cairn
