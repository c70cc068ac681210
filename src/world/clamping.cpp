#include "world/clamping.h"

#include <algorithm>
#include <span>

namespace cairn {

namespace {

/// Whoever stands in the way of others that go back goes back, too, so this is repeated as often as bodies stand behind
/// each other. After so many rounds nobody flies a part of the way only, …
constexpr int most_exact = 4;
/// … and after so many what is too deep stays so in this step.
constexpr int most_rounds = 256;

/// Less of a flight than this is none.
constexpr double least_part = 0.02;

/// @param round from 0 on
double settledPart(double part, int round) {
    return round >= most_exact || part < least_part ? 0 : part;
}

/// Finds to where bodies go back. @return whether any does
bool findPlaces(StepData& data, const WaysInput& input, int round) {
    findTooDeep(input, data.too_deep);
    if (std::ranges::all_of(data.too_deep, [](const auto& part) { return part.empty(); })) return false;
    data.go_back_to.assign(input.bodies.slots(), 1);
    for (const std::vector<TooDeep>& part : data.too_deep) {
        for (const auto& [pair, flown] : part) {
            for (const BodyIndex i : {pair.a, pair.b}) {
                if (mayGoBack(input, i)) data.go_back_to[i] = std::min(data.go_back_to[i], settledPart(flown, round));
            }
        }
    }
    return true;
}

}  // namespace

void clampMotion(WorldState& world, const PairsInput& pairs) {
    StepData& data = world.data;
    std::vector<BodyWay>& way = data.before.way;
    const Vec3 acceleration = world.gravity + world.global_acceleration;
    const auto inputOf = [&](std::span<const std::uint8_t> stuck, std::span<const std::uint8_t> back) -> WaysInput {
        return {world.bodies, data.pairs.pairs(), data.contacts, pairs.range, way, data.jointed, stuck,
                back,         world.executor};
    };
    // In most steps nobody goes back, and then it is all the same who could not.
    if (!findPlaces(data, inputOf({}, {}), 0)) return;
    findStuck(inputOf({}, {}), data.stuck);
    data.stopped.assign(world.bodies.slots(), 0);
    std::span<const std::uint8_t> back;
    for (int round = 0; round < most_rounds; ++round) {
        if (!findPlaces(data, inputOf(data.stuck, back), round)) return;
        data.back.assign(world.bodies.slots(), 0);
        for (BodyIndex i = 0; i < world.bodies.slots(); ++i) {
            if (!(data.go_back_to[i] < way[i].part)) continue;
            flyBack(world.bodies, i, data.go_back_to[i], acceleration, world.settings.sleep, world.part.length, way[i]);
            data.back[i] = 1;
            data.stopped[i] = 1;
        }
        back = data.back;
        data.pairs.detectBack(pairs, back, data.contacts);
    }
}

}  // namespace cairn
