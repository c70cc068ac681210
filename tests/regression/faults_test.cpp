/// Faults and extremes that a world survives: nothing spreads, nothing explodes, nothing fails silently.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "cairn/world.h"

namespace cairn {
namespace {

/// A world with a floor and one material, e = 0 and µ = 0.5, whose steps check themselves.
struct Ground {
    explicit Ground(const Settings& settings = Settings::preset(Preset::performance), const Vec3& gravity = {0, 0, -10})
        : world(settings) {
        oak = world.addMaterial({"oak", 800});
        world.setDefaultPairProperties({.restitution = 0, .static_friction = 0.5, .kinetic_friction = 0.5});
        world.setGravity(gravity);
        world.setChecks(Checks::on);
        ground = world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
    }

    BodyId add(const Shape& shape, const Vec3& position, std::optional<double> mass = {}) {
        return world.addBody({.shape = shape, .material = oak, .mass = mass, .pose = {position, Quat::Identity()}});
    }
    BodyId box(double size, const Vec3& position) { return add(Box{Vec3::Constant(size)}, position); }
    void step(int steps) {
        for (int i = 0; i < steps; ++i) world.step();
    }
    double height(BodyId id) const { return world.pose(id).position.z(); }

    World world;
    MaterialId oak{};
    BodyId ground;
};

/// The largest speed of any body [m/s].
double fastest(const World& world) {
    double speed = 0;
    for (const BodyId id : world.bodies()) speed = std::max(speed, world.linearVelocity(id).norm());
    return speed;
}

std::uint64_t splitmix(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

/// A number within ±1.
double uniform(std::uint64_t& state) {
    return static_cast<double>(splitmix(state) >> 11U) * 0x1p-52 - 1;
}

TEST(Faults, AnOverflowingBodyIsFrozenAndItsNeighboursStand) {
    for (std::size_t victim = 1; victim <= 5; ++victim) {
        Ground g;
        std::vector<BodyId> tower;
        for (int i = 0; i < 5; ++i) tower.push_back(g.box(0.1, Vec3(0, 0, 0.05 + 0.1 * i)));
        g.step(120);
        const BodyId id = tower[victim - 1];
        const Vec3 place = g.world.pose(id).position;
        // 1e30 N·s on 0.8 kg, added up until no number can hold it.
        g.world.setLinearVelocity(id, Vec3(1e9, 0, 0));
        g.world.applyImpulse(id, Vec3(1e30, 0, 0));
        g.step(120);
        ASSERT_EQ(g.world.faults().size(), 1U);
        EXPECT_EQ(g.world.faults()[0].body, id);
        EXPECT_EQ(g.world.faults()[0].step, 121);
        EXPECT_NE(g.world.faults()[0].what.find("velocity"), std::string::npos);
        EXPECT_TRUE(g.world.isFixed(id));
        EXPECT_EQ(g.world.pose(id).position, place);
        for (std::size_t i = 0; i < tower.size(); ++i) {
            EXPECT_NEAR(g.height(tower[i]), 0.05 + 0.1 * static_cast<double>(i), 2e-3) << victim << ' ' << i;
        }
    }
}

TEST(Faults, AHugeVelocityWithinTheLimitsHarmsNobodyElse) {
    Ground g;
    std::vector<BodyId> tower;
    for (int i = 0; i < 5; ++i) tower.push_back(g.box(0.1, Vec3(0, 0, 0.05 + 0.1 * i)));
    g.step(60);
    g.world.setLinearVelocity(tower[4], Vec3(0, 0, 9e8));
    g.world.setAngularVelocity(tower[4], Vec3(1e8, 1e8, -1e8));
    g.step(120);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(g.height(tower[i]), 0.05 + 0.1 * static_cast<double>(i), 2e-3);
    }
    EXPECT_LT(fastest(g.world), 1e9);
}

TEST(Faults, ThousandsInsideEachOtherSeparateWithoutAnExplosion) {
    for (const bool on_the_floor : {false, true}) {
        Ground g(Settings::preset(Preset::performance), on_the_floor ? Vec3(0, 0, -10) : Vec3::Zero());
        std::uint64_t random = 7;
        const Vec3 centre(0, 0, on_the_floor ? 0.5 : 100);
        for (int i = 0; i < 1500; ++i) {
            const Vec3 offset = 0.4 * Vec3(uniform(random), uniform(random), uniform(random));
            const Shape shapes[] = {Sphere{0.05}, Box{Vec3(0.1, 0.1, 0.1)}, Capsule{0.03, 0.06}};
            g.add(shapes[i % 3], centre + offset);
        }
        const double energy = g.world.kineticEnergy() + g.world.potentialEnergy();
        double first_overlap = 0;
        std::int64_t penetrating = 0;
        double speed = 0;
        for (int i = 0; i < 90; ++i) {
            g.world.step();
            const Statistics& statistics = g.world.statistics();
            if (i == 0) first_overlap = statistics.largest_overlap;
            if (i == 0) penetrating = statistics.corrected_contacts + statistics.uncorrected_contacts;
            speed = std::max(speed, fastest(g.world));
        }
        EXPECT_TRUE(g.world.faults().empty());
        EXPECT_GT(penetrating, 1500) << "they were inside each other";
        // A fall from the top of the heap takes √(2·10·1) m/s; without gravity nothing may move at all.
        EXPECT_LT(speed, on_the_floor ? 6 : 1e-9);
        if (!on_the_floor) {
            EXPECT_LE(g.world.kineticEnergy() + g.world.potentialEnergy(), energy + 1e-9);
        }
        EXPECT_LT(g.world.statistics().mean_overlap, 0.2 * first_overlap);
    }
}

TEST(Faults, HundredsAtOnePlaceSeparateWithoutAnExplosion) {
    for (const bool falling : {false, true}) {
        Ground g(Settings::preset(Preset::performance), falling ? Vec3(0, 0, -10) : Vec3::Zero());
        std::uint64_t random = 3;
        for (int i = 0; i < 200; ++i) {
            const Shape shapes[] = {Sphere{0.1}, Box{Vec3(0.2, 0.1, 0.15)}, Capsule{0.05, 0.1}};
            const Quat turn(2, uniform(random), uniform(random), uniform(random));
            g.world.addBody({.shape = shapes[i % 3], .material = g.oak, .pose = {Vec3(0, 0, 1), turn}});
        }
        double speed = 0;
        for (int i = 0; i < 150; ++i) {
            g.world.step();
            speed = std::max(speed, fastest(g.world));
        }
        EXPECT_TRUE(g.world.faults().empty());
        // A fall from the top of the heap, which grows to about 2 m, takes √(2·10·2) m/s.
        EXPECT_LT(speed, falling ? 7 : 1e-9);
        EXPECT_LT(g.world.statistics().largest_overlap, 0.01);
        int apart = 0;
        for (const BodyId id : g.world.bodies()) {
            if (id != g.ground && (g.world.pose(id).position - Vec3(0, 0, 1)).norm() > 0.1) ++apart;
        }
        EXPECT_GT(apart, 100);
    }
}

TEST(Faults, NumbersThatAreNotFiniteAreRefusedByEveryCall) {
    Ground g;
    const BodyId a = g.box(1, Vec3(0, 0, 0.5));
    const BodyId b = g.box(1, Vec3(3, 0, 0.5));
    const SpringId spring = g.world.addSpring({.a = a, .b = b, .stiffness = 1, .rest_length = 3});
    const JointId hinge = g.world.addJoint({.kind = JointKind::hinge, .a = b, .anchor = Vec3(3, 0, 0.5)});
    const auto before = g.world.save();
    const double infinity = std::numeric_limits<double>::infinity();
    World& w = g.world;
    for (const double bad : {std::nan(""), infinity, -infinity}) {
        const Vec3 v(0, bad, 0);
        const Vec3 good(1, 0, 0);
        EXPECT_THROW(w.applyForce(a, v), InputError);
        EXPECT_THROW(w.applyForceAt(a, v, good), InputError);
        EXPECT_THROW(w.applyForceAt(a, good, v), InputError);
        EXPECT_THROW(w.applyTorque(a, v), InputError);
        EXPECT_THROW(w.applyImpulse(a, v), InputError);
        EXPECT_THROW(w.applyImpulseAt(a, v, good), InputError);
        EXPECT_THROW(w.applyImpulseAt(a, good, v), InputError);
        EXPECT_THROW(w.applyAngularImpulse(a, v), InputError);
        EXPECT_THROW(w.setConstantForce(a, v), InputError);
        EXPECT_THROW(w.setConstantTorque(a, v), InputError);
        EXPECT_THROW(w.setLinearVelocity(a, v), InputError);
        EXPECT_THROW(w.setAngularVelocity(a, v), InputError);
        EXPECT_THROW(w.setPose(a, {v, Quat::Identity()}), InputError);
        EXPECT_THROW(w.setPose(a, {good, Quat(1, bad, 0, 0)}), InputError);
        EXPECT_THROW(w.setGravity(v), InputError);
        EXPECT_THROW(w.setGlobalAcceleration(v), InputError);
        EXPECT_THROW(w.setDefaultPairProperties({.static_friction = bad}), InputError);
        EXPECT_THROW(w.addMaterial({"bad", bad}), InputError);
        EXPECT_THROW(g.add(Sphere{bad}, good), InputError);
        EXPECT_THROW(g.add(Sphere{1}, v), InputError);
        EXPECT_THROW(g.add(Sphere{1}, good, bad), InputError);
        EXPECT_THROW(w.addBody({.material = g.oak, .linear_velocity = v}), InputError);
        EXPECT_THROW(w.addSpring({.a = a, .stiffness = bad}), InputError);
        EXPECT_THROW(w.setSpringAnchor(spring, v), InputError);
        EXPECT_THROW(w.addJoint({.a = a, .anchor = v}), InputError);
        EXPECT_THROW(w.setJointMotor(hinge, {bad, 1}), InputError);
        EXPECT_THROW(w.setJointLimits(hinge, bad, 1), InputError);
        Settings settings = w.settings();
        settings.steps_per_second = bad;
        EXPECT_THROW(w.setSettings(settings), InputError);
    }
    World same = World::restore(before);
    w.step();
    same.step();
    EXPECT_EQ(w.stateHash(), same.stateHash()) << "a refused call leaves the world as it was";
}

TEST(Extremes, AMillionMetresFromTheOriginABoxRestsAndSleeps) {
    Ground g;
    const BodyId box = g.box(1, Vec3(1e6, -1e6, 0.5));
    const BodyId upper = g.box(1, Vec3(1e6, -1e6, 1.5));
    g.step(480);
    EXPECT_NEAR(g.height(box), 0.5, 2e-3);
    EXPECT_NEAR(g.height(upper), 1.5, 2e-3);
    EXPECT_TRUE(g.world.isAsleep(box));
    EXPECT_NEAR(g.world.pose(box).position.x(), 1e6, 1e-3);
}

TEST(Extremes, MillimetresAndKilometresShareAScene) {
    Ground g;
    Settings s = g.world.settings();
    s.detection.contact_margin = 1e-5;
    s.correction.penetration_threshold = 1e-4;
    g.world.setSettings(s);
    const BodyId mountain = g.add(Sphere{1000}, Vec3(0, 0, 1000));
    g.world.setFixed(mountain, true);
    const BodyId grain = g.add(Sphere{0.0005}, Vec3(0, 0, 2000.0005));
    const BodyId dust = g.add(Box{Vec3::Constant(0.001)}, Vec3(3000, 0, 0.0005));
    const BodyId hall = g.add(Box{Vec3(1000, 1000, 1000)}, Vec3(-5000, 0, 500));
    const BodyId crumb = g.add(Box{Vec3::Constant(0.001)}, Vec3(-5000, 0, 1000.0005));
    g.step(240);
    EXPECT_TRUE(g.world.faults().empty());
    EXPECT_NEAR(g.height(grain), 2000.0005, 3e-4);
    EXPECT_NEAR(g.height(dust), 0.0005, 3e-4);
    EXPECT_NEAR(g.height(hall), 500, 1e-2);
    EXPECT_NEAR(g.height(crumb), 1000.0005, 1e-2);
}

TEST(Extremes, AMassRatioOfAMillionNeitherExplodesNorSinks) {
    for (const ResolutionKind kind : {ResolutionKind::impulse_queue, ResolutionKind::accelerated_sweeps}) {
        Settings settings = Settings::preset(Preset::performance);
        settings.resolution.resolution = kind;
        Ground g(settings);
        // A contact of such bodies is only nearly resolved: a step may add a thousandth to the kinetic energy, which
        // the checks refuse.
        g.world.setChecks(Checks::state);
        const BodyId light = g.add(Box{Vec3::Constant(1)}, Vec3(0, 0, 0.5), 1e-3);
        const BodyId heavy = g.add(Box{Vec3::Constant(1)}, Vec3(0, 0, 1.5), 1e3);
        for (int i = 0; i < 480; ++i) {
            g.world.step();
            // The resolution may fail to hold the heavy box up; then it is no faster than if it fell.
            ASSERT_LT(g.world.linearVelocity(heavy).norm(), 10 * g.world.time() + 1) << i;
            ASSERT_LT(fastest(g.world), 50) << "the light box, squeezed out, at step " << i;
        }
        EXPECT_TRUE(g.world.faults().empty());
        EXPECT_GT(g.height(light), 0.45);
        EXPECT_GT(g.height(heavy), 0.45);
    }
}

TEST(Extremes, TimeStepsFromAMicrosecondToAThirtiethGiveNoGarbage) {
    for (const double rate : {20.0, 30.0, 60.0, 180.0, 1e4, 1e6}) {
        Ground g(Settings::preset(Preset::performance, rate));
        const BodyId box = g.box(0.1, Vec3(0, 0, 0.05));
        const BodyId ball = g.add(Sphere{0.05}, Vec3(1, 0, 0.0501));
        const double seconds = std::min(1.0, 2000 / rate);
        g.step(static_cast<int>(seconds * rate));
        EXPECT_TRUE(g.world.faults().empty());
        EXPECT_NEAR(g.height(box), 0.05, 5e-3) << rate;
        EXPECT_NEAR(g.height(ball), 0.05, 5e-3) << rate;
        EXPECT_NEAR(g.world.time(), seconds, 1e-9) << rate;
    }
    EXPECT_THROW(Settings::preset(Preset::performance, 0.9e-3), InputError);
    EXPECT_THROW(Settings::preset(Preset::performance, 1.1e6), InputError);
}

TEST(Extremes, GravityMayVanishTurnAndGrow) {
    Ground g;
    Settings s = g.world.settings();
    s.sleep.sleeping = false;
    s.sleep.damping = 0;
    g.world.setSettings(s);
    const BodyId ball = g.add(Sphere{0.1}, Vec3(0, 0, 5));
    g.world.setGravity(Vec3::Zero());
    g.step(240);
    EXPECT_EQ(g.height(ball), 5) << "weightless";
    g.world.setGravity(Vec3(0, 0, 1));
    g.step(240);
    EXPECT_NEAR(g.height(ball), 5.5, 0.01);
    g.world.setGravity(Vec3(0, 0, -1000));
    g.step(240);
    EXPECT_NEAR(g.height(ball), 0.1, 0.1) << "pressed onto the floor by 100 g";
    EXPECT_GT(g.height(ball), 0);
    g.world.setGravity(Vec3(0, 0, -1e6));
    g.step(240);
    EXPECT_TRUE(g.world.faults().empty());
    EXPECT_TRUE(g.world.pose(ball).position.allFinite());
    EXPECT_THROW(g.world.setGravity(Vec3(0, 0, std::numeric_limits<double>::infinity())), InputError);
}

TEST(Faults, ASleepingPileFallsWhenItsSupportIsRemoved) {
    Ground g;
    const BodyId table = g.world.addBody(
        {.shape = Box{Vec3(2, 2, 0.1)}, .material = g.oak, .pose = {Vec3(0, 0, 1), Quat::Identity()}, .fixed = true});
    std::vector<BodyId> pile;
    for (int i = 0; i < 5; ++i) pile.push_back(g.box(0.1, Vec3(0, 0, 1.1 + 0.1 * i)));
    for (int i = 0; i < 2000 && g.world.statistics().asleep < 5; ++i) g.world.step();
    ASSERT_EQ(g.world.statistics().asleep, 5);
    g.world.removeBody(table);
    g.step(480);
    for (const BodyId id : pile) EXPECT_LT(g.height(id), 0.6) << "still hangs in the air";
}

TEST(Limits, OneMaterialTooManyIsRefused) {
    World world;
    for (int i = 0; i < 256; ++i) world.addMaterial({"material " + std::to_string(i), 1000});
    EXPECT_THROW(world.addMaterial({"one more", 1000}), InputError);
    EXPECT_EQ(world.materials().size(), 256U);
}

TEST(Limits, PlacesAndSpeedsBeyondThemAreRefusedWithTheLimit) {
    Ground g;
    const auto refusal = [](const auto& action) -> std::string {
        try {
            action();
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const BodyId box = g.box(1, Vec3(0, 0, 0.5));
    EXPECT_NE(refusal([&] { g.box(1, Vec3(1.1e12, 0, 0)); }).find("within ±1000000000000 m"), std::string::npos);
    EXPECT_NE(refusal([&] { g.world.setLinearVelocity(box, Vec3(0, 1.1e9, 0)); }).find("within ±1000000000 m/s"),
              std::string::npos);
    EXPECT_EQ(g.world.bodyCount(), 2U);
    EXPECT_NE(refusal([&] { g.add(Sphere{1}, Vec3(0, 0, 1), 1.1e30); }).find("within 1e-30 and 1e+30 kg"),
              std::string::npos);
    EXPECT_NE(refusal([&] { g.add(Sphere{1}, Vec3(0, 0, 1), 0.9e-30); }).find("within 1e-30 and 1e+30 kg"),
              std::string::npos);
    EXPECT_NE(refusal([&] { g.world.setGravity(Vec3(0, 8e11, 8e11)); }).find("up to 1000000000000 m/s²"),
              std::string::npos);
    EXPECT_EQ(g.world.bodyCount(), 2U);
}

TEST(Faults, CallsInAWrongOrderAreRefusedByName) {
    World world;
    EXPECT_THROW(world.addBody({}), InputError) << "no material yet";
    EXPECT_THROW(world.pose(BodyId{}), StaleIdError);
    EXPECT_THROW(world.removeBody(BodyId{0, 0}), StaleIdError);
    EXPECT_THROW(world.addSpring({}), StaleIdError);
    EXPECT_THROW(world.removeSpring(SpringId{}), StaleIdError);
    EXPECT_THROW(world.setPairProperties(MaterialId{0}, MaterialId{0}, {}), InputError);
    EXPECT_THROW(world.pairProperties(MaterialId{0}, MaterialId{0}), InputError);
    EXPECT_THROW(World::restore({}), InputError);
    world.step();
    EXPECT_TRUE(world.contacts().empty());
    EXPECT_TRUE(world.batches().empty());
    const MaterialId oak = world.addMaterial({"oak", 800});
    const BodyId a = world.addBody({.material = oak});
    const BodyId b = world.addBody({.material = oak, .pose = {Vec3(2, 0, 0), Quat::Identity()}});
    const SpringId spring = world.addSpring({.a = a, .b = b, .stiffness = 1, .rest_length = 2});
    world.removeBody(b);
    EXPECT_THROW(world.setSpringAnchor(spring, Vec3::Zero()), StaleIdError) << "gone with its body";
    EXPECT_THROW(world.removeBody(b), StaleIdError);
    world.setFixed(a, true);
    EXPECT_THROW(world.applyForce(a, Vec3(1, 0, 0)), InputError);
    world.step();
    World other;
    EXPECT_THROW(other.wake(a), StaleIdError) << "of another world";
}

}  // namespace
}  // namespace cairn
