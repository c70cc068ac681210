#include <fmt/format.h>

#include <array>
#include <charconv>

#include "scene/built_in_tools.h"

namespace cairn {
namespace {

/// A number in a built-in scene's name.
struct Parameter {
    std::string_view meaning;
    int minimum;
    int maximum;
    int fallback;           ///< value if it is not given; 0 = it must be given
    bool is_fewer = false;  ///< than the parameter before it
};

using Numbers = std::array<int, 3>;

/// A row of the table of built-in scenes.
struct Entry {
    BuiltInScene scene;
    std::size_t parameter_count;
    std::array<Parameter, 3> parameters;
    SceneSource (*make)(std::string name, const Numbers& numbers);

    std::string_view family() const { return scene.name.substr(0, scene.name.find(':')); }
};

constexpr auto known_scenes = std::to_array<Entry>({
    {{"stacks5", "five walls of 55 boxes, hit by an iron ball (thesis §5.1)", "stacks5"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource { return stacksScene(std::move(name), 5); }},
    {{"stacks8", "eight walls of 55 boxes, hit by an iron ball (thesis §5.1)", "stacks8"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource { return stacksScene(std::move(name), 8); }},
    {{"well324", "324 balls fall into a low well (thesis §5.1)", "well324"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource { return wellScene(std::move(name), 0.0665, 0.11, 6, 9); }},
    {{"well392", "392 balls fall into a low well (thesis §5.1)", "well392"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource { return wellScene(std::move(name), 0.057, 0.095, 7, 8); }},
    {{"cage384", "384 balls and boxes fly in a cage; gravity comes on after 1 s (thesis §5.1)", "cage384"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource {
         return cageScene(std::move(name), {3.45, 3.45, 2.65}, 0.16, 8, 6);
     }},
    {{"cage2816", "2816 balls and boxes fly in a cage; gravity comes on after 1 s (thesis §5.1)", "cage2816"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource {
         return cageScene(std::move(name), {3.31, 3.31, 2.31}, 0.1, 16, 11);
     }},
    {{"catapult7", "a falling box tosses seven boxes from a plank (thesis §5.6)", "catapult7"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource { return catapultScene(std::move(name)); }},
    {{"catapult15", "a falling box tosses fifteen small boxes from a plank (thesis §5.6)", "catapult15"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource { return catapultScene(std::move(name)); }},
    {{"cradle:N:K", "N elastic balls in free space, K of them flying against the row of the others (5 and 1)",
      "cradle:5:2"},
     2,
     {{{"N, the number of balls", 2, 1000, 5}, {"K, the number of moving balls", 1, 999, 1, true}}},
     [](std::string name, const Numbers& n) -> SceneSource { return cradleScene(std::move(name), n[0], n[1]); }},
    {{"cradle_swing:N:K", "N elastic balls on rods, K of them pulled aside (5 and 1)", "cradle_swing:5:2"},
     2,
     {{{"N, the number of balls", 2, 1000, 5}, {"K, the number of balls pulled aside", 1, 999, 1, true}}},
     [](std::string name, const Numbers& n) -> SceneSource {
         return swingingCradleScene(std::move(name), n[0], n[1]);
     }},
    {{"tower:N", "N boxes on top of each other", "tower:10"},
     1,
     {{{"N, the number of boxes", 1, 10000, 0}}},
     [](std::string name, const Numbers& n) -> SceneSource { return towerScene(std::move(name), n[0]); }},
    {{"wall:ROWS", "a wall with ROWS boxes in the lowest row and one fewer in each above", "wall:10"},
     1,
     {{{"ROWS, the number of rows", 1, 400, 0}}},
     [](std::string name, const Numbers& n) -> SceneSource { return wallScene(std::move(name), n[0]); }},
    {{"heap:N", "N boxes, balls and capsules of different sizes poured into a pit", "heap:1000"},
     1,
     {{{"N, the number of bodies", 1, 100000, 0}}},
     [](std::string name, const Numbers& n) { return heapScene(std::move(name), n[0]); }},
    {{"pit:N", "N boxes of 6 to 10 cm fall into a pit 1.5 m wide: the more, the deeper", "pit:800"},
     1,
     {{{"N, the number of boxes", 1, 20000, 0}}},
     [](std::string name, const Numbers& n) { return pitScene(std::move(name), n[0]); }},
    {{"pits:P:N", "P pits beside each other, and N boxes, balls and capsules that fall into each (100)", "pits:4:50"},
     2,
     {{{"P, the number of pits", 1, 100000, 0}, {"N, the number of bodies in each", 1, 1000, 100}}},
     [](std::string name, const Numbers& n) { return pitsScene(std::move(name), n[0], n[1]); }},
    {{"gas:N", "N elastic balls fly about in free space", "gas:200"},
     1,
     {{{"N, the number of balls", 1, 10000000, 0}}},
     [](std::string name, const Numbers& n) { return gasScene(std::move(name), n[0]); }},
    {{"bed:X:Y:LAYERS", "layers of X times Y balls fall onto each other between walls (20)", "bed:6:5:4"},
     3,
     {{{"X, the balls along x", 1, 1000, 0},
       {"Y, the balls along y", 1, 1000, 0},
       {"LAYERS, the balls above each other", 1, 100, 20}}},
     [](std::string name, const Numbers& n) { return bedScene(std::move(name), n[0], n[1], n[2]); }},
    {{"grains:N", "N boxes, balls and capsules in a pit, twenty layers deep: the more, the wider", "grains:300"},
     1,
     {{{"N, the number of grains", 1, 10000000, 0}}},
     [](std::string name, const Numbers& n) { return grainsScene(std::move(name), n[0]); }},
    {{"rockfall", "rubble comes down a mountain side into a valley", "rockfall"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource { return rockfallScene(std::move(name)); }},
    {{"shake_table", "an earthquake shakes a façade of stones", "shake_table"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource { return shakeTableScene(std::move(name)); }},
    {{"excavator", "an excavator's arm digs in stones", "excavator"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource { return excavatorScene(std::move(name)); }},
    {{"drum", "a turning drum feeds a conveyor with stones", "drum"},
     0,
     {},
     [](std::string name, const Numbers&) -> SceneSource { return drumScene(std::move(name)); }},
});

/// The parts of a name between its colons.
std::vector<std::string_view> splitName(std::string_view name) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t end = name.find(':', begin);
        parts.push_back(name.substr(begin, end - begin));
        if (end == std::string_view::npos) return parts;
        begin = end + 1;
    }
}

const Entry* findEntry(std::string_view family) {
    for (const Entry& entry : known_scenes) {
        if (entry.family() == family) return &entry;
    }
    return nullptr;
}

int readNumber(std::string_view name, std::string_view text, const Parameter& parameter, int maximum) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < parameter.minimum || number > maximum) {
        throw InputError(fmt::format("scene '{}': '{}' is not allowed for {}; give a whole number from {} to {}", name,
                                     text, parameter.meaning, parameter.minimum, maximum));
    }
    return number;
}

}  // namespace

std::vector<BuiltInScene> builtInScenes() {
    std::vector<BuiltInScene> scenes;
    scenes.reserve(std::size(known_scenes));
    for (const Entry& entry : known_scenes) scenes.push_back(entry.scene);
    return scenes;
}

bool isBuiltInScene(std::string_view name) {
    return findEntry(splitName(name).front()) != nullptr;
}

Scene builtInScene(std::string_view name) {
    return builtInSource(name).whole();
}

SceneSource builtInSource(std::string_view name) {
    const std::vector<std::string_view> parts = splitName(name);
    const Entry* const entry = findEntry(parts.front());
    if (entry == nullptr) {
        std::vector<std::string_view> names;
        names.reserve(std::size(known_scenes));
        for (const Entry& known : known_scenes) names.push_back(known.scene.name);
        throw InputError(fmt::format("'{}' is not a built-in scene; built in are {}", name, fmt::join(names, ", ")));
    }
    if (parts.size() - 1 > entry->parameter_count) {
        throw InputError(fmt::format("scene '{}' has too many parts; its form is {}, such as {}", name,
                                     entry->scene.name, entry->scene.example));
    }
    Numbers numbers{};
    for (std::size_t i = 0; i < entry->parameter_count; ++i) {
        const Parameter& parameter = entry->parameters[i];
        // A row of a cradle has at least one ball that waits.
        const int maximum = parameter.is_fewer ? numbers[i - 1] - 1 : parameter.maximum;
        if (i + 1 < parts.size()) {
            numbers[i] = readNumber(name, parts[i + 1], parameter, maximum);
        } else if (parameter.fallback > 0) {
            numbers[i] = parameter.fallback;
        } else {
            throw InputError(fmt::format("scene '{}' needs {}; its form is {}, such as {}", name, parameter.meaning,
                                         entry->scene.name, entry->scene.example));
        }
    }
    return entry->make(std::string(name), numbers);
}

}  // namespace cairn
