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

}  // namespace
}  // namespace cairn
