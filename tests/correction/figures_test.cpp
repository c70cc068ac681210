/// @file The situations that the thesis draws in its chapter on penetration correction. x points right, z up.
#include <gtest/gtest.h>

#include "correction/candidate.h"
#include "correction/contact_scene.h"

namespace cairn::test {
namespace {

/// Penetrating below −1/16, corrected to −1/32: powers of two, so that sums in the tests are exact.
struct Figure : ContactScene {
    Figure() { settings.penetration_threshold = 1.0 / 16; }
    static constexpr double touching = -1.0 / 32;  // nothing to spare: any push is handed on
    double distance(std::uint32_t contact) const { return contacts[contact].distance; }
    Vec3 moved(BodyIndex body, const Vec3& from = Vec3::Zero()) const { return position[body] - from; }
};

void expectCounts(const CorrectionCounts& counts, int penetrating, int corrected, int displaced) {
    EXPECT_EQ(counts.penetrating, penetrating);
    EXPECT_EQ(counts.corrected, corrected);
    EXPECT_EQ(counts.uncorrected, penetrating - corrected);
    EXPECT_EQ(counts.displaced, displaced);
}

TEST(Figure3, AStackIsLiftedWholeAndASphereOnTopAlone) {
    Figure stack;
    const BodyIndex ground = stack.addFixed();
    const BodyIndex bottom = stack.addBody();
    const BodyIndex top = stack.addBody();
    const auto below = stack.touch(bottom, ground, up, -1.0 / 8);
    const auto above = stack.touch(top, bottom, up, Figure::touching);
    expectCounts(stack.correct(), 1, 1, 2);
    EXPECT_EQ(stack.moved(bottom), Vec3(0, 0, 3.0 / 32));
    EXPECT_EQ(stack.moved(top), Vec3(0, 0, 3.0 / 32));
    EXPECT_EQ(stack.distance(below), -1.0 / 32);
    EXPECT_EQ(stack.distance(above), Figure::touching);

    Figure sphere_on_top;
    const BodyIndex floor = sphere_on_top.addFixed();
    const BodyIndex block = sphere_on_top.addBody();
    const BodyIndex sphere = sphere_on_top.addBody();
    sphere_on_top.touch(block, floor, up, Figure::touching);
    sphere_on_top.touch(sphere, block, up, -1.0 / 8);
    expectCounts(sphere_on_top.correct(), 1, 1, 1);
    EXPECT_EQ(sphere_on_top.moved(block), Vec3::Zero());
    EXPECT_EQ(sphere_on_top.moved(sphere), Vec3(0, 0, 3.0 / 32));
}

TEST(Figure4, OnlyOneOfTwoFreeBodiesMoves) {
    Figure pair;
    const BodyIndex left = pair.addBody();
    const BodyIndex other = pair.addBody();
    const auto contact = pair.touch(other, left, right, -1.0 / 8);
    expectCounts(pair.correct(), 1, 1, 1);
    // Both close equally fast, so B (the higher slot) is tried first and the other cannot do better.
    EXPECT_EQ(pair.moved(left), Vec3::Zero());
    EXPECT_EQ(pair.moved(other), Vec3(3.0 / 32, 0, 0));
    EXPECT_EQ(pair.distance(contact), -1.0 / 32);
}

TEST(Figure5b, TheSphereGoesBackTheWayItCame) {
    Figure scene;
    const BodyIndex block = scene.addBody();
    const BodyIndex sphere = scene.addBody();
    const auto contact = scene.touch(sphere, block, -right, -1.0 / 8);
    scene.moveBy(sphere, {3.0 / 16, 0, -3.0 / 8});
    expectCounts(scene.correct(), 1, 1, 1);
    EXPECT_EQ(scene.moved(sphere), Vec3(-3.0 / 32, 0, 3.0 / 16));
    EXPECT_EQ(scene.distance(contact), -1.0 / 32);
}

TEST(Figure6, NeighboursMoveByTheSameDisplacementAndTheirOverlapStays) {
    Figure scene;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    const BodyIndex top_left = scene.addBody();
    const BodyIndex top_right = scene.addBody();
    const auto below = scene.touch(x, ground, up, -1.0 / 8);
    const auto touching = scene.touch(top_left, x, {-0.6, 0, 0.8}, Figure::touching);
    const auto overlapping = scene.touch(top_right, x, {0.6, 0, 0.8}, -3.0 / 64);
    expectCounts(scene.correct(), 1, 1, 3);
    for (const BodyIndex body : {x, top_left, top_right}) EXPECT_EQ(scene.moved(body), Vec3(0, 0, 3.0 / 32));
    EXPECT_EQ(scene.distance(below), -1.0 / 32);
    EXPECT_EQ(scene.distance(touching), Figure::touching);
    EXPECT_EQ(scene.distance(overlapping), -3.0 / 64);
}

TEST(Figure7a, AGapIsClosedAndTheRestOfTheDisplacementHandedOn) {
    Figure scene;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex x = scene.addBody();
    const BodyIndex y = scene.addBody();
    const Vec3 slope(0.6, 0, 0.8);
    const auto below = scene.touch(x, ground, slope, -1.0 / 32 - 0.5);
    const auto gap = scene.touch(y, x, right, 0.15 - 1.0 / 32);
    expectCounts(scene.correct(), 1, 1, 2);
    EXPECT_TRUE(near(scene.moved(x), 0.5 * slope));
    // s = 0.5·0.6 = 0.3 and e = 0.15: half of the displacement is left, in its own direction.
    EXPECT_TRUE(near(scene.moved(y), 0.25 * slope));
    EXPECT_NEAR(scene.distance(gap), -1.0 / 32, 1e-15);
    EXPECT_NEAR(scene.distance(below), -1.0 / 32, 1e-15);
}

TEST(Figure7b, TheSecondBlockClosesTheGapThatTheFirstOneOpened) {
    Figure scene;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex left_block = scene.addBody();
    const BodyIndex right_block = scene.addBody();
    const BodyIndex top = scene.addBody();
    for (const BodyIndex block : {left_block, right_block}) {
        for (int i = 0; i < 2; ++i) scene.touch(block, ground, up, -1.0 / 8);
    }
    const auto on_left = scene.touch(top, left_block, up, Figure::touching);
    const auto on_right = scene.touch(top, right_block, up, Figure::touching);
    // Each block is moved once, for both of its contacts, and the top one only with the first of them.
    expectCounts(scene.correct(), 4, 4, 3);
    for (const BodyIndex block : {left_block, right_block, top}) {
        EXPECT_EQ(scene.moved(block), Vec3(0, 0, 3.0 / 32));
    }
    for (std::uint32_t contact = 0; contact < 4; ++contact) EXPECT_EQ(scene.distance(contact), -1.0 / 32);
    EXPECT_EQ(scene.distance(on_left), Figure::touching);
    EXPECT_EQ(scene.distance(on_right), Figure::touching);
}

TEST(Figure7b, AfterTheFirstBlockTheContactDataShowTheGap) {
    Figure scene;
    const BodyIndex ground = scene.addFixed();
    const BodyIndex left_block = scene.addBody();
    const BodyIndex right_block = scene.addBody();
    const BodyIndex top = scene.addBody({0, 0, 2});
    const auto below = scene.touch(left_block, ground, up, -1.0 / 8);
    scene.touch(right_block, ground, up, Figure::touching);
    const auto on_left = scene.touch(top, left_block, up, Figure::touching);
    const auto on_right = scene.touch(top, right_block, up, Figure::touching);
    expectCounts(scene.correct(), 1, 1, 2);
    EXPECT_EQ(scene.distance(on_left), Figure::touching);
    EXPECT_EQ(scene.distance(on_right), Figure::touching + 3.0 / 32);  // (2.3.7b), one body moved
    // (2.3.7a): with both bodies moved a point moves with them, with one of them half as far.
    EXPECT_EQ(scene.contacts[on_left].point, Vec3(0, 0, 1 + 3.0 / 32));
    EXPECT_EQ(scene.contacts[on_right].point, Vec3(0, 0, 1 + 3.0 / 64));
    EXPECT_EQ(scene.contacts[below].point, Vec3(0, 0, 3.0 / 64));
}

TEST(Figure8a, ASphereBetweenFixedBodiesStays) {
    Figure scene;
    const BodyIndex block = scene.addFixed();
    const BodyIndex wall = scene.addFixed();
    const BodyIndex sphere = scene.addBody();
    const auto left_contact = scene.touch(sphere, block, right, -1.0 / 8);
    const auto right_contact = scene.touch(sphere, wall, -right, Figure::touching);
    expectCounts(scene.correct(), 1, 0, 0);
    EXPECT_EQ(scene.moved(sphere), Vec3::Zero());
    EXPECT_EQ(scene.distance(left_contact), -1.0 / 8);
    EXPECT_EQ(scene.distance(right_contact), Figure::touching);
}

TEST(Figure8b, BodiesThatPushEachOtherThroughAThirdStay) {
    Figure scene;
    const BodyIndex left_body = scene.addBody();
    const BodyIndex right_body = scene.addBody();
    const BodyIndex clamp = scene.addBody();  // holds both from outside
    const auto contact = scene.touch(right_body, left_body, right, -1.0 / 8);
    scene.touch(left_body, clamp, right, Figure::touching);
    scene.touch(clamp, right_body, right, Figure::touching);
    expectCounts(scene.correct(), 1, 0, 0);
    for (const BodyIndex body : {left_body, right_body, clamp}) EXPECT_EQ(scene.moved(body), Vec3::Zero());
    EXPECT_EQ(scene.distance(contact), -1.0 / 8);
}

/// Spheres in a row, each touching the next; the two in the middle overlap.
struct RowOfBoxes : Figure {
    std::vector<BodyIndex> spheres;

    RowOfBoxes(int left_of_overlap, int right_of_overlap) {
        for (int i = 0; i < left_of_overlap + right_of_overlap; ++i) {
            spheres.push_back(addBody());
            if (i > 0) touch(spheres[i], spheres[i - 1], right, i == left_of_overlap ? -1.0 / 8 : Figure::touching);
        }
    }
};

TEST(Figure9a, TheSideWithFewerBodiesMoves) {
    RowOfBoxes row(3, 4);
    expectCounts(row.correct(), 1, 1, 3);
    for (int i = 0; i < 7; ++i) {
        EXPECT_EQ(row.moved(row.spheres[i]), i < 3 ? Vec3(-3.0 / 32, 0, 0) : Vec3(Vec3::Zero()));
    }
    RowOfBoxes mirrored(4, 3);
    expectCounts(mirrored.correct(), 1, 1, 3);
    for (int i = 0; i < 7; ++i) {
        EXPECT_EQ(mirrored.moved(mirrored.spheres[i]), i < 4 ? Vec3(Vec3::Zero()) : Vec3(3.0 / 32, 0, 0));
    }
}

TEST(Figure9a, FewerBodiesAreBetterThanTheStepBackOfTheFasterBody) {
    RowOfBoxes row(3, 2);
    row.moveBy(row.spheres[2], {1, 0, 1});
    expectCounts(row.correct(), 1, 1, 2);
    EXPECT_EQ(row.moved(row.spheres[3]), Vec3(3.0 / 32, 0, 0));
    EXPECT_EQ(row.moved(row.spheres[2]), Vec3::Zero());
}

TEST(Figure9b, WithEquallyManyBodiesTheStepBackIsPreferred) {
    Figure scene;
    const BodyIndex still = scene.addBody();
    const BodyIndex moving = scene.addBody();
    scene.touch(moving, still, right, -1.0 / 8);
    scene.moveBy(moving, {-3.0 / 16, 0, -3.0 / 8});
    expectCounts(scene.correct(), 1, 1, 1);
    EXPECT_EQ(scene.moved(still), Vec3::Zero());
    EXPECT_EQ(scene.moved(moving), Vec3(3.0 / 32, 0, 3.0 / 16));
}

TEST(Figure9b, TheStepBackIsPreferredAlsoIfItIsTriedAfterANormal) {
    for (const bool spinning_has_lower_slot : {true, false}) {
        Figure scene;
        const BodyIndex first = scene.addBody();
        const BodyIndex second = scene.addBody();
        const BodyIndex spinning = spinning_has_lower_slot ? first : second;
        const BodyIndex moving = spinning_has_lower_slot ? second : first;
        scene.position[spinning] = {0, 0, 1};
        const auto contact = scene.touch(moving, spinning, right, -1.0 / 8);
        scene.contacts[contact].point = Vec3::Zero();
        scene.w[spinning] = {0, -1000, 0};  // 1000 m/s to the right at the point, but no linear step to go back
        scene.moveBy(moving, {-3.0 / 16, 0, 0});
        const auto candidates = listCandidates(scene.contacts[contact], scene.state(), scene.remaining());
        ASSERT_EQ(candidates[0].body, spinning);
        ASSERT_EQ(candidates[0].kind, CandidateKind::normal);
        expectCounts(scene.correct(), 1, 1, 1);
        EXPECT_EQ(scene.moved(spinning, {0, 0, 1}), Vec3::Zero());
        EXPECT_EQ(scene.moved(moving), Vec3(3.0 / 32, 0, 0));
    }
}

TEST(Figure10, ABodyWithoutAContactIsNotSeen) {
    Figure scene;
    const BodyIndex wall = scene.addFixed();
    const BodyIndex left_sphere = scene.addBody();
    const BodyIndex middle = scene.addBody({1, 0, 0});
    const BodyIndex unseen = scene.addBody({2, 0, 0});
    scene.touch(left_sphere, wall, right, Figure::touching);
    const auto overlap = scene.touch(middle, left_sphere, right, -1.0 / 8);
    for (const BodyIndex body : {middle, unseen}) scene.moveBy(body, {-3.0 / 16, 0, 0});
    expectCounts(scene.correct(), 1, 1, 1);
    EXPECT_EQ(scene.moved(middle, {1, 0, 0}), Vec3(3.0 / 32, 0, 0));
    EXPECT_EQ(scene.moved(unseen, {2, 0, 0}), Vec3::Zero());
    EXPECT_EQ(scene.distance(overlap), -1.0 / 32);
}

/// A stick above a stack of two blocks.
struct Stick : Figure {
    BodyIndex ground = addFixed();
    BodyIndex lower = addBody({0, 0, 1});
    BodyIndex upper = addBody({0, 0, 2});
    BodyIndex stick = addBody({1, 0, 3});
    std::uint32_t marked = 0;

    Stick() {
        touch(lower, ground, up, Figure::touching);
        touch(upper, lower, up, Figure::touching);
        marked = touch(stick, upper, up, -1.0 / 8);
        contacts[marked].point = {0, 0, 2.5};
        // All of the stack falls a little, so that the closing speed, not the first to move at all, decides.
        for (const BodyIndex body : {lower, upper}) v[body] = {0, 0, 0.01};
    }
    BodyIndex triedFirst() { return listCandidates(contacts[marked], state(), remaining())[0].body; }
};

TEST(Figure11Left, AStickThatFellGoesBackUpItsPath) {
    Stick scene;
    scene.moveBy(scene.stick, {3.0 / 16, 0, -3.0 / 16});
    EXPECT_EQ(scene.triedFirst(), scene.stick);
    expectCounts(scene.correct(), 1, 1, 1);
    EXPECT_EQ(scene.moved(scene.stick, {1, 0, 3}), Vec3(-3.0 / 32, 0, 3.0 / 32));
}

TEST(Figure11Right, AStickThatTurnedGoesUpAlongTheNormal) {
    Stick scene;
    scene.w[scene.stick] = {0, -2, 0};  // its end, 1 m to the left, turns downwards with 2 m/s
    EXPECT_EQ(scene.triedFirst(), scene.stick);
    expectCounts(scene.correct(), 1, 1, 1);
    EXPECT_EQ(scene.moved(scene.stick, {1, 0, 3}), Vec3(0, 0, 3.0 / 32));
}

TEST(Figure12, APartOfTheOverlapRemains) {
    Figure scene;
    const BodyIndex block = scene.addFixed();
    const BodyIndex sphere = scene.addBody();
    const auto contact = scene.touch(sphere, block, up, -1.0 / 8);
    scene.remaining_part = 0.25;
    expectCounts(scene.correct(), 1, 1, 1);
    EXPECT_EQ(scene.distance(contact), -1.0 / 64);
    expectCounts(scene.correct(), 0, 0, 0);
}

/// A sphere at a wall on the left and four more that moved against it.
struct FourSpheres : ContactScene {
    std::vector<BodyIndex> spheres;

    FourSpheres() {
        const BodyIndex wall = addFixed();
        const BodyIndex at_wall = addBody();
        touch(at_wall, wall, right, 0);
        BodyIndex last = at_wall;
        for (int i = 0; i < 4; ++i) {
            spheres.push_back(addBody());
            touch(spheres.back(), last, right, i == 0 ? -2e-3 : 0);
            moveBy(spheres.back(), {-3e-3, 0, 0});
            last = spheres.back();
        }
    }
};

TEST(Figure13, WithoutARemainingOverlapAllFourSpheresMove) {
    FourSpheres scene;
    expectCounts(scene.correct(), 1, 1, 4);
    for (const BodyIndex sphere : scene.spheres) EXPECT_NEAR(scene.position[sphere].x(), 2e-3, 1e-8);
}

TEST(Figure13, AllowingSmallOverlapsStopsAfterTwoSpheres) {
    FourSpheres scene;
    for (Contact& contact : scene.contacts) contact.allowed_overlap = 1.74e-3;
    expectCounts(scene.correct(), 1, 1, 2);
    EXPECT_NEAR(scene.position[scene.spheres[0]].x(), 1.13e-3, 1e-15);
    EXPECT_NEAR(scene.position[scene.spheres[1]].x(), 0.26e-3, 1e-15);
    EXPECT_EQ(scene.position[scene.spheres[2]], Vec3::Zero());
    EXPECT_EQ(scene.position[scene.spheres[3]], Vec3::Zero());
    for (std::uint32_t contact = 1; contact <= 2; ++contact) {
        EXPECT_NEAR(scene.contacts[contact].distance, -0.87e-3, 1e-15);
    }
    EXPECT_NEAR(scene.contacts[3].distance, -0.26e-3, 1e-15);
    EXPECT_EQ(scene.contacts[4].distance, 0);
}

}  // namespace
}  // namespace cairn::test
