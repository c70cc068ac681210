#include "correction/candidate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "correction/contact_scene.h"

namespace cairn::test {
namespace {

constexpr double left_over = -0.001;  // f·thr_pen

/// A above B: n = (0, 0, 1), 5 mm deep, so that d_c = −4 mm.
struct Pair : ContactScene {
    BodyIndex a = addBody({0, 0, 1});
    BodyIndex b = addBody({0, 0, 0});
    std::uint32_t contact = touch(a, b, Vec3::UnitZ(), -0.005);

    CandidateList candidates() { return listCandidates(contacts[contact], state(), left_over); }
};

const Candidate* find(const CandidateList& list, BodyIndex body, CandidateKind kind) {
    for (const Candidate& candidate : list) {
        if (candidate.body == body && candidate.kind == kind) return &candidate;
    }
    return nullptr;
}

TEST(Candidate, CorrectionDistanceLeavesAPartOfTheThreshold_Eq2_5_4) {
    Contact contact;
    contact.distance = -0.005;
    EXPECT_DOUBLE_EQ(correctionDistance(contact, left_over), -0.004);
}

TEST(Candidate, LeavesAlongTheNormal_Eq2_3_1_Figure4_Figure5a) {
    Pair pair;
    const CandidateList list = pair.candidates();
    ASSERT_EQ(list.size(), 2U);
    const Candidate* of_a = find(list, pair.a, CandidateKind::normal);
    const Candidate* of_b = find(list, pair.b, CandidateKind::normal);
    ASSERT_NE(of_a, nullptr);
    ASSERT_NE(of_b, nullptr);
    EXPECT_TRUE(near(of_a->displacement, {0, 0, 0.004}));
    EXPECT_TRUE(near(of_b->displacement, {0, 0, -0.004}));
    EXPECT_EQ(of_a->other, pair.b);
    EXPECT_EQ(of_b->other, pair.a);
}

TEST(Candidate, ALeavesBackAlongItsVelocity_Eq2_3_3a_Figure5b) {
    Pair pair;
    pair.moveBy(pair.a, {0.006, 0, -0.008});
    const CandidateList list = pair.candidates();
    ASSERT_EQ(list.size(), 3U);
    const Candidate* back = find(list, pair.a, CandidateKind::velocity);
    ASSERT_NE(back, nullptr);
    EXPECT_TRUE(near(back->displacement, {-0.003, 0, 0.004}));
}

TEST(Candidate, BLeavesBackAlongItsVelocity_Eq2_3_3b) {
    Pair pair;
    pair.moveBy(pair.b, {0.006, 0, 0.008});
    const CandidateList list = pair.candidates();
    ASSERT_EQ(list.size(), 3U);
    const Candidate* back = find(list, pair.b, CandidateKind::velocity);
    ASSERT_NE(back, nullptr);
    EXPECT_TRUE(near(back->displacement, {-0.003, 0, -0.004}));
}

TEST(Candidate, AGoesBackOnlyIfItsStepWasLongEnough_Eq2_3_2a) {
    Pair pair;
    const double d_c = correctionDistance(pair.contacts[0], left_over);
    pair.moveBy(pair.a, {1, 0, d_c});
    EXPECT_NE(find(pair.candidates(), pair.a, CandidateKind::velocity), nullptr);
    pair.moveBy(pair.a, {1, 0, std::nextafter(d_c, 0)});
    EXPECT_EQ(find(pair.candidates(), pair.a, CandidateKind::velocity), nullptr);
    pair.moveBy(pair.a, {0, 0, 0.1});
    EXPECT_EQ(find(pair.candidates(), pair.a, CandidateKind::velocity), nullptr);
}

TEST(Candidate, BGoesBackOnlyIfItsStepWasLongEnough_Eq2_3_2b) {
    Pair pair;
    const double d_c = correctionDistance(pair.contacts[0], left_over);
    pair.moveBy(pair.b, {1, 0, -d_c});
    EXPECT_NE(find(pair.candidates(), pair.b, CandidateKind::velocity), nullptr);
    pair.moveBy(pair.b, {1, 0, std::nextafter(-d_c, 0)});
    EXPECT_EQ(find(pair.candidates(), pair.b, CandidateKind::velocity), nullptr);
    pair.moveBy(pair.b, {0, 0, -0.1});
    EXPECT_EQ(find(pair.candidates(), pair.b, CandidateKind::velocity), nullptr);
}

TEST(Candidate, AStepOfZeroLengthIsNoWayBack) {
    Pair pair;
    const CandidateList list = pair.candidates();
    EXPECT_EQ(list.size(), 2U);
    for (const Candidate& candidate : list) EXPECT_EQ(candidate.kind, CandidateKind::normal);
}

TEST(Candidate, AFixedBodyHasNone) {
    for (const BodyIndex fixed : {0U, 1U}) {
        Pair pair;
        pair.moveBy(pair.a, {0, 0, -1});
        pair.moveBy(pair.b, {0, 0, 1});
        pair.kind[fixed] = BodyKind::fixed;
        const CandidateList list = pair.candidates();
        ASSERT_EQ(list.size(), 2U);
        EXPECT_EQ(list[0].body, 1 - fixed);
        EXPECT_EQ(list[1].body, 1 - fixed);
    }
}

TEST(Candidate, ClosingSpeedsIncludeTheRotation_Eq2_5_1_Eq2_5_2_Eq2_5_3) {
    Pair pair;
    pair.contacts[0].point = {0.5, 0, 0.25};
    pair.v[pair.a] = {9, 9, -2};
    pair.w[pair.a] = {0, 3, 0};  // ω × r = (0, 3, 0) × (0.5, 0, −0.75) = (−2.25, 0, −1.5)
    EXPECT_DOUBLE_EQ(closingSpeedOfA(pair.contacts[0], pair.state()), 3.5);
    pair.v[pair.b] = {7, 7, 1};
    pair.w[pair.b] = {0, -4, 0};  // ω × r = (0, −4, 0) × (0.5, 0, 0.25) = (−1, 0, 2)
    EXPECT_DOUBLE_EQ(closingSpeedOfB(pair.contacts[0], pair.state()), 3);
}

TEST(Candidate, TheFasterClosingBodyIsTriedFirstAndItsVelocityBeforeItsNormal) {
    Pair pair;
    pair.moveBy(pair.a, {0, 0, -0.02});
    pair.moveBy(pair.b, {0, 0, 0.01});
    const CandidateList a_first = pair.candidates();
    ASSERT_EQ(a_first.size(), 4U);
    const BodyIndex bodies[] = {pair.a, pair.a, pair.b, pair.b};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(a_first[i].body, bodies[i]);
        EXPECT_EQ(a_first[i].kind, i % 2 == 0 ? CandidateKind::velocity : CandidateKind::normal);
    }
    pair.moveBy(pair.b, {0, 0, 0.03});
    const CandidateList b_first = pair.candidates();
    ASSERT_EQ(b_first.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(b_first[i].body, bodies[3 - i]);
        EXPECT_EQ(b_first[i].kind, i % 2 == 0 ? CandidateKind::velocity : CandidateKind::normal);
    }
}

TEST(Candidate, BIsTriedFirstIfBothCloseEquallyFast) {
    Pair pair;
    pair.moveBy(pair.a, {0, 0, -0.02});
    pair.moveBy(pair.b, {0, 0, 0.02});
    EXPECT_EQ(pair.candidates()[0].body, pair.b);
}

TEST(Candidate, DisplacementsThatAreNotFiniteAreLeftOut) {
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {inf, -inf, nan}) {
        Pair pair;
        pair.linear_step[pair.a] = {0, bad, -0.01};
        pair.linear_step[pair.b] = {0, 0, bad};
        EXPECT_EQ(find(pair.candidates(), pair.a, CandidateKind::velocity), nullptr);
        EXPECT_EQ(find(pair.candidates(), pair.b, CandidateKind::velocity), nullptr);
        EXPECT_EQ(pair.candidates().size(), 2U);
        pair.contacts[0].normal.z() = bad;
        EXPECT_EQ(pair.candidates().size(), 0U);
    }
}

}  // namespace
}  // namespace cairn::test
