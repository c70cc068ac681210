/// A four-bar linkage against its equation of motion, integrated by Runge and Kutta.
#include <gtest/gtest.h>

#include <array>
#include <complex>

#include "joint_testing.h"

namespace cairn {
namespace {

using mechanics::joint_gravity;
using mechanics::JointBench;
using mechanics::undamped;

using Point = std::complex<double>;  // x + i·z

/// Crank from the origin, rocker from the ground's other end, coupler between them: bars of 1 kg per metre.
struct FourBar {
    static constexpr double crank = 0.5, coupler = 1.2, rocker = 0.9, ground = 1.1;
    static constexpr double width = 0.04;

    /// The four corners where the crank stands at an angle.
    static std::array<Point, 4> corners(double angle) {
        const Point p = std::polar(crank, angle);
        const Point to_ground = ground - p;
        const double reach = std::abs(to_ground);
        const double along = (coupler * coupler - rocker * rocker + reach * reach) / (2 * reach);
        const Point q = p + to_ground / reach * Point(along, std::sqrt(coupler * coupler - along * along));
        return {Point(0), p, q, Point(ground)};
    }
    /// Twice the kinetic energy per squared speed of the crank, by differences.
    static double inertia(double angle) {
        constexpr double h = 1e-5;
        const auto before = corners(angle - h);
        const auto after = corners(angle + h);
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Point bar = before[i + 1] - before[i];
            const double length = std::abs(bar);
            const Point moved = 0.5 * (after[i] + after[i + 1] - before[i] - before[i + 1]) / (2 * h);
            const double turned = std::arg((after[i + 1] - after[i]) / bar) / (2 * h);
            sum += length * (std::norm(moved) + turned * turned * (length * length + width * width) / 12);
        }
        return sum;
    }
    static double potential(double angle) {
        const auto c = corners(angle);
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            sum += std::abs(c[i + 1] - c[i]) * joint_gravity * 0.5 * (c[i] + c[i + 1]).imag();
        }
        return sum;
    }
    /// I·θ″ + ½·I′·θ′² + V′ = 0.
    static double acceleration(double angle, double speed) {
        constexpr double h = 1e-4;
        const double inertia_slope = (inertia(angle + h) - inertia(angle - h)) / (2 * h);
        const double potential_slope = (potential(angle + h) - potential(angle - h)) / (2 * h);
        return -(0.5 * inertia_slope * speed * speed + potential_slope) / inertia(angle);
    }
};

TEST(FourBarLinkage, MovesAsItsEquationOfMotionSays) {
    JointBench bench(Vec3(0, 0, -joint_gravity), undamped(3840));
    const double begin = 1.1;
    const auto corner = FourBar::corners(begin);
    std::array<BodyId, 3> bars;
    const auto at = [](Point p) { return Vec3(p.real(), 0, p.imag()); };
    for (std::size_t i = 0; i < 3; ++i) {
        const Point bar = corner[i + 1] - corner[i];
        bars[i] = bench.add(Box{{std::abs(bar), FourBar::width, FourBar::width}}, std::abs(bar),
                            at(0.5 * (corner[i] + corner[i + 1])), Quat::FromTwoVectors(Vec3::UnitX(), at(bar)));
    }
    const auto hinge = [&](BodyId a, std::optional<BodyId> b, Point anchor) {
        return bench.world.addJoint(
            {.kind = JointKind::hinge, .a = a, .b = b, .anchor = at(anchor), .axis = -Vec3::UnitY()});
    };
    const JointId crank = hinge(bars[0], std::nullopt, corner[0]);
    hinge(bars[1], bars[0], corner[1]);
    hinge(bars[2], bars[1], corner[2]);
    hinge(bars[2], std::nullopt, corner[3]);
    double angle = begin;
    double speed = 0;
    // Runge and Kutta's classical method.
    const auto advance = [&](double h) {
        const double v1 = speed;
        const double a1 = FourBar::acceleration(angle, v1);
        const double v2 = speed + 0.5 * h * a1;
        const double a2 = FourBar::acceleration(angle + 0.5 * h * v1, v2);
        const double v3 = speed + 0.5 * h * a2;
        const double a3 = FourBar::acceleration(angle + 0.5 * h * v2, v3);
        const double v4 = speed + h * a3;
        const double a4 = FourBar::acceleration(angle + h * v3, v4);
        angle += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
        speed += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    };
    double farthest = 0;
    const double energy = bench.energy();
    for (int i = 0; i < 30; ++i) {
        bench.run(0.05);
        for (int k = 0; k < 5000; ++k) advance(1e-5);
        ASSERT_NEAR(bench.world.joint(crank).position, angle - begin, 1e-5) << bench.world.time();
        farthest = std::max(farthest, std::abs(angle - begin));
    }
    EXPECT_GT(farthest, 1) << "it moves";
    EXPECT_LE(bench.largestError(), 1e-9);
    EXPECT_NEAR(bench.energy(), energy, 1e-3);
}

}  // namespace
}  // namespace cairn
