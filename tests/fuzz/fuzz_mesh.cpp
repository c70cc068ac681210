/// Any bytes are a file of a mesh or picture of heights, or are refused; and any solid in any pose has finite contacts
/// with any surface, and finite answers to questions about it.
#include <cmath>
#include <string_view>

#include "cairn/mesh_file.h"
#include "cairn/query.h"
#include "fuzz/bytes.h"
#include "geometry/geometry.h"
#include "geometry/surface_data.h"
#include "narrow_phase/narrow_phase.h"

namespace {

using namespace cairn;

bool isUnitVector(const Vec3& v) {
    return std::abs(v.norm() - 1) < 1e-9;
}

/// Up to 12 vertices, often on a grid so that triangles lie in one plane, and triangles of any of them.
Mesh anyMesh(fuzz::Bytes& in) {
    const bool grid = in.below(2) == 0;
    const double scale = fuzz::length(in);
    std::vector<Vec3> vertices(3 + in.below(10));
    for (Vec3& vertex : vertices) {
        for (double& x : vertex) x = grid ? static_cast<double>(in.below(3)) - 1 : in.within(1);
        vertex *= scale;
    }
    std::vector<TriangleCorners> triangles(1 + in.below(16));
    for (TriangleCorners& triangle : triangles) {
        for (std::uint32_t& corner : triangle) corner = in.below(static_cast<std::uint32_t>(vertices.size()) + 1);
    }
    return Mesh(std::move(vertices), std::move(triangles), in.below(2) == 0 ? SurfaceSides::one : SurfaceSides::two);
}

void touch(fuzz::Bytes& in) {
    const Mesh mesh = anyMesh(in);
    const Shape solid = fuzz::shape(in);
    if (!isSolid(solid)) return;
    const double reach = largestRadius(solid) + mesh.data().radius;
    const Pose pose{Vec3(in.within(reach), in.within(reach), in.within(reach)), fuzz::rotation(in)};
    const Pose ground{Vec3(in.within(1), in.within(1), in.within(1)), fuzz::rotation(in)};
    const double margin = in.below(2) == 0 ? 1e-4 : std::abs(in.within(1));
    Manifold manifold;
    forEachManifold(solid, pose, mesh, ground, margin, manifold, [&](const Manifold& found) {
        fuzz::require(isUnitVector(found.normal) && found.size > 0 && found.size <= Manifold::capacity);
        for (std::size_t i = 0; i < found.size; ++i) {
            fuzz::require(found.points[i].point.allFinite() && found.points[i].triangle < mesh.triangles().size());
            fuzz::require(found.points[i].distance <= margin + 1e-9 * reach);
        }
    });
    const Ray ray{in.vector(10), in.vector(1)};
    if (const auto hit = castRay(mesh, ground, ray)) {
        fuzz::require(std::isfinite(hit->distance) && hit->distance >= 0 && isUnitVector(hit->normal));
    }
    const ClosestPoints closest = closestPoints(solid, pose, mesh, ground);
    fuzz::require(std::isfinite(closest.distance) && isUnitVector(closest.normal));
    if (const auto hit = castShape(solid, pose, in.vector(10), mesh, ground)) {
        fuzz::require(std::isfinite(hit->distance) && hit->distance >= 0 && isUnitVector(hit->normal));
    }
}

void readAsFile(std::string_view bytes) {
    const Mesh mesh = parseMesh(bytes, "fuzz");
    for (const TriangleCorners& triangle : mesh.triangles()) {
        for (const std::uint32_t corner : triangle) fuzz::require(corner < mesh.vertices().size());
    }
    for (const Vec3& vertex : mesh.vertices()) fuzz::require(vertex.allFinite());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        if (data[0] == 1) {
            fuzz::Bytes in(data + 1, size - 1);
            touch(in);
        } else if (bytes.starts_with("\x89PNG")) {
            // A picture of many pixels is a long computation and nothing new.
            if (size > 24 && (data[16] | data[17] | data[18] | data[20] | data[21] | data[22]) != 0) return 0;
            parseHeightField(bytes, "fuzz", {1, 1}, 1);
        } else {
            readAsFile(bytes);
        }
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
