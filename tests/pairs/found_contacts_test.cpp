#include "pairs/found_contacts.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace cairn {
namespace {

/// What contacts are told apart by.
std::vector<double> distancesOf(std::span<const Contact> contacts) {
    std::vector<double> distances;
    for (const Contact& contact : contacts) distances.push_back(contact.distance);
    return distances;
}

struct Joining {
    BodyStorage bodies;
    MaterialTable materials;
    std::vector<Contact> contacts;
    std::vector<FoundContacts> parts;
    ContactJoiner joiner;

    Joining() {
        materials.add({.name = "matter", .density = 1});
        for (int i = 0; i < 2; ++i) bodies.allocate(BodyKind::dynamic);
    }
    void join() { joiner.join(bodies, materials, Executor(2), parts, contacts); }
};

TEST(FoundContacts, ContactsThatStayAndNewOnesComeInTheirOrder) {
    std::mt19937 random(5);
    for (int trial = 0; trial < 300; ++trial) {
        Joining joining;
        for (int i = 0; i < 40; ++i) joining.contacts.push_back({.a = 0, .b = 1, .distance = 1.0 * i});
        joining.parts.resize(2);
        std::vector<double> expected;
        double next_new = 1000;
        for (std::size_t old = 0; old < 40;) {
            FoundContacts& part = joining.parts[old < 20 ? 0 : 1];
            const std::size_t some = std::min<std::size_t>(1 + random() % 4, 40 - old);
            switch (random() % 3) {
                case 0:  // they stay
                    part.add(old, some, true);
                    for (std::size_t i = 0; i < some; ++i) expected.push_back(static_cast<double>(old + i));
                    break;
                case 1:  // they are gone
                    break;
                default:  // others come in their stead
                    for (std::size_t i = random() % 6; i > 0; --i) {
                        part.found.push_back({0, 1, Vec3::Zero(), Vec3::UnitX(), next_new});
                        part.add(part.found.size() - 1, 1, false);
                        expected.push_back(next_new++);
                    }
            }
            old += some;
        }
        joining.join();
        ASSERT_EQ(distancesOf(joining.contacts), expected) << "trial " << trial;
    }
}

std::vector<FoundContact> touchingIn(const std::vector<Vec3>& points) {
    std::vector<FoundContact> contacts;
    for (const Vec3& point : points) {
        contacts.push_back(
            {.a = 0, .b = 1, .point = point, .normal = Vec3::UnitZ(), .distance = 0.01, .allowed_overlap = 0.02});
    }
    return contacts;
}

TEST(SquaredPatch, IsThatOfTheNarrowestSide) {
    const Vec3 at(3, -2, 5);
    const Quat turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
    const auto place = [&](double x, double y) -> Vec3 { return at + turn * Vec3(x, y, 0); };
    EXPECT_NEAR(squaredPatchOf(touchingIn({place(0.3, 0.1), place(-0.3, 0.1), place(0.3, -0.1), place(-0.3, -0.1)})),
                0.01, 1e-12);
    EXPECT_NEAR(squaredPatchOf(touchingIn({place(0, 0), place(0.1, 0.2), place(-0.2, -0.4)})), 0, 1e-12) << "a line";
    EXPECT_EQ(squaredPatchOf(touchingIn({place(0, 0), place(1, 1)})), 0);
    EXPECT_EQ(squaredPatchOf({}), 0);
}

TEST(SquaredPatch, LeavesOutWhatIsApart) {
    std::vector<FoundContact> contacts = touchingIn({{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}});
    contacts[0].distance = 0.03;
    EXPECT_GT(squaredPatchOf(contacts), 0.2);
    contacts[1].distance = 0.03;
    EXPECT_EQ(squaredPatchOf(contacts), 0);
}

TEST(FoundContacts, WideOnesResistRollingByWhereTheyPress) {
    Joining joining;
    joining.materials.setDefault(
        {.static_friction = 0.5, .kinetic_friction = 0.5, .rolling_friction = 0.2, .spinning_friction = 0.2});
    joining.parts.resize(1);
    for (const double half_width : {0.1, 0.3, 0.5}) {
        joining.parts[0].found.push_back({0, 1, Vec3::Zero(), Vec3::UnitX(), 0});
        joining.parts[0].found.back().squared_patch = half_width * half_width;
    }
    joining.parts[0].add(0, 3, false);
    joining.join();
    EXPECT_EQ(joining.contacts[0].rolling_friction, 0.2);
    EXPECT_EQ(joining.contacts[0].spinning_friction, 0.2);
    EXPECT_EQ(joining.contacts[1].rolling_friction, 0);
    EXPECT_EQ(joining.contacts[1].spinning_friction, 0.2) << "sliding there resists with 0.15 m";
    EXPECT_EQ(joining.contacts[2].spinning_friction, 0);
}

}  // namespace
}  // namespace cairn
