/// The pairs that lanes work on at once, and sweeps over them.
#include "resolution/lane_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "resolution/batch_fixture.h"
#include "resolution/sweeps.h"

namespace cairn {
namespace {

constexpr std::uint32_t moving_bodies = 150;

/// Visits each contact in the order of the groups, row by row. @return [contacts] the group that it is in
std::vector<std::size_t> groupsOf(const LaneGroups& groups, std::span<const ContactEnds> ends) {
    std::vector<std::size_t> group_of(ends.size(), SIZE_MAX);
    for (std::size_t g = 0; g < groups.groups().size(); ++g) {
        const LaneGroup& group = groups.groups()[g];
        for (std::size_t row = group.begin; row < group.end; ++row) {
            for (std::size_t lane = 0; lane < lane_count; ++lane) {
                const std::uint32_t contact = groups.contactsOf(row)[lane];
                if (contact == LaneGroups::no_contact) continue;
                EXPECT_EQ(group_of[contact], SIZE_MAX) << "once";
                group_of[contact] = g;
                EXPECT_EQ(groups.slots()[contact], row * lane_count + lane);
                EXPECT_EQ(ends[contact], (ContactEnds{group.a[lane], group.b[lane]}));
            }
        }
    }
    return group_of;
}

TEST(LaneGroups, InOrderComeAfterAllThatTheyShareABodyWith) {
    const std::vector<ContactEnds> ends = test::randomEnds(3, 200, 900);
    LaneGroups groups;
    groups.inOrder(ends, moving_bodies);
    ASSERT_EQ(groups.sets(), 1U);
    EXPECT_FALSE(groups.isShared(0));
    const std::vector<std::size_t> group_of = groupsOf(groups, ends);
    for (std::size_t later = 0; later < ends.size(); ++later) {
        for (std::size_t earlier = 0; earlier < later; ++earlier) {
            if (ends[earlier] == ends[later]) {
                EXPECT_EQ(group_of[earlier], group_of[later]);
                continue;
            }
            const auto isShared = [&](std::uint32_t body) {
                return body < moving_bodies && (body == ends[later].a || body == ends[later].b);
            };
            if (!isShared(ends[earlier].a) && !isShared(ends[earlier].b)) continue;
            EXPECT_LT(group_of[earlier], group_of[later]);
        }
    }
    EXPECT_GT(ends.size(), groups.rows() * lane_count / 2) << "lanes are well filled";
}

TEST(LaneGroups, ByColoursHoldEveryContactOnceInSharedSets) {
    const std::vector<ContactEnds> ends = test::randomEnds(4, 200, 900);
    LaneGroups groups;
    groups.inOrder(ends, moving_bodies);
    groups.byColours(ends, moving_bodies);
    EXPECT_EQ(std::ranges::count(groupsOf(groups, ends), SIZE_MAX), 0);
    EXPECT_GT(groups.sets(), 1U);
    for (std::size_t set = 0; set < groups.sets(); ++set) EXPECT_TRUE(groups.isShared(set));
}

TEST(LaneGroups, NothingHasNoGroups) {
    LaneGroups groups;
    groups.inOrder({}, 0);
    EXPECT_TRUE(groups.groups().empty());
    EXPECT_EQ(groups.rows(), 0U);
    groups.byColours({}, 0);
    EXPECT_TRUE(groups.groups().empty());
}

/// Solves a pile as one batch. @return visits
template <class Sweeper>
std::int64_t sweep(test::Pile& pile, SweepOrder order) {
    std::vector<BodyIndex> bodies;
    for (BodyIndex i = 0; i < pile.kind.size(); ++i) {
        if (pile.kind[i] == BodyKind::dynamic) bodies.push_back(i);
    }
    std::vector<std::uint32_t> indices(pile.contacts.size());
    std::iota(indices.begin(), indices.end(), 0U);
    ResolutionSettings settings = test::exactSettings();
    settings.iterations = 40;
    settings.tolerance = 1e-3;
    BodyState state = pile.state();
    state.time_step = 1.0 / 240;
    const BatchView batch{bodies, indices, {}};
    BatchKind kind = kindOf(batch, pile.contacts, state, settings);
    kind.order = order;
    Sweeps<Sweeper> sweeps;
    return sweeps.resolve(batch, kind, pile.contacts, state, settings, Executor{});
}

TEST(LaneGroups, SweepsInOrderGiveTheSameBitsAsOneByOne) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        test::Pile one_by_one = test::randomPile(seed, 60, 200, 5);
        test::Pile in_order = test::randomPile(seed, 60, 200, 5);
        const std::int64_t visits = sweep<OrderedSweeper>(one_by_one, SweepOrder::one_by_one);
        EXPECT_GT(visits, 2000);
        EXPECT_EQ(sweep<LaneSweeper>(in_order, SweepOrder::in_order), visits);
        for (std::size_t i = 0; i < in_order.v.size(); ++i) {
            ASSERT_EQ(in_order.v[i], one_by_one.v[i]) << "body " << i;
            ASSERT_EQ(in_order.w[i], one_by_one.w[i]) << "body " << i;
        }
        for (std::size_t i = 0; i < in_order.contacts.size(); ++i) {
            ASSERT_EQ(in_order.contacts[i].impulse, one_by_one.contacts[i].impulse) << "contact " << i;
        }
    }
}

}  // namespace
}  // namespace cairn
