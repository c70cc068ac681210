#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "cairn/scene.h"
#include "scene/joint_axis_names.h"
#include "scene/json_node.h"
#include "scene/scene_writing.h"

namespace cairn {
namespace {

using written::arrayText;
using written::inertiaText;
using written::isOmitted;
using written::number;
using written::orientationText;
using written::same;
using written::vector;

std::string text(const std::string& value) {
    try {
        return Json(value).dump();
    } catch (const Json::exception&) {
        throw InputError(
            fmt::format("a scene with the name {} cannot be written; names must be UTF-8", shown(Json(value))));
    }
}

std::string namesText(const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : ",") + text(name);
    return "[" + out + "]";
}

std::string lawText(const ConstantMotion& motion) {
    return fmt::format(R"("constant","velocity":{},"spin":{})", vector(motion.velocity), vector(motion.spin));
}
std::string lawText(const SineMotion& motion) {
    return fmt::format(R"("sine","amplitude":{},"turn":{},"frequency":{},"phase":{})", vector(motion.amplitude),
                       vector(motion.turn), number(motion.frequency), number(motion.phase));
}
std::string lawText(const TableMotion& motion) {
    std::string out = fmt::format(R"("table","times":{})", arrayText(motion.times, number));
    if (!motion.displacements.empty())
        out += fmt::format(R"(,"displacements":{})", arrayText(motion.displacements, vector));
    if (!motion.turns.empty()) out += fmt::format(R"(,"turns":{})", arrayText(motion.turns, vector));
    if (!motion.velocities.empty()) out += fmt::format(R"(,"velocities":{})", arrayText(motion.velocities, vector));
    if (motion.end == TableEnd::repeat) out += R"(,"end":"repeat")";
    return out;
}

std::string motionText(const Motion& motion, const Vec3& pivot) {
    std::string out = fmt::format(R"({{"type":{})", std::visit([](const auto& law) { return lawText(law); }, motion));
    if (!isOmitted(pivot)) out += fmt::format(R"(,"pivot":{})", vector(pivot));
    return out + "}";
}

/// Groups, a motion and what a body feels of its own.
std::string ownText(const SceneBody& body) {
    std::string out;
    if (!body.groups.empty()) out += fmt::format(R"(,"groups":{})", namesText(body.groups));
    if (body.sensor) out += R"(,"sensor":true)";
    if (!same(body.gravity_factor, 1)) out += fmt::format(R"(,"gravity_factor":{})", number(body.gravity_factor));
    if (!same(body.linear_damping, 0)) out += fmt::format(R"(,"linear_damping":{})", number(body.linear_damping));
    if (!same(body.angular_damping, 0)) out += fmt::format(R"(,"angular_damping":{})", number(body.angular_damping));
    if (body.motion) out += fmt::format(R"(,"motion":{})", motionText(*body.motion, body.pivot));
    if (!isOmitted(body.surface_velocity)) {
        out += fmt::format(R"(,"surface_velocity":{})", vector(body.surface_velocity));
    }
    if (!body.locked.empty()) {
        std::vector<std::string> names;
        for (const JointAlong along : body.locked) {
            names.emplace_back(jointAxisNames()[static_cast<std::size_t>(along)]);
        }
        out += fmt::format(R"(,"locked":{})", namesText(names));
    }
    if (body.user_data != 0) out += fmt::format(R"(,"user_data":{})", body.user_data);
    return out;
}

std::string filtersText(const SceneFilters& filters) {
    std::string out = fmt::format(R"({{"groups":{})", namesText(filters.groups));
    std::string apart;
    for (const auto& [a, b] : filters.apart) apart += (apart.empty() ? "" : ",") + namesText({a, b});
    if (!apart.empty()) out += fmt::format(R"(,"apart":[{}])", apart);
    std::string exceptions;
    for (const SceneException& e : filters.exceptions) {
        exceptions += fmt::format(R"({}{{"a":{},"b":{},"touch":{}}})", exceptions.empty() ? "" : ",", e.a, e.b,
                                  e.touch == Touch::always);
    }
    if (!exceptions.empty()) out += fmt::format(R"(,"exceptions":[{}])", exceptions);
    return out + "}";
}

std::string bodyText(const SceneBody& body, const WrittenShapes& shapes) {
    std::string out = fmt::format(R"({{"shape":{},"material":{})", shapes.textOf(body.shape), text(body.material));
    const auto addVector = [&out](std::string_view key, const Vec3& value) {
        if (!isOmitted(value)) out += fmt::format(R"(,"{}":{})", key, vector(value));
    };
    if (!body.name.empty()) out += fmt::format(R"(,"name":{})", text(body.name));
    if (body.mass) out += fmt::format(R"(,"mass":{})", number(*body.mass));
    if (body.centre_of_mass) out += fmt::format(R"(,"centre_of_mass":{})", vector(*body.centre_of_mass));
    if (body.inertia) out += fmt::format(R"(,"inertia":{})", inertiaText(*body.inertia));
    addVector("position", body.position);
    out += orientationText(body.orientation);
    addVector("linear_velocity", body.linear_velocity);
    addVector("angular_velocity", body.angular_velocity);
    if (body.fixed) out += R"(,"fixed":true)";
    if (body.asleep) out += R"(,"asleep":true)";
    return out + ownText(body) + "}";
}

// Bodies of events are written by index: every body has one, few have a name.
std::string actionText(const SetGravity& a) {
    return fmt::format(R"("gravity":{})", vector(a.gravity));
}
std::string actionText(const SetVelocity& a) {
    return fmt::format(R"("body":{},"set_velocity":{})", a.body, vector(a.velocity));
}
std::string actionText(const GiveImpulse& a) {
    return fmt::format(R"("body":{},"impulse":{})", a.body, vector(a.impulse));
}
std::string actionText(const SetForce& a) {
    return fmt::format(R"("body":{},"force":{})", a.body, vector(a.force));
}
std::string actionText(const SetTorque& a) {
    return fmt::format(R"("body":{},"torque":{})", a.body, vector(a.torque));
}
std::string actionText(const RemoveBody& a) {
    return fmt::format(R"("body":{},"remove":true)", a.body);
}

std::string eventText(const SceneEvent& event) {
    const std::string action = std::visit([](const auto& a) { return actionText(a); }, event.action);
    return fmt::format(R"({{"time":{},{}}})", number(event.time), action);
}

/// The members that differ from what a reader would assume.
std::string pairText(const PairProperties& pair, const PairProperties& inherited) {
    std::string out;
    const auto add = [&out](std::string_view key, double value, double assumed) {
        if (!same(value, assumed)) out += fmt::format(R"({}"{}":{})", out.empty() ? "" : ",", key, number(value));
    };
    add("restitution", pair.restitution, inherited.restitution);
    add("static_friction", pair.static_friction, inherited.static_friction);
    add("kinetic_friction", pair.kinetic_friction, inherited.kinetic_friction);
    add("rolling_friction", pair.rolling_friction, inherited.rolling_friction);
    add("spinning_friction", pair.spinning_friction, inherited.spinning_friction);
    return "{" + out + "}";
}

std::string contactsText(const Scene& scene) {
    const PairProperties& d = scene.default_pair;
    std::string out = fmt::format(R"({{"default":{{"restitution":{},"static_friction":{},"kinetic_friction":{})",
                                  number(d.restitution), number(d.static_friction), number(d.kinetic_friction));
    if (!same(d.rolling_friction, 0)) out += fmt::format(R"(,"rolling_friction":{})", number(d.rolling_friction));
    if (!same(d.spinning_friction, 0)) out += fmt::format(R"(,"spinning_friction":{})", number(d.spinning_friction));
    out += "}";
    for (const auto& [names, pair] : scene.pairs) {
        std::string properties = pairText(pair, d);
        const auto law = std::ranges::find(scene.pair_laws, names, [](const auto& entry) { return entry.first; });
        if (law != scene.pair_laws.end()) {
            properties.back() = properties.size() > 2 ? ',' : ' ';
            properties += fmt::format(R"("law":{}}})", pairLawText(law->second));
        }
        out += fmt::format(",\n{}:{}", text(names.first + "/" + names.second), properties);
    }
    return out + "}";
}

std::string springText(const SceneSpring& spring) {
    std::string out = fmt::format(R"({{"a":{})", spring.a);
    if (spring.b) out += fmt::format(R"(,"b":{})", *spring.b);
    if (!isOmitted(spring.anchor_a)) out += fmt::format(R"(,"anchor_a":{})", vector(spring.anchor_a));
    if (!isOmitted(spring.anchor_b)) out += fmt::format(R"(,"anchor_b":{})", vector(spring.anchor_b));
    out += fmt::format(R"(,"stiffness":{})", number(spring.stiffness));
    if (!same(spring.damping, 0)) out += fmt::format(R"(,"damping":{})", number(spring.damping));
    if (!same(spring.rest_length, 0)) out += fmt::format(R"(,"rest_length":{})", number(spring.rest_length));
    return out + "}";
}

std::string valueText(bool value) {
    return value ? "true" : "false";
}
std::string valueText(std::int64_t value) {
    return fmt::format("{}", value);
}
std::string valueText(const std::string& value) {
    return text(value);
}
std::string valueText(double value) {
    std::string out = number(value);
    // Keeps a whole number of type double apart from an integer when it is read back.
    if (out.find_first_of(".e") == std::string::npos) out += ".0";
    return out;
}

std::string settingsText(const Scene& scene) {
    std::string out;
    if (scene.preset) out += fmt::format(R"("preset":"{}")", nameOf(*scene.preset));
    for (const auto& [name, value] : scene.settings) {
        if (!out.empty()) out += ",";
        out += text(name) + ":" + std::visit([](const auto& v) { return valueText(v); }, value);
    }
    return "{" + out + "}";
}

std::string materialsText(const Scene& scene) {
    std::string out;
    for (const Material& material : scene.materials) {
        if (!out.empty()) out += ",";
        out += fmt::format(R"({}:{{"density":{}}})", text(material.name), number(material.density));
    }
    return "{" + out + "}";
}

/// An array with one entry per line.
template <typename T, typename Format>
std::string lines(const std::vector<T>& entries, Format format) {
    if (entries.empty()) return "[]";
    std::string out = "[";
    for (std::size_t i = 0; i < entries.size(); ++i) {
        out += i == 0 ? "\n" : ",\n";
        out += format(entries[i]);
    }
    return out + "\n]";
}

std::string eventsText(const Scene& scene) {
    std::string out;
    for (const SceneEvent& event : scene.events) {
        if (!out.empty()) out += ",\n";
        out += eventText(event);
    }
    return "[" + out + "]";
}

/// Pieces of a text that are handed over are about so long [bytes].
constexpr std::size_t piece_size = std::size_t{1} << 16U;

/// @param scene all but the bodies @param append takes the text, piece by piece
void writeParts(const Scene& scene, const SceneSource::Tell& bodies,
                const std::function<void(std::string_view)>& append) {
    std::string out = fmt::format("{{\"name\":{},\"duration\":{},\"gravity\":{},\n", text(scene.name),
                                  number(scene.duration), gravityText(scene));
    if (!scene.events.empty()) out += fmt::format("\"events\":{},\n", eventsText(scene));
    out += fmt::format("\"materials\":{},\n\"contacts\":{},\n", materialsText(scene), contactsText(scene));
    if (!scene.filters.isEmpty()) out += fmt::format("\"filters\":{},\n", filtersText(scene.filters));
    if (scene.frame_motion) {
        out += fmt::format("\"frame_motion\":{},\n", motionText(*scene.frame_motion, Vec3::Zero()));
    }
    const WrittenShapes shapes(bodies);
    if (const std::string shared = shapes.shared(); !shared.empty()) out += fmt::format("\"shapes\":{},\n", shared);
    out += "\"bodies\":[";
    bool any = false;
    bodies([&](const SceneBody& body) {
        out += any ? ",\n" : "\n";
        out += bodyText(body, shapes);
        any = true;
        if (out.size() < piece_size) return;
        append(out);
        out.clear();
    });
    out += any ? "\n]" : "]";
    if (!scene.springs.empty()) out += fmt::format(",\n\"springs\":{}", lines(scene.springs, springText));
    if (!scene.joints.empty()) out += fmt::format(",\n\"joints\":{}", lines(scene.joints, jointText));
    if (!scene.drives.empty()) out += fmt::format(",\n\"drives\":{}", lines(scene.drives, driveText));
    if (scene.preset || !scene.settings.empty()) out += fmt::format(",\n\"settings\":{}", settingsText(scene));
    append(out + "}\n");
}

}  // namespace

void writeText(const SceneSource& source, const std::function<void(std::string_view)>& append) {
    writeParts(
        source.scene(), [&source](const SceneSource::Take& take) { source.forEachBody(take); }, append);
}

std::string formatScene(const Scene& scene) {
    std::string text;
    writeParts(
        scene, [&scene](const SceneSource::Take& take) { std::ranges::for_each(scene.bodies, take); },
        [&text](std::string_view piece) { text += piece; });
    return text;
}

std::string formatScene(const SceneSource& source) {
    std::string text;
    writeText(source, [&text](std::string_view piece) { text += piece; });
    return text;
}

void writeScene(const Scene& scene, const std::filesystem::path& file) {
    const std::string content = formatScene(scene);
    std::ofstream stream(file, std::ios::binary | std::ios::trunc);
    stream << content;
    stream.close();
    if (!stream) {
        throw IoError(
            fmt::format("{}: cannot be written; check that its folder exists, that it may be written and "
                        "that the disk is not full",
                        file.string()));
    }
}

}  // namespace cairn
