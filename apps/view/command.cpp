#include "command.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>

namespace cairn::view {

using nlohmann::json;

namespace {

constexpr double smallest_size = 1e-4;  // [m]
constexpr double largest_size = 1e3;    // [m]
constexpr std::size_t longest_name = 200;

/// Reads the members of a command.
class Members {
  public:
    Members(const json& object, std::string_view what, std::initializer_list<std::string_view> known)
        : object_(object), what_(what) {
        for (const auto& [key, value] : object.items()) {
            bool expected = key == "do" || key == "id" || key == "type";
            for (const std::string_view name : known) expected = expected || name == key;
            if (!expected) throw InputError(fmt::format("{}: unknown member '{}'", what_, shortened(key)));
        }
    }

    double number(const char* key, double minimum, double maximum) const {
        const json& value = member(key);
        if (!value.is_number()) fail(key, "must be a number");
        const double number = value.get<double>();
        if (!(number >= minimum && number <= maximum)) {
            fail(key, fmt::format("is {}; allowed is {} to {}", number, minimum, maximum));
        }
        return number;
    }

    std::int64_t whole(const json& value, const char* key, std::int64_t minimum, std::int64_t maximum) const {
        if (!value.is_number_integer()) fail(key, "must be a whole number");
        // Unsigned numbers above the signed range would wrap around.
        const double size = value.get<double>();
        if (!(size >= static_cast<double>(minimum) && size <= static_cast<double>(maximum))) {
            fail(key, fmt::format("is {}; allowed is {} to {}", size, minimum, maximum));
        }
        return value.get<std::int64_t>();
    }
    std::int64_t whole(const char* key, std::int64_t minimum, std::int64_t maximum) const {
        return whole(member(key), key, minimum, maximum);
    }

    std::string text(const char* key, std::size_t longest) const {
        const json& value = member(key);
        if (!value.is_string()) fail(key, "must be a text");
        const auto& text = value.get_ref<const std::string&>();
        if (text.size() > longest) fail(key, fmt::format("has {} bytes; at most {} are allowed", text.size(), longest));
        return text;
    }

    bool flag(const char* key) const {
        const json& value = member(key);
        if (!value.is_boolean()) fail(key, "must be true or false");
        return value.get<bool>();
    }

    Vec3 vector(const char* key, double smallest, double largest) const {
        return vector(member(key), key, smallest, largest);
    }
    /// @param value of the member or one of its entries
    Vec3 vector(const json& value, const char* key, double smallest, double largest) const {
        if (!value.is_array() || value.size() != 3) fail(key, "must be an array of three numbers");
        Vec3 v;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!value[k].is_number()) fail(key, "must be an array of three numbers");
            v[static_cast<int>(k)] = value[k].get<double>();
            if (!(v[static_cast<int>(k)] >= smallest && v[static_cast<int>(k)] <= largest)) {
                fail(key,
                     fmt::format("has the entry {}; allowed is {} to {}", v[static_cast<int>(k)], smallest, largest));
            }
        }
        return v;
    }
    Vec3 point(const char* key) const { return vector(key, -farthest, farthest); }

    BodyId body(const char* key) const {
        const json& value = member(key);
        if (!value.is_array() || value.size() != 2) fail(key, "must be an array of slot and generation");
        return {static_cast<std::uint32_t>(whole(value[0], key, 0, UINT32_MAX)),
                static_cast<std::uint32_t>(whole(value[1], key, 0, UINT32_MAX))};
    }

    const json& member(const char* key) const {
        const auto found = object_.find(key);
        if (found == object_.end()) fail(key, "is missing");
        return *found;
    }

    [[noreturn]] void fail(const char* key, std::string_view problem) const {
        throw InputError(fmt::format("{}: '{}' {}", what_, key, problem));
    }

  private:
    static std::string shortened(const std::string& text) {
        return text.size() <= 60 ? text : text.substr(0, 60) + "…";
    }

    const json& object_;
    std::string what_;
};

Shape parseShape(const json& value) {
    if (!value.is_object()) throw InputError("add: 'shape' must be an object");
    const std::string type = Members(value, "shape", {"type", "radius", "size", "length"}).text("type", longest_name);
    if (type == "sphere") {
        return Sphere{Members(value, "sphere", {"radius"}).number("radius", smallest_size, largest_size)};
    }
    if (type == "box") return Box{Members(value, "box", {"size"}).vector("size", smallest_size, largest_size)};
    if (type == "capsule") {
        const Members members(value, "capsule", {"radius", "length"});
        return Capsule{members.number("radius", smallest_size, largest_size),
                       members.number("length", smallest_size, largest_size)};
    }
    if (type == "cylinder") {
        const Members members(value, "cylinder", {"radius", "length"});
        return Cylinder{members.number("radius", smallest_size, largest_size),
                        members.number("length", smallest_size, largest_size)};
    }
    throw InputError(fmt::format("add: the shape '{}' is unknown; there are sphere, box, capsule and cylinder", type));
}

SettingValue parseValue(const Members& members) {
    const json& value = members.member("value");
    if (value.is_boolean()) return value.get<bool>();
    if (value.is_number_integer()) return members.whole("value", -(std::int64_t{1} << 53), std::int64_t{1} << 53);
    if (value.is_number()) return value.get<double>();
    if (value.is_string()) return members.text("value", longest_name);
    members.fail("value", "must be a number, a text, true or false");
}

Layers parseLayers(const Members& members) {
    const json& value = members.member("layers");
    if (!value.is_array() || value.size() > 32) members.fail("layers", "must be an array of at most 32 names");
    Layers layers = 0;
    for (const json& entry : value) {
        const auto layer = entry.is_string() ? layerFromName(entry.get_ref<const std::string&>()) : std::nullopt;
        if (!layer) members.fail("layers", fmt::format("has an unknown name; there are {}", layerNames()));
        layers |= bit(*layer);
    }
    return layers;
}

using Parse = Action (*)(const json&);

Action parseStep(const json& o) {
    return Step{static_cast<int>(Members(o, "step", {"count"}).whole("count", 1, most_steps))};
}
Action parseSpeed(const json& o) {
    return SetSpeed{Members(o, "speed", {"value"}).number("value", slowest_speed, fastest_speed)};
}
Action parseUpload(const json& o) {
    const Members members(o, "upload", {"name", "text"});
    return LoadText{members.text("name", longest_name), members.text("text", longest_upload)};
}
Action parseSet(const json& o) {
    const Members members(o, "set", {"field", "value"});
    return SetField{members.text("field", longest_name), parseValue(members)};
}
Action parseThrow(const json& o) {
    const Members members(o, "throw", {"origin", "velocity", "radius", "material"});
    return ThrowBall{members.point("origin"), members.point("velocity"),
                     members.number("radius", smallest_size, largest_size), members.text("material", longest_name)};
}
Action parseAdd(const json& o) {
    const Members members(o, "add", {"shape", "material", "position"});
    return AddBody{parseShape(members.member("shape")), members.text("material", longest_name),
                   members.point("position")};
}
Action parseFreeze(const json& o) {
    const Members members(o, "freeze", {"body", "fixed"});
    return FreezeBody{members.body("body"), members.flag("fixed")};
}
Action parseGrab(const json& o) {
    const Members members(o, "grab", {"body", "point"});
    return GrabBody{members.body("body"), members.point("point")};
}
Action parseSelect(const json& o) {
    const Members members(o, "select", {"body"});
    if (members.member("body").is_null()) return SelectBody{};
    return SelectBody{members.body("body")};
}

/// Rays from one point.
Action parseRays(const json& o) {
    const Members members(o, "rays", {"origin", "directions"});
    const Vec3 origin = members.point("origin");
    const json& directions = members.member("directions");
    if (!directions.is_array() || directions.size() > most_rays) {
        members.fail("directions", fmt::format("must be an array of at most {} directions", most_rays));
    }
    CastRays cast;
    for (const json& entry : directions) {
        const Vec3 direction = members.vector(entry, "directions", -1, 1);
        if (direction.norm() < 1e-3) members.fail("directions", "has a direction of no length");
        cast.rays.push_back({origin, direction});
    }
    return cast;
}

template <typename Plain>
Action parsePlain(const json& o) {
    [[maybe_unused]] const Members none(o, "command", {});
    return Plain{};
}

const std::map<std::string, Parse, std::less<>>& parsers() {
    static const std::map<std::string, Parse, std::less<>> table = {
        {"play", parsePlain<Play>},
        {"pause", parsePlain<Pause>},
        {"reset", parsePlain<Reset>},
        {"release", parsePlain<ReleaseBody>},
        {"step", parseStep},
        {"speed", parseSpeed},
        {"load",
         [](const json& o) -> Action {
             return LoadBuiltIn{Members(o, "load", {"scene"}).text("scene", longest_name)};
         }},
        {"upload", parseUpload},
        {"dial", [](const json& o) -> Action { return SetDial{Members(o, "dial", {"value"}).number("value", 0, 1)}; }},
        {"set", parseSet},
        {"throw", parseThrow},
        {"add", parseAdd},
        {"delete", [](const json& o) -> Action { return DeleteBody{Members(o, "delete", {"body"}).body("body")}; }},
        {"freeze", parseFreeze},
        {"grab", parseGrab},
        {"drag", [](const json& o) -> Action { return DragBody{Members(o, "drag", {"target"}).point("target")}; }},
        {"select", parseSelect},
        {"rays", parseRays},
        {"layers", [](const json& o) -> Action { return ChooseLayers{parseLayers(Members(o, "layers", {"layers"}))}; }},
    };
    return table;
}

json parseJson(std::string_view text) {
    json object;
    try {
        object = json::parse(text);
    } catch (const json::exception& error) {
        throw InputError(fmt::format("the command is not JSON: {}", error.what()));
    }
    if (!object.is_object()) throw InputError("a command must be a JSON object");
    return object;
}

std::optional<std::int64_t> idOf(const json& object) {
    const auto id = object.find("id");
    if (id == object.end() || !id->is_number_unsigned()) return std::nullopt;
    constexpr double largest_exact = 9e15;
    if (id->get<double>() > largest_exact) return std::nullopt;
    return id->get<std::int64_t>();
}

}  // namespace

Command parseCommand(std::string_view text) {
    const json object = parseJson(text);
    const auto name = object.find("do");
    if (name == object.end() || !name->is_string()) throw InputError("a command needs a text member 'do'");
    const auto& verb = name->get_ref<const std::string&>();
    const auto parser = parsers().find(verb);
    if (parser == parsers().end()) {
        std::string known;
        for (const auto& entry : parsers()) known += (known.empty() ? "" : ", ") + entry.first;
        throw InputError(fmt::format("the command '{}' is unknown; there are {}", verb.substr(0, 60), known));
    }
    if (text.size() > longest_command && verb != "upload") {
        throw InputError(fmt::format("the command has {} bytes; at most {} are allowed", text.size(), longest_command));
    }
    return {idOf(object), parser->second(object)};
}

std::optional<std::int64_t> commandId(std::string_view text) noexcept {
    if (text.size() > longest_command) return std::nullopt;
    const json object = json::parse(text, nullptr, false);
    return object.is_object() ? idOf(object) : std::nullopt;
}

}  // namespace cairn::view
