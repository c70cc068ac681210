#include "world/sensors.h"

#include <algorithm>
#include <tuple>

#include "queries/body_query.h"

namespace cairn {

namespace {

/// Whether the shapes of two bodies have a point in common.
bool doOverlap(const BodyStorage& bodies, BodyIndex a, BodyIndex b) {
    std::vector<std::uint32_t> parts;
    findOverlaps({bodies.shape[a], bodies.shapePose(a)}, {bodies.shape[b], bodies.shapePose(b)}, parts);
    return !parts.empty();
}

}  // namespace

void findSensed(WorldState& world) {
    const BodyStorage& bodies = world.bodies;
    StepData& data = world.data;
    data.sensed.clear();
    if (std::ranges::none_of(bodies.sensor, [](std::uint8_t sensor) { return sensor != 0; })) return;
    for (const BodyPair& pair : data.pairs.pairs()) {
        if (bodies.sensor[pair.a] == bodies.sensor[pair.b]) continue;
        const auto [sensor, body] = bodies.sensor[pair.a] != 0 ? std::pair(pair.a, pair.b) : std::pair(pair.b, pair.a);
        if (bodies.filter.keepsApart(sensor, body, bodies.groups[sensor], bodies.groups[body])) continue;
        if (!data.pairs.bounds()[sensor].overlaps(data.pairs.bounds()[body])) continue;
        if (doOverlap(bodies, sensor, body)) data.sensed.push_back({bodies.idOf(sensor), bodies.idOf(body)});
    }
    std::ranges::sort(data.sensed, {}, [](const Sensed& s) { return std::tuple(s.sensor, s.body); });
}

}  // namespace cairn
