#include "world/found_contacts.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "world/world_state.h"

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
    StepData data;

    Joining() {
        materials.add({.name = "matter", .density = 1});
        for (int i = 0; i < 2; ++i) bodies.allocate(BodyKind::dynamic);
    }
    void join(DetectionRound round) { joinContacts(bodies, materials, Executor(2), round, data); }
};

TEST(FoundContacts, ContactsThatStayAndNewOnesComeInTheirOrder) {
    std::mt19937 random(5);
    for (int trial = 0; trial < 300; ++trial) {
        Joining joining;
        StepData& data = joining.data;
        for (int i = 0; i < 40; ++i) data.contacts.push_back({.a = 0, .b = 1, .distance = 1.0 * i});
        data.thread_contacts.resize(2);
        std::vector<double> expected;
        double next_new = 1000;
        for (std::size_t old = 0; old < 40;) {
            FoundContacts& part = data.thread_contacts[old < 20 ? 0 : 1];
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
        joining.join(DetectionRound::first);
        ASSERT_EQ(distancesOf(data.contacts), expected) << "trial " << trial;
    }
}

TEST(FoundContacts, WhatStaysBeginsWithTheImpulsesOfTheLastStep) {
    for (const bool has_history : {true, false}) {
        Joining joining;
        StepData& data = joining.data;
        data.contacts = {{.a = 0, .b = 1, .reference_impulse = Vec3(5, 0, 0), .impulse = Vec3(3, 0, 0)}};
        data.has_history = has_history;
        data.thread_contacts.resize(1);
        data.thread_contacts[0].add(0, 1, true);
        joining.join(DetectionRound::first);
        const Contact& contact = data.contacts[0];
        EXPECT_EQ(contact.last_impulse, has_history ? Vec3(3, 0, 0) : Vec3(0, 0, 0));
        EXPECT_EQ(contact.reference_impulse, has_history ? Vec3(5, 0, 0) : Vec3(0, 0, 0));
        EXPECT_EQ(contact.impulse, Vec3(0, 0, 0));
        const Vec3 before = contact.last_impulse;
        joining.join(DetectionRound::later);
        EXPECT_EQ(data.contacts[0].last_impulse, before) << "it is the same step still";
    }
}

}  // namespace
}  // namespace cairn
