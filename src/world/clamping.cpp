#include "world/clamping.h"

#include <algorithm>
#include <optional>
#include <span>

#include "math/rotation.h"
#include "math/tolerances.h"

namespace cairn {

namespace {

/// Whoever stands in the way of others that go back goes back, too, so this is repeated as often as bodies stand behind
/// each other. After so many rounds all that go back fly a half of their way, if they may, or nothing, so that who
/// stands behind each other comes down together, and each goes back twice at most, …
constexpr int most_exact = 4;
/// … and after so many what is too deep stays so in this step.
constexpr int most_rounds = 256;

/// Less of a way than this is none.
constexpr double least_part = 0.02;

/// Who gets no farther than this part of a flight is held.
constexpr double most_held = 0.5;

/// @param round from 0 on
double settledPart(double part, int round) {
    if (round < most_exact) return part < least_part ? 0 : part;
    return part < 0.5 ? 0 : 0.5;
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

/// How far the surface of a body went at most since it was somewhere else [m].
double waySince(const BodyStorage& bodies, BodyIndex i, const Pose& before) {
    return (bodies.position[i] - before.position).norm() + turnedWay(bodies, i, before.orientation);
}

Pose detectedPose(const BodyStorage& bodies, BodyIndex i) {
    return {bodies.detected_position[i], bodies.detected_orientation[i]};
}

/// Notes how far surfaces of bodies went since they were somewhere else. @return the farthest [m]; nothing if none did
std::optional<double> findMoved(const BodyStorage& bodies, const PosesBefore& before, std::vector<MovedBody>& moved) {
    moved.assign(bodies.slots(), {});
    std::optional<double> farthest;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        if (bodies.kind[i] != BodyKind::dynamic) continue;
        const bool same = bodies.position[i] == before.position[i] &&
                          bodies.orientation[i].coeffs() == before.orientation[i].coeffs();
        if (same) continue;
        moved[i].way = waySince(bodies, i, {before.position[i], before.orientation[i]});
        farthest = std::max(farthest.value_or(0), moved[i].way);
    }
    return farthest;
}

/// Takes back the bodies of data.moved until none is pressed too deep into others.
void takeBackPressed(WorldState& world, const DetectionRange& range, const PosesBefore& before) {
    StepData& data = world.data;
    BodyStorage& bodies = world.bodies;
    std::vector<BodyWay>& way = data.moved_way;
    way.resize(bodies.slots());
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        way[i].begin = {before.position[i], before.orientation[i]};
        way[i].part = data.moved[i].way > 0 ? 1 : 0;
    }
    std::span<const std::uint8_t> back;
    for (int round = 0; round < most_rounds; ++round) {
        const WaysInput input{bodies, data.pairs.pairs(), data.contacts, range, way, {}, {}, back, world.executor};
        findPressed(input, data.moved, data.too_deep);
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

/// Takes back those that flew too deep. @return whether there were any
bool takeBackFlown(WorldState& world, const PairsInput& pairs) {
    StepData& data = world.data;
    std::vector<BodyWay>& way = data.before.way;
    const Vec3 acceleration = world.gravity + world.global_acceleration;
    const auto inputOf = [&](std::span<const std::uint8_t> stuck, std::span<const std::uint8_t> back) -> WaysInput {
        return {world.bodies, data.pairs.pairs(), data.contacts, pairs.range, way, data.jointed, stuck,
                back,         world.executor};
    };
    measureFlights(inputOf({}, {}), data.flights);
    // Who did not move is no deeper than before.
    if (!data.flights.far && !data.pairs.foundDeep()) return false;
    // In most steps nobody goes back, and then it is all the same who could not.
    findTooDeep(inputOf({}, {}), data.flights, data.too_deep);
    if (!findPlaces(data, inputOf({}, {}), 0)) return false;
    findStuck(inputOf({}, {}), data.stuck);
    data.stopped.assign(world.bodies.slots(), 0);
    std::span<const std::uint8_t> back;
    for (int round = 0; round < most_rounds; ++round) {
        const WaysInput input = inputOf(data.stuck, back);
        findTooDeep(input, data.flights, data.too_deep);
        if (!findPlaces(data, input, round)) break;
        data.back.assign(world.bodies.slots(), 0);
        for (BodyIndex i = 0; i < world.bodies.slots(); ++i) {
            if (!(data.go_back_to[i] < way[i].part)) continue;
            flyBack(world.bodies, i, data.go_back_to[i], acceleration, world.settings.sleep, world.part.length, way[i]);
            data.back[i] = 1;
            data.stopped[i] = 1;
        }
        back = data.back;
        measureFlights(inputOf(data.stuck, back), data.flights);
        data.pairs.detectBack(pairs, back, data.contacts);
    }
    return true;
}

}  // namespace

void clampMotion(WorldState& world, const PairsInput& pairs) {
    const StepData& data = world.data;
    BodyStorage& bodies = world.bodies;
    const bool any = takeBackFlown(world, pairs);
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        // Who sleeps flies when it wakes.
        if (bodies.asleep[i] != 0) continue;
        const double part = data.before.way[i].part;
        const bool held = any && data.stopped[i] != 0 && part <= most_held;
        if (held && bodies.held[i] != 0) {
            // The contacts of the last step did not tell it either: with this velocity it goes nowhere.
            bodies.v[i] *= part;
            bodies.w[i] *= part;
        }
        bodies.held[i] = held ? 1 : 0;
    }
}

bool clampCorrection(WorldState& world, const DetectionRange& range) {
    StepData& data = world.data;
    const BodyStorage& bodies = world.bodies;
    const PosesBefore before{bodies.detected_position, bodies.detected_orientation};
    if (!findMoved(bodies, before, data.moved)) return false;
    for (const Contact& contact : data.contacts) {
        for (const BodyIndex i : {contact.a, contact.b}) {
            if (bodies.kind[i] != BodyKind::dynamic) continue;
            double& deepest = data.moved[i].deepest;
            deepest = std::max(deepest, -contact.distance / contact.allowed_overlap);
        }
    }
    takeBackPressed(world, range, before);
    return true;
}

void measureCorrected(WorldState& world, const DetectionRange& range) {
    StepData& data = world.data;
    const WaysInput input{world.bodies, data.pairs.pairs(), data.contacts, range, data.moved_way, {}, {},
                          {},           world.executor};
    limitToDepths(input, data.moved, data.contacts);
}

void clampCompletion(WorldState& world, const DetectionRange& range, const PosesBefore& before) {
    const BodyStorage& bodies = world.bodies;
    std::vector<MovedBody>& moved = world.data.moved;
    const std::optional<double> farthest = findMoved(bodies, before, moved);
    if (!farthest) return;
    // Where no two were too deep, nobody was moved before, and small ways lead none too deep.
    const double smallest = world.data.flights.smallest;
    const double room = (most_flown_overlap - 1) * range.overlapOf(smallest, smallest);
    const bool deep = std::ranges::find(world.data.deep, 1) != world.data.deep.end();
    if (!deep && 4 * *farthest < surely_below * room) return;
    for (BodyIndex i = 0; i < bodies.slots(); ++i) {
        // Contacts follow what the correction turned to first order only.
        if (bodies.kind[i] == BodyKind::dynamic) moved[i].unsure = waySince(bodies, i, detectedPose(bodies, i));
    }
    takeBackPressed(world, range, before);
}

}  // namespace cairn
