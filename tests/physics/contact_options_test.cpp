/// Options of the contact law and the diagnostics, on whole worlds against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cairn/world.h"

namespace cairn {
namespace {

constexpr double g = 9.81;

Settings accurate(ResolutionKind kind, double rate = 960) {
    Settings settings = Settings::preset(Preset::accuracy, rate, g);
    settings.integration.exact_flight = true;
    settings.sleep.sleeping = false;
    settings.resolution.resolution = kind;
    settings.resolution.iterations = 1000;
    settings.resolution.tolerance = 0;
    if (kind == ResolutionKind::accelerated_sweeps) settings.resolution.resolution_threshold *= 1e-3;
    return settings;
}

/// A half-space through the origin and one body on it. @param slope of the ground [rad], down along x
struct OnGround {
    World world;
    BodyId id{};

    OnGround(const Settings& settings, const PairProperties& pair, BodyDescription body, double slope = 0)
        : world(settings) {
        world.setGravity(Vec3(g * std::sin(slope), 0, -g * std::cos(slope)));
        body.material = world.addMaterial({.name = "matter", .density = 1000});
        world.setDefaultPairProperties(pair);
        BodyDescription plane;
        plane.shape = HalfSpace{.normal = Vec3::UnitZ(), .offset = 0};
        plane.fixed = true;
        world.addBody(plane);
        id = world.addBody(body);
    }
    void run(double time) {
        while (world.time() < time) world.step();
    }
};

BodyDescription ball(double radius, const Vec3& position) {
    BodyDescription body;
    body.shape = Sphere{radius};
    body.mass = 1;
    body.pose.position = position;
    return body;
}

constexpr PairProperties rolls_hard{
    .restitution = 0, .static_friction = 0.5, .kinetic_friction = 0.5, .rolling_friction = 0.01};

class RollingBall : public testing::TestWithParam<ResolutionKind> {};

TEST_P(RollingBall, SlowsDownAndStops) {
    BodyDescription rolling = ball(0.1, Vec3(0, 0, 0.1));
    rolling.linear_velocity = Vec3(1, 0, 0);
    rolling.angular_velocity = Vec3(0, 10, 0);
    OnGround ground(accurate(GetParam()), rolls_hard, rolling);
    const double deceleration = 5.0 / 7 * 0.01 / 0.1 * g;
    ground.run(1);
    EXPECT_NEAR(ground.world.linearVelocity(ground.id).x(), 1 - deceleration * ground.world.time(), 1e-4);
    ground.run(2);
    EXPECT_LT(ground.world.linearVelocity(ground.id).norm(), 1e-6);
}

TEST_P(RollingBall, StaysOnAnInclineBelowTheAngleOfItsTorqueAndRollsAbove) {
    const double limit = std::atan(0.01 / 0.1);
    OnGround below(accurate(GetParam()), rolls_hard, ball(0.1, Vec3(0, 0, 0.1)), limit - 0.001);
    OnGround above(accurate(GetParam()), rolls_hard, ball(0.1, Vec3(0, 0, 0.1)), limit + 0.01);
    below.run(1);
    above.run(1);
    EXPECT_LT(below.world.pose(below.id).position.x(), 1e-5);
    const double acceleration = 5.0 / 7 * g * (std::sin(limit + 0.01) - 0.1 * std::cos(limit + 0.01));
    EXPECT_NEAR(above.world.linearVelocity(above.id).x(), acceleration, 1e-3 * acceleration);
}

TEST_P(RollingBall, EndsItsSpin) {
    BodyDescription spinning = ball(0.1, Vec3(0, 0, 0.1));
    spinning.angular_velocity = Vec3(0, 0, 10);
    PairProperties pair = rolls_hard;
    pair.spinning_friction = 0.002;
    OnGround ground(accurate(GetParam()), pair, spinning);
    ground.run(0.5);
    const double deceleration = 0.002 * g / (0.4 * 0.01);
    EXPECT_NEAR(ground.world.angularVelocity(ground.id).z(), 10 - deceleration * ground.world.time(), 0.01);
    ground.run(2.5);
    EXPECT_LT(ground.world.angularVelocity(ground.id).norm(), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Resolutions, RollingBall,
                         testing::Values(ResolutionKind::impulse_queue, ResolutionKind::accelerated_sweeps));

TEST(RollingFriction, HoldsAtTheWheelsOfACart) {
    World world(accurate(ResolutionKind::accelerated_sweeps));
    world.setGravity(Vec3(0, 0, -g));
    const MaterialId matter = world.addMaterial({.name = "matter", .density = 1000});
    world.setDefaultPairProperties(rolls_hard);
    BodyDescription plane;
    plane.shape = HalfSpace{.normal = Vec3::UnitZ(), .offset = 0};
    plane.fixed = true;
    plane.material = matter;
    world.addBody(plane);
    BodyDescription frame;
    frame.shape = Box{Vec3(1, 0.3, 0.05)};
    frame.mass = 10;
    frame.pose.position = Vec3(0, 0, 0.1);
    frame.linear_velocity = Vec3(1, 0, 0);
    const BodyId cart = world.addBody(frame);
    for (const double x : {-0.4, 0.4}) {
        for (const double y : {-0.3, 0.3}) {
            BodyDescription wheel = ball(0.1, Vec3(x, y, 0.1));
            wheel.mass = 0.1;
            wheel.linear_velocity = Vec3(1, 0, 0);
            wheel.angular_velocity = Vec3(0, 10, 0);
            JointDescription hinge;
            hinge.kind = JointKind::hinge;
            hinge.a = cart;
            hinge.b = world.addBody(wheel);
            hinge.anchor = Vec3(x, y, 0.1);
            hinge.axis = Vec3::UnitY();
            world.addJoint(hinge);
        }
    }
    while (world.time() < 0.25) world.step();
    // µr·g/r, less what the wheels' inertia gives back: (M + 4m(1 + 2/5))·a = µr·(M + 4m)·g/r.
    const double deceleration = 0.1 * g * 10.4 / 10.56;
    EXPECT_NEAR(world.linearVelocity(cart).x(), 1 - deceleration * world.time(), 1e-4);
}

TEST(RollingFriction, HoldsAtACylinderOnItsSide) {
    BodyDescription rolling = ball(0.1, Vec3(0, 0, 0.1));
    rolling.shape = Cylinder{.radius = 0.1, .length = 0.3};
    rolling.pose.orientation = Quat(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
    rolling.linear_velocity = Vec3(1, 0, 0);
    rolling.angular_velocity = Vec3(0, 10, 0);
    OnGround ground(accurate(ResolutionKind::accelerated_sweeps), rolls_hard, rolling);
    ground.run(1);
    const double deceleration = 2.0 / 3 * 0.01 / 0.1 * g;
    EXPECT_NEAR(ground.world.linearVelocity(ground.id).x(), 1 - deceleration * ground.world.time(), 1e-3);
}

TEST(TouchingRestitution, ReachesTheHeightsOfTenBouncesAtAnyTimeStep) {
    for (const double rate : {240.0, 960.0}) {
        Settings settings = accurate(ResolutionKind::accelerated_sweeps, rate);
        settings.detection.contact_margin = 1e-9;
        settings.resolution.restitution_speed = RestitutionSpeed::touching;
        settings.resolution.restitution_threshold = 1e-4;
        OnGround ground(settings, {.restitution = 0.8, .static_friction = 0, .kinetic_friction = 0},
                        ball(0.1, Vec3(0, 0, 1.1)));
        int bounces = 0;
        double before = 0;
        while (bounces < 10) {
            ground.world.step();
            const double v = ground.world.linearVelocity(ground.id).z();
            if (before < 0 && v > 0) {
                ++bounces;
                const double z = ground.world.pose(ground.id).position.z() - 0.1;
                EXPECT_NEAR((z + v * v / (2 * g)) / std::pow(0.64, bounces), 1, 1e-6) << "bounce " << bounces;
            }
            before = v;
            ASSERT_LT(ground.world.time(), 10);
        }
    }
}

TEST(TouchingRestitution, LetsABallComeToRestAndStay) {
    for (const double rate : {240.0, 960.0}) {
        for (const double restitution : {0.5, 0.9}) {
            Settings settings = accurate(ResolutionKind::impulse_queue, rate);
            settings.detection.contact_margin = 1e-9;
            settings.resolution.restitution_speed = RestitutionSpeed::touching;
            settings.resolution.restitution_threshold = 1e-4;
            OnGround ground(settings, {.restitution = restitution, .static_friction = 0, .kinetic_friction = 0},
                            ball(0.1, Vec3(0, 0, 0.2)));
            ground.run(5);
            for (int i = 0; i < 100; ++i) {
                ground.world.step();
                ASSERT_LT(std::abs(ground.world.linearVelocity(ground.id).z()), 1e-5) << rate << ", " << restitution;
            }
            EXPECT_NEAR(ground.world.pose(ground.id).position.z(), 0.1, 1e-3) << rate << ", " << restitution;
        }
    }
}

/// Elastic balls without friction over each other, in a shaft if asked for.
World elasticBalls(const Settings& settings, int balls, bool shaft) {
    World world(settings);
    world.setGravity(Vec3(0, 0, -g));
    world.addMaterial({.name = "matter", .density = 1000});
    world.setDefaultPairProperties({.restitution = 1, .static_friction = 0, .kinetic_friction = 0});
    for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
        if (normal.z() == 0 && !shaft) continue;
        BodyDescription side;
        side.shape = HalfSpace{.normal = normal, .offset = normal.z() == 0 ? -0.1 : 0};
        side.fixed = true;
        world.addBody(side);
    }
    for (int i = 0; i < balls; ++i) world.addBody(ball(0.05, Vec3(0.01 * (i % 2), 0.02 * (i % 3), 0.5 + 0.25 * i)));
    return world;
}

double energyOf(const World& world) {
    return world.kineticEnergy() + world.potentialEnergy();
}

TEST(ElasticBounce, CompletesTheFlightUntilTheImpact) {
    for (const double rate : {60.0, 100.0, 1000.0}) {
        for (const int balls : {1, 2}) {
            World world = elasticBalls(accurate(ResolutionKind::accelerated_sweeps, rate), balls, false);
            const double first = energyOf(world);
            double most = 0;
            while (world.time() < 5) {
                world.step();
                most = std::max(most, std::abs(energyOf(world) / first - 1));
            }
            EXPECT_LE(most, 1e-12) << rate << " steps/s, balls: " << balls;
        }
    }
}

/// Eight elastic balls fly in a shaft. @return by what part their energy differs at most from what it was
double mostOffInShaft(double rate) {
    Settings settings = Settings::preset(Preset::accuracy, rate, g);
    settings.resolution.impacts = Impacts::sequential;
    World world = elasticBalls(settings, 8, true);
    const double first = energyOf(world);
    double most = 0;
    while (world.time() < 5) {
        world.step();
        most = std::max(most, std::abs(energyOf(world) / first - 1));
    }
    return most;
}

TEST(ElasticBounce, KeepsTheEnergyWhereImpactsFollowEachOtherWithinAStep) {
    EXPECT_LE(mostOffInShaft(1000), 1e-5);
    EXPECT_LE(mostOffInShaft(100), 1e-2);
}

TEST(ElasticBounce, CompletesTheFlightOfWhatAThirdBodyStruckAgainLaterInTheStep) {
    Settings settings = Settings::preset(Preset::accuracy, 100, g);
    settings.resolution.impacts = Impacts::sequential;
    World world = elasticBalls(settings, 0, false);
    BodyDescription one = ball(0.05, Vec3(-0.115, 0, 1));
    one.linear_velocity = Vec3(1, 0, 0);
    BodyDescription third = ball(0.05, Vec3(0.116, 0, 1));
    third.linear_velocity = Vec3(-0.4, 0, 0);
    world.addBody(one);
    const BodyId middle = world.addBody(ball(0.05, Vec3(0, 0, 1)));
    world.addBody(third);
    const double first = energyOf(world);
    world.step();
    // The first ball gave its speed to the middle one, which gave it on for that of the third.
    ASSERT_NEAR(world.linearVelocity(middle).x(), -0.4, 1e-9);
    EXPECT_LE(std::abs(energyOf(world) / first - 1), 1e-12);
}

TEST(ElasticBounce, SeldomLosesEnergyBetweenWallsThatABallReachesBothInAStep) {
    // It is reflected to and fro, as if each wall were where it is at once, until the impacts are too many.
    int losing = 0;
    int rates = 0;
    for (double rate = 60; rate <= 300; rate += 1, ++rates) losing += mostOffInShaft(rate) > 1e-2 ? 1 : 0;
    EXPECT_LE(losing, rates / 10) << "of " << rates;
}

TEST(ContactOptions, RefuseWhatCannotBe) {
    Settings settings = Settings::preset(Preset::accuracy);
    settings.resolution.restitution_law = RestitutionLaw::energetic;
    settings.resolution.impacts = Impacts::simultaneous;
    EXPECT_THROW(World{settings}, InputError);
    World world;
    EXPECT_THROW(world.setDefaultPairProperties({.rolling_friction = -1}), InputError);
    EXPECT_THROW(world.setDefaultPairProperties({.spinning_friction = std::nan("")}), InputError);
}

/// Boxes and balls that tumble onto the ground, one of them spinning.
World tumbling(Settings settings) {
    settings.diagnostics.diagnostics = true;
    World world(settings);
    world.setGravity(Vec3(0, 0, -g));
    const MaterialId matter = world.addMaterial({.name = "matter", .density = 1000});
    world.setDefaultPairProperties({.restitution = 0.4, .static_friction = 0.4, .kinetic_friction = 0.3});
    BodyDescription plane;
    plane.shape = HalfSpace{.normal = Vec3::UnitZ(), .offset = 0};
    plane.fixed = true;
    plane.material = matter;
    world.addBody(plane);
    for (int i = 0; i < 5; ++i) {
        BodyDescription body = ball(0.2, Vec3(0.15 * i, 0.1 * (i % 2), 0.5 + 0.5 * i));
        if (i % 2 == 0) body.shape = Box{Vec3(0.3, 0.2, 0.4)};
        body.angular_velocity = Vec3(i, 2, -1);
        world.addBody(body);
    }
    return world;
}

/// Sum of the magnitudes of what bodies have [N·s].
double momentumOf(const World& world) {
    double sum = 0;
    for (const BodyId id : world.bodies()) {
        if (!world.isFixed(id)) sum += world.mass(id) * world.linearVelocity(id).norm();
    }
    return sum;
}

class Accounts : public testing::TestWithParam<ResolutionKind> {};

TEST_P(Accounts, OfEnergyAndMomentumCloseInEveryStep) {
    World world = tumbling(accurate(GetParam(), 240));
    double friction = 0;
    double restitution = 0;
    for (int i = 0; i < 480; ++i) {
        world.step();
        const Diagnostics& d = world.statistics().diagnostics;
        ASSERT_NEAR(d.energy_error, 0, 1e-11) << "step " << i;
        // Each sweep rounds each velocity.
        const double sweeps = static_cast<double>(world.statistics().global_iterations);
        const double rounding = std::numeric_limits<double>::epsilon() * sweeps * momentumOf(world);
        ASSERT_LT(d.momentum_error, std::max(1e-12, rounding)) << "step " << i;
        ASSERT_NEAR(d.energy, world.kineticEnergy() + world.potentialEnergy(), 1e-12);
        friction += d.energy_friction;
        restitution += d.energy_restitution;
    }
    EXPECT_LT(friction, -1);
    EXPECT_LT(restitution, -1);
}

INSTANTIATE_TEST_SUITE_P(Resolutions, Accounts,
                         testing::Values(ResolutionKind::impulse_queue, ResolutionKind::accelerated_sweeps));

TEST(Diagnostics, CountDampingAndSleepOnAccountsOfTheirOwn) {
    Settings settings = Settings::preset(Preset::performance, 240, g);
    // It leaves resting bodies a little motion that sleep takes; the sweeps leave none.
    settings.resolution.resolution = ResolutionKind::impulse_queue;
    // It holds bodies while it resolves others: what that takes is on no account.
    settings.resolution.shock_propagation = false;
    World world = tumbling(settings);
    Statistics sum;
    double energy = world.kineticEnergy() + world.potentialEnergy();
    for (int i = 0; i < 1200; ++i) {
        world.step();
        sum.add(world.statistics());
    }
    const Diagnostics& d = sum.diagnostics;
    EXPECT_NE(d.energy_damping, 0);
    EXPECT_NE(d.energy_correction, 0);
    EXPECT_LT(d.energy_sleep, 0);
    energy += d.energy_flight + d.energy_forces + d.energy_damping + d.energy_friction + d.energy_restitution +
              d.energy_joints + d.energy_correction + d.energy_sleep;
    EXPECT_NEAR(energy, d.energy, 1e-8);
    EXPECT_NEAR(d.energy_error, 0, 1e-8);
}

TEST(Diagnostics, SeeThatASlidingBoxDissipatesAsMuchAsItCan) {
    Settings settings = accurate(ResolutionKind::accelerated_sweeps);
    settings.diagnostics.diagnostics = true;
    BodyDescription box = ball(0.1, Vec3(0, 0, 0.1));
    box.shape = Box{Vec3::Constant(0.2)};
    box.linear_velocity = Vec3(2, 0, 0);
    OnGround ground(settings, {.restitution = 0, .static_friction = 0.3, .kinetic_friction = 0.3}, box);
    for (int i = 0; i < 200; ++i) {
        ground.world.step();
        const Diagnostics& d = ground.world.statistics().diagnostics;
        EXPECT_LT(d.signorini, 1e-10);
        EXPECT_LT(d.de_saxce, 1e-8);
        EXPECT_LT(d.dissipation, 1e-8);
        const double weight = g / 960;
        EXPECT_NEAR(d.fixed_impulse.z(), weight, 1e-9);
        EXPECT_NEAR(d.fixed_impulse.x(), -0.3 * weight, 1e-9);
        EXPECT_NEAR(d.force_impulse.z(), -weight, 1e-12);
    }
}

TEST(Diagnostics, AreZeroUnlessAskedFor) {
    World world = tumbling(accurate(ResolutionKind::impulse_queue));
    Settings settings = world.settings();
    settings.diagnostics.diagnostics = false;
    world.setSettings(settings);
    world.step();
    EXPECT_EQ(world.statistics().diagnostics.energy, 0);
    EXPECT_EQ(world.statistics().diagnostics.momentum, Vec3::Zero());
}

TEST(Diagnostics, DoNotChangeWhatHappens) {
    World with = tumbling(accurate(ResolutionKind::impulse_queue));
    World without = tumbling(accurate(ResolutionKind::impulse_queue));
    Settings settings = without.settings();
    settings.diagnostics.diagnostics = false;
    without.setSettings(settings);
    for (int i = 0; i < 300; ++i) {
        with.step();
        without.step();
        ASSERT_EQ(with.stateHash(), without.stateHash());
    }
}

TEST(Diagnostics, CountWhatAHingeGives) {
    Settings settings = accurate(ResolutionKind::impulse_queue);
    settings.diagnostics.diagnostics = true;
    World world(settings);
    world.setGravity(Vec3(0, 0, -g));
    world.addMaterial({.name = "matter", .density = 1000});
    JointDescription pendulum;
    pendulum.kind = JointKind::ball;
    pendulum.a = world.addBody(ball(0.1, Vec3(1, 0, 0)));
    pendulum.anchor = Vec3::Zero();
    world.addJoint(pendulum);
    Vec3 from_hinge = Vec3::Zero();
    Vec3 from_gravity = Vec3::Zero();
    for (int i = 0; i < 500; ++i) {
        world.step();
        const Diagnostics& d = world.statistics().diagnostics;
        ASSERT_LT(d.momentum_error, 1e-9) << i;
        ASSERT_LT(d.angular_momentum_error, 1e-4) << i;
        from_hinge += d.fixed_impulse;
        from_gravity += d.force_impulse;
    }
    EXPECT_GT(from_hinge.norm(), 1);
    EXPECT_LT((from_hinge + from_gravity - world.linearMomentum()).norm(), 1e-9);
}

}  // namespace
}  // namespace cairn
