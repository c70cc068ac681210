#include "describe.h"

#include <fmt/format.h>

#include <cmath>

#include "cairn/statistics.h"

namespace cairn::view {

using nlohmann::json;

namespace {

template <typename... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// JSON has no infinity.
json finiteOrNull(double value) {
    return std::isfinite(value) ? json(value) : json(nullptr);
}

std::string_view kindOf(const SettingValue& value) {
    constexpr std::string_view names[] = {"switch", "whole", "number", "choice"};
    return names[value.index()];
}

}  // namespace

json toJson(const Vec3& v) {
    return json::array({v.x(), v.y(), v.z()});
}

json toJson(const Quat& q) {
    return json::array({q.w(), q.x(), q.y(), q.z()});
}

namespace {

json surfaceJson(std::span<const Vec3> vertices, std::span<const TriangleCorners> triangles) {
    json points = json::array();
    for (const Vec3& vertex : vertices) points.push_back(toJson(vertex));
    return {{"type", "mesh"}, {"vertices", points}, {"indices", json(triangles)}};
}

}  // namespace

json toJson(const Shape& shape) {
    return std::visit(
        Overloaded{
            [](const Sphere& s) -> json {
                return {{"type", "sphere"}, {"radius", s.radius}};
            },
            [](const Box& b) -> json {
                return {{"type", "box"}, {"size", toJson(b.size)}};
            },
            [](const Capsule& c) -> json {
                return {{"type", "capsule"}, {"radius", c.radius}, {"length", c.length}};
            },
            [](const Cylinder& c) -> json {
                return {{"type", "cylinder"}, {"radius", c.radius}, {"length", c.length}};
            },
            [](const ConvexHull& h) -> json {
                json points = json::array();
                for (const Vec3& corner : h.corners()) points.push_back(toJson(corner));
                return {{"type", "hull"}, {"points", points}};
            },
            [](const Compound& c) -> json {
                json parts = json::array();
                for (const CompoundPart& part : c.parts) {
                    parts.push_back({{"shape", toJson(part.shape)},
                                     {"position", toJson(part.pose.position)},
                                     {"orientation", toJson(part.pose.orientation)}});
                }
                return {{"type", "compound"}, {"parts", parts}};
            },
            [](const Mesh& m) -> json { return surfaceJson(m.vertices(), m.triangles()); },
            [](const HeightField& f) -> json { return surfaceJson(f.vertices(), f.triangles()); },
            [](const HalfSpace& h) -> json {
                // The page expects a unit normal with the offset along it.
                return {{"type", "plane"}, {"normal", toJson(Vec3(h.normal.normalized()))}, {"offset", h.offset}};
            }},
        shape);
}

json toJson(const SettingValue& value) {
    return std::visit([](const auto& v) { return json(v); }, value);
}

json toJson(std::span<const Material> materials) {
    json all = json::array();
    for (const Material& material : materials) all.push_back({{"name", material.name}, {"density", material.density}});
    return all;
}

std::string describeShape(const Shape& shape) {
    return std::visit(
        Overloaded{
            [](const Sphere& s) { return fmt::format("ball, diameter {:.4g} cm", 200 * s.radius); },
            [](const Box& b) {
                return fmt::format("box {:.4g} × {:.4g} × {:.4g} cm", 100 * b.size.x(), 100 * b.size.y(),
                                   100 * b.size.z());
            },
            [](const Capsule& c) {
                return fmt::format("capsule, diameter {:.4g} cm, length {:.4g} cm", 200 * c.radius,
                                   100 * (c.length + 2 * c.radius));
            },
            [](const Cylinder& c) {
                return fmt::format("cylinder, diameter {:.4g} cm, length {:.4g} cm", 200 * c.radius, 100 * c.length);
            },
            [](const ConvexHull& h) { return fmt::format("hull of {} corners", h.corners().size()); },
            [](const Compound& c) { return fmt::format("compound of {} parts", c.parts.size()); },
            [](const Mesh& m) { return fmt::format("mesh of {} triangles", m.triangles().size()); },
            [](const HeightField& f) { return fmt::format("height field of {} × {} heights", f.columns(), f.rows()); },
            [](const HalfSpace&) { return std::string("half-space"); }},
        shape);
}

namespace {

/// The longest of some vectors from the first on, or zero.
Vec3 farthest(const std::vector<Vec3>& vectors) {
    Vec3 longest = Vec3::Zero();
    for (const Vec3& v : vectors) {
        const Vec3 way = v - vectors.front();
        if (way.norm() > longest.norm()) longest = way;
    }
    return longest;
}

json motionOf(const Motion& motion) {
    return std::visit(
        Overloaded{[](const ConstantMotion& m) -> json {
                       return {{"velocity", toJson(m.velocity)}, {"spin", toJson(m.spin)}};
                   },
                   [](const SineMotion& m) -> json {
                       return {{"swing", toJson(m.amplitude)}, {"turn", toJson(m.turn)}};
                   },
                   [](const TableMotion& m) -> json {
                       return {{"swing", toJson(farthest(m.displacements))}, {"turn", toJson(farthest(m.turns))}};
                   }},
        motion);
}

/// How a fixed body moves and its surface runs; empty for all others.
json lawOf(const World& world, BodyId id) {
    const std::optional<Motion> motion = world.motion(id);
    json law = motion ? motionOf(*motion) : json::object();
    const Vec3 surface = world.surfaceVelocity(id);
    if (!surface.isZero(0)) law["surface"] = toJson(surface);
    return law;
}

}  // namespace

json describeBody(const World& world, BodyId id) {
    json body = {{"slot", id.index},
                 {"generation", id.generation},
                 {"name", world.name(id)},
                 {"shape", toJson(world.shape(id))},
                 {"material", static_cast<std::uint32_t>(world.material(id))},
                 {"mass", finiteOrNull(world.mass(id))}};
    if (world.isSensor(id)) body["sensor"] = true;
    if (json law = lawOf(world, id); !law.empty()) body["law"] = std::move(law);
    return body;
}

json describeSettings(const Settings& settings) {
    json all = json::object();
    for (const SettingField& field : settingFields()) all[std::string(field.name)] = toJson(field.get(settings));
    return all;
}

json describeFields() {
    json all = json::array();
    const Settings defaults;
    for (const SettingField& field : settingFields()) {
        const SettingValue value = field.get(defaults);
        json choices = json::array();
        for (const std::string_view choice : field.choices) choices.push_back(choice);
        all.push_back({{"name", field.name},
                       {"stage", field.stage},
                       {"unit", field.unit},
                       {"meaning", field.meaning},
                       {"kind", kindOf(value)},
                       {"minimum", finiteOrNull(field.minimum)},
                       {"maximum", finiteOrNull(field.maximum)},
                       {"choices", choices}});
    }
    return all;
}

json describeScenes() {
    json all = json::array();
    for (const BuiltInScene& scene : builtInScenes()) {
        all.push_back({{"name", scene.name}, {"description", scene.description}, {"example", scene.example}});
    }
    return all;
}

json describeStages() {
    json all = json::array();
    for (const std::string_view name : stage_names) all.push_back(name);
    return all;
}

std::string bodyTitle(const World& world, BodyId id) {
    const std::string& name = world.name(id);
    return name.empty() ? fmt::format("body {}", id.index) : name;
}

}  // namespace cairn::view
