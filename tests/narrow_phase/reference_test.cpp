#include "narrow_phase/reference.h"

#include <cmath>

#include "narrow_phase/manifold_check.h"
#include "narrow_phase/pair_random.h"
#include "samples.h"

namespace cairn::testing {
namespace {

/// Two posed shapes and a margin.
struct Situation {
    Shape a;
    Shape b;
    Pose pose_a;
    Pose pose_b;
    double margin;
};

/// Random, parallel or nearly parallel orientations.
Quat relativeOrientation(Random& random) {
    switch (random.below(3)) {
        case 0:
            return random.orientation();
        case 1:
            return random.alignedOrientation();
        default:
            return random.nearly(random.alignedOrientation());
    }
}

/// A quarter of the pairs overlaps deeply (some with one centre); the others touch, overlap or miss by up to 0.1 to
/// 1e-9 m, coming from any direction or onto a face.
Situation situation(Random& random, const Shape& a, const Shape& b) {
    Situation s{a, b, {random.vector(1), Quat::Identity()}, {}, std::pow(10.0, -2 - random.below(4))};
    if (random.below(2) == 0) s.pose_a.orientation = random.orientation();
    s.pose_b.orientation = (s.pose_a.orientation * relativeOrientation(random)).normalized();
    const int approach = random.below(4);
    if (approach == 0) {
        const Vec3 along = Vec3::Unit(random.below(3)) * random.uniform(-0.1, 0.1) * random.below(2);
        s.pose_b.position = s.pose_a.position + (random.below(3) == 0 ? along : random.vector(0.5));
        return s;
    }
    const Vec3 from = approach == 1 ? Vec3(4 * random.direction())
                                    : Vec3(random.vector(approach == 2 ? 0.5 : 1e-3) + 4 * Vec3::Unit(random.below(3)));
    s.pose_b.position = s.pose_a.position + s.pose_a.orientation * from;
    const Solid solid_a(a, s.pose_a);
    const Solid solid_b(b, s.pose_b);
    const Vec3L apart = coreDistance(solid_a, solid_b);
    const double gap = random.below(6) == 0 ? 0 : random.uniform(-1, 1) * std::pow(10.0, -1 - random.below(9));
    s.pose_b.position += (apart * (1 - (solid_a.radius + solid_b.radius + gap) / apart.norm())).cast<double>();
    return s;
}

/// How far the depth and direction of a contact may be from the least translation: the preference for faces.
double preference(double gap) {
    return 2.5e-3 + 0.05 * std::abs(gap);
}

/// Two points of a lying capsule have one normal, that of the closest points, so that each is a little beside the
/// other's.
double surfaceTolerance(const Situation& s) {
    const bool capsule = std::holds_alternative<Capsule>(s.a) || std::holds_alternative<Capsule>(s.b);
    return capsule ? 2e-4 : 1e-6;
}

void checkPoints(const Situation& s, const Manifold& m, double gap) {
    const Solid a(s.a, s.pose_a);
    const Solid b(s.b, s.pose_b);
    const Vec3L n = m.normal.cast<Real>();
    for (std::size_t i = 0; i < m.size; ++i) {
        const double d = m.points[i].distance;
        ASSERT_LE(d, s.margin);
        if (gap < -0.05) continue;  // far inside, the points of a tilted contact leave the surfaces
        const Vec3L p = m.points[i].point.cast<Real>();
        const double beside = d == deepest(m) ? 0 : 2 * s.margin + 0.05 * std::abs(gap);
        const double tolerance = surfaceTolerance(s) + beside;
        ASSERT_LE(static_cast<double>(a.fromSurface(p + n * Real(0.5 * d))), tolerance) << "of A";
        ASSERT_LE(static_cast<double>(b.fromSurface(p - n * Real(0.5 * d))), tolerance) << "of B";
        for (std::size_t k = 0; k < i; ++k) ASSERT_GT((m.points[i].point - m.points[k].point).norm(), 1e-6);
    }
}

void check(const Situation& s) {
    const Manifold m = contactOf(s.a, s.pose_a, s.b, s.pose_b, s.margin);
    Solid a(s.a, s.pose_a);
    const Solid b(s.b, s.pose_b);
    const double gap = static_cast<double>(gapOf(a, b));
    if (gap > s.margin + 1e-11) {
        ASSERT_EQ(m.size, 0U) << "apart by " << gap << ", margin " << s.margin;
        return;
    }
    if (m.size == 0) {
        ASSERT_GT(gap, s.margin - 1e-11) << "no contact, margin " << s.margin;
        return;
    }
    ASSERT_NEAR(m.normal.norm(), 1, 1e-12);
    ASSERT_LE(std::abs(deepest(m) - gap), preference(gap)) << "the depth is that of the least translation";
    checkPoints(s, m, gap);
    a.move(-Real(deepest(m)) * m.normal.cast<Real>());
    const double left = static_cast<double>(gapOf(a, b));
    ASSERT_LE(left, gap < -0.05 ? 2e-3 : 1e-6) << "moved by its distance, A touches B; the gap was " << gap;
    ASSERT_GE(left, gap < -0.05 ? -4e-3 : -2e-3) << "moved by its distance, A touches B; the gap was " << gap;
}

TEST(Reference, KnowsDistancesAndDepths) {
    const Solid a(Box{{2, 2, 2}}, at({0, 0, 0}));
    EXPECT_NEAR(static_cast<double>(gapOf(a, Solid(Box{{2, 2, 2}}, at({5, 6, 2})))), 5, 1e-15);
    EXPECT_NEAR(static_cast<double>(gapOf(a, Solid(Box{{2, 2, 2}}, at({1.5, 1.75, 1.8})))), -0.2, 1e-12);
    EXPECT_NEAR(static_cast<double>(gapOf(a, Solid(Sphere{1}, at({4, 5, 1})))), 4, 1e-15);
    EXPECT_NEAR(static_cast<double>(gapOf(a, Solid(Capsule{0.5, 2}, at({0, 3, 0})))), 1.5, 1e-15);
}

TEST(BoxBox, AgreesWithTheReferenceOn100000Poses) {
    Random random(1);
    for (int i = 0; i < samples(100000); ++i) {
        const Box a = random.box(1);
        const Box b = random.below(4) == 0 ? a : random.box(1);
        check(situation(random, a, b));
        if (::testing::Test::HasFatalFailure()) FAIL() << "at pose " << i;
    }
}

TEST(AllFinitePairs, AgreeWithTheReference) {
    Random random(2);
    for (int i = 0; i < samples(100000); ++i) {
        const Shape a = random.shape(1);
        check(situation(random, a, random.below(4) == 0 ? a : random.shape(1)));
        if (::testing::Test::HasFatalFailure()) FAIL() << "at pose " << i;
    }
}

TEST(CapsuleBox, OneThatCrossesAnEdgeAslantAgreesWithTheReference) {
    // The other end of the part beside the edge has its closest point on a face, in another direction.
    check({Capsule{0.28460191533685952, 0.80446220439428018},
           Box{{0.44532275011559497, 0.83677974554106183, 0.72516566790697412}},
           at({0.97764873048432688, 0.22392231250909234, 0.0064142402950322364}),
           {Vec3(1.6703805559655471, 0.19321645587585928, -0.39160814379009512),
            Quat(0.61793663041994606, 0.66786148060158212, 0.29236503528841495, 0.29434342128661467)},
           1e-4});
}

TEST(HalfSpacePairs, AgreeWithTheReference) {
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const Shape shape = random.shape(1);
        const Pose pose{random.vector(0.5), random.below(2) == 0 ? random.orientation() : random.alignedOrientation()};
        const Pose ground{random.vector(0.5), random.orientation()};
        const HalfSpace half_space{random.uniform(0.1, 9) * random.direction(), random.uniform(-1, 1)};
        const double margin = std::pow(10.0, -1 - random.below(5));
        const Manifold m = contactOf(shape, pose, half_space, ground, margin);
        const Solid solid(shape, pose);
        const Vec3L n = (ground.orientation * half_space.normal.normalized()).cast<Real>();
        std::size_t expected = 0;
        double lowest = std::numeric_limits<double>::infinity();
        for (const Vec3L& corner : solid.corners) {
            const Vec3L from = corner - ground.position.cast<Real>();
            const double height = static_cast<double>(from.dot(n) - Real(half_space.offset) - solid.radius);
            lowest = std::min(lowest, height);
            if (height > margin) continue;
            ++expected;
            const Vec3L halfway = corner - (solid.radius + Real(0.5 * height)) * n;
            bool found = false;
            for (std::size_t k = 0; k < m.size; ++k) {
                found = found || ((m.points[k].point.cast<Real>() - halfway).norm() < 1e-12L &&
                                  std::abs(m.points[k].distance - height) < 1e-12);
            }
            ASSERT_TRUE(found) << "corner at height " << height;
        }
        ASSERT_EQ(m.size, expected);
        if (expected > 0) {
            ASSERT_LE(static_cast<double>((m.normal.cast<Real>() - n).norm()), 1e-14);
            ASSERT_NEAR(deepest(m), lowest, 1e-12);
        }
    }
}

}  // namespace
}  // namespace cairn::testing
