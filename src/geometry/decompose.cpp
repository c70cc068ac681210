#include "cairn/decompose.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "geometry/convex_part.h"
#include "geometry/open_edges.h"
#include "geometry/shape_entry.h"
#include "geometry/surface_data.h"
#include "geometry/tetrahedron_sums.h"

namespace cairn {

namespace {

constexpr double tolerance_part = 1e-9;  ///< of the extent: points nearer to a plane are in it
constexpr double nothing_part = 1e-12;   ///< of the volume of the box around all: a volume that is nothing
constexpr double convex_part = 1e-7;     ///< of the volume: an error that is rounding
/// Parts are divided until this part of the error is left, so that some can be joined again.
constexpr double error_before_joining = 0.5;
constexpr std::size_t divided_per_part = 2;  ///< parts that there may be before they are joined, per part allowed

void requireOptions(const DecompositionOptions& options) {
    if (!(options.largest_error >= 0 && options.largest_error <= 1)) {
        throw InputError(
            fmt::format("largest_error is {}; it must be from 0 to 1, a part of the volume", options.largest_error));
    }
    if (options.most_parts < 1 || options.most_parts > 1000) {
        throw InputError(fmt::format("most_parts is {}; it must be from 1 to 1000", options.most_parts));
    }
}

Polyhedron polyhedronOf(const SurfaceData& surface, bool turned) {
    Polyhedron solid;
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
        TriangleCorners c = surface.triangles[t];
        if (turned) std::swap(c[1], c[2]);
        const Vec3& first = surface.vertices[c[0]];
        const Vec3 area = (surface.vertices[c[1]] - first).cross(surface.vertices[c[2]] - first);
        const PolyhedronEdge border[] = {{c[0], c[1]}, {c[1], c[2]}, {c[2], c[0]}};
        solid.add(area.stableNormalized(), border);
    }
    return solid;
}

/// About the first vertex, so that nothing is lost far from the origin.
SolidProperties propertiesOf(const SurfaceData& surface) {
    const Vec3 from = surface.vertices.front();
    TetrahedronSums sums;
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
        const auto [a, b, c] = surface.corners(t);
        sums.add(a - from, b - from, c - from);
    }
    const double sign = sums.volume() < 0 ? -1 : 1;
    return {sign * sums.volume(), from + sums.centre(), sign * sums.inertia()};
}

std::vector<ConvexPart> firstParts(const Polyhedron& solid, const PartScale& scale, const Points& points) {
    auto pieces = connectedPieces(solid, points, scale.least);
    if (!pieces) {
        throw InputError(
            "a mesh encloses no solid: a piece of it is inside out and in no other; turn the triangles of that piece "
            "so that their corners run counter-clockwise seen from outside");
    }
    std::vector<ConvexPart> parts;
    for (Polyhedron& piece : *pieces) {
        if (auto part = makePart(std::move(piece), points)) parts.push_back(std::move(*part));
    }
    return parts;
}

double errorOf(const std::vector<ConvexPart>& parts) {
    double error = 0;
    for (const ConvexPart& part : parts) error += part.error;
    return error;
}

/// Divides the worst part again and again. @param volume of the solid [m³]
void divideAll(std::vector<ConvexPart>& parts, const DecompositionOptions& options, double volume,
               const PartScale& scale, Points& points) {
    const double enough = std::max(error_before_joining * options.largest_error, convex_part) * volume;
    const std::size_t most =
        options.most_parts == 1 ? 1 : divided_per_part * static_cast<std::size_t>(options.most_parts);
    while (parts.size() < most && errorOf(parts) > enough) {
        const auto worst = std::ranges::max_element(parts, [](const ConvexPart& a, const ConvexPart& b) {
            return (a.is_final ? -1 : a.error) < (b.is_final ? -1 : b.error);
        });
        if (worst->is_final) return;
        std::vector<ConvexPart> pieces = divide(*worst, scale, points);
        if (pieces.empty()) {
            worst->is_final = true;
            continue;
        }
        *worst = std::move(pieces.front());
        std::move(pieces.begin() + 1, pieces.end(), std::back_inserter(parts));
    }
}

Decomposition hullAround(const SurfaceData& surface) {
    Decomposition result;
    std::optional<HullData> hull = hullOf(surface.vertices);
    if (!hull) throw InputError("the vertices of a mesh are in one plane or line; there is no hull around them");
    result.took_hull = true;
    result.volume = result.parts_volume = hull->mass.volume;
    result.compound.parts.push_back({ConvexHull(std::move(hull->corners)), {}, {}, {}});
    return result;
}

}  // namespace

Decomposition decompose(const Mesh& mesh, const DecompositionOptions& options) {
    requireOptions(options);
    const SurfaceData& surface = mesh.data();
    const OpenEdges open = openEdgesOf(surface);
    if (open.any()) {
        if (options.hull_if_open) return hullAround(surface);
        throw InputError(describe(open));
    }
    Points points = surface.vertices;
    Polyhedron solid = polyhedronOf(surface, false);
    const Vec3 extent = surface.upper - surface.lower;
    const PartScale scale{tolerance_part * extent.maxCoeff(), nothing_part * extent.prod()};
    const double signed_volume = volumeOf(solid, points);
    if (!(std::abs(signed_volume) > scale.least)) {
        throw InputError(fmt::format("a mesh encloses no volume ({} m³); a solid needs some", signed_volume));
    }
    Decomposition result;
    result.turned = signed_volume < 0;
    if (result.turned) solid = polyhedronOf(surface, true);
    const SolidProperties properties = propertiesOf(surface);
    std::vector<ConvexPart> parts = firstParts(solid, scale, points);
    divideAll(parts, options, properties.volume, scale, points);
    joinParts(parts, std::max(options.largest_error, convex_part) * properties.volume,
              static_cast<std::size_t>(options.most_parts));
    for (ConvexPart& part : parts) {
        ConvexHull hull(std::move(part.corners));
        result.parts_volume += hull.data().mass.volume;
        result.compound.parts.push_back({std::move(hull), {}, {}, {}});
    }
    result.volume = properties.volume;
    result.compound.solid = properties;
    result.error = result.parts_volume / result.volume - 1;
    return result;
}

double volumeErrorOf(const Compound& compound) {
    if (!compound.solid) return 0;
    validateShape(compound);
    double volume = 0;
    for (const CompoundPart& part : compound.parts) volume += unitMassProperties(part.shape).volume;
    return volume / compound.solid->volume - 1;
}

}  // namespace cairn
