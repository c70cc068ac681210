#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "batches/batches.h"
#include "batches/schedule.h"
#include "batches/surroundings.h"

namespace cairn {
namespace {

constexpr BodyKind D = BodyKind::dynamic;
constexpr BodyKind F = BodyKind::fixed;
constexpr BodyKind H = BodyKind::hole;

/// splitmix64.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint32_t below(std::size_t limit) {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return static_cast<std::uint32_t>((z ^ (z >> 31)) % limit);
    }

  private:
    std::uint64_t state_;
};

using Pairs = std::vector<std::pair<BodyIndex, BodyIndex>>;

/// Sorted as the narrow phase delivers them.
std::vector<Contact> contactsBetween(Pairs pairs) {
    for (auto& [a, b] : pairs) {
        if (a > b) std::swap(a, b);
    }
    std::sort(pairs.begin(), pairs.end());
    std::vector<Contact> contacts(pairs.size());
    for (std::size_t c = 0; c < pairs.size(); ++c) std::tie(contacts[c].a, contacts[c].b) = pairs[c];
    return contacts;
}

/// A batch, for comparison.
struct Group {
    std::vector<BodyIndex> bodies;
    std::vector<std::uint32_t> contacts;

    friend bool operator==(const Group&, const Group&) = default;
};

std::vector<Group> groupsOf(const Batches& batches) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < batches.size(); ++i) {
        const BatchView view = batches[i];
        groups.push_back({{view.bodies.begin(), view.bodies.end()}, {view.contacts.begin(), view.contacts.end()}});
    }
    return groups;
}

Batches build(const std::vector<BodyKind>& kind, const std::vector<Contact>& contacts) {
    BatchScratch scratch;
    Batches batches;
    buildBatches(kind, contacts, scratch, batches);
    return batches;
}

/// Breadth-first search from each body in ascending order; contacts of each body are searched for, slowly.
std::vector<Group> searchGroups(const std::vector<BodyKind>& kind, const std::vector<Contact>& contacts) {
    std::vector<Group> groups;
    std::vector<char> seen(kind.size(), 0);
    for (BodyIndex start = 0; start < kind.size(); ++start) {
        if (kind[start] != D || seen[start] != 0) continue;
        seen[start] = 1;
        Group group{{start}, {}};
        for (std::size_t at = 0; at < group.bodies.size(); ++at) {
            for (std::uint32_t c = 0; c < contacts.size(); ++c) {
                const BodyIndex body = group.bodies[at];
                if (contacts[c].a != body && contacts[c].b != body) continue;
                group.contacts.push_back(c);
                const BodyIndex other = contacts[c].a == body ? contacts[c].b : contacts[c].a;
                if (kind[other] != D || seen[other] != 0) continue;
                seen[other] = 1;
                group.bodies.push_back(other);
            }
        }
        if (group.contacts.empty()) continue;
        std::sort(group.bodies.begin(), group.bodies.end());
        std::sort(group.contacts.begin(), group.contacts.end());
        const auto last = std::unique(group.contacts.begin(), group.contacts.end());
        group.contacts.erase(last, group.contacts.end());
        groups.push_back(group);
    }
    return groups;
}

struct Graph {
    std::vector<BodyKind> kind;
    std::vector<Contact> contacts;
};

/// @param density contacts per body
Graph randomGraph(Random& random, std::size_t bodies, double density) {
    Graph graph;
    for (std::size_t i = 0; i < bodies; ++i) {
        const auto draw = random.below(10);
        graph.kind.push_back(draw == 0 ? H : draw < 3 ? F : D);
    }
    Pairs pairs;
    const auto tries = static_cast<std::size_t>(density * static_cast<double>(bodies));
    for (std::size_t i = 0; i < tries; ++i) {
        const BodyIndex a = random.below(bodies);
        const BodyIndex b = random.below(bodies);
        if (a == b || graph.kind[a] == H || graph.kind[b] == H) continue;
        if (graph.kind[a] == F && graph.kind[b] == F) continue;
        for (std::uint32_t points = 1 + random.below(4); points > 0; --points) pairs.emplace_back(a, b);
    }
    graph.contacts = contactsBetween(pairs);
    return graph;
}

TEST(Batches, NoBodiesOrNoContactsGiveNoBatch) {
    EXPECT_EQ(build({}, {}).size(), 0u);
    EXPECT_EQ(Batches{}.size(), 0u);
    EXPECT_EQ(build({D, D, F, H}, {}).size(), 0u);
}

/// Figure 14 of the thesis: piles on one ground, which is fixed, are independent of each other.
TEST(Batches, PilesOnOneGroundAreIndependentGroups) {
    const std::vector<BodyKind> kind = {F, D, D, D, D, D, D, D, D};  // 0 is the ground, 8 is in the air
    const auto contacts = contactsBetween({{0, 1}, {0, 2}, {1, 3}, {2, 3}, {0, 4}, {4, 5}, {0, 6}, {6, 7}, {0, 7}});
    const std::vector<Group> expected = {{{1, 2, 3}, {0, 1, 5, 6}}, {{4, 5}, {2, 7}}, {{6, 7}, {3, 4, 8}}};
    EXPECT_EQ(groupsOf(build(kind, contacts)), expected);
}

TEST(Batches, AFixedBodyWithinAPileIsABarrierToo) {
    // A bridge: 0 leans on the fixed 1 from the left, 2 from the right.
    const std::vector<BodyKind> kind = {D, F, D};
    EXPECT_EQ(groupsOf(build(kind, contactsBetween({{0, 1}, {1, 2}}))), (std::vector<Group>{{{0}, {0}}, {{2}, {1}}}));
    // Once they touch each other, too, they are one group.
    EXPECT_EQ(groupsOf(build(kind, contactsBetween({{0, 1}, {0, 2}, {1, 2}}))),
              (std::vector<Group>{{{0, 2}, {0, 1, 2}}}));
}

TEST(Batches, AChainIsOneGroupWhicheverWayItIsNumbered) {
    constexpr BodyIndex length = 1000;
    Random random(1);
    std::vector<BodyIndex> number(length);
    std::iota(number.begin(), number.end(), 0u);
    for (int round = 0; round < 3; ++round) {
        Pairs pairs;
        for (BodyIndex i = 0; i + 1 < length; ++i) pairs.emplace_back(number[i], number[i + 1]);
        const Batches batches = build(std::vector<BodyKind>(length, D), contactsBetween(pairs));
        ASSERT_EQ(batches.size(), 1u);
        EXPECT_EQ(batches[0].bodies.size(), length);
        EXPECT_EQ(batches[0].contacts.size(), length - 1);
        std::reverse(number.begin(), number.end());
        if (round == 1) {
            for (std::size_t i = length; i > 1; --i) std::swap(number[i - 1], number[random.below(i)]);
        }
    }
}

TEST(Batches, EqualABreadthFirstSearchOnRandomGraphs) {
    Random random(2);
    std::size_t batches_seen = 0;
    for (int round = 0; round < 200; ++round) {
        const Graph graph = randomGraph(random, 1 + random.below(120), 0.1 + 0.01 * round);
        const Batches batches = build(graph.kind, graph.contacts);
        ASSERT_EQ(groupsOf(batches), searchGroups(graph.kind, graph.contacts)) << round;
        batches_seen += batches.size();
        ASSERT_EQ(batches.batch_of_contact.size(), graph.contacts.size());
        for (std::size_t i = 0; i < batches.size(); ++i) {
            for (const std::uint32_t c : batches[i].contacts) ASSERT_EQ(batches.batch_of_contact[c], i);
        }
    }
    EXPECT_GT(batches_seen, 1000u);
}

TEST(Batches, ScratchOfALargerStepDoesNotMatter) {
    Random random(3);
    BatchScratch scratch;
    Batches batches;
    for (const std::size_t bodies : {300, 20, 150, 2, 0}) {
        const Graph graph = bodies > 0 ? randomGraph(random, bodies, 0.8) : Graph{};
        buildBatches(graph.kind, graph.contacts, scratch, batches);
        EXPECT_EQ(groupsOf(batches), searchGroups(graph.kind, graph.contacts)) << bodies;
    }
}

TEST(Batches, OrderIsCanonicalWhateverTheOrderOfContacts) {
    // The groups, as sets of bodies in their order, must not depend on the order in which contacts are joined.
    Random random(4);
    for (int round = 0; round < 30; ++round) {
        Graph graph = randomGraph(random, 80, 0.6);
        const Batches expected = build(graph.kind, graph.contacts);
        for (std::size_t i = graph.contacts.size(); i > 1; --i) {
            std::swap(graph.contacts[i - 1], graph.contacts[random.below(i)]);
        }
        const Batches shuffled = build(graph.kind, graph.contacts);
        ASSERT_EQ(shuffled.bodies, expected.bodies);
        ASSERT_EQ(shuffled.body_begin, expected.body_begin);
        ASSERT_EQ(shuffled.contact_begin, expected.contact_begin);
        for (std::size_t i = 0; i < shuffled.size(); ++i) {
            ASSERT_TRUE(std::is_sorted(shuffled[i].contacts.begin(), shuffled[i].contacts.end()));
            if (i > 0) {
                ASSERT_LT(shuffled[i - 1].bodies.front(), shuffled[i].bodies.front());
            }
        }
    }
}

TEST(Batches, AContactThatNobodyCanFollowIsABrokenInvariant) {
    EXPECT_THROW(build({F, F}, contactsBetween({{0, 1}})), std::logic_error);
    EXPECT_THROW(build({F, H}, contactsBetween({{0, 1}})), std::logic_error);
}

TEST(ContactsOfBodies, ListTheContactsOfDynamicBodiesInAscendingOrder) {
    const std::vector<BodyKind> kind = {D, F, D, H, D};
    const auto contacts = contactsBetween({{0, 1}, {0, 2}, {0, 2}, {1, 2}});
    ContactsOfBodies lists;
    listContacts(kind, contacts, lists);
    const auto list = [&](BodyIndex i) { return std::vector<std::uint32_t>(lists[i].begin(), lists[i].end()); };
    EXPECT_EQ(list(0), (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(list(1).empty()) << "fixed";
    EXPECT_EQ(list(2), (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_TRUE(list(3).empty()) << "a hole";
    EXPECT_TRUE(list(4).empty()) << "touches nothing";
}

TEST(ContactsOfBodies, EqualASearchOnRandomGraphs) {
    Random random(5);
    ContactsOfBodies lists;
    for (int round = 0; round < 50; ++round) {
        const Graph graph = randomGraph(random, 1 + random.below(60), 1.5);
        listContacts(graph.kind, graph.contacts, lists);
        ASSERT_EQ(lists.begin.size(), graph.kind.size() + 1);
        for (BodyIndex i = 0; i < graph.kind.size(); ++i) {
            std::vector<std::uint32_t> expected;
            for (std::uint32_t c = 0; c < graph.contacts.size() && graph.kind[i] == D; ++c) {
                if (graph.contacts[c].a == i || graph.contacts[c].b == i) expected.push_back(c);
            }
            ASSERT_EQ(std::vector<std::uint32_t>(lists[i].begin(), lists[i].end()), expected);
        }
    }
}

/// Batches with the given numbers of contacts; what is in them does not matter to the schedule.
std::vector<BatchView> batchesOfSizes(const std::vector<std::uint32_t>& sizes) {
    static const std::vector<std::uint32_t> contacts(1000);
    std::vector<BatchView> batches;
    for (const std::uint32_t size : sizes) batches.push_back({{}, std::span(contacts).first(size), {}});
    return batches;
}

std::vector<std::uint32_t> orderOf(const BatchSchedule& schedule) {
    return {schedule.order().begin(), schedule.order().end()};
}

/// As in Figure 26 of the thesis.
TEST(Schedule, PutsLargeBatchesFirstByDescendingSizeAndLeavesSmallOnesInOrder) {
    BatchSchedule schedule;
    schedule.arrange(batchesOfSizes({3, 48, 5, 32, 1, 120, 31, 48, 2}));
    EXPECT_EQ(schedule.large(), 4u);
    EXPECT_EQ(orderOf(schedule), (std::vector<std::uint32_t>{5, 1, 7, 3, 0, 2, 4, 6, 8}));
}

TEST(Schedule, KnowsOnlyLargeOnlySmallAndNoBatches) {
    BatchSchedule schedule;
    schedule.arrange(batchesOfSizes({32, 33, 32}));
    EXPECT_EQ(schedule.large(), 3u);
    EXPECT_EQ(orderOf(schedule), (std::vector<std::uint32_t>{1, 0, 2}));
    schedule.arrange(batchesOfSizes({31, 1, 31}));
    EXPECT_EQ(schedule.large(), 0u);
    EXPECT_EQ(orderOf(schedule), (std::vector<std::uint32_t>{0, 1, 2}));
    schedule.arrange({});
    EXPECT_EQ(schedule.large(), 0u);
    EXPECT_TRUE(schedule.order().empty());
}

TEST(Schedule, WorksOnEveryBatchOnceOnAnyNumberOfThreads) {
    Random random(6);
    std::vector<std::uint32_t> sizes(300);
    for (auto& size : sizes) size = 1 + random.below(40);
    BatchSchedule schedule;
    schedule.arrange(batchesOfSizes(sizes));
    for (const int threads : {1, 2, 5}) {
        const Executor executor(threads);
        std::vector<int> times(sizes.size());
        schedule.forEach(executor, [&](std::uint32_t batch, int thread) {
            ASSERT_LT(thread, threads);
            ++times[batch];
        });
        for (const int n : times) ASSERT_EQ(n, 1);
    }
}

/// Six bodies in a row on a fixed one, and two beside it.
struct Line {
    std::vector<BodyKind> kind = {D, D, D, D, D, D, F, D, D};
    std::vector<Contact> contacts = contactsBetween({{0, 1}, {0, 6}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {7, 8}});
    ContactsOfBodies of_bodies;
    Surroundings surroundings;

    Line() { listContacts(kind, contacts, of_bodies); }
    void find(std::vector<std::uint32_t> seeds, int near, std::vector<std::uint8_t> excluded = {}, int far = 0) {
        const auto pushes = [](const Contact& contact) { return contact.impulse.x() > 0; };
        surroundings.find({kind, contacts, of_bodies, excluded}, seeds, {near, std::max(near, far), pushes});
    }
    std::vector<BodyIndex> bodies(std::size_t group) const {
        const auto some = surroundings.groups()[group].bodies;
        return {some.begin(), some.end()};
    }
    std::vector<std::uint32_t> contactsOf(std::size_t group) const {
        const auto some = surroundings.groups()[group].contacts;
        return {some.begin(), some.end()};
    }
};

TEST(Surroundings, HoldAllContactsOfTheBodiesWithinReach) {
    Line line;
    line.find({2}, 1);
    ASSERT_EQ(line.surroundings.groups().size(), 1);
    EXPECT_EQ(line.bodies(0), (std::vector<BodyIndex>{0, 1, 2, 3}));
    EXPECT_EQ(line.contactsOf(0), (std::vector<std::uint32_t>{0, 2, 3}));
    line.find({2}, 2);
    EXPECT_EQ(line.bodies(0), (std::vector<BodyIndex>{0, 1, 2, 3, 4}));
    EXPECT_EQ(line.contactsOf(0), (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
}

TEST(Surroundings, ReachFartherOnlyWhereContactsLead) {
    Line line;
    line.contacts[4].impulse = Vec3(1, 0, 0);  // of 3 and 4
    line.find({2}, 1, {}, 3);
    EXPECT_EQ(line.bodies(0), (std::vector<BodyIndex>{0, 1, 2, 3}));
    line.contacts[3].impulse = Vec3(1, 0, 0);  // of 2 and 3
    line.find({2}, 1, {}, 2);
    EXPECT_EQ(line.bodies(0), (std::vector<BodyIndex>{0, 1, 2, 3, 4}));
    line.find({2}, 1, {}, 3);
    EXPECT_EQ(line.bodies(0), (std::vector<BodyIndex>{0, 1, 2, 3, 4, 5}));
}

TEST(Surroundings, AreGroupsThatShareNoBodyThatMoves) {
    Line line;
    line.find({1, 6, 7}, 1);
    ASSERT_EQ(line.surroundings.groups().size(), 3);
    EXPECT_EQ(line.bodies(0), (std::vector<BodyIndex>{0, 1}));
    EXPECT_EQ(line.bodies(1), (std::vector<BodyIndex>{4, 5}));
    EXPECT_EQ(line.bodies(2), (std::vector<BodyIndex>{7, 8}));
    line.find({1, 6}, 3);
    EXPECT_EQ(line.surroundings.groups().size(), 1);
}

TEST(Surroundings, LeaveOutContactsOfExcludedBodies) {
    Line line;
    line.find({2, 7}, 2, {0, 0, 1, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(line.surroundings.groups().size(), 1);
    EXPECT_EQ(line.bodies(0), (std::vector<BodyIndex>{7, 8}));
}

}  // namespace
}  // namespace cairn
