#include <cmath>

#include "cases.h"
#include "incline_box.h"

namespace cairn::validation {

namespace seesaw_case {
namespace {

const Vec3 plank(3, 0.3, 0.05);     ///< [m]
constexpr double plank_mass = 20;   ///< [kg]
constexpr double block_edge = 0.2;  ///< [m]
constexpr double left = 1.2;        ///< distance of the left load from the hinge [m]
constexpr double right = 0.8;       ///< of the right one [m]
constexpr double left_mass = 10;    ///< [kg]

/// A plank on a hinge at the origin.
struct Plank {
    World world;
    BodyId id;

    Plank(const Settings& settings, const PairProperties& law) : world(makeWorld(settings, Vec3(0, 0, -g), law)) {
        id = world.addBody(body(Box{plank}, plank_mass, Vec3::Zero()));
        JointDescription hinge;
        hinge.kind = JointKind::hinge;
        hinge.a = id;
        hinge.axis = Vec3::UnitY();
        world.addJoint(hinge);
    }
    double top() const { return plank.z() / 2; }
    /// Positive = the right end sinks [rad/s].
    double sinkingRight() const { return world.angularVelocity(id).y(); }
};

/// Whether the left end does not sink with a mass on the right.
bool rightSinks(double rate, double right_mass) {
    Plank seesaw(accurateSettings(rate), contactLaw(0, 0.8));
    const double z = seesaw.top() + block_edge / 2;
    seesaw.world.addBody(body(Box{Vec3::Constant(block_edge)}, left_mass, Vec3(-left, 0, z)));
    seesaw.world.addBody(body(Box{Vec3::Constant(block_edge)}, right_mass, Vec3(right, 0, z)));
    runUntil(seesaw.world, 0.25);
    return seesaw.sinkingRight() > 0;
}

Result balance(const Plan& plan) {
    Result result;
    const double expected = left_mass * left / right;
    measureOver(result, plan.rates(), {{"load that balances the other one", "kg", Rule::relative, expected, 1e-3, 240}},
                [&](double rate) {
                    return std::vector{threshold(0.98 * expected, 1.02 * expected, 1e-4 * expected, [&](double mass) {
                        plan.alive();
                        return !rightSinks(rate, mass);
                    })};
                });
    return result;
}

constexpr double ball_radius = 0.1;  ///< [m]
constexpr double fall = 1;           ///< height from which the stone falls [m]
constexpr double stone_mass = 30;    ///< [kg]
constexpr double shot_mass = 2;      ///< [kg]
constexpr double shot_arm = 1.4;     ///< [m]
constexpr double stone_arm = 0.7;    ///< [m]

/// The shot's speed right after the stone has struck the other arm [m/s].
double launch(double rate) {
    Plank catapult(accurateSettings(rate), contactLaw(0, 0));
    World& world = catapult.world;
    BodyDescription rest = body(Box{Vec3(0.2, 0.3, 0.1)}, 1, Vec3(-shot_arm, 0, -catapult.top() - 0.05));
    rest.fixed = true;
    world.addBody(rest);
    const double z = catapult.top() + ball_radius;
    const BodyId shot = world.addBody(body(Sphere{ball_radius}, shot_mass, Vec3(-shot_arm, 0, z)));
    const BodyId stone = world.addBody(body(Sphere{ball_radius}, stone_mass, Vec3(stone_arm, 0, z + fall)));
    double before = 0;
    bool struck = false;
    while (world.time() < 1) {
        world.step();
        // A foreseen impact takes two steps: in the first one the stone comes just so close that it touches.
        if (struck) return world.linearVelocity(shot).z();
        const double v = world.linearVelocity(stone).z();
        struck = v > before + g / rate;
        before = v;
    }
    return 0;
}

Result shoot(const Plan& plan) {
    Result result;
    const double inertia = plank_mass / 12 * (plank.x() * plank.x() + plank.z() * plank.z());
    const double speed = std::sqrt(2 * g * fall);
    const double turning = stone_mass * speed * stone_arm /
                           (inertia + stone_mass * stone_arm * stone_arm + shot_mass * shot_arm * shot_arm);
    measureOver(result, plan.rates(),
                {{"speed of the shot after the impact", "m/s", Rule::relative, turning * shot_arm, 0.01, 960,
                  "the stone falls on until the end of the time step in which it arrives"}},
                [](double rate) { return std::vector{launch(rate)}; });
    return result;
}

}  // namespace
}  // namespace seesaw_case

const Case seesaw{"seesaw",
                  "Statics",
                  "A see-saw balances by the lever's law",
                  "m₂ = m₁ d₁/d₂",
                  "Plank of 3 m and 20 kg on a hinge, blocks of 20 cm at 1.2 m (10 kg) and 0.8 m; bisection to 0.01 %.",
                  seesaw_case::balance};

const Case catapult{
    "catapult",
    "Impacts",
    "A falling stone launches a shot over a lever",
    "m₁ v d₁ = (I + m₁ d₁² + m₂ d₂²) ω about the hinge, shot's speed ω d₂",
    "Plank of 3 m and 20 kg on a hinge; a stone of 30 kg falls 1 m onto one arm (0.7 m), a shot of 2 kg "
    "lies on the other (1.4 m); e = 0, no friction.",
    seesaw_case::shoot};

}  // namespace cairn::validation
