#include <fmt/core.h>

#include <cmath>

#include "geometry/shape_entry.h"
#include "geometry/surface_data.h"

namespace cairn {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

std::vector<Vec3> scaled(std::vector<Vec3> vertices, const Vec3& scale) {
    if (!(scale.allFinite() && (scale.array() > 0).all())) {
        throw InputError(
            fmt::format("the scale of a mesh is ({}, {}, {}); every component must be finite and above 0, "
                        "turn or mirror the vertices instead",
                        scale.x(), scale.y(), scale.z()));
    }
    for (Vec3& v : vertices) v = v.cwiseProduct(scale);
    return vertices;
}

/// A surface was validated when it was built.
template <class S>
void validate(const S&) {}

template <class S>
UnitMassProperties massProperties(const S&) {
    return {endless, Vec3::Constant(endless)};
}

template <class S>
double radius(const S& shape) {
    return shape.data().radius;
}

/// Nothing that touches a surface is small beside it.
template <class S>
double innerRadius(const S&) {
    return endless;
}

/// Of the box around all vertices, so that it costs nothing for a million of them.
template <class S>
Bounds bounds(const S& shape, const Pose& pose) {
    const SurfaceData& surface = shape.data();
    const Vec3 half = 0.5 * (surface.upper - surface.lower);
    const Vec3 centre = pose.toOuter(surface.lower + half);
    const Vec3 extent = pose.orientation.toRotationMatrix().cwiseAbs() * half;
    return {centre - extent, centre + extent};
}

template <class S>
std::optional<LocalHit> surfaceHit(const S& shape, const LocalRay& ray) {
    return castRay(shape.data(), ray, endless);
}

template <class S>
Vec3 farthest(const S& shape, const Vec3& direction) {
    const Vec3 unit = direction.stableNormalized();
    const std::vector<Vec3>& vertices = shape.data().vertices;
    std::size_t best = 0;
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        if (vertices[i].dot(unit) > vertices[best].dot(unit)) best = i;
    }
    return vertices[best];
}

template <class S>
constexpr ShapeEntry surfaceEntry(std::string_view name) {
    return finiteShapeEntry<S, validate<S>, massProperties<S>, radius<S>, innerRadius<S>, bounds<S>, surfaceHit<S>,
                            farthest<S>>(name);
}

constexpr ShapeEntry mesh_entry = surfaceEntry<Mesh>("mesh");
constexpr ShapeEntry height_field_entry = surfaceEntry<HeightField>("height_field");

void requireGrid(std::size_t columns, std::span<const double> heights, const Eigen::Vector2d& spacing) {
    if (columns < 2 || heights.size() % columns != 0 || heights.size() / columns < 2) {
        throw InputError(
            fmt::format("a height field has {} heights in rows of {}; it needs at least two rows of at "
                        "least two, all of one length",
                        heights.size(), columns));
    }
    validateDimension("the spacing of the columns of a height field", spacing.x());
    validateDimension("the spacing of the rows of a height field", spacing.y());
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (std::abs(heights[i]) <= largest_dimension) continue;
        throw InputError(
            fmt::format("the height in row {}, column {} of a height field is {}; it must be finite and "
                        "within ±{} m",
                        i / columns, i % columns, heights[i], largest_dimension));
    }
}

SurfaceData gridSurface(std::size_t columns, std::span<const double> heights, const Eigen::Vector2d& spacing) {
    const std::size_t rows = heights.size() / columns;
    const Eigen::Vector2d middle(0.5 * static_cast<double>(columns - 1), 0.5 * static_cast<double>(rows - 1));
    std::vector<Vec3> vertices;
    vertices.reserve(heights.size());
    for (std::size_t i = 0; i < heights.size(); ++i) {
        vertices.emplace_back((static_cast<double>(i % columns) - middle.x()) * spacing.x(),
                              (static_cast<double>(i / columns) - middle.y()) * spacing.y(), heights[i]);
    }
    std::vector<TriangleCorners> triangles;
    triangles.reserve(2 * (columns - 1) * (rows - 1));
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const auto a = static_cast<std::uint32_t>(row * columns + column);
            const auto c = static_cast<std::uint32_t>(a + columns);
            triangles.push_back({a, a + 1, c + 1});
            triangles.push_back({a, c + 1, c});
        }
    }
    return buildSurface(std::move(vertices), std::move(triangles), SurfaceSides::one);
}

}  // namespace

struct HeightField::Grid {
    std::size_t columns;
    std::vector<double> heights;
    Eigen::Vector2d spacing;
    SurfaceData surface;
};

Mesh::Mesh(std::vector<Vec3> vertices, std::vector<TriangleCorners> triangles, SurfaceSides sides, const Vec3& scale)
    : data_(std::make_shared<const SurfaceData>(
          buildSurface(scaled(std::move(vertices), scale), std::move(triangles), sides))) {}

std::span<const Vec3> Mesh::vertices() const {
    return data_->vertices;
}

std::span<const TriangleCorners> Mesh::triangles() const {
    return data_->triangles;
}

SurfaceSides Mesh::sides() const {
    return data_->sides;
}

const SurfaceRepairs& Mesh::repairs() const {
    return data_->repairs;
}

std::size_t Mesh::bytes() const {
    return data_->bytes();
}

HeightField::HeightField(std::size_t columns, std::vector<double> heights, const Eigen::Vector2d& spacing) {
    requireGrid(columns, heights, spacing);
    SurfaceData surface = gridSurface(columns, heights, spacing);
    grid_ = std::make_shared<const Grid>(Grid{columns, std::move(heights), spacing, std::move(surface)});
}

std::size_t HeightField::columns() const {
    return grid_->columns;
}

std::size_t HeightField::rows() const {
    return grid_->heights.size() / grid_->columns;
}

std::span<const double> HeightField::heights() const {
    return grid_->heights;
}

const Eigen::Vector2d& HeightField::spacing() const {
    return grid_->spacing;
}

std::span<const Vec3> HeightField::vertices() const {
    return grid_->surface.vertices;
}

std::span<const TriangleCorners> HeightField::triangles() const {
    return grid_->surface.triangles;
}

std::size_t HeightField::bytes() const {
    return grid_->surface.bytes() + grid_->heights.capacity() * sizeof(double);
}

const SurfaceData& HeightField::data() const {
    return grid_->surface;
}

const ShapeEntry& meshEntry() {
    return mesh_entry;
}

const ShapeEntry& heightFieldEntry() {
    return height_field_entry;
}

}  // namespace cairn
