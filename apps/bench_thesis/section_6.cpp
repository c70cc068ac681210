/// @file §5.6: catapults, Newton's cradle, a spinning ball.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "demonstrations.h"
#include "section.h"

namespace cairn::thesis {

namespace {

constexpr std::array<const char*, 2> catapults = {"catapult7", "catapult15"};
constexpr std::array<int, 2> cradle_sizes = {5, 7};
constexpr double cradle_goal = 1e-12;
/// What the pictures are seen from.
std::vector<double> catapultCamera() {
    return {1.4, -3.2, 1.4, -0.2, 0, 0.7};
}

constexpr int endless_balls = 5;
constexpr int endless_moving = 2;

std::int64_t endlessSteps(Extent extent) {
    return extent == Extent::full ? 1'000'000 : 20'000;
}

const Json& valueOf(const Results& results, const std::string& key) {
    return results.at(key).front();
}

void addCatapults(SectionResult& result, const Results& results) {
    Figure height{"5.6/catapult/height",      "Figure 37",  "highest small box",
                  "simulation step (1/30 s)", "height [m]", {}};
    Figure distance{"5.6/catapult/distance",
                    "Figure 37",
                    "farthest small box",
                    "simulation step (1/30 s)",
                    "horizontal distance from its start [m]",
                    {}};
    for (const char* name : catapults) {
        const Json& value = valueOf(results, name);
        const auto boxes = value.at("boxes").get<int>();
        const std::string id = fmt::format("5.6/{}", name);
        result.entries.push_back({id + "/peak",
                                  fmt::format("{}: peak height of the {} boxes", name, boxes),
                                  "m",
                                  {},
                                  value.at("peak_m").get<double>(),
                                  "thesis: the 15 fly higher and farther"});
        result.entries.push_back({id + "/range",
                                  fmt::format("{}: range of the {} boxes", name, boxes),
                                  "m",
                                  {},
                                  value.at("range_m").get<double>(),
                                  "distance of the farthest box from its start, at the end"});
        height.lines.push_back({fmt::format("{} boxes", boxes), value.at("height_m")});
        distance.lines.push_back({fmt::format("{} boxes", boxes), value.at("distance_m")});
        result.pictures.push_back({boxes == 7 ? "Figure 37(a)" : "Figure 37(b)", name, name, catapultCamera()});
        result.checks.push_back({fmt::format("{}: no body is lost", name), value.at("lost") == 0});
    }
    result.figures.push_back(height);
    result.figures.push_back(distance);
    const Json& heavy = valueOf(results, catapults[0]);
    const Json& light = valueOf(results, catapults[1]);
    result.checks.push_back({"the 15 lighter boxes fly higher than the 7", light.at("peak_m") > heavy.at("peak_m")});
    result.checks.push_back({"the 15 lighter boxes fly farther than the 7", light.at("range_m") > heavy.at("range_m")});
}

void addCradles(SectionResult& result, const Results& results) {
    for (const int balls : cradle_sizes) {
        double velocity = 0;
        for (int moving = 1; moving < balls; ++moving) {
            const Json& value = valueOf(results, fmt::format("cradle-{}-{}", balls, moving));
            const double error = value.at("velocity_error");
            velocity = std::max(velocity, error);
            result.entries.push_back(
                {fmt::format("5.6/cradle/{}/{}", balls, moving),
                 fmt::format("cradle of {}: {} in, {} out, error", balls, moving, moving), "", 0.0, error,
                 fmt::format("momentum {:.1e}, energy {:.1e} (relative)", value.at("momentum_error").get<double>(),
                             value.at("energy_error").get<double>())});
        }
        result.checks.push_back(
            {fmt::format("cradle of {}: exact to {:.0e} for every k", balls, cradle_goal), velocity <= cradle_goal});
    }
}

void addEndlessCradle(SectionResult& result, const Results& results, Extent extent) {
    const std::int64_t steps = endlessSteps(extent);
    const Json& value = valueOf(results, fmt::format("cradle-{}-{}-steps{}", endless_balls, endless_moving, steps));
    const std::vector<double> errors = value.at("energy_error");
    double most = 0;
    for (const double error : errors) most = std::max(most, std::abs(error));
    result.entries.push_back(
        {"5.6/cradle/drift",
         fmt::format("cradle of {} between walls: energy error over {} time steps", endless_balls, steps), "", 0.0,
         most, fmt::format("relative; {} balls in, {} still move", endless_moving, value.at("moving").get<int>())});
    result.figures.push_back({"5.6/cradle/drift",
                              "",
                              fmt::format("cradle of {} between walls, {} moving", endless_balls, endless_moving),
                              "simulated time [s]",
                              "relative energy error",
                              {{"energy / energy at the start - 1", errors, value.at("time_s")}}});
    result.checks.push_back(
        {fmt::format("the cradle never stops: after {} time steps its energy is exact to {:.0e}", steps, cradle_goal),
         most <= cradle_goal});
}

/// The step from which on the ball rests, as a time.
std::optional<double> restTime(const Json& value) {
    if (value.at("rest_step").is_null()) return {};
    return value.at("rest_step").get<double>() / simulation_steps_per_second;
}

void addSpin(SectionResult& result, const Results& results) {
    const Json& rolling = valueOf(results, "spin-horizontal");
    const Json& turning = valueOf(results, "spin-vertical");
    result.entries.push_back({"5.6/spin/horizontal",
                              "spinning ball in a pile, horizontal axis: rests after",
                              "s",
                              {},
                              restTime(rolling),
                              "thesis: friction slows the ball down until it comes to rest"});
    result.entries.push_back({"5.6/spin/vertical",
                              "spinning ball in a pile, vertical axis: rests after",
                              "s",
                              {},
                              restTime(turning),
                              restTime(turning) ? ""
                                                : "it does not: sleeping balls above do not press on it, and a "
                                                  "point contact below has no lever"});
    result.figures.push_back({"5.6/spin",
                              "",
                              "ball that spins below a pile, 20 rad/s at the start",
                              "simulation step (1/30 s)",
                              "angular speed [rad/s]",
                              {{"horizontal axis", rolling.at("spin")}, {"vertical axis", turning.at("spin")}}});
    result.checks.push_back(
        {"friction brings the spinning ball to rest", restTime(rolling).has_value() && rolling.at("spin").back() == 0});
}

}  // namespace

Section furtherCapabilities(const Plan& plan) {
    Section section{"5.6",
                    "Further simulation capabilities",
                    "Catapults, Newton's cradle for every number of balls, and a ball that spins in a pile. The thesis "
                    "describes the outcomes in words.",
                    {},
                    {}};
    for (const char* name : catapults) section.experiments.push_back(catapult(name));
    for (const int balls : cradle_sizes) {
        for (int moving = 1; moving < balls; ++moving) section.experiments.push_back(cradle(balls, moving));
    }
    section.experiments.push_back(endlessCradle(endless_balls, endless_moving, endlessSteps(plan.extent)));
    for (const SpinAxis axis : {SpinAxis::horizontal, SpinAxis::vertical}) {
        section.experiments.push_back(spinningBall(axis));
    }
    section.evaluate = [extent = plan.extent](const Results& results) {
        SectionResult result;
        addCatapults(result, results);
        addCradles(result, results);
        addEndlessCradle(result, results, extent);
        addSpin(result, results);
        return result;
    };
    return section;
}

}  // namespace cairn::thesis
