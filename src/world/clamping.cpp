#include "world/clamping.h"

#include <algorithm>
#include <span>

#include "math/rotation.h"

namespace cairn {

namespace {

/// Whoever stands in the way of others that go back goes back, too, so this is repeated as often as bodies stand behind
/// each other. After so many rounds nobody flies a part of the way only, …
constexpr int most_exact = 4;
/// … and after so many what is too deep stays so in this step.
constexpr int most_rounds = 256;

/// Less of a way than this is none.
constexpr double least_part = 0.02;

/// @param round from 0 on
double settledPart(double part, int round) {
    return round >= most_exact || part < least_part ? 0 : part;
}

/// Finds to where the bodies of data.too_deep go back. @return whether any does
bool findPlaces(StepData& data, const WaysInput& input, int round) {
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

/// Notes how far surfaces of bodies went since the detection. @return whether any did
bool findMoved(const BodyStorage& bodies, std::vector<CorrectedBody>& corrected) {
    corrected.assign(bodies.slots(), {});
    bool any = false;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] != BodyKind::dynamic || bodies.position[i] == bodies.detected_position[i]) continue;
        corrected[i].moved = (bodies.position[i] - bodies.detected_position[i]).norm() +
                             turnedWay(bodies, i, bodies.detected_orientation[i]);
        any = true;
    }
    return any;
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
    findTooDeep(inputOf({}, {}), data.too_deep);
    if (!findPlaces(data, inputOf({}, {}), 0)) return;
    findStuck(inputOf({}, {}), data.stuck);
    data.stopped.assign(world.bodies.slots(), 0);
    std::span<const std::uint8_t> back;
    for (int round = 0; round < most_rounds; ++round) {
        const WaysInput input = inputOf(data.stuck, back);
        findTooDeep(input, data.too_deep);
        if (!findPlaces(data, input, round)) return;
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

void clampCorrection(WorldState& world, const DetectionRange& range) {
    StepData& data = world.data;
    BodyStorage& bodies = world.bodies;
    if (!findMoved(bodies, data.corrected)) return;
    for (const Contact& contact : data.contacts) {
        for (const BodyIndex i : {contact.a, contact.b}) {
            if (bodies.kind[i] != BodyKind::dynamic) continue;
            double& deepest = data.corrected[i].deepest;
            deepest = std::max(deepest, -contact.distance / contact.allowed_overlap);
        }
    }
    std::vector<BodyWay>& way = data.correction_way;
    way.resize(bodies.slots());
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        way[i].begin = {bodies.detected_position[i], bodies.detected_orientation[i]};
        way[i].part = data.corrected[i].moved > 0 ? 1 : 0;
    }
    std::span<const std::uint8_t> back;
    for (int round = 0; round < most_rounds; ++round) {
        const WaysInput input{bodies, data.pairs.pairs(), data.contacts, range, way, {}, {}, back, world.executor};
        findPressed(input, data.corrected, data.too_deep);
        if (!findPlaces(data, input, round)) return;
        data.back.assign(bodies.slots(), 0);
        for (BodyIndex i = 0; i < bodies.slots(); ++i) {
            if (!(data.go_back_to[i] < way[i].part)) continue;
            const Pose to = poseOnWay({bodies.position[i], bodies.orientation[i]}, way[i], data.go_back_to[i]);
            bodies.position[i] = to.position;
            bodies.orientation[i] = to.orientation;
            bodies.inertiaInv_W[i] = toWorldInertia(bodies.inertiaInv_B[i], bodies.orientation[i]);
            way[i].part = data.go_back_to[i];
            data.back[i] = 1;
        }
        back = data.back;
    }
}

}  // namespace cairn
