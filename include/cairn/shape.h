/// @file The shapes a body can have. Lengths in metres, in the body's own frame B (centre of mass, principal
/// axes), for hulls and compounds in the frame in which they are
/// given: the pose of a body is that of its shape.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "cairn/types.h"

namespace cairn {

/// A ball about the origin of B.
struct Sphere {
    double radius = 0.5;  ///< [m], > 0
};

/// A cuboid about the origin of B, its edges along the axes of B.
struct Box {
    Vec3 size = Vec3::Ones();  ///< full edge lengths [m], each > 0
};

/// A cylinder along the z axis of B with a half ball on each end.
struct Capsule {
    double radius = 0.5;  ///< [m], > 0
    double length = 1.0;  ///< of the cylindrical part, without the half balls [m], > 0
};

/// A cylinder about the origin of B, its axis along z.
struct Cylinder {
    double radius = 0.5;  ///< [m], > 0
    double length = 1.0;  ///< along the axis [m], > 0
};

struct HullData;

/// The smallest convex solid that holds some points. They may stand in any frame: the pose of a body is that of this
/// frame, wherever its centre of mass is. Copies share what was computed of the points.
class ConvexHull {
  public:
    /// @param points in any order, some may be inside or equal [m]
    /// @throws InputError unless they are finite, at least four of them differ and they are not all in one plane
    explicit ConvexHull(std::vector<Vec3> points);

    std::span<const Vec3> points() const;   ///< as given [m]
    std::span<const Vec3> corners() const;  ///< the points that are corners of the solid, in the order given [m]
    /// Corners, faces and mass properties, for the engine itself.
    const HullData& data() const { return *data_; }

  private:
    std::shared_ptr<const HullData> data_;
};

/// All points p with normal·p ≤ offset are solid; always fixed, has no mass.
struct HalfSpace {
    Vec3 normal = Vec3::UnitZ();  ///< outward, in B, any length > 0
    double offset = 0;            ///< distance of the plane from the origin of B along the normal [m]
};

struct CompoundPart;
class BoundsTree;

/// Volume, centre and inertia of a solid of density 1, in the frame of its shape.
struct SolidProperties {
    double volume = 0;            ///< [m³], > 0
    Vec3 centre = Vec3::Zero();   ///< of mass [m]
    Mat3 inertia = Mat3::Zero();  ///< about the centre [m⁵], symmetric, that of a body
};

/// Several shapes that move as one body. Parts may touch and overlap; where they overlap each counts with its own mass.
struct Compound {
    std::vector<CompoundPart> parts;  ///< at least one
    /// What the parts stand for, such as a concave mesh (decompose()): its mass, centre and inertia count in place of
    /// theirs, and none of them has a mass or density of its own.
    std::optional<SolidProperties> solid{};
    /// Over the parts, for the engine itself: made anew wherever it takes a compound.
    std::shared_ptr<const BoundsTree> tree{};
};

struct SurfaceData;

/// Which sides of a surface touch others.
enum class SurfaceSides : std::uint8_t {
    one,  ///< that from which a triangle's corners run counter-clockwise; what got behind it is brought out again
    two,  ///< that on which the middle of the other shape is
};

/// Corners of a triangle, indices of vertices.
using TriangleCorners = std::array<std::uint32_t, 3>;

/// What was mended when a surface was built.
struct SurfaceRepairs {
    std::size_t welded = 0;      ///< vertices at the place of another one, or of no triangle
    std::size_t degenerate = 0;  ///< triangles without an area, left out
    std::size_t duplicate = 0;   ///< triangles given before, left out
    std::size_t open_edges = 0;  ///< edges that stay without exactly one neighbour of the same orientation
};

/// A surface of triangles; its body is fixed and may have a law of motion. It has no mass. Neighbours in one plane are
/// one face, and inner edges that are flat or concave touch nothing, so that whatever slides or rolls over a plane of
/// triangles moves as on the plane. Copies share one table: about 200 bytes per triangle.
class Mesh {
  public:
    /// @param vertices [m, after scaling] @param triangles indices of vertices, counter-clockwise seen from outside
    /// @param sides @param scale by which vertices are multiplied, each component > 0
    /// Vertices at one place are welded; triangles without an area and those given twice are left out.
    /// @throws InputError for numbers that are not finite or beyond 1e9 m, indices out of range, or no triangle left
    Mesh(std::vector<Vec3> vertices, std::vector<TriangleCorners> triangles, SurfaceSides sides = SurfaceSides::one,
         const Vec3& scale = Vec3::Ones());

    std::span<const Vec3> vertices() const;              ///< those kept, in the order given, scaled [m]
    std::span<const TriangleCorners> triangles() const;  ///< those kept, in the order given: the parts of queries
    SurfaceSides sides() const;                          ///< as given
    const SurfaceRepairs& repairs() const;               ///< what was mended
    std::size_t bytes() const;                           ///< of memory that copies share
    /// For the engine itself.
    const SurfaceData& data() const { return *data_; }

  private:
    std::shared_ptr<const SurfaceData> data_;
};

/// Ground given by heights over a grid, of two triangles per cell; else as a mesh of one side, which looks along z.
class HeightField {
  public:
    /// @param columns along x, ≥ 2 @param heights row after row, the rows along y, at least two [m]
    /// @param spacing of the columns and of the rows [m], > 0. The grid's middle is the origin of the shape's frame.
    /// @throws InputError for numbers that are not finite or out of range, or a number of heights that fills no grid
    HeightField(std::size_t columns, std::vector<double> heights, const Eigen::Vector2d& spacing);

    std::size_t columns() const;                         ///< along x
    std::size_t rows() const;                            ///< along y
    std::span<const double> heights() const;             ///< row after row [m]
    const Eigen::Vector2d& spacing() const;              ///< of columns and rows [m]
    std::span<const Vec3> vertices() const;              ///< one per height, row after row [m]
    std::span<const TriangleCorners> triangles() const;  ///< two per cell, row after row: the parts of queries
    std::size_t bytes() const;                           ///< of memory that copies share
    /// For the engine itself.
    const SurfaceData& data() const;

  private:
    struct Grid;
    std::shared_ptr<const Grid> grid_;
};

/// Any shape. A new kind joins here, in src/geometry (one table entry) and src/narrow_phase (its row of testers).
using Shape = std::variant<Sphere, Box, Capsule, HalfSpace, Cylinder, ConvexHull, Compound, Mesh, HeightField>;

/// A shape of a compound.
struct CompoundPart {
    Shape shape;                      ///< any but half-spaces, meshes, height fields and compounds
    Pose pose{};                      ///< of the shape in the compound's frame; the quaternion is normalised
    std::optional<double> mass{};     ///< [kg], > 0
    std::optional<double> density{};  ///< in place of a mass [kg/m³], > 0; without either it is that of the material
};

}  // namespace cairn
