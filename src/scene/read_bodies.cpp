#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "geometry/body_mass.h"
#include "geometry/geometry.h"
#include "scene/scene_reading.h"
#include "world/limits.h"

namespace cairn {
namespace {

/// @param inherited values of the members that are not given
PairProperties readPair(const JsonNode& node, const PairProperties& inherited) {
    node.expectKeys(
        {"restitution", "static_friction", "kinetic_friction", "rolling_friction", "spinning_friction", "law"});
    PairProperties pair = inherited;
    if (const auto value = node.find("restitution")) {
        pair.restitution = value->nonNegative();
        if (pair.restitution > 1) value->refuse("a number within 0 and 1");
    }
    if (const auto value = node.find("static_friction")) pair.static_friction = value->nonNegative();
    if (const auto value = node.find("kinetic_friction")) pair.kinetic_friction = value->nonNegative();
    if (const auto value = node.find("rolling_friction")) pair.rolling_friction = value->nonNegative();
    if (const auto value = node.find("spinning_friction")) pair.spinning_friction = value->nonNegative();
    if (pair.kinetic_friction > pair.static_friction) {
        node.fail(
            fmt::format("has kinetic_friction {} above static_friction {}{}; kinetic friction must be 0 to "
                        "static friction",
                        pair.kinetic_friction, pair.static_friction,
                        node.find("kinetic_friction") && node.find("static_friction")
                            ? ""
                            : " (a value that is not given is the default pair's)"));
    }
    return pair;
}

/// A body must have a mass and an inertia that a double can hold.
void checkMass(const JsonNode& node, const SceneBody& body, double density) {
    BodyMass found{};
    try {
        found = bodyMass(body.shape, density, {body.mass, body.centre_of_mass, body.inertia});
    } catch (const InputError& error) {
        node.fail(fmt::format("is refused: {}", error.what()));
    }
    const auto usable = [](double x) { return std::isnormal(x) && std::isnormal(1 / x); };
    if (!usable(found.mass) || !usable(found.inertia.minCoeff()) || !usable(found.inertia.maxCoeff())) {
        node.fail(
            fmt::format("has a mass of {} kg and an inertia of {} to {} kg·m²; shape, density and mass must give "
                        "numbers that are neither 0 nor infinite",
                        found.mass, found.inertia.minCoeff(), found.inertia.maxCoeff()));
    }
}

/// Members that only a fixed body has, or none.
void checkMotion(const JsonNode& node, const SceneBody& body) {
    const auto member = [&](std::string_view key) { return node.find(key).value_or(node); };
    if (body.fixed && !body.locked.empty()) {
        member("locked").fail("is that of a fixed body, which moves along no axis; leave it out");
    }
    if (!body.fixed && !body.surface_velocity.isZero(0)) {
        member("surface_velocity").fail("is that of a body that forces move; only the surface of a fixed body runs");
    }
    if (!body.fixed && body.motion) {
        member("motion").fail("is that of a body that forces move; a body with a motion needs \"fixed\": true");
    }
}

/// Members that contradict each other.
void checkBody(const JsonNode& node, const SceneBody& body, const SceneReading& reading) {
    checkMotion(node, body);
    const bool moves = !body.linear_velocity.isZero(0) || !body.angular_velocity.isZero(0);
    if (!isSolid(body.shape)) {
        const std::string_view name = shapeName(body.shape);
        if (!body.fixed) node.fail(fmt::format("is a {0} that is not fixed; a {0} needs \"fixed\": true", name));
        if (body.mass) node.fail(fmt::format("is a {0} with a mass; a {0} is fixed and has none, remove mass", name));
        if (body.centre_of_mass || body.inertia) {
            node.fail(fmt::format("is a {0} with a centre of mass or an inertia; a {0} has none, remove them", name));
        }
    }
    if (body.fixed && moves) node.fail("is fixed and has a velocity; a fixed body never moves, remove one of them");
    if (body.fixed && body.asleep) node.fail("is fixed and asleep; only a body that can move sleeps, remove asleep");
    if (body.asleep && moves) {
        node.fail("is asleep and has a velocity; a sleeping body is at rest, remove asleep or the velocities");
    }
    if (isSolid(body.shape)) checkMass(node, body, reading.density.at(body.material));
}

/// Groups and what the body feels of its own.
std::vector<JointAlong> readLocked(const JsonNode& node) {
    node.expectArray("an array of axes of the world that do not move");
    std::vector<JointAlong> axes;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const JointAlong along = readJointAlong(node.element(i));
        if (std::ranges::find(axes, along) != axes.end()) node.element(i).fail("is given twice; give it once");
        axes.push_back(along);
    }
    return axes;
}

void readOwnProperties(const JsonNode& node, const SceneReading& reading, SceneBody& body) {
    if (const auto groups = node.find("groups")) {
        groups->expectArray("an array of names of groups");
        body.groups.clear();
        for (std::size_t i = 0; i < groups->size(); ++i) {
            const std::string name = readGroup(groups->element(i), reading);
            if (std::ranges::find(body.groups, name) != body.groups.end()) {
                groups->element(i).fail(fmt::format("is the group '{}' a second time; name it once", name));
            }
            body.groups.push_back(name);
        }
    }
    const auto checked = [](const JsonNode& value, auto require) {
        const double number = value.number();
        try {
            require(number);
        } catch (const InputError& error) {
            value.fail(fmt::format("is not allowed: {}", error.what()));
        }
        return number;
    };
    if (const auto value = node.find("sensor")) body.sensor = value->flag();
    if (const auto value = node.find("locked")) body.locked = readLocked(*value);
    if (const auto value = node.find("gravity_factor")) {
        body.gravity_factor = checked(*value, [](double x) { requireGravityFactor(x); });
    }
    if (const auto value = node.find("linear_damping")) {
        body.linear_damping = checked(*value, [](double x) { requireDamping(x, "linear"); });
    }
    if (const auto value = node.find("angular_damping")) {
        body.angular_damping = checked(*value, [](double x) { requireDamping(x, "angular"); });
    }
    if (const auto value = node.find("user_data")) {
        if (!value->value().is_number_unsigned()) value->refuse("a whole number from 0 to 18446744073709551615");
        body.user_data = value->value().get<std::uint64_t>();
    }
}

constexpr std::array<std::string_view, 21> body_keys = {
    "shape",           "material",         "template",       "mass",
    "centre_of_mass",  "inertia",          "position",       "orientation",
    "linear_velocity", "angular_velocity", "fixed",          "asleep",
    "groups",          "sensor",           "gravity_factor", "linear_damping",
    "angular_damping", "user_data",        "motion",         "surface_velocity",
    "locked"};

void readMotionOf(const JsonNode& node, SceneBody& body) {
    if (const auto value = node.find("surface_velocity")) {
        body.surface_velocity = value->vector();
    }
    if (const auto value = node.find("motion")) {
        body.motion = readMotion(*value);
        const auto pivot = value->find("pivot");
        body.pivot = pivot ? pivot->vector() : Vec3::Zero();
    }
}

/// What the body begins with.
BodyTemplate templateOf(const JsonNode& node, const SceneReading& reading) {
    const auto given = node.find("template");
    if (!given) return {};
    const auto found = reading.templates.find(given->text());
    if (found != reading.templates.end()) return found->second;
    if (reading.groups.contains(given->text())) {
        given->fail("is a template of a group; 'includes' places it, a body needs that of a body");
    }
    given->fail(fmt::format("is the unknown template {}; {}", shown(given->value()),
                            knownNames(reading.templates, "templates")));
}

/// What a body has, from its template on.
BodyTemplate readMembers(const JsonNode& node, const SceneReading& reading) {
    BodyTemplate read = templateOf(node, reading);
    SceneBody& body = read.body;
    if (const auto value = node.find("shape")) {
        body.shape = readShape(*value, reading);
        read.has_shape = true;
    }
    if (const auto value = node.find("material")) {
        body.material = value->text();
        if (!reading.density.contains(body.material)) {
            value->fail(fmt::format("is the unknown material '{}'; {}", body.material,
                                    knownNames(reading.density, "materials")));
        }
    }
    if (const auto value = node.find("mass")) body.mass = value->positive();
    if (const auto value = node.find("centre_of_mass")) body.centre_of_mass = value->vector();
    if (const auto value = node.find("inertia")) body.inertia = readInertia(*value, "kg·m²");
    if (const auto value = node.find("position")) body.position = value->vector();
    if (const auto value = node.find("orientation")) body.orientation = readOrientation(*value);
    if (const auto value = node.find("linear_velocity")) body.linear_velocity = value->vector();
    if (const auto value = node.find("angular_velocity")) body.angular_velocity = value->vector();
    if (const auto value = node.find("fixed")) body.fixed = value->flag();
    if (const auto value = node.find("asleep")) body.asleep = value->flag();
    readOwnProperties(node, reading, body);
    readMotionOf(node, body);
    return read;
}

}  // namespace

void readTemplateOfBody(const JsonNode& node, std::string_view name, SceneReading& reading) {
    node.expectKeys(body_keys);
    reading.templates.emplace(name, readMembers(node, reading));
}

void readBodyInto(const JsonNode& node, SceneReading& reading) {
    std::array<std::string_view, body_keys.size() + 1> keys{"name"};
    std::ranges::copy(body_keys, keys.begin() + 1);
    node.expectKeys(keys);
    BodyTemplate read = readMembers(node, reading);
    SceneBody& body = read.body;
    if (!read.has_shape) node.required("shape", "an object, or the name of a shape");
    if (body.material.empty()) node.required("material", "the name of a material");
    checkBody(node, body, reading);
    if (const auto name = node.find("name")) {
        body.name = name->text();
        const auto [other, added] = reading.by_name.emplace(body.name, reading.told + reading.scene.bodies.size());
        if (!added) {
            name->fail(fmt::format("is '{}' as that of bodies[{}]; a name must be unique", body.name, other->second));
        }
    }
    reading.scene.bodies.push_back(std::move(body));
}

void readBodies(const JsonNode& node, SceneReading& reading) {
    node.expectArray("an array of bodies; it may be empty");
    for (std::size_t i = 0; i < node.size(); ++i) readBodyInto(node.element(i), reading);
}

void readMaterials(const JsonNode& node, SceneReading& reading) {
    if (!node.value().is_object()) node.refuse("an object with one entry per material");
    for (const auto& [name, value] : node.value().get_ref<const Json::object_t&>()) {
        const JsonNode entry = node.member(name, value);
        if (name.empty()) entry.fail("is a material without a name; a name has at least one character");
        if (name.find('/') != std::string::npos) {
            entry.fail("has a '/' in its name; it separates the two materials of a pair, use another character");
        }
        entry.expectKeys({"density"});
        const double density = entry.required("density", "a number above 0 [kg/m³]").positive();
        reading.scene.materials.push_back({name, density});
        reading.density.emplace(name, density);
    }
}

void readContacts(const JsonNode& node, SceneReading& reading) {
    if (!node.value().is_object()) node.refuse("an object with the keys default and pairs such as oak/iron");
    Scene& scene = reading.scene;
    if (const auto value = node.find("default")) {
        scene.default_pair = readPair(*value, PairProperties{});
        if (const auto law = value->find("law")) law->fail("is of no pair; give laws to pairs such as oak/iron");
    }
    std::set<std::pair<std::string, std::string>> seen;
    for (const auto& [key, value] : node.value().get_ref<const Json::object_t&>()) {
        if (key == "default") continue;
        const JsonNode entry = node.member(key, value);
        const std::size_t slash = key.find('/');
        if (slash == std::string::npos) {
            entry.fail("is no pair; allowed are default and two materials such as oak/iron");
        }
        std::pair<std::string, std::string> names{key.substr(0, slash), key.substr(slash + 1)};
        for (const std::string& name : {names.first, names.second}) {
            if (!reading.density.contains(name)) {
                entry.fail(
                    fmt::format("names the unknown material '{}'; {}", name, knownNames(reading.density, "materials")));
            }
        }
        if (!seen.insert(std::minmax(names.first, names.second)).second) {
            entry.fail("gives a pair that was given before; both orders of the names mean the same pair");
        }
        if (const auto law = entry.find("law")) scene.pair_laws.emplace_back(names, readPairLaw(*law));
        scene.pairs.emplace_back(std::move(names), readPair(entry, scene.default_pair));
    }
}

}  // namespace cairn
