#include <gtest/gtest.h>

#include <numbers>

#include "oracle.h"
#include "resolution/impulse.h"
#include "resolution/local_batch.h"

namespace cairn::test {
namespace {

/// Gathers a pile's bodies and contacts as the resolution does.
LocalBatch gathered(Pile& pile) {
    std::vector<BodyIndex> bodies;
    for (BodyIndex i = 0; i < pile.kind.size(); ++i) {
        if (pile.kind[i] == BodyKind::dynamic) bodies.push_back(i);
    }
    std::vector<std::uint32_t> indices(pile.contacts.size());
    std::iota(indices.begin(), indices.end(), 0U);
    LocalBatch batch;
    batch.gather({bodies, indices}, pile.contacts, pile.state());
    return batch;
}

/// A ball of 1 kg and radius 0.5 m on the ground: K = diag(1, 3.5, 3.5) in contact coordinates.
struct BallOnGround {
    Pile pile;
    BodyIndex ground, ball;

    explicit BallOnGround(const Vec3& velocity, double restitution = 0, Friction friction = {}) {
        ground = pile.addFixed(Vec3(3, 2, -1));
        ball = pile.addSphere(Vec3(0, 0, 0.5));
        pile.v[ball] = velocity;
        pile.touch(ground, ball, Vec3::Zero(), -Vec3::UnitZ(), restitution, friction);
    }
    Vec3 impulseOnBall() const { return -pile.contacts[0].impulse; }
};

/// A thin rod of 1 kg and 2 m that touches the ground with one end, `angle` from the horizontal; turns about y only.
struct RodOnGround {
    Pile pile;
    BodyIndex ground, rod;

    RodOnGround(double angle, const Vec3& velocity, Friction friction) {
        ground = pile.addFixed();
        Mat3 inertia = 1e6 * Mat3::Identity();
        inertia(1, 1) = 1.0 / 3;
        rod = pile.add(Vec3(-std::cos(angle), 0, std::sin(angle)), 1, inertia);
        pile.v[rod] = velocity;
        pile.touch(ground, rod, Vec3::Zero(), -Vec3::UnitZ(), 0, friction);
    }
};

TEST(ContactBasis, FollowsTheThesisInBothCases) {
    // n2 = 0: y = (n1, -n0, 0)
    const Mat3 horizontal = contactBasis(Vec3(0.6, 0.8, 0));
    EXPECT_TRUE(horizontal.col(0).isApprox(Vec3(0.6, 0.8, 0)));
    EXPECT_TRUE(horizontal.col(1).isApprox(Vec3(0.8, -0.6, 0)));
    EXPECT_TRUE(horizontal.col(2).isApprox(Vec3(0, 0, -1)));
    // otherwise y = (0, n2, -n1), normalised
    const Mat3 tilted = contactBasis(Vec3(0, 0.6, 0.8));
    EXPECT_TRUE(tilted.col(1).isApprox(Vec3(0, 0.8, -0.6)));
    EXPECT_TRUE(tilted.col(2).isApprox(Vec3(-1, 0, 0)));
}

TEST(ContactBasis, IsOrthonormalAndRightHandedForEveryNormal) {
    Random random(1);
    std::vector<Vec3> normals = {Vec3::UnitX(),
                                 Vec3::UnitY(),
                                 Vec3::UnitZ(),
                                 -Vec3::UnitX(),
                                 Vec3(1, 0, 1e-200),
                                 Vec3(1, 1e-160, 1e-160),
                                 Vec3(1, 1e-9, -1e-12).normalized()};
    for (int i = 0; i < 1000; ++i) normals.push_back(random.vector(1).normalized());
    for (const Vec3& n : normals) {
        const Mat3 basis = contactBasis(n);
        EXPECT_TRUE((basis.transpose() * basis).isIdentity(1e-14)) << n.transpose();
        EXPECT_NEAR(basis.determinant(), 1, 1e-14) << n.transpose();
    }
}

TEST(CollisionMatrix, OfTwoBallsIsKnown) {
    // 1/2 + 1/4 along the normal; in the plane r²/I = 1/(0.4 m) of each ball on top.
    Pile pile;
    const BodyIndex a = pile.addSphere(Vec3(0.5, 0, 0), 2), b = pile.addSphere(Vec3(-0.5, 0, 0), 4);
    pile.touch(a, b, Vec3::Zero(), Vec3::UnitX());
    const LocalBatch batch = gathered(pile);
    const Mat3 k = collisionMatrix(batch.contacts[0], batch.bodies[0], batch.bodies[1]).toMatrix();
    EXPECT_TRUE(k.isApprox(Vec3(0.75, 0.75 + 1.875, 0.75 + 1.875).asDiagonal().toDenseMatrix(), 1e-14)) << k;
}

TEST(CollisionMatrix, OfARodOnTheGroundIsKnown) {
    // r = (1/2, 0, -√3/2): Kxx = 1 + 3/4 along the normal -z, coupling ±3·(√3/4), 1 + 9/4 along the ground.
    RodOnGround rod(std::numbers::pi / 3, Vec3::Zero(), {});
    const LocalBatch batch = gathered(rod.pile);
    const ContactFrame& c = batch.contacts[0];
    const Mat3 world =
        c.basis * collisionMatrix(c, batch.bodies[c.a], batch.bodies[c.b]).toMatrix() * c.basis.transpose();
    EXPECT_NEAR(world(2, 2), 1.75, 1e-5);
    EXPECT_NEAR(world(0, 0), 3.25, 1e-5);
    EXPECT_NEAR(world(0, 2), 0.75 * std::sqrt(3.0), 1e-5);
}

TEST(CollisionMatrix, EqualsTheWorldFormulaInContactCoordinates) {
    Pile pile = randomPile(7, 30, 80, 3);
    const LocalBatch batch = gathered(pile);
    for (std::size_t i = 0; i < pile.contacts.size(); ++i) {
        const ContactFrame& frame = batch.contacts[i];
        const Mat3 k = frame.basis.transpose() * worldCollisionMatrix(pile, pile.contacts[i]) * frame.basis;
        EXPECT_TRUE(frame.k_row.isApprox(k.row(0).transpose(), 1e-12));
        EXPECT_TRUE(frame.k_inv.toMatrix().isApprox(k.inverse(), 1e-10));
    }
}

TEST(CollisionMatrix, ThatCannotBeInvertedLeavesTheNormalPartOrNothing) {
    Pile pile;
    const BodyIndex a = pile.addFixed(), b = pile.addSphere(Vec3(0, 0, 0.5));
    pile.touch(a, b, Vec3::Zero(), -Vec3::UnitZ(), 0, {0.5, 0.5});
    LocalBatch batch = gathered(pile);
    ContactFrame& frame = batch.contacts[0];
    LocalBody& ball = batch.bodies[frame.b];
    ball.mass_inv = 1e-150;
    ball.inertia_inv = {};
    batch.updateCollisionMatrixOf(frame);
    ASSERT_TRUE(isResolvable(frame));
    EXPECT_DOUBLE_EQ(contactImpulse(frame, Vec3(-1, 1, 0), 0)[0], 1e150);
    ball.mass_inv = 0;
    batch.updateCollisionMatrixOf(frame);
    EXPECT_FALSE(isResolvable(frame));
    EXPECT_EQ(frame.k_row, Vec3::Zero());
}

TEST(RelativeVelocity, CountsLinearAndAngularPartsOfBothBodies) {
    Pile pile;
    const BodyIndex a = pile.addSphere(Vec3(0.5, 0, 0)), b = pile.addSphere(Vec3(-0.5, 0, 0));
    pile.v[a] = Vec3(-1, 2, 0);
    pile.w[a] = Vec3(0, 0, 3);  // × (-0.5, 0, 0) = (0, -1.5, 0)
    pile.v[b] = Vec3(4, 0, 1);
    pile.w[b] = Vec3(0, 2, 0);  // × (0.5, 0, 0) = (0, 0, -1)
    pile.touch(a, b, Vec3::Zero(), Vec3::UnitX());
    const LocalBatch batch = gathered(pile);
    // relative (-5, 0.5, 0) in W; x = (1,0,0), y = (0,-1,0)
    EXPECT_TRUE(batch.velocityOf(batch.contacts[0]).isApprox(Vec3(-5, -0.5, 0), 1e-14));
}

TEST(Restitution, HeadOnBallsExchangeVelocitiesWhenElastic) {
    Pile pile;
    const BodyIndex a = pile.addSphere(Vec3(0.5, 0, 0)), b = pile.addSphere(Vec3(-0.5, 0, 0));
    pile.v[b] = Vec3(2, 0, 0);
    pile.touch(a, b, Vec3::Zero(), Vec3::UnitX(), 1);
    const ResolutionCounts counts = pile.resolve(exactSettings());
    EXPECT_EQ(counts.global_iterations, 1);
    EXPECT_TRUE(pile.v[a].isApprox(Vec3(2, 0, 0), 1e-14));
    EXPECT_LT(pile.v[b].norm(), 1e-14);
    EXPECT_TRUE(pile.contacts[0].impulse.isApprox(Vec3(2, 0, 0), 1e-14));
}

TEST(Restitution, SeparatesWithItsPartOfTheClosingSpeed) {
    for (const double e : {0.0, 0.25, 0.5, 1.0}) {
        Pile pile = randomPile(11, 2, 1, 0, e, {0.3, 0.2});
        pile.v[0] = -2 * pile.contacts[0].normal;  // closing for certain
        const double before = pile.delta(pile.contacts[0]);
        ASSERT_LT(before, -1);
        pile.resolve(exactSettings());
        EXPECT_NEAR(pile.delta(pile.contacts[0]), -e * before, 1e-13);
    }
}

TEST(Restitution, IsZeroBelowItsThreshold) {
    ResolutionSettings settings = exactSettings();
    settings.restitution_threshold = 0.1;
    BallOnGround slow(Vec3(0, 0, -0.099), 0.5);
    slow.pile.resolve(settings);
    EXPECT_NEAR(slow.pile.v[slow.ball].z(), 0, 1e-15);
    // Algorithm 11 takes e = 0 for δ > −threshold only.
    BallOnGround just(Vec3(0, 0, -0.1), 0.5);
    just.pile.resolve(settings);
    EXPECT_NEAR(just.pile.v[just.ball].z(), 0.05, 1e-15);
}

TEST(ResolutionThreshold, LeavesSlowerContactsAlone) {
    ResolutionSettings settings = exactSettings();
    settings.resolution_threshold = 0.01;
    BallOnGround slow(Vec3(0.2, 0, -0.01), 0.5, {0.4, 0.3});
    EXPECT_EQ(slow.pile.resolve(settings).global_iterations, 0);
    EXPECT_EQ(slow.pile.v[slow.ball], Vec3(0.2, 0, -0.01));
    BallOnGround faster(Vec3(0.2, 0, -0.0101), 0.5, {0.4, 0.3});
    EXPECT_EQ(faster.pile.resolve(settings).global_iterations, 1);
}

TEST(Friction, DoesNotTouchSeparatingContacts) {
    BallOnGround ball(Vec3(1, 2, 0.5), 0.5, {0.4, 0.3});
    EXPECT_EQ(ball.pile.resolve(exactSettings()).global_iterations, 0);
    EXPECT_EQ(ball.pile.v[ball.ball], Vec3(1, 2, 0.5));
    EXPECT_EQ(ball.impulseOnBall(), Vec3::Zero());
}

TEST(Friction, SticksUpToTheStaticCoefficient) {
    // Sticking takes jt = vx/3.5 = 0.39, normal 1.
    BallOnGround ball(Vec3(1.365, 0, -1), 0, {0.4, 0.3});
    ball.pile.resolve(exactSettings());
    EXPECT_TRUE(ball.impulseOnBall().isApprox(Vec3(-0.39, 0, 1), 1e-14));
    const Vec3 at_contact = ball.pile.v[ball.ball] + ball.pile.w[ball.ball].cross(Vec3(0, 0, -0.5));
    EXPECT_LT(at_contact.norm(), 1e-14);
}

TEST(Friction, SlidesWithTheKineticCoefficientBeyond) {
    // Sticking would take jt = 0.41 > µs; sliding leaves µk.
    BallOnGround ball(Vec3(1.435, 0, -1), 0, {0.4, 0.3});
    ball.pile.resolve(exactSettings());
    EXPECT_TRUE(ball.impulseOnBall().isApprox(Vec3(-0.3, 0, 1), 1e-14));
    EXPECT_TRUE(ball.pile.v[ball.ball].isApprox(Vec3(1.135, 0, 0), 1e-14));
    EXPECT_NEAR(ball.pile.w[ball.ball].y(), 0.3 * 0.5 / 0.1, 1e-13);
}

TEST(Friction, WithoutItLeavesTheTangentAlone) {
    BallOnGround ball(Vec3(3, -2, -1), 0.5);
    ball.pile.resolve(exactSettings());
    EXPECT_TRUE(ball.pile.v[ball.ball].isApprox(Vec3(3, -2, 0.5), 1e-14));
    EXPECT_EQ(ball.pile.w[ball.ball], Vec3::Zero());
}

TEST(Friction, IsTheSameForAllHeadings) {
    for (const double speed : {0.5, 5.0}) {  // sticks, slides
        for (int i = 0; i < 16; ++i) {
            const double angle = i * std::numbers::pi / 8;
            const Vec3 heading(std::cos(angle), std::sin(angle), 0);
            BallOnGround ball(speed * heading - Vec3::UnitZ(), 0.25, {0.4, 0.3});
            ball.pile.resolve(exactSettings());
            const Vec3 impulse = ball.impulseOnBall();
            EXPECT_NEAR(impulse.z(), 1.25, 1e-13);
            EXPECT_NEAR(impulse.dot(heading), speed < 1 ? -0.5 / 3.5 : -0.3 * 1.25, 1e-13);
            EXPECT_NEAR(impulse.cross(heading).z(), 0, 1e-13);
        }
    }
}

TEST(Friction, OfACoupledContactReachesTheNormalTargetOnTheKineticCone) {
    // A sliding rod: friction pushes into or out of the ground, (3.5.6) must hold all the same.
    for (const double speed : {-4.0, 4.0}) {
        RodOnGround rod(std::numbers::pi / 3, Vec3(speed, 0, -1), {0.5, 0.4});
        rod.pile.resolve(exactSettings());
        EXPECT_NEAR(rod.pile.delta(rod.pile.contacts[0]), 0, 1e-14);
        const Vec3 impulse = -rod.pile.contacts[0].impulse;
        EXPECT_NEAR(impulse.x(), (speed > 0 ? -0.4 : 0.4) * impulse.z(), 1e-13);
        // target 1 = (Kzz ∓ µk·Kxz)·jz
        EXPECT_NEAR(impulse.z(), 1 / (1.75 - (speed > 0 ? 0.4 : -0.4) * 0.75 * std::sqrt(3.0)), 1e-5);
    }
}

TEST(Friction, ThatWouldPullIsLeftOut) {
    // µk = 2 > µs, which the world refuses: 1.75 − 2 · 1.299 < 0 when the rod slides towards its lean (Painlevé).
    RodOnGround rod(std::numbers::pi / 3, Vec3(4, 0, -1), {0.5, 2});
    rod.pile.resolve(exactSettings());
    const Vec3 impulse = -rod.pile.contacts[0].impulse;
    EXPECT_NEAR(impulse.z(), 1 / 1.75, 1e-5);
    EXPECT_NEAR(impulse.x(), 0, 1e-12);
    EXPECT_NEAR(rod.pile.delta(rod.pile.contacts[0]), 0, 1e-14);
}

TEST(Friction, NeverPullsWhereTheStickingImpulseWould) {
    // Sliding away from its lean, the rod's end would have to be held down to stop: j0 < 0, and |jt| < µs·|j0|.
    RodOnGround rod(std::numbers::pi / 3, Vec3(-40, 0, -1), {2, 1});
    rod.pile.resolve(exactSettings());
    const Vec3 impulse = -rod.pile.contacts[0].impulse;
    EXPECT_NEAR(impulse.z(), 1 / (1.75 + 0.75 * std::sqrt(3.0)), 1e-5);
    EXPECT_NEAR(impulse.x(), impulse.z(), 1e-12);
}

TEST(Friction, AlwaysPushesReachesTheTargetAndStaysInTheCone) {
    Random random(5);
    int sliding = 0, sticking = 0;
    for (int i = 0; i < 20000; ++i) {
        const double mu_s = random.uniform(0, 3), mu_k = mu_s * random.uniform(0, 1);
        RodOnGround rod(random.uniform(0.01, 1.5), Vec3(random.uniform(-9, 9), random.uniform(-9, 9), -1),
                        {mu_s, mu_k});
        rod.pile.w[rod.rod] = random.vector(1);
        if (rod.pile.delta(rod.pile.contacts[0]) > -1e-3) continue;
        rod.pile.resolve(exactSettings());
        const Vec3 impulse = -rod.pile.contacts[0].impulse;
        const double tangent = std::hypot(impulse.x(), impulse.y());
        ASSERT_GT(impulse.z(), 0);
        ASSERT_LE(tangent, mu_s * impulse.z() * (1 + 1e-12));
        ASSERT_NEAR(rod.pile.delta(rod.pile.contacts[0]), 0, 1e-11);
        const Vec3 r = -rod.pile.position[rod.rod];
        const Vec3 left = rod.pile.v[rod.rod] + rod.pile.w[rod.rod].cross(r);
        if (std::hypot(left.x(), left.y()) < 1e-9) {
            ++sticking;
        } else {
            ++sliding;
            ASSERT_LE(tangent, mu_k * impulse.z() * (1 + 1e-12));
        }
    }
    EXPECT_GT(sliding, 1000);
    EXPECT_GT(sticking, 1000);
}

TEST(SingleContact, ConservesMomentumAndNeverGainsEnergyWithoutFriction) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const Friction friction = seed % 2 == 0 ? Friction{} : Friction{0.5, 0.4};
        Pile pile = randomPile(seed, 2, 1, 0, static_cast<double>(seed % 5) / 4, friction);
        pile.v[0] = -2 * pile.contacts[0].normal;
        const Vec3 momentum = pile.momentum(), angular = pile.angularMomentum();
        const double energy = pile.energy();
        ASSERT_EQ(pile.resolve(exactSettings()).global_iterations, 1);
        EXPECT_LT((pile.momentum() - momentum).norm(), 1e-12);
        EXPECT_LT((pile.angularMomentum() - angular).norm(), 1e-12);
        const bool frictionless = seed % 2 == 0;
        EXPECT_TRUE(!frictionless || pile.energy() <= energy * (1 + 1e-13));
    }
}

TEST(SingleContact, ImpulsesOfTheStepAddUp) {
    BallOnGround ball(Vec3(0, 0, -1));
    ball.pile.contacts[0].impulse = Vec3(1, 2, 3);
    ball.pile.resolve(exactSettings());
    EXPECT_TRUE(ball.pile.contacts[0].impulse.isApprox(Vec3(1, 2, 2), 1e-14));
}

}  // namespace
}  // namespace cairn::test
