#include <fmt/core.h>

#include "geometry/geometry.h"
#include "scene/scene_reading.h"

namespace cairn {
namespace {

/// Range of a quaternion's length before it is normalised; outside it the direction drowns in rounding.
constexpr double smallest_quaternion = 1e-6;
constexpr double largest_quaternion = 1e6;

constexpr std::string_view shape_types = "sphere, box, capsule, cylinder, hull, compound or plane";

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

CompoundPart readPart(const JsonNode& node) {
    node.expectKeys({"shape", "position", "orientation", "mass", "density"});
    const JsonNode shape = node.required("shape", "an object");
    CompoundPart part{readShape(shape), {}, {}, {}};
    if (isInfinite(part.shape) || std::holds_alternative<Compound>(part.shape)) {
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

Shape readCompound(const JsonNode& node) {
    node.expectKeys({"type", "parts"});
    const JsonNode list = node.required("parts", "an array of at least one part");
    list.expectArray("an array of at least one part");
    if (list.size() == 0) list.fail("is empty; a compound without parts has no mass, it needs at least one");
    Compound compound;
    for (std::size_t i = 0; i < list.size(); ++i) compound.parts.push_back(readPart(list.element(i)));
    return compound;
}

}  // namespace

Shape readShape(const JsonNode& node) {
    if (!node.value().is_object()) node.refuse("an object with the key type and the dimensions");
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
    if (type != "compound") type_node.refuse(shape_types);
    return readCompound(node);
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
