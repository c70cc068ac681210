#include "resolution/queue.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "batch_fixture.h"

namespace cairn::test {
namespace {

constexpr double threshold = -0.1;

std::uint32_t searchAll(const std::vector<double>& delta) {
    std::uint32_t winner = no_contact;
    double smallest = threshold;
    for (std::uint32_t i = 0; i < delta.size(); ++i) {
        if (delta[i] < smallest) {
            smallest = delta[i];
            winner = i;
        }
    }
    return winner;
}

/// δ of contacts between pairs of bodies.
struct Contacts {
    std::vector<double> delta;
    std::vector<std::array<std::uint32_t, 2>> bodies;
    ContactLists lists;

    /// @param pairs the bodies of each contact @param immovable bodies from this one on have no list
    Contacts(std::vector<double> values, std::vector<std::array<std::uint32_t, 2>> pairs, std::uint32_t count,
             std::uint32_t immovable)
        : delta(std::move(values)), bodies(std::move(pairs)) {
        for (std::uint32_t body = 0; body < count; ++body) {
            lists.begin.push_back(static_cast<std::uint32_t>(lists.contact.size()));
            for (std::uint32_t i = 0; i < bodies.size() && body < immovable; ++i) {
                if (bodies[i][0] == body || bodies[i][1] == body) lists.contact.push_back(i);
            }
            lists.count.push_back(static_cast<std::uint32_t>(lists.contact.size()) - lists.begin.back());
        }
    }

    template <class Queue>
    void insertInto(Queue& queue) const {
        for (std::uint32_t i = 0; i < delta.size(); ++i) {
            for (const std::uint32_t body : bodies[i]) {
                if (lists.count[body] > 0) queue.insert(i, body);
            }
        }
    }
};

/// Contacts of one body each.
Contacts alone(std::vector<double> delta) {
    std::vector<std::array<std::uint32_t, 2>> pairs(delta.size());
    const auto count = static_cast<std::uint32_t>(delta.size());
    for (std::uint32_t i = 0; i < count; ++i) pairs[i] = {i, count};
    return {std::move(delta), std::move(pairs), count + 1, count};
}

template <class Queue>
class OrderedQueue : public testing::Test {};
using OrderedQueues = testing::Types<ArrayQueue, TournamentQueue>;
TYPED_TEST_SUITE(OrderedQueue, OrderedQueues);

TYPED_TEST(OrderedQueue, GivesWhatASearchOverEverythingGives) {
    for (const std::size_t size : {1U, 2U, 7U, 8U, 9U, 63U, 64U, 65U, 500U, 600U}) {
        Random random(size);
        const auto count = static_cast<std::uint32_t>(2 + size / 4);
        const auto pick = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random.uniform(0, n)); };
        // Few different values, so that ties are common.
        const auto value = [&] { return std::floor(random.uniform(-8, 8)) / 4; };
        std::vector<std::array<std::uint32_t, 2>> pairs(size);
        for (auto& [a, b] : pairs) {
            a = pick(count - 1);
            b = a + 1 + pick(count - 1 - a);
        }
        std::vector<double> delta(size);
        for (double& d : delta) d = value();
        Contacts contacts(delta, pairs, count, count - 1);
        TypeParam queue;
        queue.reset(contacts.lists, contacts.delta, threshold);
        contacts.insertInto(queue);
        for (int iteration = 0; iteration < 2000; ++iteration) {
            const std::uint32_t next = queue.next();
            ASSERT_EQ(next, searchAll(contacts.delta)) << "size " << size << ", iteration " << iteration;
            // As in a resolution: all contacts of two bodies change either way; now and then a contact turns out not to
            // close.
            if (next != no_contact && iteration % 10 == 9) {
                contacts.delta[next] = iteration % 20 == 9 ? INFINITY : threshold;
                queue.contactOpened(next);
                continue;
            }
            const std::array<std::uint32_t, 2> both =
                next == no_contact ? std::array{pick(count), pick(count)} : contacts.bodies[next];
            for (const std::uint32_t body : both) {
                for (const std::uint32_t i : contacts.lists[body]) {
                    contacts.delta[i] = value() + (iteration % 7 == 0 ? -1 : 1);
                }
            }
            if (next != no_contact) contacts.delta[next] = 1;
            for (const std::uint32_t body : both) queue.bodyChanged(body);
        }
    }
}

TYPED_TEST(OrderedQueue, IsEmptyWithoutClosingContacts) {
    const Contacts none = alone({});
    TypeParam queue;
    queue.reset(none.lists, none.delta, threshold);
    EXPECT_EQ(queue.next(), no_contact);
    const Contacts open = alone({threshold, 0, 1, 1e300, INFINITY});
    queue.reset(open.lists, open.delta, threshold);
    open.insertInto(queue);
    EXPECT_EQ(queue.next(), no_contact);
}

TYPED_TEST(OrderedQueue, DropsAContactThatMustNotBeTouchedAgain) {
    Contacts contacts = alone({-1, -2, -3});
    TypeParam queue;
    queue.reset(contacts.lists, contacts.delta, threshold);
    contacts.insertInto(queue);
    ASSERT_EQ(queue.next(), 2U);
    contacts.delta[2] = contacts.delta[1] = INFINITY;
    queue.contactOpened(2);
    queue.bodyChanged(1);
    EXPECT_EQ(queue.next(), 0U);
}

TYPED_TEST(OrderedQueue, ForgetsEverythingWhenReset) {
    Contacts contacts = alone({-5, -1});
    TypeParam queue;
    queue.reset(contacts.lists, contacts.delta, threshold);
    contacts.insertInto(queue);
    ASSERT_EQ(queue.next(), 0U);
    queue.reset(contacts.lists, contacts.delta, threshold);
    EXPECT_EQ(queue.next(), no_contact);
    queue.insert(1, 1);
    EXPECT_EQ(queue.next(), 1U);
}

TEST(LatestFirstQueue, GivesTheContactThatBeganToCloseLast) {
    Contacts contacts = alone({0, -1, -3, -2});
    LatestFirstQueue queue;
    queue.reset(contacts.lists, contacts.delta, threshold);
    EXPECT_EQ(queue.next(), no_contact);
    contacts.insertInto(queue);
    EXPECT_EQ(queue.next(), 3U);  // chain 1, 2, 3
    contacts.delta[2] = 0;
    queue.contactOpened(2);
    contacts.delta[1] = -9;
    queue.bodyChanged(1);
    EXPECT_EQ(queue.next(), 3U);  // chain 1, 3
    contacts.delta[3] = 0;
    queue.contactOpened(3);
    EXPECT_EQ(queue.next(), 1U);
    contacts.delta[0] = -1;
    queue.bodyChanged(0);
    EXPECT_EQ(queue.next(), 0U);  // chain 1, 0
    contacts.delta[1] = 0;
    queue.bodyChanged(1);
    contacts.delta[0] = 0;
    queue.bodyChanged(0);
    EXPECT_EQ(queue.next(), no_contact);
}

}  // namespace
}  // namespace cairn::test
