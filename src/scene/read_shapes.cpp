#include <fmt/core.h>

#include "cairn/decompose.h"
#include "cairn/mesh_file.h"
#include "geometry/geometry.h"
#include "scene/scene_reading.h"

namespace cairn {
namespace {

/// Range of a quaternion's length before it is normalised; outside it the direction drowns in rounding.
constexpr double smallest_quaternion = 1e-6;
constexpr double largest_quaternion = 1e6;

constexpr std::string_view shape_types =
    "sphere, box, capsule, cylinder, hull, compound, solid, plane, mesh or height_field";

double readLength(const JsonNode& node, std::string_view key) {
    return node.required(key, "a number above 0 [m]").positive();
}

Shape readBox(const JsonNode& node) {
    node.expectKeys({"type", "size"});
    const JsonNode size = node.required("size", "three edge lengths [m]");
    const Vec3 edges = size.vector();
    if (!(edges.array() > 0).all()) size.refuse("three numbers above 0: the full edge lengths [m]");
    return Box{edges};
}

Shape readPlane(const JsonNode& node) {
    node.expectKeys({"type", "normal", "offset"});
    const JsonNode normal = node.required("normal", "an array of three numbers");
    const HalfSpace plane{normal.vector(), node.required("offset", "a number [m]").number()};
    const double length_squared = plane.normal.squaredNorm();
    if (!(length_squared > 1e-12 && length_squared < 1e12)) normal.refuse("a direction of length 1e-6 to 1e6");
    return plane;
}

Shape readHull(const JsonNode& node) {
    node.expectKeys({"type", "points"});
    const JsonNode list = node.required("points", "an array of at least four points [m]");
    list.expectArray("an array of at least four points [m]");
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < list.size(); ++i) points.push_back(list.element(i).vector());
    try {
        return ConvexHull(std::move(points));
    } catch (const InputError& error) {
        list.fail(fmt::format("are refused: {}", error.what()));
    }
}

/// Does what may refuse a shape, with the node in its message.
template <class Build>
Shape built(const JsonNode& node, const Build& build) {
    try {
        return build();
    } catch (const InputError& error) {
        node.fail(fmt::format("is refused: {}", error.what()));
    } catch (const IoError& error) {
        node.fail(fmt::format("names a file that fails: {}", error.what()));
    }
}

void requireOneOf(const JsonNode& node, std::string_view first, std::string_view second) {
    if (node.find(first).has_value() == node.find(second).has_value()) {
        node.fail(fmt::format("needs either {} or {}", first, second));
    }
}

/// One number for all axes, or three.
Vec3 readScale(const JsonNode& node) {
    return node.value().is_array() ? node.vector() : Vec3::Constant(node.positive());
}

constexpr std::string_view triangles_form =
    "an array of triangles, each of three indices of vertices, or of indices, three to a triangle";

std::uint32_t readVertexIndex(const JsonNode& node) {
    const Json& index = node.value();
    if (!index.is_number_unsigned() || index.get<std::uint64_t>() > UINT32_MAX) {
        node.refuse("the index of a vertex, a whole number from 0 on");
    }
    return index.get<std::uint32_t>();
}

/// Three indices together, or all in one row.
std::vector<TriangleCorners> readTriangles(const JsonNode& list) {
    list.expectArray(triangles_form);
    const bool in_a_row = list.size() > 0 && !list.element(0).value().is_array();
    if (in_a_row && list.size() % 3 != 0)
        list.fail(fmt::format("has {} indices; give three to a triangle", list.size()));
    std::vector<TriangleCorners> triangles(in_a_row ? list.size() / 3 : list.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const JsonNode triangle = in_a_row ? list : list.element(i);
        if (!triangle.value().is_array() || (!in_a_row && triangle.size() != 3)) {
            triangle.refuse("three indices of vertices");
        }
        const std::size_t first = in_a_row ? 3 * i : 0;
        for (std::size_t k = 0; k < 3; ++k) triangles[i][k] = readVertexIndex(triangle.element(first + k));
    }
    return triangles;
}

/// What use makes of the triangles of a file, or of those that are given.
template <class Use>
Shape readTriangleShape(const JsonNode& node, SurfaceSides sides, const Use& use) {
    const auto scale_node = node.find("scale");
    const Vec3 scale = scale_node ? readScale(*scale_node) : Vec3::Ones();
    requireOneOf(node, "file", "vertices");
    if (const auto file = node.find("file")) {
        if (node.find("indices")) node.fail("has a file and indices; the file has its own, remove them");
        return built(*file, [&] { return use(readMesh(file->file(), sides, scale)); });
    }
    const JsonNode list = node.required("vertices", "an array of points [m]");
    list.expectArray("an array of points [m]");
    std::vector<Vec3> vertices;
    vertices.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) vertices.push_back(list.element(i).vector());
    auto triangles = readTriangles(node.required("indices", triangles_form));
    return built(node, [&] { return use(Mesh(std::move(vertices), std::move(triangles), sides, scale)); });
}

Shape readMeshShape(const JsonNode& node) {
    node.expectKeys({"type", "file", "vertices", "indices", "scale", "sides"});
    SurfaceSides sides = SurfaceSides::one;
    if (const auto given = node.find("sides")) {
        const std::string name = given->text();
        if (name != "one" && name != "two") given->refuse("one or two");
        sides = name == "one" ? SurfaceSides::one : SurfaceSides::two;
    }
    return readTriangleShape(node, sides, [](Mesh mesh) { return mesh; });
}

Shape readSolid(const JsonNode& node) {
    node.expectKeys({"type", "file", "vertices", "indices", "scale", "largest_error", "most_parts", "hull_if_open"});
    DecompositionOptions options;
    if (const auto given = node.find("largest_error")) options.largest_error = given->number();
    if (const auto given = node.find("most_parts")) {
        const Json& value = given->value();
        if (!value.is_number_integer() || value < 1 || value > 1000) given->refuse("a whole number from 1 to 1000");
        options.most_parts = value.get<int>();
    }
    if (const auto given = node.find("hull_if_open")) options.hull_if_open = given->flag();
    return readTriangleShape(node, SurfaceSides::one,
                             [&](const Mesh& mesh) { return decompose(mesh, options).compound; });
}

Eigen::Vector2d readSpacing(const JsonNode& node) {
    if (!node.value().is_array()) return Eigen::Vector2d::Constant(node.positive());
    if (node.size() != 2) node.refuse("a number above 0, or two: of columns and of rows [m]");
    return {node.element(0).positive(), node.element(1).positive()};
}

Shape readHeightFieldShape(const JsonNode& node) {
    node.expectKeys({"type", "heights", "file", "spacing", "scale"});
    const Eigen::Vector2d spacing = readSpacing(node.required("spacing", "a number above 0, or two [m]"));
    const auto scale_node = node.find("scale");
    const double scale = scale_node ? scale_node->number() : 1;
    requireOneOf(node, "file", "heights");
    if (const auto file = node.find("file")) {
        return built(*file, [&] { return readHeightField(file->file(), spacing, scale); });
    }
    const JsonNode rows = node.required("heights", "an array of rows of heights [m]");
    rows.expectArray("an array of rows of heights [m]");
    std::vector<double> heights;
    std::size_t columns = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        const JsonNode line = rows.element(row);
        line.expectArray("a row of heights [m]");
        if (row == 0) columns = line.size();
        if (line.size() != columns)
            line.fail(fmt::format("has {} heights; the first row has {}", line.size(), columns));
        for (std::size_t i = 0; i < columns; ++i) heights.push_back(scale * line.element(i).number());
    }
    return built(node, [&] { return HeightField(columns, std::move(heights), spacing); });
}

CompoundPart readPart(const JsonNode& node, const SceneReading& reading) {
    node.expectKeys({"shape", "position", "orientation", "mass", "density"});
    const JsonNode shape = node.required("shape", "an object");
    CompoundPart part{readShape(shape, reading), {}, {}, {}};
    if (!isSolid(part.shape) || std::holds_alternative<Compound>(part.shape)) {
        shape.fail(fmt::format("is a {}; a part of a compound must be a sphere, box, capsule, cylinder or hull",
                               shapeName(part.shape)));
    }
    if (const auto value = node.find("position")) part.pose.position = value->vector();
    if (const auto value = node.find("orientation")) part.pose.orientation = readOrientation(*value);
    if (const auto value = node.find("mass")) part.mass = value->positive();
    if (const auto value = node.find("density")) part.density = value->positive();
    if (part.mass && part.density) node.fail("has a mass and a density; give one of them");
    return part;
}

/// Mass, centre and inertia of what the parts of a compound stand for.
SolidProperties readSolidProperties(const JsonNode& node) {
    node.expectKeys({"volume", "centre_of_mass", "inertia"});
    SolidProperties solid;
    solid.volume = node.required("volume", "a number above 0 [m³]").positive();
    solid.centre = node.required("centre_of_mass", "a point [m]").vector();
    solid.inertia = readInertia(node.required("inertia", "three or six numbers [m⁵]"), "m⁵");
    return solid;
}

Shape readCompound(const JsonNode& node, const SceneReading& reading) {
    node.expectKeys({"type", "parts", "solid"});
    const JsonNode list = node.required("parts", "an array of at least one part");
    list.expectArray("an array of at least one part");
    if (list.size() == 0) list.fail("is empty; a compound without parts has no mass, it needs at least one");
    Compound compound;
    for (std::size_t i = 0; i < list.size(); ++i) compound.parts.push_back(readPart(list.element(i), reading));
    const auto solid = node.find("solid");
    if (!solid) return compound;
    compound.solid = readSolidProperties(*solid);
    return built(*solid, [&] {
        validateShape(compound);
        return compound;
    });
}

}  // namespace

Shape readShape(const JsonNode& node, const SceneReading& reading) {
    if (node.value().is_string()) {
        const auto found = reading.shapes.find(node.value().get_ref<const std::string&>());
        if (found != reading.shapes.end()) return found->second;
        node.fail(
            fmt::format("is the unknown shape {}; {}", shown(node.value()), knownNames(reading.shapes, "shapes")));
    }
    if (!node.value().is_object())
        node.refuse("an object with the key type and the dimensions, or the name of a shape");
    const JsonNode type_node = node.required("type", shape_types);
    const std::string type = type_node.text();
    if (type == "sphere") {
        node.expectKeys({"type", "radius"});
        return Sphere{readLength(node, "radius")};
    }
    if (type == "capsule" || type == "cylinder") {
        node.expectKeys({"type", "radius", "length"});
        const double radius = readLength(node, "radius");
        const double length = readLength(node, "length");
        return type == "capsule" ? Shape(Capsule{radius, length}) : Shape(Cylinder{radius, length});
    }
    if (type == "box") return readBox(node);
    if (type == "plane") return readPlane(node);
    if (type == "hull") return readHull(node);
    if (type == "mesh") return readMeshShape(node);
    if (type == "solid") return readSolid(node);
    if (type == "height_field") return readHeightFieldShape(node);
    if (type != "compound") type_node.refuse(shape_types);
    return readCompound(node, reading);
}

Mat3 readInertia(const JsonNode& node, std::string_view unit) {
    if (!node.value().is_array() || (node.size() != 3 && node.size() != 6)) {
        node.refuse(fmt::format("three moments xx, yy, zz, or these and the products xy, xz, yz [{}]", unit));
    }
    const auto at = [&](std::size_t i) { return node.element(i).number(); };
    Mat3 inertia = Vec3(at(0), at(1), at(2)).asDiagonal();
    if (node.size() == 6) {
        inertia(0, 1) = inertia(1, 0) = at(3);
        inertia(0, 2) = inertia(2, 0) = at(4);
        inertia(1, 2) = inertia(2, 1) = at(5);
    }
    return inertia;
}

Quat readOrientation(const JsonNode& node) {
    if (!node.value().is_array() || node.size() != 4) node.refuse("four numbers w, x, y, z");
    const Quat q(node.element(0).number(), node.element(1).number(), node.element(2).number(),
                 node.element(3).number());
    const double length = q.norm();
    if (!(length >= smallest_quaternion && length <= largest_quaternion)) {
        node.refuse("a quaternion w, x, y, z of length 1e-6 to 1e6, so that it can be normalised");
    }
    return q;
}

}  // namespace cairn
