#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "batches/follow_progress.h"

namespace cairn {
namespace {

using Amounts = std::map<std::uint32_t, double>;  ///< by contact

/// Two piles of three bodies on the ground, 0; contact i is that of bodies i and i + 1.
class FollowProgressTest : public ::testing::Test {
  protected:
    FollowProgressTest() : contacts_(6) {
        for (std::uint32_t i = 0; i < contacts_.size(); ++i) {
            contacts_[i].a = i == 3 ? 0 : i;
            contacts_[i].b = i + 1;
        }
        progress_.begin(kind_);
    }

    /// A round that leaves so much. @return what is gone on with
    std::vector<std::uint32_t> roundThatLeaves(const Amounts& amounts, const std::vector<std::uint32_t>& added = {}) {
        std::vector<std::uint32_t> left;
        for (const auto& [contact, amount] : amounts) left.push_back(contact);
        progress_.giveUp(left, added, contacts_, [&](std::uint32_t i) { return amounts.at(i); });
        return left;
    }

    void join(std::vector<BodyIndex> bodies) {
        const std::vector<BatchView> groups{{bodies, {}}};
        progress_.join(groups);
    }

    std::vector<BodyKind> kind_{BodyKind::fixed,   BodyKind::dynamic, BodyKind::dynamic, BodyKind::dynamic,
                                BodyKind::dynamic, BodyKind::dynamic, BodyKind::dynamic};
    std::vector<Contact> contacts_;
    FollowProgress progress_;
};

using Contacts = std::vector<std::uint32_t>;

TEST_F(FollowProgressTest, GoesOnWhereRoundsHalveWhatIsLeft) {
    double amount = 1;
    for (int round = 0; round < 40; ++round, amount *= 0.5) EXPECT_EQ(roundThatLeaves({{1, amount}}), Contacts{1});
}

TEST_F(FollowProgressTest, GivesUpWhereSixRoundsDoNotHalveIt) {
    double amount = 1;
    for (int round = 0; round < 6; ++round, amount *= 0.9) EXPECT_EQ(roundThatLeaves({{1, amount}}), Contacts{1});
    EXPECT_EQ(roundThatLeaves({{1, amount}}), Contacts{});
    EXPECT_EQ(roundThatLeaves({{1, amount}}), Contacts{});
}

TEST_F(FollowProgressTest, GivesUpWhatIsHandedFromPairToPair) {
    for (int round = 0; round < 6; ++round) {
        const std::uint32_t contact = round % 2 == 0 ? 1 : 2;
        EXPECT_EQ(roundThatLeaves({{contact, 1.0}}), Contacts{contact});
        join({1, 2, 3});
    }
    EXPECT_EQ(roundThatLeaves({{1, 1.0}}), Contacts{});
}

TEST_F(FollowProgressTest, TellsPilesApart) {
    double amount = 1;
    for (int round = 0; round < 6; ++round, amount *= 0.5) roundThatLeaves({{1, 1.0}, {4, amount}});
    EXPECT_EQ(roundThatLeaves({{1, 1.0}, {4, amount}}), Contacts{4});
}

TEST_F(FollowProgressTest, TellsPilesOnTheSameGroundApart) {
    double amount = 1;
    for (int round = 0; round < 6; ++round, amount *= 0.5) roundThatLeaves({{0, 1.0}, {3, amount}});
    EXPECT_EQ(roundThatLeaves({{0, 1.0}, {3, amount}}), Contacts{3});
}

TEST_F(FollowProgressTest, BeginsAnewWhereSomethingStrikes) {
    for (int round = 0; round < 6; ++round) roundThatLeaves({{1, 1.0}, {4, 1.0}});
    EXPECT_EQ(roundThatLeaves({{1, 1.0}, {4, 1.0}}, {5}), Contacts{4});
    EXPECT_EQ(roundThatLeaves({{1, 1.0}, {4, 1.0}}), Contacts{4});
}

TEST_F(FollowProgressTest, ForgetsEarlierSteps) {
    for (int round = 0; round < 9; ++round) roundThatLeaves({{1, 1.0}});
    progress_.begin(kind_);
    EXPECT_EQ(roundThatLeaves({{1, 1.0}}), Contacts{1});
}

}  // namespace
}  // namespace cairn
