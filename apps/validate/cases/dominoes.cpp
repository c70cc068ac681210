#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace dominoes_wave_case {
namespace {

const Vec3 domino(0.0075, 0.024, 0.048);  ///< thickness, width, height [m]
constexpr int dominoes = 80;
/// Between these the speed is measured: narrow gaps take the longest to a steady wave.
constexpr int first_measured = 40;
constexpr int last_measured = 75;

/// Speed of the steady wave [m/s]; 0 if it stopped.
double waveSpeed(const Settings& settings, double gap, const Plan& plan) {
    World world = makeWorld(settings, Vec3(0, 0, -g), contactLaw(0, 0.2));
    const MaterialId floor = world.addMaterial({.name = "floor", .density = 1000});
    world.setPairProperties(MaterialId{0}, floor, contactLaw(0, 10));
    BodyDescription ground;
    ground.shape = HalfSpace{};
    ground.fixed = true;
    ground.material = floor;
    world.addBody(ground);
    const double pitch = gap + domino.x();
    std::vector<BodyId> row;
    row.reserve(dominoes);
    for (int i = 0; i < dominoes; ++i) {
        row.push_back(world.addBody(body(Box{domino}, 0.01, Vec3(i * pitch, 0, domino.z() / 2))));
    }
    // The first one is tipped beyond its balance, or almost to its neighbour, and falls.
    const double tilt = std::min(1.3 * std::atan(domino.x() / domino.z()), 0.8 * gap / domino.z());
    Pose pose;
    pose.orientation = Quat(Eigen::AngleAxisd(tilt, Vec3::UnitY()));
    const Vec3 corner(domino.x() / 2, 0, 0);
    pose.position = corner + pose.orientation * Vec3(-domino.x() / 2, 0, domino.z() / 2);
    world.setPose(row.front(), pose);
    world.setAngularVelocity(row.front(), Vec3(0, 6, 0));
    world.setLinearVelocity(row.front(), Vec3(0, 6, 0).cross(pose.position - corner));
    double began = 0;
    while (world.time() < 5) {
        world.step();
        plan.alive();
        const auto moving = [&](int i) { return world.angularVelocity(row[static_cast<std::size_t>(i)]).y() > 0.05; };
        if (began == 0 && moving(first_measured)) began = world.time();
        if (moving(last_measured)) return (last_measured - first_measured) * pitch / (world.time() - began);
    }
    return 0;
}

Result run(const Plan& plan) {
    Result result;
    struct Published {
        double gap, speed;
    };
    Line measured{"measured", {}, {}};
    Line expected{"expected", {}, {}, true};
    for (const auto& [gap, speed] :
         {Published{0.005, 1.083}, {0.0085, 1.024}, {0.010, 1.005}, {0.020, 0.922}, {0.030, 0.847}, {0.036, 0.790}}) {
        const std::vector<double> rates = plan.isQuick() ? std::vector<double>{960} : std::vector<double>{960, 3840};
        double last = 0;
        measureOver(
            result, rates,
            {{fmt::format("speed of the wave, gap {:g} mm", 1000 * gap), "m/s", Rule::relative, speed, 0.03, 3840}},
            [&, gap = gap](double rate) { return std::vector{last = waveSpeed(accurateSettings(rate), gap, plan)}; });
        measured.x.push_back(1000 * gap);
        measured.y.push_back(last);
        expected.x.push_back(1000 * gap);
        expected.y.push_back(speed);
    }
    result.figures.push_back({"Speed of the wave", "gap [mm]", "speed [m/s]", {measured, expected}});
    return result;
}

}  // namespace
}  // namespace dominoes_wave_case

const Case dominoes_wave{
    "dominoes",
    "Dominoes",
    "A row of dominoes falls with the right speed",
    "J. M. J. van Leeuwen, The domino effect, Am. J. Phys. 78 (2010)",
    "48 × 24 × 7.5 mm, 80 of them, µ = 0.2 between them, feet that do not slip (µ = 10), e = 0; speed "
    "between the 40th and the 75th.",
    dominoes_wave_case::run};

}  // namespace cairn::validation
