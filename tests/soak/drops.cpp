/// @file Throws solids of all kinds onto rough ground of triangles and counts those that end below it.
#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "throws.h"

namespace {

using namespace cairn;
using namespace cairn::testing;

constexpr int worlds_per_line = 50;  ///< between two lines that tell how far it is
constexpr const char* usage =
    "usage: cairn_drops [--throws N] [--seed N] [--preset NAME] [--steps-per-second N] [--ground mesh|height_field]\n"
    "                   [--company alone|together] [--smallest PART]\n";

struct Order {
    int throws = 100000;
    Preset preset = Preset::performance;
    double steps_per_second = 0;
    Throws world{};
};

/// @throws std::invalid_argument for what it does not know
Order readOrder(const std::vector<std::string>& words) {
    Order order;
    if (words.size() % 2 != 0) throw std::invalid_argument(fmt::format("'{}' has no value", words.back()));
    for (std::size_t i = 0; i < words.size(); i += 2) {
        const std::string& name = words[i];
        const std::string& value = words[i + 1];
        const auto oneOf = [&](const char* first, const char* second) {
            if (value == first) return true;
            if (value != second) throw std::invalid_argument(fmt::format("{} is {} or {}", name, first, second));
            return false;
        };
        if (name == "--throws") {
            order.throws = std::stoi(value);
        } else if (name == "--seed") {
            order.world.seed = std::stoull(value);
        } else if (name == "--preset") {
            order.preset = presetNamed(value);
        } else if (name == "--steps-per-second") {
            order.steps_per_second = std::stod(value);
        } else if (name == "--ground") {
            order.world.ground = oneOf("mesh", "height_field") ? Ground::mesh : Ground::height_field;
        } else if (name == "--company") {
            order.world.company = oneOf("alone", "together") ? Company::alone : Company::together;
        } else if (name == "--smallest") {
            order.world.smallest = std::stod(value);
        } else {
            throw std::invalid_argument(fmt::format("there is no option {}", name));
        }
    }
    order.world.settings = Settings::preset(order.preset, order.steps_per_second);
    return order;
}

int run(Order order) {
    const Shape ground = roughGround(order.world.ground);
    int lost = 0;
    int done = 0;
    for (int worlds = 1; done < order.throws; ++worlds, ++order.world.seed) {
        for (const LostSolid& solid : throwSolids(ground, order.world)) {
            ++lost;
            fmt::print("lost: seed {} body {} ({}) is at ({}, {}, {})\n", solid.seed, solid.index, solid.kind,
                       solid.position.x(), solid.position.y(), solid.position.z());
        }
        done += order.world.bodies;
        if (worlds % worlds_per_line != 0 && done < order.throws) continue;
        fmt::print("{} thrown, {} lost\n", done, lost);
        std::fflush(stdout);
    }
    return lost == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(readOrder(std::vector<std::string>(argv + 1, argv + argc)));
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n{}", error.what(), usage);
        return 2;
    }
}
