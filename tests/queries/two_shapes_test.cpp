/// Closest points, casts, overlaps and contacts of two placed shapes.
#include <gtest/gtest.h>

#include "cairn/query.h"
#include "geometry/geometry.h"
#include "queries/inside.h"

namespace cairn {
namespace {

using testing::anyCompound;
using testing::anySolid;
using testing::Random;

/// How high a bounded shape reaches along a direction [m, W].
double heightAlong(const Shape& shape, const Pose& pose, const Vec3& direction) {
    return direction.dot(pose.toOuter(support(shape, pose.orientation.conjugate() * direction)));
}

/// How far two shapes are apart along a direction from B to A.
double gapAlong(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, const Vec3& normal) {
    return -heightAlong(a, pose_a, -normal) - heightAlong(b, pose_b, normal);
}

TEST(ClosestPoints, AreProvedByThePlanesThatPartTheShapes) {
    Random random(21);
    int apart = 0;
    int overlapping = 0;
    for (int i = 0; i < 4000; ++i) {
        const Shape a = anySolid(random, 1);
        const Shape b = anySolid(random, 1);
        const Pose pose_a{random.vector(1), random.orientation()};
        const Pose pose_b{random.vector(1), random.orientation()};
        const ClosestPoints found = closestPoints(a, pose_a, b, pose_b);
        ASSERT_NEAR(found.normal.norm(), 1, 1e-9);
        ASSERT_LT((found.on_a - found.on_b - found.distance * found.normal).norm(), 1e-8);
        // No plane parts them farther, and none shows less overlap.
        ASSERT_NEAR(gapAlong(a, pose_a, b, pose_b, found.normal), found.distance, 1e-8) << "case " << i;
        for (int k = 0; k < 20; ++k) {
            ASSERT_LE(gapAlong(a, pose_a, b, pose_b, random.direction()), found.distance + 1e-8);
        }
        ++(found.distance > 0 ? apart : overlapping);
        EXPECT_EQ(overlap(a, pose_a, b, pose_b), found.distance <= 0);
        const ClosestPoints back = closestPoints(b, pose_b, a, pose_a);
        EXPECT_NEAR(back.distance, found.distance, 1e-8);
    }
    EXPECT_GT(apart, 500);
    EXPECT_GT(overlapping, 300);
}

TEST(ClosestPoints, OfAHalfSpaceAreBelowTheLowestPoint) {
    const HalfSpace ground{Vec3(0, 0, 2), 0.5};
    const ClosestPoints above = closestPoints(Sphere{1}, Pose{Vec3(3, 4, 5)}, ground, Pose{});
    EXPECT_NEAR(above.distance, 3.5, 1e-15);
    EXPECT_LT((above.on_a - Vec3(3, 4, 4)).norm(), 1e-15);
    EXPECT_LT((above.on_b - Vec3(3, 4, 0.5)).norm(), 1e-15);
    const ClosestPoints below = closestPoints(ground, Pose{}, Box{}, Pose{Vec3(0, 0, -1)});
    EXPECT_NEAR(below.distance, -2, 1e-15);
    EXPECT_LT((below.normal + Vec3::UnitZ()).norm(), 1e-15);
    EXPECT_THROW(closestPoints(ground, Pose{}, ground, Pose{}), InputError);
    EXPECT_FALSE(overlap(ground, Pose{}, ground, Pose{}));
}

TEST(ClosestPoints, OfCompoundsAreThoseOfTheirClosestParts) {
    Random random(22);
    for (int i = 0; i < 300; ++i) {
        const Compound a = anyCompound(random, 4, 1);
        const Compound b = anyCompound(random, 5, 1);
        const Pose pose_a{random.vector(1), random.orientation()};
        const Pose pose_b{random.vector(1), random.orientation()};
        const ClosestPoints found = closestPoints(a, pose_a, b, pose_b);
        double least = std::numeric_limits<double>::infinity();
        for (const CompoundPart& p : a.parts) {
            for (const CompoundPart& q : b.parts) {
                const double d =
                    closestPoints(p.shape, pose_a.toOuter(p.pose), q.shape, pose_b.toOuter(q.pose)).distance;
                least = std::min(least, d);
            }
        }
        EXPECT_NEAR(found.distance, least, 1e-9);
        const CompoundPart& p = a.parts[found.part_a];
        const CompoundPart& q = b.parts[found.part_b];
        EXPECT_NEAR(closestPoints(p.shape, pose_a.toOuter(p.pose), q.shape, pose_b.toOuter(q.pose)).distance, least,
                    1e-9);
    }
}

TEST(ClosestPoints, AreApartExactlyWhereTheShapesDoNotOverlap) {
    // A grain 10⁻¹² m off the rim of a disc, which is less than rounding tells of places 890 m away.
    const Shape disc = Cylinder{890.67018749192357, 6.7076345221139493e-06};
    const Shape grain = Sphere{1e-6};
    const Pose beside{Vec3(4.3963566413216249e-05, -890.67018849192357, 0), Quat::Identity()};
    EXPECT_FALSE(overlap(disc, Pose{}, grain, beside));
    EXPECT_GT(closestPoints(disc, Pose{}, grain, beside).distance, 0);
    EXPECT_GT(closestPoints(grain, beside, disc, Pose{}).distance, 0);
    EXPECT_LT(closestPoints(disc, Pose{}, grain, beside).distance, 1e-8);
}

TEST(ShapeCast, StopsWhereTheShapesBeginToTouch) {
    Random random(23);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Shape a = anySolid(random, 1);
        const Shape b = i % 9 == 0 ? Shape(HalfSpace{random.direction(), -1}) : anySolid(random, 1);
        const Pose begin{3 * random.vector(1), random.orientation()};
        const Pose pose_b{random.vector(0.5), random.orientation()};
        const Vec3 way = 2 * (random.vector(1) - begin.position);
        const auto gapAt = [&](double part) {
            return closestPoints(a, {begin.position + part * way, begin.orientation}, b, pose_b).distance;
        };
        if (gapAt(0) <= 0) continue;
        const auto hit = castShape(a, begin, way, b, pose_b);
        const double end = hit ? hit->distance / way.norm() : 1.0;
        for (int k = 0; k < 50; ++k) ASSERT_GT(gapAt(end * k / 50.0), 0) << "case " << i;
        if (!hit) continue;
        ++hits;
        // A touch that is nearly passed is met within the square root of what the gap is known to.
        EXPECT_NEAR(gapAt(end), 0, 1e-6);
        EXPECT_LT(hit->normal.dot(way), 0);
        EXPECT_NEAR(hit->normal.norm(), 1, 1e-9);
        EXPECT_LE(closestPoints(Sphere{1e-6}, Pose{hit->point}, b, pose_b).distance, 1e-5);
    }
    EXPECT_GT(hits, 500);
}

TEST(ShapeCast, KnowsClosedForms) {
    // Two balls on a line beside each other's centres.
    const auto balls = castShape(Sphere{1}, Pose{Vec3(-5, 1, 0)}, Vec3(10, 0, 0), Sphere{1}, Pose{});
    ASSERT_TRUE(balls);
    EXPECT_NEAR(balls->distance, 5 - std::sqrt(3.0), 1e-12);
    EXPECT_LT((balls->normal - Vec3(-std::sqrt(0.75), 0.5, 0)).norm(), 1e-6);
    // Face on face.
    const auto boxes = castShape(Box{}, Pose{Vec3(-5, 0.3, 0)}, Vec3(10, 0, 0), Box{}, Pose{});
    ASSERT_TRUE(boxes);
    EXPECT_NEAR(boxes->distance, 4, 1e-9);
    EXPECT_LT((boxes->normal + Vec3::UnitX()).norm(), 1e-9);
    EXPECT_NEAR(boxes->point.x(), -0.5, 1e-6);
    // The way ends before it, exactly at it, and leads away.
    EXPECT_FALSE(castShape(Sphere{1}, Pose{Vec3(0, 0, 5)}, Vec3(0, 0, -3.99), HalfSpace{}, Pose{}));
    EXPECT_TRUE(castShape(Sphere{1}, Pose{Vec3(0, 0, 5)}, Vec3(0, 0, -4), HalfSpace{}, Pose{}));
    EXPECT_FALSE(castShape(Sphere{1}, Pose{Vec3(0, 0, 5)}, Vec3(0, 0, 4), HalfSpace{}, Pose{}));
    // What overlaps at the beginning meets at once.
    const auto inside = castShape(Sphere{1}, Pose{Vec3(1.5, 0, 0)}, Vec3(1, 0, 0), Sphere{1}, Pose{});
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside->distance, 0);
    EXPECT_LT((inside->normal - Vec3::UnitX()).norm(), 1e-12);
}

TEST(ShapeCast, RefusesHalfSpacesAndNoWay) {
    EXPECT_THROW(castShape(HalfSpace{}, Pose{}, Vec3::UnitX(), Sphere{}, Pose{}), InputError);
    EXPECT_THROW(castShape(Sphere{}, Pose{}, Vec3::Zero(), Sphere{}, Pose{}), InputError);
    EXPECT_THROW(castShape(Sphere{}, Pose{}, Vec3(0, 0, 1e13), Sphere{}, Pose{}), InputError);
}

TEST(ShapeCast, NamesTheFirstPartsThatTouch) {
    Random random(24);
    for (int i = 0; i < 200; ++i) {
        const Compound a = anyCompound(random, 3, 1);
        const Compound b = anyCompound(random, 4, 1);
        const Pose begin{Vec3(-4, 0, 0), random.orientation()};
        const Pose pose_b{random.vector(0.5), random.orientation()};
        const Vec3 way(8, 0, 0);
        const auto hit = castShape(a, begin, way, b, pose_b);
        double least = std::numeric_limits<double>::infinity();
        for (const CompoundPart& p : a.parts) {
            for (const CompoundPart& q : b.parts) {
                const auto of_parts = castShape(p.shape, begin.toOuter(p.pose), way, q.shape, pose_b.toOuter(q.pose));
                if (of_parts) least = std::min(least, of_parts->distance);
            }
        }
        ASSERT_EQ(hit.has_value(), least < 1e9);
        if (!hit) continue;
        EXPECT_NEAR(hit->distance, least, 1e-9);
        const CompoundPart& p = a.parts[hit->moving_part];
        const CompoundPart& q = b.parts[hit->part];
        EXPECT_NEAR(castShape(p.shape, begin.toOuter(p.pose), way, q.shape, pose_b.toOuter(q.pose))->distance, least,
                    1e-9);
    }
}

TEST(ContactsOf, AreThoseOfAStep) {
    const std::vector<ShapeContact> found = contactsOf(Box{}, Pose{Vec3(0, 0, 0.49)}, HalfSpace{}, Pose{}, 1e-3);
    ASSERT_EQ(found.size(), 4U);
    for (const ShapeContact& contact : found) {
        EXPECT_NEAR(contact.distance, -0.01, 1e-15);
        EXPECT_EQ(contact.normal, Vec3::UnitZ());
    }
    EXPECT_TRUE(contactsOf(Box{}, Pose{Vec3(0, 0, 0.6)}, HalfSpace{}, Pose{}, 1e-3).empty());
    const Compound pair{{{Sphere{0.5}, Pose{Vec3(-1, 0, 0)}}, {Sphere{0.5}, Pose{Vec3(1, 0, 0)}}}};
    const auto parts = contactsOf(pair, Pose{Vec3(0, 0, 0.5)}, HalfSpace{}, Pose{}, 1e-3);
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].part_a, 0U);
    EXPECT_EQ(parts[1].part_a, 1U);
    EXPECT_THROW(contactsOf(Box{}, Pose{}, Box{}, Pose{}, -1), InputError);
}

}  // namespace
}  // namespace cairn
