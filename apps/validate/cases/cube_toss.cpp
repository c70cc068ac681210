#include <fmt/format.h>

#include <numbers>

#include "cases.h"
#include "validate/toss.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace cube_toss_case {
namespace {

constexpr double camera = 148;  ///< samples per second of the real recordings

Settings settingsAt(double rate) {
    Settings settings = accurateSettings(rate);
    settings.resolution.restitution_speed = RestitutionSpeed::touching;
    return settings;
}

/// A cube that is thrown like those of the data set, about half a metre per second and a turn or two.
Toss synthetic() {
    Toss toss;
    toss.name = "synthetic";
    TossSample begin;
    begin.pose.position = Vec3(0, 0, 0.25);
    begin.pose.orientation = Quat(Eigen::AngleAxisd(0.6, Vec3(1, 2, 0.5).normalized()));
    begin.v = Vec3(0.6, 0.2, 0.3);
    begin.w = Vec3(2, 5, -1);
    toss.samples = {begin};
    return toss;
}

void compare(Result& result, const Toss& toss, double rate) {
    const TossErrors errors = compareToss(toss, settingsAt(rate));
    const std::string setup = fmt::format("{}, {}", toss.name, timeStepText(rate));
    result.show("mean error of the position over the side", "", errors.meanPosition() / toss.side, setup);
    result.show("mean error of the orientation", "°", errors.meanAngle() * 180 / std::numbers::pi, setup);
    result.figures.push_back({"Error of the position, " + setup,
                              "time [s]",
                              "error [m]",
                              {{"simulation against recording", errors.time, errors.position}}});
}

Result run(const Plan& plan) {
    Result result;
    // Up to the first impacts, where the simulation converges; after that a cube's toss is chaotic.
    const Toss fine = simulateToss(synthetic(), settingsAt(camera * 128), camera, plan.isQuick() ? 0.3 : 0.6);
    for (const double rate : {camera * 4, camera * 16}) {
        plan.alive();
        compare(result, fine, rate);
    }
    result.atMost("mean error of the position against a fine time step, over the side", "",
                  compareToss(fine, settingsAt(camera * 16)).meanPosition() / fine.side, 0.05,
                  "synthetic toss, Δt = 1/2368 s against 1/18944 s");
    for (const Toss& toss : plan.tosses) {
        plan.alive();
        compare(result, toss, camera * 16);
    }
    return result;
}

}  // namespace
}  // namespace cube_toss_case

const Case cube_toss{"cube-toss",
                     "Real experiments",
                     "A cube is tossed onto a table",
                     "recorded tosses, such as those of DAIRLab's ContactNets (not bundled): --toss FILE",
                     "Cube of 104.8 mm and 0.37 kg, µ = 0.18, e = 0.125, 148 samples per second; without a file a "
                     "simulated toss stands in for a recorded one.",
                     cube_toss_case::run};

}  // namespace cairn::validation
