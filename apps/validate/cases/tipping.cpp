#include <cmath>

#include "cases.h"
#include "incline_box.h"

namespace cairn::validation {

namespace tipping_case {
namespace {

const Vec3 size(0.2, 0.2, 0.5);  ///< [m]
constexpr double watched = 3;    ///< [s]

bool stillStands(const World& world, BodyId box, const Quat& begin) {
    return world.pose(box).orientation.angularDistance(begin) < 5 * degree;
}

/// The angle at which a tall box tips over [°].
double angleOfTipping(double rate, const Plan& plan) {
    const double expected = std::atan(size.x() / size.z()) / degree;
    return threshold(expected - 1, expected + 1, 0.02, [&](double angle) {
        plan.alive();
        InclineBox setup(accurateSettings(rate), angle * degree, 0.3, contactLaw(0, 1.5), size);
        runUntil(setup.world, watched);
        return stillStands(setup.world, setup.box, setup.incline.orientation());
    });
}

/// The direction of weight and push together at which a box on level ground no longer rests [°].
/// @param height of the push above the ground [m]
double angleOfPush(double rate, double friction, double height, double expected, const Plan& plan) {
    return threshold(expected - 1, expected + 1, 0.02, [&](double angle) {
        plan.alive();
        InclineBox setup(accurateSettings(rate), 0, 0, contactLaw(0, friction), size);
        const Vec3 push(g * std::tan(angle * degree), 0, 0);
        setup.world.setConstantForce(setup.box, push);
        setup.world.setConstantTorque(setup.box, Vec3(0, 0, height - size.z() / 2).cross(push));
        runUntil(setup.world, watched);
        const bool slid = setup.displacement().norm() > 1e-3;
        return !slid && stillStands(setup.world, setup.box, setup.incline.orientation());
    });
}

Result run(const Plan& plan) {
    Result result;
    const double height = 0.4;
    const double tips = std::atan(size.x() / size.z()) / degree;
    const double pushed = std::atan(size.x() / 2 / height) / degree;
    const double slides = std::atan(0.2) / degree;
    const std::vector<double> rates = plan.isQuick() ? std::vector<double>{240} : std::vector<double>{240, 960};
    measureOver(result, rates,
                {{"incline at which it tips", "°", Rule::absolute, tips, 0.1, 240},
                 {"push 0.4 m above the ground at which it tips", "°", Rule::absolute, pushed, 0.1, 240},
                 {"push 0.1 m above the ground at which it slides, µ = 0.2", "°", Rule::absolute, slides, 0.1, 240}},
                [&](double rate) {
                    return std::vector{angleOfTipping(rate, plan), angleOfPush(rate, 1.5, height, pushed, plan),
                                       angleOfPush(rate, 0.2, 0.1, slides, plan)};
                });
    return result;
}

}  // namespace
}  // namespace tipping_case

const Case tipping{"tipping",
                   "Statics",
                   "A box tips or slides when it must",
                   "tips at tan θ = b/h on an incline, at F/(mg) = b/(2·height) under a push; slides at µ",
                   "Box 0.2 × 0.2 × 0.5 m; pushes as the angle atan F/(mg); 3 s each, bisection to 0.02°.",
                   tipping_case::run};

}  // namespace cairn::validation
