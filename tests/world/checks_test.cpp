/// The checks of a step notice what they are for, and sound runs pass them.
#include "world/checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "world/totals.h"
#include "world/world_state.h"

namespace cairn {
namespace {

/// Two boxes on the floor after some steps.
class Checked {
  public:
    Checked() : state(Settings::preset(Preset::performance)) {
        state.materials.add({"oak", 800});
        state.gravity = Vec3(0, 0, -10);
        add(HalfSpace{}, Vec3::Zero(), BodyKind::fixed);
        add(Box{Vec3::Constant(1)}, Vec3(0, 0, 0.499), BodyKind::dynamic);
        add(Box{Vec3::Constant(1)}, Vec3(0, 0, 1.498), BodyKind::dynamic);
        state.checks = Checks::on;
        for (int i = 0; i < 3; ++i) stepWorld(state);
    }

    WorldState state;

  private:
    void add(const Shape& shape, const Vec3& position, BodyKind kind) {
        BodyStorage& b = state.bodies;
        const BodyIndex i = b.allocate(kind);
        b.shape[i] = shape;
        b.position[i] = position;
        b.mass[i] = 1;
        b.inertia_B[i] = Vec3(0.1, 0.2, 0.3);
        b.r_max[i] = 1;
        b.motion[i] = 1;
        b.updateMassProperties(i);
    }
};

std::string broken(const std::function<void(WorldState&)>& breaking) {
    Checked world;
    breaking(world.state);
    try {
        checkBatches(world.state);
        checkState(world.state);
    } catch (const InvariantError& error) {
        return error.what();
    }
    return "";
}

TEST(StateChecks, PassASoundWorld) {
    EXPECT_EQ(broken([](WorldState&) {}), "");
}

TEST(StateChecks, NameStepBodyAndWhatIsBroken) {
    const auto expect = [](const char* part, const std::function<void(WorldState&)>& breaking) {
        const std::string text = broken(breaking);
        EXPECT_EQ(text.find("time step 3: "), 0U) << text;
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    expect("body 1 has a position", [](WorldState& w) { w.bodies.position[1].x() = std::nan(""); });
    expect("body 2 has a velocity", [](WorldState& w) { w.bodies.w[2].x() = std::nan(""); });
    expect("body 1 has an orientation of length 1.1", [](WorldState& w) { w.bodies.orientation[1].coeffs() *= 1.1; });
    expect("not symmetric", [](WorldState& w) { w.bodies.inertiaInv_W[1](0, 1) += 1; });
    expect("does not follow", [](WorldState& w) { w.bodies.inertiaInv_W[1](0, 0) += 1; });
    expect("is fixed but moves", [](WorldState& w) { w.bodies.v[0].x() = 1; });
    expect("sleeps but moves", [](WorldState& w) {
        w.bodies.asleep[1] = 1;
        w.bodies.v[1].x() = 1;
    });
    expect("normal of length 2", [](WorldState& w) { w.data.contacts[1].normal *= 2; });
    expect("not finite", [](WorldState& w) { w.data.contacts[1].impulse.x() = std::nan(""); });
    expect("out of order", [](WorldState& w) { std::swap(w.data.contacts.front(), w.data.contacts.back()); });
    expect("not in the world", [](WorldState& w) { w.data.contacts[0].b = 77; });
    expect("is lost", [](WorldState& w) { w.data.batches.batch_of_contact.assign(8, 1); });
    expect("another number of contacts", [](WorldState& w) { w.data.contacts.pop_back(); });
}

TEST(StateChecks, NoticeEnergyFromNowhere) {
    Checked world;
    const double energy = kineticEnergyOf(world.state.bodies).rounded();
    EXPECT_NO_THROW(checkEnergy(world.state, energy));
    world.state.bodies.v[1] = Vec3(0, 0, 1);
    EXPECT_THROW(checkEnergy(world.state, energy), InvariantError);
}

/// A rod that strikes the ground askew. @return its kinetic energy before and after the impact [J]
std::pair<double, double> strikeAskew(RestitutionLaw law) {
    Settings settings = Settings::preset(Preset::accuracy);
    settings.resolution.resolution = ResolutionKind::impulse_queue;
    settings.resolution.restitution_law = law;
    World world(settings);
    world.setChecks(Checks::on);
    const MaterialId oak = world.addMaterial({"oak", 800});
    world.setDefaultPairProperties({.restitution = 0.9, .static_friction = 1, .kinetic_friction = 1});
    world.addBody({.shape = HalfSpace{}, .material = oak, .fixed = true});
    const double slope = 0.7;
    const Pose pose{Vec3(0, 0, 0.5 * std::sin(slope) + 0.1001),
                    Quat(Eigen::AngleAxisd(M_PI / 2 - slope, Vec3::UnitY()))};
    world.addBody({.shape = Capsule{0.1, 1}, .material = oak, .pose = pose, .linear_velocity = Vec3(0.5, 0, -1)});
    const double before = world.kineticEnergy();
    for (int i = 0; i < 10; ++i) world.step();
    return {before, world.kineticEnergy()};
}

TEST(StateChecks, LetNewtonsLawOfImpactRaiseTheEnergy) {
    const auto [before, after] = strikeAskew(RestitutionLaw::newton);
    EXPECT_GT(after, 1.05 * before);
    const auto [kept, energetic] = strikeAskew(RestitutionLaw::energetic);
    EXPECT_LT(energetic, kept);
}

}  // namespace
}  // namespace cairn
