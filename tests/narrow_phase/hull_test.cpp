#include <cmath>

#include "geometry/geometry.h"
#include "narrow_phase/manifold_check.h"
#include "narrow_phase/pair_random.h"
#include "narrow_phase/reference.h"

namespace cairn::testing {
namespace {

ConvexHull boxHull(const Box& box) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        const Vec3 sign((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5);
        corners.emplace_back(sign.cwiseProduct(box.size));
    }
    return ConvexHull(corners);
}

/// Random, parallel or nearly parallel.
Quat turned(Random& random, const Quat& from) {
    const int kind = random.below(3);
    if (kind == 0) return random.orientation();
    const Quat aligned = (from * random.alignedOrientation()).normalized();
    return kind == 1 ? aligned : random.nearly(aligned);
}

/// Moves b towards a, or away, on the line of their centres until their distance is as wished.
void bringTogether(const Shape& a, const Pose& pose_a, const Shape& b, Pose& pose_b, double wished) {
    const Vec3 towards = (pose_a.position - pose_b.position).normalized();
    for (int k = 0; k < 8; ++k) {
        const Manifold m = contactOf(a, pose_a, b, pose_b, 10);
        if (m.size == 0) return;
        pose_b.position += (deepest(m) - wished) / std::max(0.2, m.normal.dot(towards)) * towards;
    }
}

TEST(HullContact, ABoxGivenAsAHullTouchesLikeTheBox) {
    Random random(51);
    int faces = 0;
    int different = 0;
    for (int i = 0; i < 4000; ++i) {
        const Box box_a = random.box(1);
        const Box box_b = random.box(1);
        const Pose pose_a{random.vector(0.4), random.orientation()};
        Pose pose_b{pose_a.position + 2 * random.direction(), turned(random, pose_a.orientation)};
        bringTogether(box_a, pose_a, box_b, pose_b, random.uniform(-5e-3, 5e-3));
        const Manifold boxes = contactOf(box_a, pose_a, box_b, pose_b, 0.01);
        for (const Shape& hull : {Shape(boxHull(box_b)), Shape(box_b)}) {
            const Manifold hulls = contactOf(boxHull(box_a), pose_a, hull, pose_b, 0.01);
            ASSERT_EQ(hulls.size > 0, boxes.size > 0) << "pose " << i;
            if (boxes.size == 0) continue;
            ASSERT_NEAR(deepest(hulls), deepest(boxes), 2.5e-3) << "pose " << i;
            // Where two directions are nearly equally good, each may take another.
            std::vector<Vec3> points;
            for (std::size_t k = 0; k < boxes.size; ++k) points.push_back(boxes.points[k].point);
            if ((hulls.normal - boxes.normal).norm() > 1e-6 || !hasPoints(hulls, points, 1e-6)) {
                ++different;
                continue;
            }
            if (boxes.size > 2) ++faces;
        }
    }
    EXPECT_GT(faces, 1000);
    EXPECT_LT(different, 160);
}

TEST(HullContact, AStandingBoxHullHasExactlyTheContactsOfTheBox) {
    const Box box{{1, 2, 3}};
    const Pose above = at({0.2, 0.3, 2.99});
    for (const Shape& ground :
         {Shape(Box{{5, 5, 3}}), Shape(boxHull(Box{{5, 5, 3}})), Shape(HalfSpace{{0, 0, 1}, 1.5})}) {
        const Manifold m = contactOf(boxHull(box), above, ground, at({0, 0, 0}));
        EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.01));
        EXPECT_TRUE(hasPoints(m, {{-0.3, -0.7, 1.495}, {0.7, -0.7, 1.495}, {0.7, 1.3, 1.495}, {-0.3, 1.3, 1.495}}));
    }
}

TEST(HullContact, AnotherFrameOfThePointsChangesNothing) {
    Random random(52);
    int contacts = 0;
    for (int i = 0; i < 1000; ++i) {
        std::vector<Vec3> points;
        for (int k = 0; k < 12; ++k) points.push_back(random.vector(0.5));
        const Pose frame{random.vector(2), random.orientation()};
        std::vector<Vec3> moved;
        for (const Vec3& p : points) moved.push_back(frame.toInner(p));
        const Pose pose{random.vector(0.3), random.orientation()};
        const Pose other{pose.toOuter(frame.position), (pose.orientation * frame.orientation).normalized()};
        const Shape b = random.solid(1);
        const Pose pose_b{random.vector(0.5), random.orientation()};
        const Manifold m = contactOf(ConvexHull(points), pose, b, pose_b, 0.01);
        const Manifold n = contactOf(ConvexHull(moved), other, b, pose_b, 0.01);
        ASSERT_EQ(m.size > 0, n.size > 0) << "pose " << i;
        if (m.size == 0) continue;
        ++contacts;
        ASSERT_NEAR(deepest(m), deepest(n), 1e-9 + 1e-2 * std::abs(deepest(m))) << "pose " << i;
    }
    EXPECT_GT(contacts, 200);
}

TEST(HullContact, ASphereTouchesFaceEdgeAndCorner) {
    const ConvexHull cube = boxHull(Box{{2, 2, 2}});
    const Vec3 edge = Vec3(0, 0.6, 0.8);
    const Vec3 corner = Vec3(2, 1, 2) / 3;
    EXPECT_TRUE(touches(contactOf(Sphere{0.5}, at({0.3, 0.2, 1.49}), cube, at({0, 0, 0})), Vec3::UnitZ(), -0.01, 1e-9));
    EXPECT_TRUE(
        touches(contactOf(Sphere{0.5}, at(Vec3(0.2, 1, 1) + 0.49 * edge), cube, at({0, 0, 0})), edge, -0.01, 1e-9));
    EXPECT_TRUE(
        touches(contactOf(Sphere{0.5}, at(Vec3(1, 1, 1) + 0.49 * corner), cube, at({0, 0, 0})), corner, -0.01, 1e-9));
    EXPECT_TRUE(touches(contactOf(Sphere{0.5}, at({0.1, 0.9, 0.2}), cube, at({0, 0, 0})), Vec3::UnitY(), -0.6, 1e-9));
}

TEST(HullContact, ARoundFaceStandsOnManyCornersButNotTooMany) {
    std::vector<Vec3> prism;
    for (int i = 0; i < 40; ++i) {
        const double turn = 2 * std::numbers::pi * i / 40;
        for (const double z : {-1.0, 1.0}) prism.emplace_back(std::cos(turn), std::sin(turn), z);
    }
    const ConvexHull hull(prism);
    for (const Shape& ground : {Shape(Box{{5, 5, 2}}), Shape(HalfSpace{{0, 0, 1}, 1}), Shape(hull)}) {
        const Manifold m = contactOf(hull, at({0, 0, 1.99}), ground, at({0, 0, 0}));
        EXPECT_TRUE(touches(m, Vec3::UnitZ(), -0.01, 1e-9));
        EXPECT_GE(m.size, 8U);
        Vec3 mean = Vec3::Zero();
        for (std::size_t k = 0; k < m.size; ++k) mean += m.points[k].point / static_cast<double>(m.size);
        EXPECT_LE(mean.head<2>().norm(), 0.15) << "all around";
    }
}

}  // namespace
}  // namespace cairn::testing
