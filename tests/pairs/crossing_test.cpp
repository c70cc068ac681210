/// Contacts with triangles that the middle of a body, or of a part of it, would pass through within a step.
#include <gtest/gtest.h>

#include <vector>

#include "broad_phase/hash_grids.h"
#include "pairs/foreseen.h"
#include "pairs/pair_table.h"

namespace cairn {
namespace {

constexpr double height = 1;
constexpr double half_width = 0.05;

/// A wall that is thin at its top: two faces that meet in the y axis 1 m above the ground.
Mesh fin() {
    std::vector<Vec3> vertices;
    std::vector<TriangleCorners> triangles;
    for (std::uint32_t j = 0; j <= 4; ++j) {
        const double y = 0.5 * j - 1;
        vertices.emplace_back(-half_width, y, 0);
        vertices.emplace_back(0, y, height);
        vertices.emplace_back(half_width, y, 0);
        if (j == 0) continue;
        const std::uint32_t a = 3 * (j - 1);
        for (std::uint32_t k = a; k < a + 2; ++k) {
            triangles.push_back({k, k + 1, k + 4});
            triangles.push_back({k, k + 4, k + 3});
        }
    }
    return Mesh(vertices, triangles);
}

/// Of the face towards −x.
const Vec3 left_normal = Vec3(-height, 0, half_width).normalized();

double heightOverLeft(const Vec3& p) {
    return left_normal.dot(p - Vec3(-half_width, 0, 0));
}

Mesh floor() {
    return Mesh({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

struct Crossing {
    Vec3 point, normal;
    double distance;
};

/// A solid and a surface, which move on for a sixtieth of a second.
struct Flight {
    BodyStorage bodies;
    DetectionRange range{.threshold = 1e-3, .foresight = {1.0 / 60, Vec3(0, 0, -1.0 / 6)}};
    BodyIndex solid = 0;
    BodyIndex ground = 0;

    /// Who has the lower slot.
    enum class First { solid, ground };

    Flight(const Shape& flies, const Pose& pose, const Vec3& v, const Shape& surface, First first = First::solid) {
        for (const bool is_solid : {first == First::solid, first != First::solid}) {
            const BodyIndex i = bodies.allocate(is_solid ? BodyKind::dynamic : BodyKind::fixed);
            (is_solid ? solid : ground) = i;
            bodies.shape[i] = is_solid ? flies : surface;
            bodies.r_max[i] = largestRadius(bodies.shape[i]);
            bodies.r_min[i] = is_solid ? smallestRadius(flies) : std::numeric_limits<double>::infinity();
        }
        bodies.position[solid] = pose.position;
        bodies.orientation[solid] = pose.orientation;
        bodies.v[solid] = v;
    }
    std::vector<Crossing> crossings() const {
        std::vector<BodyAhead> ahead(2);
        for (const BodyIndex i : {solid, ground}) searchedBounds(bodies, range, i, ahead[i]);
        const BodyPair pair{0, 1};
        const PairAhead both(bodies, range, pair, ahead);
        std::vector<Crossing> found;
        if (!both.mayCross()) return found;
        both.forEachCrossing([&](const Vec3& point, const Vec3& normal, double distance) {
            found.push_back({point, normal, distance});
        });
        return found;
    }
    /// What a step would work with.
    std::vector<Contact> contacts() {
        MaterialTable materials;
        materials.add({.name = "matter", .density = 1});
        HashGrids broad_phase;
        const Executor executor(1);
        PairTable pairs;
        std::vector<Contact> contacts;
        pairs.detect({bodies, materials, broad_phase, {}, range, executor}, contacts);
        return contacts;
    }
};

/// Two balls on a rod without width, a metre from its middle.
Compound dumbbell(const Vec3& along) {
    Compound made;
    for (const double end : {-1.0, 1.0}) made.parts.push_back({Sphere{0.1}, {end * along}, {}, {}});
    return made;
}

TEST(CrossingContacts, AreThoseOfABallWithThePlaneInItsWay) {
    for (const Flight::First first : {Flight::First::solid, Flight::First::ground}) {
        const Flight flight(Sphere{0.1}, {Vec3(0.3, -0.2, 0.4)}, Vec3(12, 3, -40), floor(), first);
        const std::vector<Crossing> found = flight.crossings();
        ASSERT_EQ(found.size(), 1U);
        EXPECT_LT((found[0].point - Vec3(0.3, -0.2, 0.3)).norm(), 1e-12);
        const double to_a = first == Flight::First::solid ? 1 : -1;
        EXPECT_LT((found[0].normal - to_a * Vec3::UnitZ()).norm(), 1e-12);
        EXPECT_NEAR(found[0].distance, 0.3, 1e-12) << "what is between them now";
    }
}

TEST(CrossingContacts, ThereAreNoneOfWhatPassesByPartsOrIsSlow) {
    const Vec3 place(-0.3, 0.2, 0.5);
    EXPECT_EQ(Flight(Sphere{0.1}, {place}, Vec3(40, 0, 0), fin()).crossings().size(), 1U);
    EXPECT_TRUE(Flight(Sphere{0.1}, {place}, Vec3(40, 0, 120), fin()).crossings().empty()) << "over it";
    EXPECT_TRUE(Flight(Sphere{0.1}, {place}, Vec3(0, 40, 0), fin()).crossings().empty()) << "beside it";
    EXPECT_TRUE(Flight(Sphere{0.1}, {place}, Vec3(-40, 0, 0), fin()).crossings().empty()) << "away from it";
    EXPECT_TRUE(Flight(Sphere{0.1}, {place}, Vec3(2, 0, 0), fin()).crossings().empty()) << "slow";
    EXPECT_TRUE(Flight(Sphere{0.1}, {place}, Vec3(40, 0, 0), Box{{0.1, 2, 2}}).crossings().empty()) << "no surface";
}

TEST(CrossingContacts, OfACompoundAreThoseOfThePartsThatWouldPass) {
    // Only one of its ends flies against the wall; the other passes beside it.
    const Vec3 middle(-0.3, 1.5, 0.5);
    const Flight flight(dumbbell(Vec3::UnitY()), {middle}, Vec3(40, 0, 0), fin());
    const std::vector<Crossing> found = flight.crossings();
    ASSERT_EQ(found.size(), 1U);
    const Vec3 part = middle - Vec3::UnitY();
    EXPECT_LT((found[0].normal - left_normal).norm(), 1e-12);
    EXPECT_LT((found[0].point - (part - 0.1 * left_normal)).norm(), 1e-12);
    EXPECT_NEAR(found[0].distance, heightOverLeft(part) - 0.1, 1e-12);
    // Before the wall with all its length both have one.
    EXPECT_EQ(Flight(dumbbell(0.5 * Vec3::UnitY()), {Vec3(-0.3, 0.1, 0.5)}, Vec3(40, 0, 0), fin()).crossings().size(),
              2U);
}

TEST(CrossingContacts, SeeHowABodyTurns) {
    // Its middle stays; the wall is within the arc that one of its ends goes.
    Flight flight(dumbbell(Vec3::UnitY()), {Vec3(-0.2, 0, 0.5)}, Vec3::Zero(), fin());
    flight.bodies.w[flight.solid] = Vec3(0, 0, -30);
    const std::vector<Crossing> found = flight.crossings();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_LT((found[0].normal - left_normal).norm(), 1e-12);
    EXPECT_LT((found[0].point - (Vec3(-0.2, 1, 0.5) - 0.1 * left_normal)).norm(), 1e-12);
    // The speed of the end is more than the contact allows.
    const Vec3 v = Vec3(0, 0, -30).cross(found[0].point - Vec3(-0.2, 0, 0.5));
    EXPECT_LT(found[0].distance, -v.dot(left_normal) / 60);
}

TEST(CrossingContacts, SeeHowTheSurfaceMoves) {
    Flight flight(Sphere{0.1}, {Vec3(-0.3, 0.2, 0.5)}, Vec3::Zero(), fin());
    flight.range.foresight.fall.setZero();
    flight.bodies.v[flight.ground] = Vec3(-40, 0, 0);
    const std::vector<Crossing> found = flight.crossings();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_LT((found[0].normal - left_normal).norm(), 1e-12);
    EXPECT_NEAR(found[0].distance, heightOverLeft(Vec3(-0.3, 0.2, 0.5)) - 0.1, 1e-12);
}

TEST(CrossingContacts, AreForeseenOnesOfTheirPair) {
    for (const Flight::First first : {Flight::First::solid, Flight::First::ground}) {
        Flight flight(dumbbell(Vec3::UnitY()), {Vec3(-0.3, 1.5, 0.5)}, Vec3(40, 0, 0), fin(), first);
        const Vec3 normal = first == Flight::First::solid ? left_normal : Vec3(-left_normal);
        const double gap = heightOverLeft(Vec3(-0.3, 0.5, 0.5)) - 0.1;
        int crossing = 0;
        for (const Contact& c : flight.contacts()) {
            if ((c.normal - normal).norm() > 1e-9 || std::abs(c.distance - gap) > 1e-9) continue;
            ++crossing;
            EXPECT_TRUE(c.isForeseen());
            EXPECT_NEAR(c.allowed_closing, 60 * gap, 1e-9);
            EXPECT_NEAR(c.allowed_overlap, 1e-3, 1e-15);
        }
        EXPECT_GE(crossing, 1);
    }
    // What is behind the face already is stopped where it is.
    Flight inside(Sphere{0.3}, {Vec3(-0.04, 0.2, 0.5)}, Vec3(40, 0, 0), fin());
    for (const Contact& c : inside.contacts()) EXPECT_GE(c.allowed_closing, 0);
}

}  // namespace
}  // namespace cairn
