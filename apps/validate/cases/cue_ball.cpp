#include <cmath>
#include <numbers>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace cue_ball_case {
namespace {

constexpr double radius = 0.028575;  ///< [m]
constexpr double speed = 2;          ///< [m/s]
constexpr double degree = std::numbers::pi / 180;

/// How the cue ball arrives.
enum class Shot { stun, natural_roll };

struct Paths {
    double deflection = 0;  ///< of the cue ball, once it rolls [°]
    double between = 0;     ///< of the two balls, right after the impact [°]
};

Paths play(double rate, Shot shot, double cut) {
    Settings settings = accurateSettings(rate);
    // What the cloth does during the time step of the impact is no part of it.
    settings.resolution.impacts = Impacts::sequential;
    World world = makeWorld(settings, Vec3(0, 0, -g), contactLaw(0, 0.2));
    const MaterialId cloth = world.addMaterial({.name = "cloth", .density = 1000});
    world.setPairProperties(MaterialId{0}, MaterialId{0}, contactLaw(1, 0));
    BodyDescription table;
    table.shape = HalfSpace{};
    table.fixed = true;
    table.material = cloth;
    world.addBody(table);
    BodyDescription cue = body(Sphere{radius}, 0.17, Vec3(0, 0, radius));
    cue.linear_velocity = Vec3(speed, 0, 0);
    if (shot == Shot::natural_roll) cue.angular_velocity = Vec3(0, speed / radius, 0);
    const BodyId a = world.addBody(cue);
    // The balls touch after the first time step's motion, with the line of centres exactly at the cut angle.
    const Vec3 centre = Vec3(speed / rate, 0, radius) + 2 * radius * Vec3(std::cos(cut), std::sin(cut), 0);
    const BodyId b = world.addBody(body(Sphere{radius}, 0.17, centre));
    world.step();
    const Vec3 va = world.linearVelocity(a);
    const Vec3 vb = world.linearVelocity(b);
    Paths paths;
    paths.between = std::acos(va.dot(vb) / (va.norm() * vb.norm())) / degree;
    runUntil(world, 2);
    const Vec3 v = world.linearVelocity(a);
    paths.deflection = std::abs(std::atan2(v.y(), v.x())) / degree;
    return paths;
}

double expectedDeflection(double cut) {
    return std::atan(std::sin(cut) * std::cos(cut) / (std::sin(cut) * std::sin(cut) + 0.4)) / degree;
}

Result run(const Plan& plan) {
    Result result;
    measureOver(result, plan.rates(),
                {{"angle between the balls, stun shot, cut 40°", "°", Rule::absolute, 90, 0.5, 960,
                  "in the step of the impact the cloth already pushes a little"},
                 {"deflection of the rolling cue ball, cut 28.1°", "°", Rule::absolute, 33.75, 0.05, 960}},
                [](double rate) {
                    return std::vector{play(rate, Shot::stun, 40 * degree).between,
                                       play(rate, Shot::natural_roll, 28.1 * degree).deflection};
                });
    Line measured{"measured", {}, {}};
    Line formula{"expected", {}, {}, true};
    double most = 0;
    double best = 0;
    for (double cut = 4; cut < 80; cut += cut < 34 && cut >= 22 ? 1 : 6) {
        plan.alive();
        const double deflection = play(960, Shot::natural_roll, cut * degree).deflection;
        measured.x.push_back(cut);
        measured.y.push_back(deflection);
        formula.x.push_back(cut);
        formula.y.push_back(expectedDeflection(cut * degree));
        if (deflection > most) best = cut;
        most = std::max(most, deflection);
    }
    result.absolute("cut angle of the largest deflection", "°", 28.1, best, 2, timeStepText(960),
                    "cut angles are tried in steps of 1°");
    result.figures.push_back(
        {"Deflection of the rolling cue ball", "cut angle [°]", "deflection [°]", {measured, formula}});
    return result;
}

}  // namespace
}  // namespace cue_ball_case

const Case cue_ball{"cue-ball",
                    "Impacts",
                    "Billiard: the 90° and the 30° rule",
                    "tan θ = sin φ cos φ/(sin²φ + 2/5): at most 33.75° at a cut angle of 28.1°",
                    "Balls of 57.15 mm and 170 g, elastic and without friction on each other; µ = 0.2 on the cloth.",
                    cue_ball_case::run};

}  // namespace cairn::validation
