/// When shapes that move would overlap.
#include "narrow_phase/approach.h"

#include "narrow_phase/manifold_check.h"
#include "narrow_phase/pair_random.h"

namespace cairn::testing {
namespace {

constexpr double depth = 0.01;

MovingShape moving(const Shape& shape, const Vec3& place, const Vec3& v, const Vec3& w = Vec3::Zero()) {
    return {.shape = shape, .pose = at(place), .centre = place, .v = v, .w = w, .turning = w.norm()};
}

TEST(TimeOfOverlap, IsWhenTheDepthIsReached) {
    const Shape ball = Sphere{0.5};
    const MovingShape one = moving(ball, Vec3(3, 0, 0), Vec3(-10, 0, 0));
    const MovingShape other = moving(ball, Vec3(0, 0, 0), Vec3(10, 0, 0));
    const auto met = timeOfOverlap(one, other, 1, depth);
    ASSERT_TRUE(met.has_value());
    EXPECT_NEAR(*met, (2 + depth) / 20, 1e-3 * depth);
    EXPECT_FALSE(timeOfOverlap(one, other, 0.1, depth).has_value()) << "not before the step ends";
    EXPECT_EQ(timeOfOverlap(moving(ball, Vec3(0.5, 0, 0), Vec3::Zero()), other, 1, depth), 0) << "from the beginning";
}

TEST(TimeOfOverlap, IsNoneForThosePassingByAndFoundForThoseThatArePastEachOtherInTheEnd) {
    const Shape rod = Capsule{0.1, 2};
    const Shape ball = Sphere{0.1};
    // The rod lies along z, and its upper end turns to x.
    const MovingShape turning = moving(rod, Vec3::Zero(), Vec3::Zero(), Vec3(0, 4, 0));
    EXPECT_TRUE(timeOfOverlap(turning, moving(ball, Vec3(0.7, 0, 0.7), Vec3::Zero()), 0.5, depth).has_value());
    EXPECT_FALSE(timeOfOverlap(turning, moving(ball, Vec3(0.7, 0.3, 0.7), Vec3::Zero()), 0.5, depth).has_value());
    EXPECT_FALSE(timeOfOverlap(turning, moving(ball, Vec3(-0.7, 0, 0.7), Vec3::Zero()), 0.5, depth).has_value());
    const MovingShape still = moving(rod, Vec3::Zero(), Vec3::Zero());
    const auto through = timeOfOverlap(still, moving(ball, Vec3(5, 0, 0.3), Vec3(-20, 0, 0)), 0.5, depth);
    ASSERT_TRUE(through.has_value());
    EXPECT_NEAR(*through, (5 - 0.2 + depth) / 20, 1e-3 * depth) << "the ball is far behind it at the end";
}

TEST(TimeOfOverlap, IsNoneForPlatesThatTurnCloseToEachOther) {
    // No point is safe for long from one that turns so fast, whatever it does along the normal.
    const Shape plate = Box{Vec3(1.2, 1.2, 0.1)};
    const MovingShape still = moving(plate, Vec3::Zero(), Vec3::Zero());
    const MovingShape beside = moving(plate, Vec3(0.1, 0, 0.12), Vec3::Zero(), Vec3(0, 0, 10));
    EXPECT_FALSE(timeOfOverlap(still, beside, 1, depth).has_value());
    const MovingShape closing = moving(plate, Vec3(0.1, 0, 0.12), Vec3(0, 0, -0.05), Vec3(0, 0, 10));
    const auto met = timeOfOverlap(still, closing, 1, depth);
    ASSERT_TRUE(met.has_value());
    EXPECT_NEAR(*met, 0.6, 1e-2);
}

TEST(TimeOfOverlap, PassesOverNoTimeInWhichSolidsThatTurnAreDeeper) {
    Random random(7);
    const Shape shapes[] = {Capsule{0.03, 1.6}, Box{Vec3(1, 0.6, 0.1)}, Cylinder{0.4, 0.2}, Sphere{0.3}};
    int meetings = 0;
    for (int n = 0; n < 400; ++n) {
        const auto any = [&](const Vec3& place) {
            MovingShape shape = moving(shapes[random.below(4)], place, random.vector(1), random.vector(6));
            shape.pose.orientation = random.orientation();
            return shape;
        };
        const MovingShape one = any(Vec3::Zero());
        const MovingShape other = any(random.uniform(0.2, 1.5) * random.direction());
        const auto met = timeOfOverlap(one, other, 0.5, depth);
        if (met && *met == 0) continue;  // from the beginning
        meetings += met ? 1 : 0;
        const double until = met.value_or(0.5);
        for (int k = 0; k < 200; ++k) {
            const double time = until * k / 200;
            const double then = overlapDepth(one.shape, one.poseAfter(time), other.shape, other.poseAfter(time));
            ASSERT_LE(then, 1.05 * depth) << "pair " << n << " after " << time << " of " << until << " s";
        }
        if (met) {
            const double then = overlapDepth(one.shape, one.poseAfter(*met), other.shape, other.poseAfter(*met));
            EXPECT_GE(then, 0.5 * depth) << "pair " << n << " after " << *met << " s";
        }
    }
    EXPECT_GT(meetings, 50);
}

}  // namespace
}  // namespace cairn::testing
