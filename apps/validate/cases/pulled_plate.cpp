#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "cases.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace pulled_plate_case {
namespace {

constexpr int along_edge = 5;      ///< balls
constexpr double radius = 0.1;     ///< [m]
constexpr double ball_mass = 1;    ///< [kg]
constexpr double plate_mass = 10;  ///< [kg]
constexpr double force = 150;      ///< [N]
constexpr double ground_friction = 0.4;
constexpr double ball_friction = 0.8;
constexpr double simulated = 2;    ///< [s]
const Vec3 plate_size(4, 2, 0.1);  ///< [m]

struct Course {
    double plate_error = 0;  ///< root of the mean squared difference of the velocity from the formula [m/s]
    double balls_error = 0;
    double step_time = 0;  ///< wall, one thread [s]
};

/// Acceleration of the plate: friction makes each ball roll, with 2/7 of it.
double plateAcceleration() {
    constexpr double balls = along_edge * along_edge * ball_mass;
    return (force - ground_friction * (plate_mass + balls) * g) / (plate_mass + 2.0 / 7 * balls);
}

Course pull(const Settings& settings, const Plan& plan) {
    World world = makeWorld(settings, Vec3(0, 0, -g), contactLaw(0, ball_friction));
    const MaterialId stone = world.addMaterial({.name = "stone", .density = 1000});
    world.setPairProperties(MaterialId{0}, stone, contactLaw(0, ground_friction));
    BodyDescription floor;
    floor.shape = HalfSpace{};
    floor.fixed = true;
    floor.material = stone;
    world.addBody(floor);
    const BodyId plate = world.addBody(body(Box{plate_size}, plate_mass, Vec3(0, 0, plate_size.z() / 2)));
    world.setConstantForce(plate, Vec3(force, 0, 0));
    std::vector<BodyId> balls;
    for (int x = 0; x < along_edge; ++x) {
        for (int y = 0; y < along_edge; ++y) {
            const Vec3 place(0.3 * (x - 2), 0.3 * (y - 2), plate_size.z() + radius);
            balls.push_back(world.addBody(body(Sphere{radius}, ball_mass, place)));
        }
    }
    const double acceleration = plateAcceleration();
    Course course;
    double seconds = 0;
    while (world.time() < simulated) {
        const auto begin = std::chrono::steady_clock::now();
        world.step();
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        if (world.stepCount() % 64 == 0) plan.alive();
        const double wanted = acceleration * world.time();
        course.plate_error += (world.linearVelocity(plate) - Vec3(wanted, 0, 0)).squaredNorm();
        for (const BodyId ball : balls) {
            course.balls_error += (world.linearVelocity(ball) - Vec3(2.0 / 7 * wanted, 0, 0)).squaredNorm();
        }
    }
    const auto steps = static_cast<double>(world.stepCount());
    course.plate_error = std::sqrt(course.plate_error / steps);
    course.balls_error = std::sqrt(course.balls_error / (steps * static_cast<double>(balls.size())));
    course.step_time = seconds / steps;
    return course;
}

/// Adds what was found. @param allowed error [m/s]
void add(Result& result, const Course& course, double allowed, const std::string& setup) {
    result.atMost("velocity of the plate, root of the mean squared error", "m/s", course.plate_error, allowed, setup);
    result.atMost("velocities of the balls, likewise", "m/s", course.balls_error, allowed, setup);
    result.show("a time step", "ms", 1e3 * course.step_time, setup);
}

Result run(const Plan& plan) {
    Result result;
    const auto withPreset = [](Preset preset) {
        Settings settings = Settings::preset(preset, 0, g);
        settings.parallel.threads = 1;
        return settings;
    };
    add(result, pull(withPreset(Preset::accuracy), plan), 1e-8, "accuracy");
    add(result, pull(withPreset(Preset::performance), plan), 1e-3, "performance");
    return result;
}

}  // namespace
}  // namespace pulled_plate_case

const Case pulled_plate{"pulled-plate",
                        "Rolling",
                        "Balls roll on a plate that is pulled",
                        "plate: a = (F − µ(M + nm)g)/(M + 2/7·nm); balls: 2/7·a, since friction f = m·a_b at the rim "
                        "turns them with 5f/(2mr) and what touches does not slide",
                        "F = 150 N pulls a plate of M = 10 kg over ground with µ = 0.4; on it n = 25 balls of m = 1 kg "
                        "and 20 cm, µ = 0.8, begin to roll; 2 s.",
                        pulled_plate_case::run};

}  // namespace cairn::validation
