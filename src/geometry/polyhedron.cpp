/// Sums over faces need no more than their edges, in any order: the area vector of a face is half the sum of a × b over
/// them. So faces are kept as sets of edges and need no triangulation.
#include "geometry/polyhedron.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "math/groups.h"

namespace cairn {

namespace {

/// Sine of the angle between faces that counts as an edge that stands back.
constexpr double least_reflex_sine = 1e-4;

/// Edges between the same two points stand side by side.
struct SharedEdge {
    std::uint32_t low, high;
    std::uint32_t face;
    std::int32_t sign;  ///< 1 from low to high, −1 from high to low

    bool isAt(const SharedEdge& other) const { return low == other.low && high == other.high; }
};

/// Sorts by all members: into places by the lower point first, where there are few edges each.
void sortByLow(std::vector<SharedEdge>& shared) {
    std::vector<std::size_t> begin;
    for (const SharedEdge& edge : shared) {
        if (edge.low + std::size_t{2} > begin.size()) begin.resize(edge.low + std::size_t{2}, 0);
        ++begin[edge.low + 1];
    }
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    std::vector<SharedEdge> sorted(shared.size());
    std::vector<std::size_t> next = begin;
    for (const SharedEdge& edge : shared) sorted[next[edge.low]++] = edge;
    for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
        const std::span some = std::span(sorted).subspan(begin[i], begin[i + 1] - begin[i]);
        if (some.size() < 2) continue;
        std::ranges::sort(some, [](const SharedEdge& a, const SharedEdge& b) {
            return std::tie(a.high, a.face, a.sign) < std::tie(b.high, b.face, b.sign);
        });
    }
    shared = std::move(sorted);
}

std::vector<SharedEdge> sharedEdges(const Polyhedron& solid) {
    std::vector<SharedEdge> shared;
    shared.reserve(solid.edges.size());
    for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
        for (const auto& [from, to] : solid.edgesOf(solid.faces[f])) {
            shared.push_back({std::min(from, to), std::max(from, to), f, from < to ? 1 : -1});
        }
    }
    sortByLow(shared);
    return shared;
}

/// Calls use with each run of edges between the same two points.
template <class Use>
void forEachRun(std::span<const SharedEdge> shared, const Use& use) {
    for (std::size_t begin = 0; begin < shared.size();) {
        std::size_t end = begin + 1;
        while (end < shared.size() && shared[end].isAt(shared[begin])) ++end;
        use(shared.subspan(begin, end - begin));
        begin = end;
    }
}

/// Solid angle of the surface seen from a point, in whole spheres: how often it encloses the point.
/// @source van Oosterom, Strackee 1983, doi:10.1109/TBME.1983.325207
double windingAbout(const Polyhedron& solid, const Points& points, const Vec3& p) {
    double angle = 0;
    for (const PolyhedronFace& face : solid.faces) {
        const Vec3 c = points[solid.edges[face.begin].from] - p;
        for (const auto& [from, to] : solid.edgesOf(face)) {
            const Vec3 a = points[from] - p;
            const Vec3 b = points[to] - p;
            const double la = a.norm();
            const double lb = b.norm();
            const double lc = c.norm();
            angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
        }
    }
    return angle / (4 * std::numbers::pi);
}

Vec3 middleOf(const Polyhedron& solid, const PolyhedronFace& face, const Points& points) {
    Vec3 sum = Vec3::Zero();
    for (const PolyhedronEdge& edge : solid.edgesOf(face)) sum += points[edge.from];
    return sum / static_cast<double>(face.end - face.begin);
}

/// The closed surfaces that hang together, of pieces and of cavities.
std::vector<Polyhedron> shellsOf(const Polyhedron& solid) {
    Groups groups(solid.faces.size());
    forEachRun(sharedEdges(solid), [&](std::span<const SharedEdge> run) {
        for (const SharedEdge& edge : run) groups.join(run.front().face, edge.face);
    });
    std::vector<Polyhedron> shells;
    std::vector<std::uint32_t> number(solid.faces.size());
    for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
        const std::uint32_t group = groups.find(f);
        if (group == f) {
            number[f] = static_cast<std::uint32_t>(shells.size());
            shells.emplace_back();
        }
        shells[number[group]].add(solid.faces[f].normal, solid.edgesOf(solid.faces[f]));
    }
    return shells;
}

}  // namespace

void Polyhedron::add(const Vec3& normal, std::span<const PolyhedronEdge> border) {
    const auto begin = static_cast<std::uint32_t>(edges.size());
    edges.insert(edges.end(), border.begin(), border.end());
    faces.push_back({normal, begin, static_cast<std::uint32_t>(edges.size())});
}

void Polyhedron::add(const Polyhedron& other) {
    for (const PolyhedronFace& face : other.faces) add(face.normal, other.edgesOf(face));
}

double volumeOf(const Polyhedron& solid, const Points& points) {
    if (solid.faces.empty()) return 0;
    const Vec3& middle = points[solid.edges.front().from];
    double six = 0;
    for (const PolyhedronFace& face : solid.faces) {
        const Vec3& first = points[solid.edges[face.begin].from];
        Vec3 area = Vec3::Zero();
        for (const auto& [from, to] : solid.edgesOf(face)) area += (points[from] - first).cross(points[to] - first);
        six += area.dot(first - middle);
    }
    return six / 6;
}

std::vector<std::uint32_t> pointsOf(const Polyhedron& solid) {
    std::vector<std::uint8_t> is_used;
    for (const PolyhedronEdge& edge : solid.edges) {
        if (edge.from >= is_used.size()) is_used.resize(edge.from + std::size_t{1}, 0);
        is_used[edge.from] = 1;
    }
    std::vector<std::uint32_t> used;
    for (std::uint32_t i = 0; i < is_used.size(); ++i) {
        if (is_used[i] != 0) used.push_back(i);
    }
    return used;
}

std::optional<std::vector<Polyhedron>> connectedPieces(const Polyhedron& solid, const Points& points, double least) {
    std::vector<Polyhedron> pieces;
    std::vector<double> volumes;
    std::vector<Polyhedron> cavities;
    for (Polyhedron& shell : shellsOf(solid)) {
        const double volume = volumeOf(shell, points);
        if (std::abs(volume) <= least) continue;
        if (volume < 0) {
            cavities.push_back(std::move(shell));
        } else {
            pieces.push_back(std::move(shell));
            volumes.push_back(volume);
        }
    }
    std::vector<std::size_t> holders;
    for (const Polyhedron& cavity : cavities) {
        const Vec3 inside = middleOf(cavity, cavity.faces.front(), points);
        std::size_t holder = pieces.size();
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            if (windingAbout(pieces[p], points, inside) < 0.5) continue;
            if (holder == pieces.size() || volumes[p] < volumes[holder]) holder = p;
        }
        if (holder == pieces.size()) return {};
        holders.push_back(holder);
    }
    for (std::size_t c = 0; c < cavities.size(); ++c) pieces[holders[c]].add(cavities[c]);
    return pieces;
}

std::vector<ReflexEdge> reflexEdges(const Polyhedron& solid, const Points& points) {
    std::vector<ReflexEdge> reflex;
    forEachRun(sharedEdges(solid), [&](std::span<const SharedEdge> run) {
        if (run.size() != 2 || run[0].sign == run[1].sign) return;
        const SharedEdge& rising = run[0].sign > 0 ? run[0] : run[1];
        const SharedEdge& falling = run[0].sign > 0 ? run[1] : run[0];
        const Vec3& first = solid.faces[rising.face].normal;
        const Vec3& second = solid.faces[falling.face].normal;
        const Vec3 along = (points[rising.high] - points[rising.low]).stableNormalized();
        if (first.cross(second).dot(along) < -least_reflex_sine) {
            reflex.push_back({rising.low, rising.high, first, second});
        }
    });
    return reflex;
}

}  // namespace cairn
