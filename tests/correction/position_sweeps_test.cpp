/// What position sweeps do with one contact, with chains of them and with the motion of the bodies.
#include "correction/position_sweeps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include "correction/contact_scene.h"

namespace cairn::test {
namespace {

/// A scene with gravity and its correction.
struct SweepsScene : ContactScene {
    static constexpr double threshold = 0.01;
    static constexpr double gravity = 10;
    double time_step = 1;            ///< so long that all that is lifted is free [s]
    std::function<void()> put_back;  ///< called before the correction settles

    SweepsScene() { settings.penetration_threshold = threshold; }
    CorrectionCounts run() {
        PositionSweeps sweeps;
        return runWith(sweeps);
    }
    CorrectionCounts runWith(PositionSweeps& sweeps) {
        const std::vector<BodyIndex> bodies = movingBodies();
        std::vector<std::uint32_t> indices(contacts.size());
        std::iota(indices.begin(), indices.end(), 0U);
        BodyState all = state();
        all.acceleration = Vec3(0, 0, -gravity);
        all.time_step = time_step;
        const auto position_before = position;
        const auto orientation_before = orientation;
        CorrectionCounts counts = sweeps.correct({bodies, indices}, {}, contacts, all, remaining_part);
        if (put_back) put_back();
        counts.add(sweeps.settle({bodies, indices}, contacts, all, {position_before, orientation_before}));
        return counts;
    }
    double energy() const {
        double sum = 0;
        for (BodyIndex i = 0; i < kind.size(); ++i) {
            if (kind[i] != BodyKind::dynamic) continue;
            sum += (0.5 * v[i].squaredNorm() + gravity * position[i].z()) / mass_inv[i];
            sum += 0.5 * w[i].dot(inertiaInv_W[i].inverse() * w[i]);
        }
        return sum;
    }
};

TEST(PositionSweeps, LeaveContactsDownToTheThreshold) {
    SweepsScene scene;
    const BodyIndex x = scene.addBody();
    const BodyIndex ground = scene.addFixed();
    scene.touch(x, ground, up, -SweepsScene::threshold);
    EXPECT_EQ(scene.run().penetrating, 0);
    EXPECT_EQ(scene.position[x], Vec3::Zero());
    scene.contacts[0].distance = 2e-3;
    EXPECT_EQ(scene.run().penetrating, 0);
    EXPECT_EQ(scene.position[x], Vec3::Zero());
}

TEST(PositionSweeps, LeaveTheRemainingPartOfADeeperOne) {
    SweepsScene scene;
    scene.remaining_part = 0.7;
    const BodyIndex x = scene.addBody();
    const BodyIndex ground = scene.addFixed();
    scene.touch(x, ground, up, -0.012);
    const CorrectionCounts counts = scene.run();
    EXPECT_EQ(counts.corrected, 1);
    EXPECT_EQ(counts.displaced, 1);
    EXPECT_TRUE(near(scene.position[x], Vec3(0, 0, 0.005)));
    EXPECT_TRUE(near(scene.position[ground], Vec3::Zero()));
    EXPECT_NEAR(scene.contacts[0].distance, scene.remaining(), 1e-12);
    EXPECT_NEAR(scene.contacts[0].point.z(), 0.0025, 1e-12);
}

TEST(PositionSweeps, LeaveHalfOfWhatIsFarTooDeep) {
    SweepsScene scene;
    const BodyIndex x = scene.addBody();
    const BodyIndex ground = scene.addFixed();
    scene.touch(x, ground, up, -0.03);
    const CorrectionCounts counts = scene.run();
    EXPECT_EQ(counts.uncorrected, 1);
    EXPECT_TRUE(near(scene.position[x], Vec3(0, 0, 0.015)));
    EXPECT_NEAR(scene.contacts[0].distance, -0.015, 1e-12);
}

TEST(PositionSweeps, TurnABodyAboutTheFootThatIsTooDeep) {
    SweepsScene scene;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    scene.touch(x, ground, up, -0.012);
    scene.contacts[0].point = Vec3(1, 0, 0);
    scene.run();
    // With unit mass and inertia a lever of one metre halves what the push moves the centre of mass.
    EXPECT_NEAR(scene.position[x].z(), 0.003, 1e-12);
    EXPECT_NEAR(scene.orientation[x].y(), std::sin(-0.003 / 2), 1e-12);
    EXPECT_NEAR(scene.contacts[0].distance, -0.006, 1e-12);
}

TEST(PositionSweeps, TurnNoFartherThanWhatTouchesStaysWhatItIs) {
    SweepsScene scene;
    const BodyIndex floor = scene.addFixed(Vec3::Zero());
    const BodyIndex body = scene.addBody(Vec3(0, 0, 0.5));
    scene.touch(body, floor, up, -0.09);
    scene.contacts[0].point = Vec3(0.5, 0, 0);
    scene.run();
    const double lever = Vec3(0.5, 0, -0.5).norm();
    EXPECT_LE(Eigen::AngleAxisd(scene.orientation[body]).angle(), 3 * SweepsScene::threshold / lever * (1 + 1e-12));
    EXPECT_GT(scene.position[body].z(), 0.5);
}

TEST(PositionSweeps, SettleWhatIsLeftWhereBodiesWerePutBack) {
    SweepsScene scene;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    const BodyIndex y = scene.addBody(Vec3(1, 0, 0));
    scene.asleep[x] = 1;
    scene.v[y] = Vec3(0, 0, -2);
    scene.touch(x, ground, up, -0.012);
    scene.touch(y, ground, up, -0.012);
    scene.put_back = [&] {
        scene.position[x] = Vec3::Zero();
        scene.position[y] = Vec3(1, 0, 0.001);
        scene.orientation[x] = scene.orientation[y] = Quat::Identity();
    };
    const double before = scene.energy();
    const CorrectionCounts counts = scene.run();
    EXPECT_EQ(counts.displaced, 1);
    EXPECT_EQ(counts.uncorrected, 2);
    EXPECT_EQ(scene.contacts[0].distance, -0.012);
    EXPECT_EQ(scene.asleep[x], 1) << "nobody moved it";
    EXPECT_NEAR(scene.contacts[1].distance, -0.011, 1e-12);
    EXPECT_NEAR(scene.energy(), before, 1e-12) << "it pays for what it was lifted";
}

TEST(PositionSweeps, MoveThePairByInverseMasses) {
    SweepsScene scene;
    const BodyIndex light = scene.addBody();
    const BodyIndex heavy = scene.addBody();
    scene.mass_inv[heavy] = 0.25;
    scene.touch(light, heavy, right, -0.03);
    scene.run();
    EXPECT_NEAR(scene.position[light].x(), 0.8 * 0.015, 1e-12);
    EXPECT_NEAR(scene.position[heavy].x(), -0.2 * 0.015, 1e-12);
}

TEST(PositionSweeps, LiftTheHeavyBodyThatPressesALightOneOntoTheFloor) {
    SweepsScene scene;
    const BodyIndex floor = scene.addFixed();
    const BodyIndex light = scene.addBody();
    const BodyIndex heavy = scene.addBody();
    scene.mass_inv[heavy] = 1.0 / 8000;
    scene.inertiaInv_W[heavy] /= 8000;
    scene.touch(light, floor, up, -0.015);
    scene.touch(heavy, light, up, -0.015);
    scene.run();
    for (const Contact& contact : scene.contacts) EXPECT_GE(contact.distance, -1.3 * SweepsScene::threshold);
    EXPECT_GT(scene.position[heavy].z(), 0.004) << "what both have too much";
}

TEST(PositionSweeps, PushWhatAPushedBodyGetsTooDeepInto) {
    SweepsScene scene;
    const BodyIndex wall = scene.addFixed();
    for (int i = 0; i < 3; ++i) scene.addBody();
    scene.touch(1, wall, right, -0.03);
    scene.touch(2, 1, right, -SweepsScene::threshold);
    scene.touch(3, 2, right, 0.05);
    scene.run();
    EXPECT_GT(scene.position[1].x(), 0.01);
    EXPECT_GT(scene.position[2].x(), 0.005);
    EXPECT_EQ(scene.position[3], Vec3::Zero()) << "its contact never gets too deep";
}

TEST(PositionSweeps, PayWhatTheyLiftFromTheMotionAlongTheNormal) {
    for (const double speed : {-2.0, 2.0}) {
        SweepsScene scene;
        const BodyIndex x = scene.addBody();
        const BodyIndex ground = scene.addFixed();
        scene.v[x] = Vec3(1, 0, speed);
        scene.touch(x, ground, up, -0.03);
        const double before = scene.energy();
        scene.run();
        EXPECT_NEAR(scene.energy(), before, 1e-12);
        EXPECT_EQ(scene.v[x].x(), 1) << "along the normal only";
        EXPECT_NEAR(scene.v[x].z(), std::copysign(std::sqrt(4 - 2 * SweepsScene::gravity * 0.015), speed), 1e-12);
    }
}

/// How far what the motion does not pay for may lift a body in a step [m].
double freeLift(double time_step) {
    return 0.01 * 0.5 * SweepsScene::gravity * time_step * time_step;
}

TEST(PositionSweeps, LiftByAPartOfAFallWhereNobodyPays) {
    for (const double time_step : {1.0 / 240, 1.0 / 960}) {
        SweepsScene scene;
        scene.time_step = time_step;
        const BodyIndex ground = scene.addFixed();
        const BodyIndex x = scene.addBody();
        const BodyIndex y = scene.addBody(Vec3(0, 0, 1));
        scene.mass_inv[y] = 0.1;
        scene.touch(x, ground, up, -0.012);
        scene.touch(y, x, up, -0.01);
        EXPECT_EQ(scene.run().uncorrected, 1);
        const double lift_x = scene.position[x].z();
        const double lift_y = scene.position[y].z() - 1;
        EXPECT_NEAR((lift_x + 10 * lift_y) / (11 * freeLift(time_step)), 1, 1e-9) << "both owe for each other";
        EXPECT_GT(lift_y, 0);
        EXPECT_NEAR(scene.contacts[0].distance, -0.012 + lift_x, 1e-15);
        EXPECT_NEAR(scene.contacts[1].distance, -0.01 + lift_y - lift_x, 1e-15);
    }
}

TEST(PositionSweeps, LiftByWhatIsPaidForAndAPartOfAFall) {
    SweepsScene scene;
    scene.time_step = 1.0 / 240;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    scene.v[x] = Vec3(0, 0, -0.1);
    scene.touch(x, ground, up, -0.012);
    scene.run();
    EXPECT_NEAR(scene.position[x].z(), 0.1 * 0.1 / (2 * SweepsScene::gravity) + freeLift(scene.time_step), 1e-12);
    EXPECT_EQ(scene.v[x], Vec3::Zero());
}

TEST(PositionSweeps, LiftFasterWhatIsDeeperThanStepsLetBodiesGet) {
    for (const double depth : {1.3, 2.0, 2.6}) {
        SweepsScene scene;
        scene.time_step = 1.0 / 240;
        const BodyIndex ground = scene.addFixed();
        const BodyIndex x = scene.addBody();
        scene.touch(x, ground, up, -depth * SweepsScene::threshold);
        scene.run();
        EXPECT_NEAR(scene.position[x].z() / (std::pow(depth / 1.3, 8) * freeLift(scene.time_step)), 1, 1e-9);
    }
}

TEST(PositionSweeps, LiftWhatASupportThatMovesCarries) {
    SweepsScene scene;
    scene.time_step = 1.0 / 240;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    scene.v[ground] = scene.v[x] = Vec3(0, 0, 0.5);
    scene.touch(x, ground, up, -0.012);
    scene.run();
    EXPECT_NEAR(scene.position[x].z(), 0.006, 1e-12) << "half of it";
    EXPECT_EQ(scene.v[x], Vec3(0, 0, 0.5));
}

TEST(PositionSweeps, NeverTurnWhomTheyOnlyPush) {
    SweepsScene scene;
    scene.time_step = 1.0 / 240;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    scene.orientation[x].coeffs() *= 1 + 1e-15;
    const Quat before = scene.orientation[x];
    scene.touch(x, ground, up, -0.012);
    scene.run();
    EXPECT_EQ(scene.orientation[x].coeffs(), before.coeffs());
}

TEST(PositionSweeps, NeverReverseWhatHasLessThanItOwes) {
    SweepsScene scene;
    const BodyIndex x = scene.addBody();
    const BodyIndex ground = scene.addFixed();
    scene.v[x] = Vec3(0, 0, -0.1);
    scene.touch(x, ground, up, -0.03);
    scene.run();
    EXPECT_EQ(scene.v[x], Vec3::Zero());
}

TEST(PositionSweeps, KeepMomentumAndEnergyOfPairsThatPay) {
    SweepsScene scene;
    const BodyIndex lower = scene.addBody(Vec3(0.3, 0.1, 0));
    const BodyIndex upper = scene.addBody(Vec3(0, 0, 1));
    scene.mass_inv[lower] = 0.1;
    scene.v[upper] = Vec3(0, 0, -3);
    scene.w[lower] = Vec3(0.5, -1, 2);
    scene.touch(upper, lower, Vec3(0.6, 0, 0.8), -0.03);
    const auto momentum = [&] { return Vec3(10 * scene.v[lower] + scene.v[upper]); };
    const Vec3 linear = momentum();
    const double before = scene.energy();
    const double kinetic = before - SweepsScene::gravity * (10 * scene.position[lower].z() + scene.position[upper].z());
    scene.run();
    EXPECT_TRUE(near(momentum(), linear));
    EXPECT_LT(scene.energy() - SweepsScene::gravity * (10 * scene.position[lower].z() + scene.position[upper].z()),
              kinetic);
    EXPECT_LE(scene.energy(), before + 1e-12);
}

TEST(PositionSweeps, WakeWhomTheyMoveAndGiveNoMotionToSleepers) {
    SweepsScene scene;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    const BodyIndex sleeper = scene.addBody();
    scene.asleep[x] = scene.asleep[sleeper] = 1;
    scene.v[x] = Vec3(0, 0, -1);
    scene.touch(x, ground, up, -0.03);
    scene.touch(sleeper, x, right, -0.001);
    scene.run();
    EXPECT_EQ(scene.asleep[x], 0);
    EXPECT_EQ(scene.woken[x], WakeReason::displaced);
    EXPECT_EQ(scene.asleep[sleeper], 1);
    EXPECT_EQ(scene.v[sleeper], Vec3::Zero());
}

TEST(PositionSweeps, LeaveWhatIsNotFiniteWhereItIs) {
    SweepsScene scene;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    const BodyIndex y = scene.addBody();
    scene.touch(x, ground, up, -INFINITY);
    scene.touch(y, ground, up, -0.03);
    scene.run();
    EXPECT_EQ(scene.position[x], Vec3::Zero());
    EXPECT_NEAR(scene.position[y].z(), 0.015, 1e-12);
}

/// A column of bodies, all too deep in each other.
SweepsScene layeredScene() {
    SweepsScene scene;
    scene.addFixed();
    for (int i = 1; i <= 40; ++i) {
        scene.addBody(Vec3(0, 0, 0.1 * i));
        scene.v[scene.v.size() - 1] = Vec3(0, 0, -1);
        scene.touch(static_cast<BodyIndex>(i), static_cast<BodyIndex>(i - 1), up, -0.012);
    }
    return scene;
}

TEST(PositionSweeps, RepeatThemselvesWhateverTheyDidBefore) {
    PositionSweeps used;
    SweepsScene other;
    other.addBody();
    other.addFixed();
    other.touch(0, 1, up, -0.5);
    other.runWith(used);
    SweepsScene first = layeredScene();
    SweepsScene second = layeredScene();
    first.run();
    second.runWith(used);
    EXPECT_EQ(first.position, second.position);
    EXPECT_EQ(first.v, second.v);
}

}  // namespace
}  // namespace cairn::test
