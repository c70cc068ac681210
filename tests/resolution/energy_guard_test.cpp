/// No resolution that begins with the impulses of the last step raises the kinetic energy of a batch.
#include <gtest/gtest.h>

#include "resolution/batch_fixture.h"

namespace cairn {
namespace {

using test::Pile;

ResolutionSettings fewSweeps() {
    ResolutionSettings settings = test::exactSettings();
    settings.resolution = ResolutionKind::accelerated_sweeps;
    settings.restitution_threshold = 0.05;
    settings.iterations = 1;
    return settings;
}

/// A chain of balls on a table. @param last impulse that each contact had in the step before [N·s]
Pile chain(double last) {
    Pile pile;
    const BodyIndex ground = pile.addFixed(Vec3(0, 0, -1));
    for (int i = 0; i < 10; ++i) {
        const BodyIndex ball = pile.addSphere(Vec3(0, 0, 0.5 + i), i % 2 == 0 ? 1 : 30);
        pile.touch(ball == 1 ? ground : ball - 1, ball, Vec3(0, 0, i), -Vec3::UnitZ(), 0, {0.5, 0.5});
        pile.contacts.back().last_impulse = -last * Vec3::UnitZ();
        pile.v[ball] = Vec3(0, 0, -0.01);
    }
    return pile;
}

TEST(EnergyGuard, ForgetsImpulsesOfAnotherSituation) {
    Pile pile = chain(50);
    const double before = pile.energy();
    pile.resolve(fewSweeps());
    EXPECT_LE(pile.energy(), before * (1 + 1e-12));
    for (const Contact& contact : pile.contacts) EXPECT_LT(contact.impulse.norm(), 10);
    EXPECT_GT(pile.contacts[0].impulse.norm(), 0.01) << "the ball on the table was stopped";
}

TEST(EnergyGuard, LetsAMovingSupportGiveItsWorkOnly) {
    for (const double speed : {1e-3, 0.1, 1.0}) {
        Pile pile = chain(50);
        pile.v[0] = Vec3(0, 0, speed);
        const double before = pile.energy();
        pile.resolve(fewSweeps());
        const double given = speed * pile.contacts[0].impulse.norm();
        EXPECT_LE(pile.energy(), before + given + 0.01 * (before + given)) << speed;
        EXPECT_LT(pile.contacts[0].impulse.norm(), 10 + 100 * speed);
        EXPECT_GT(pile.v[1].z(), 0.5 * speed) << "it is carried along";
    }
}

TEST(EnergyGuard, LeavesGoodImpulsesAlone) {
    Pile cold = chain(0);
    Pile warm = cold;
    cold.resolve(fewSweeps());
    for (std::size_t i = 0; i < warm.contacts.size(); ++i) warm.contacts[i].last_impulse = cold.contacts[i].impulse;
    warm.resolve(fewSweeps());
    EXPECT_LT(warm.energy(), cold.energy());
}

}  // namespace
}  // namespace cairn
