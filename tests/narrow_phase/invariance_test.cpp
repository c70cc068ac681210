#include "geometry/geometry.h"
#include "narrow_phase/manifold_check.h"
#include "narrow_phase/pair_random.h"
#include "samples.h"

namespace cairn::testing {
namespace {

/// Any shape near the origin, half-spaces included.
Shape anyShape(Random& random, double size) {
    if (random.below(4) != 0) return random.solid(size);
    return HalfSpace{random.uniform(0.1, 3) * random.direction(), random.uniform(-0.5, 0.5) * size};
}

Quat anyOrientation(Random& random) {
    switch (random.below(3)) {
        case 0:
            return random.orientation();
        case 1:
            return random.alignedOrientation();
        default:
            return random.nearly(random.alignedOrientation());
    }
}

/// Lengths that are multiples of a quarter, so that faces, edges and centres often coincide exactly.
Shape roundShape(Random& random) {
    const auto length = [&] { return 0.25 * (1 + random.below(4)); };
    switch (random.below(5)) {
        case 0:
            return Sphere{length()};
        case 3:
            return Cylinder{length(), length()};
        case 1:
            return Box{{length(), length(), length()}};
        case 2:
            return Capsule{length(), length()};
        default:
            return HalfSpace{Vec3::Unit(random.below(3)), length() - 0.5};
    }
}

::testing::AssertionResult isSane(const Manifold& m, double margin) {
    if (m.size > Manifold::capacity) return ::testing::AssertionFailure() << m.size << " points";
    if (m.size > 0 && !(std::abs(m.normal.norm() - 1) < 1e-9)) {
        return ::testing::AssertionFailure() << "normal " << m.normal.transpose();
    }
    for (std::size_t i = 0; i < m.size; ++i) {
        if (!m.points[i].point.allFinite() || !std::isfinite(m.points[i].distance)) {
            return ::testing::AssertionFailure() << "point " << i << " is not finite";
        }
        if (m.points[i].distance > margin) {
            return ::testing::AssertionFailure() << "distance " << m.points[i].distance << " beyond the margin";
        }
        for (std::size_t k = 0; k < i; ++k) {
            if (m.points[i].point == m.points[k].point) return ::testing::AssertionFailure() << "a point twice";
        }
    }
    return ::testing::AssertionSuccess();
}

void expectSame(const Manifold& m, const Manifold& swapped) {
    ASSERT_EQ(m.size, swapped.size);
    if (m.size == 0) return;
    ASSERT_EQ(m.normal, Vec3(-swapped.normal));
    for (std::size_t i = 0; i < m.size; ++i) {
        ASSERT_EQ(m.points[i].point, swapped.points[i].point);
        ASSERT_EQ(m.points[i].distance, swapped.points[i].distance);
    }
}

TEST(AllPairs, SwappingGivesTheSameBitsWithTheOppositeNormal) {
    Random random(21);
    int contacts = 0;
    for (int i = 0; i < 50000; ++i) {
        const Shape a = anyShape(random, 1);
        const Shape b = random.below(4) == 0 ? a : anyShape(random, 1);
        const Pose pose_a{random.vector(0.5), anyOrientation(random)};
        const Pose pose_b{random.below(8) == 0 ? pose_a.position : random.vector(0.5), anyOrientation(random)};
        // Of two bodies that are equal in everything none can be told from the other.
        if (pose_a.position == pose_b.position && pose_a.orientation.isApprox(pose_b.orientation)) continue;
        const Manifold m = contactOf(a, pose_a, b, pose_b, 0.01);
        expectSame(m, contactOf(b, pose_b, a, pose_a, 0.01));
        if (::testing::Test::HasFatalFailure()) FAIL() << shapeName(a) << " and " << shapeName(b) << ", pose " << i;
        if (m.size > 0) ++contacts;
    }
    EXPECT_GT(contacts, 10000);
}

TEST(AllPairs, AnyPoseGivesFiniteDistinctPointsAndAUnitNormal) {
    Random random(22);
    for (int i = 0; i < samples(200000); ++i) {
        const bool round = random.below(2) == 0;
        const Shape a = round ? roundShape(random) : anyShape(random, 1);
        const Shape b = round ? roundShape(random) : anyShape(random, 1);
        const Vec3 apart = round ? Vec3(0.25 * random.below(4) * Vec3::Unit(random.below(3))) : random.vector(1);
        const Pose pose_a{random.vector(1), round ? random.alignedOrientation() : anyOrientation(random)};
        const Pose pose_b{pose_a.position + apart, random.below(2) == 0 ? pose_a.orientation : anyOrientation(random)};
        const double margin = random.below(3) == 0 ? 0 : std::pow(10.0, -random.below(6));
        ASSERT_TRUE(isSane(contactOf(a, pose_a, b, pose_b, margin), margin))
            << shapeName(a) << " and " << shapeName(b) << ", pose " << i;
    }
}

TEST(AllPairs, AbsurdlyFarBodiesDoNotTouch) {
    for (const double far : {1e100, 1e160, 1e300}) {
        for (const Shape& a : {Shape(Sphere{}), Shape(Box{}), Shape(Capsule{}), Shape(Cylinder{})}) {
            for (const Shape& b : {Shape(Sphere{}), Shape(Box{}), Shape(Capsule{}), Shape(HalfSpace{})}) {
                EXPECT_EQ(contactOf(a, at({0, far, far}), b, at({0, 0, 0})).size, 0U);
            }
        }
    }
}

/// Situations in general position, so that no preference is a tie; the same for every motion.
TEST(AllPairs, MovingBothBodiesMovesTheContact) {
    Random random(23);
    int contacts = 0;
    for (int i = 0; i < 20000; ++i) {
        const Shape a = random.solid(1);
        const Shape b = anyShape(random, 1);
        const Pose pose_a{random.vector(0.5), random.orientation()};
        const Pose pose_b{random.vector(0.5), random.orientation()};
        const Pose motion{random.vector(5), random.orientation()};
        const auto moved = [&](const Pose& pose) {
            return Pose{motion.toOuter(pose.position), (motion.orientation * pose.orientation).normalized()};
        };
        const Manifold m = contactOf(a, pose_a, b, pose_b, 0.01);
        const Manifold after = contactOf(a, moved(pose_a), b, moved(pose_b), 0.01);
        ASSERT_EQ(m.size == 0, after.size == 0);
        if (m.size == 0) continue;
        ++contacts;
        // Two boxes change places in the canonical order; the preference for the first one's faces may then choose
        // another of two nearly equal contacts.
        ASSERT_NEAR(deepest(m), deepest(after), 2e-3 + 0.04 * std::abs(deepest(m))) << "pose " << i;
        if (std::abs(deepest(m) - deepest(after)) > 1e-9 || a.index() == 1) continue;
        // The direction of least overlap of round shapes is found by trial: a depth right to 1e-11 has an angle to
        // 1e-5.
        const bool round = std::holds_alternative<Cylinder>(a) || std::holds_alternative<Cylinder>(b);
        ASSERT_LE((motion.orientation * m.normal - after.normal).norm(), round ? 1e-4 : 1e-6) << "pose " << i;
    }
    EXPECT_GT(contacts, 4000);
}

TEST(AllPairs, ContactsFarFromTheOriginAreThoseNearIt) {
    Random random(24);
    int contacts = 0;
    const Vec3 far(1048576, -2097152, 524288);  // multiples of a power of two: positions below keep all their bits
    for (int i = 0; i < 20000; ++i) {
        const auto grid = [&]() -> Vec3 {
            const double x = random.below(4096) - 2048;
            const double y = random.below(4096) - 2048;
            return Vec3(x, y, random.below(4096) - 2048) / 4096;
        };
        const Shape a = random.solid(1);
        const Shape b = anyShape(random, 1);
        const Pose pose_a{grid(), anyOrientation(random)};
        const Pose pose_b{grid(), anyOrientation(random)};
        const Manifold near = contactOf(a, pose_a, b, pose_b, 0.01);
        const Manifold away = contactOf(a, {pose_a.position + far, pose_a.orientation}, b,
                                        {pose_b.position + far, pose_b.orientation}, 0.01);
        ASSERT_EQ(near.size, away.size) << "pose " << i;
        if (near.size == 0) continue;
        ++contacts;
        ASSERT_EQ(near.normal, away.normal);
        for (std::size_t k = 0; k < near.size; ++k) {
            ASSERT_EQ(near.points[k].distance, away.points[k].distance);
            ASSERT_LE((near.points[k].point + far - away.points[k].point).norm(), 1e-9);
        }
    }
    EXPECT_GT(contacts, 4000);
}

Shape scaled(const Shape& shape, double factor) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return Sphere{factor * sphere->radius};
    if (const auto* box = std::get_if<Box>(&shape)) return Box{factor * box->size};
    if (const auto* capsule = std::get_if<Capsule>(&shape)) {
        return Capsule{factor * capsule->radius, factor * capsule->length};
    }
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        return Cylinder{factor * cylinder->radius, factor * cylinder->length};
    }
    const auto& half_space = std::get<HalfSpace>(shape);
    return HalfSpace{half_space.normal, factor * half_space.offset};
}

TEST(AllPairs, MillimetresAndKilometresTouchLikeMetres) {
    Random random(25);
    for (int i = 0; i < 20000; ++i) {
        const Shape a = random.solid(1);
        const Shape b = anyShape(random, 1);
        const Pose pose_a{random.vector(0.5), anyOrientation(random)};
        const Pose pose_b{random.vector(0.5), anyOrientation(random)};
        const Manifold m = contactOf(a, pose_a, b, pose_b, 0x1p-7);
        for (const double factor : {0x1p-10, 0x1p10}) {  // powers of two scale without rounding
            const Manifold other =
                contactOf(scaled(a, factor), {factor * pose_a.position, pose_a.orientation}, scaled(b, factor),
                          {factor * pose_b.position, pose_b.orientation}, factor * 0x1p-7);
            ASSERT_EQ(m.size, other.size) << "pose " << i << ", factor " << factor;
            for (std::size_t k = 0; k < m.size; ++k) {
                ASSERT_NEAR(m.points[k].distance, other.points[k].distance / factor, 1e-9);
                ASSERT_LE((m.points[k].point - other.points[k].point / factor).norm(), 1e-9);
            }
        }
    }
}

TEST(AllPairs, ATinyBodyOnAHugeOneHasTheSameManifold) {
    const Box ground{{1000, 1000, 1000}};
    const double size = 1e-3;
    const Manifold box = contactOf(Box{Vec3::Constant(size)}, at({300, 200, 500.00049}), ground, at({0, 0, 0}), 1e-5);
    EXPECT_TRUE(touches(box, Vec3::UnitZ(), -1e-5, 1e-12));
    EXPECT_EQ(box.size, 4U);
    const Manifold sphere = contactOf(Sphere{size}, at({300, 200, 500.00099}), ground, at({0, 0, 0}), 1e-5);
    EXPECT_TRUE(touches(sphere, Vec3::UnitZ(), -1e-5, 1e-12));
    const Manifold capsule =
        contactOf(Capsule{size, size}, at({300, 200, 500.00099}, Vec3::UnitY(), 90), ground, at({0, 0, 0}), 1e-5);
    EXPECT_TRUE(touches(capsule, Vec3::UnitZ(), -1e-5, 1e-12));
    EXPECT_EQ(capsule.size, 2U);
}

}  // namespace
}  // namespace cairn::testing
