#include "resolution/queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

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

/// The contacts 0, 1, … count − 1.
std::vector<std::uint32_t> upTo(std::size_t count) {
    std::vector<std::uint32_t> contacts(count);
    std::iota(contacts.begin(), contacts.end(), 0U);
    return contacts;
}

/// δ of some contacts, filled up as TournamentQueue wants it.
std::vector<double> filledUp(std::vector<double> delta) {
    delta.resize((delta.size() / TournamentQueue::fan_out + 1) * TournamentQueue::fan_out, INFINITY);
    return delta;
}

template <class Queue>
class OrderedQueue : public testing::Test {};
using OrderedQueues = testing::Types<ArrayQueue, TournamentQueue>;
TYPED_TEST_SUITE(OrderedQueue, OrderedQueues);

TYPED_TEST(OrderedQueue, GivesWhatASearchOverEverythingGives) {
    for (const std::size_t size : {1U, 2U, 7U, 8U, 9U, 63U, 64U, 65U, 500U, 600U}) {
        Random random(size);
        // Few different values, so that ties are common.
        const auto value = [&] { return std::floor(random.uniform(-8, 8)) / 4; };
        std::vector<double> delta(size);
        for (double& d : delta) d = value();
        delta = filledUp(delta);
        TypeParam queue;
        queue.reset(delta, threshold);
        queue.refresh(upTo(size));
        for (int iteration = 0; iteration < 2000; ++iteration) {
            const std::uint32_t next = queue.next();
            ASSERT_EQ(next, searchAll(delta)) << "size " << size << ", iteration " << iteration;
            // As in a resolution: the contact itself opens, some others change either way; now and then everything
            // does.
            std::vector<std::uint32_t> changed;
            if (next != no_contact) changed.push_back(next);
            const std::size_t changes = iteration % 100 == 99 ? size : 3;
            while (changed.size() < changes) {
                changed.push_back(static_cast<std::uint32_t>(random.uniform(0, static_cast<double>(size))));
            }
            for (const std::uint32_t i : changed) delta[i] = value() + (iteration % 7 == 0 ? -1 : 1);
            if (next != no_contact) delta[next] = 1;
            queue.refresh(changed);
        }
    }
}

TYPED_TEST(OrderedQueue, IsEmptyWithoutClosingContacts) {
    const std::vector<double> none = filledUp({});
    TypeParam queue;
    queue.reset(none, threshold);
    EXPECT_EQ(queue.next(), no_contact);
    const std::vector<double> open = filledUp({threshold, 0, 1, 1e300, INFINITY});
    queue.reset(open, threshold);
    queue.refresh(upTo(5));
    EXPECT_EQ(queue.next(), no_contact);
}

TYPED_TEST(OrderedQueue, DropsAContactThatMustNotBeTouchedAgain) {
    std::vector<double> delta = filledUp({-1, -2, -3});
    TypeParam queue;
    queue.reset(delta, threshold);
    queue.refresh(upTo(3));
    ASSERT_EQ(queue.next(), 2U);
    delta[2] = delta[1] = INFINITY;
    queue.refresh(std::vector<std::uint32_t>{2});
    queue.refresh(std::vector<std::uint32_t>{1});
    EXPECT_EQ(queue.next(), 0U);
}

TYPED_TEST(OrderedQueue, ForgetsEverythingWhenReset) {
    std::vector<double> delta = filledUp({-5, -1});
    TypeParam queue;
    queue.reset(delta, threshold);
    queue.refresh(std::vector<std::uint32_t>{0});
    queue.refresh(std::vector<std::uint32_t>{1});
    ASSERT_EQ(queue.next(), 0U);
    delta[0] = INFINITY;
    queue.reset(delta, threshold);
    EXPECT_EQ(queue.next(), no_contact);
    queue.refresh(std::vector<std::uint32_t>{1});
    EXPECT_EQ(queue.next(), 1U);
}

TEST(FirstEntryQueue, GivesTheFirstOfTheListAndFillsHolesWithTheLast) {
    std::vector<double> delta = filledUp({0, -1, -3, -2});
    FirstEntryQueue queue;
    queue.reset(delta, threshold);
    queue.refresh(upTo(4));
    EXPECT_EQ(queue.next(), 1U);  // list 1, 2, 3
    delta[1] = 0;
    queue.refresh(std::vector<std::uint32_t>{1});
    EXPECT_EQ(queue.next(), 3U);  // list 3, 2 (Figure 25)
    delta[0] = -9;
    queue.refresh(std::vector<std::uint32_t>{0});
    EXPECT_EQ(queue.next(), 3U);  // list 3, 2, 0 (Figure 24)
}

}  // namespace
}  // namespace cairn::test
