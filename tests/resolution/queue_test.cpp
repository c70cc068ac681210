#include "resolution/queue.h"

#include <gtest/gtest.h>

#include <cmath>

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
        TypeParam queue;
        queue.reset(delta, threshold);
        for (std::uint32_t i = 0; i < size; ++i) queue.refresh(i);
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
            for (const std::uint32_t i : changed) queue.refresh(i);
        }
    }
}

TYPED_TEST(OrderedQueue, IsEmptyWithoutClosingContacts) {
    const std::vector<double> none;
    TypeParam queue;
    queue.reset(none, threshold);
    EXPECT_EQ(queue.next(), no_contact);
    const std::vector<double> open = {threshold, 0, 1, std::nan(""), INFINITY};
    queue.reset(open, threshold);
    for (std::uint32_t i = 0; i < open.size(); ++i) queue.refresh(i);
    EXPECT_EQ(queue.next(), no_contact);
}

TYPED_TEST(OrderedQueue, DropsAContactWhoseDeltaBecomesNaN) {
    std::vector<double> delta = {-1, -2, -3};
    TypeParam queue;
    queue.reset(delta, threshold);
    for (std::uint32_t i = 0; i < 3; ++i) queue.refresh(i);
    ASSERT_EQ(queue.next(), 2U);
    delta[2] = delta[1] = std::nan("");
    queue.refresh(2);
    queue.refresh(1);
    EXPECT_EQ(queue.next(), 0U);
}

TYPED_TEST(OrderedQueue, ForgetsEverythingWhenReset) {
    std::vector<double> delta = {-5, -1};
    TypeParam queue;
    queue.reset(delta, threshold);
    queue.refresh(0);
    queue.refresh(1);
    ASSERT_EQ(queue.next(), 0U);
    queue.reset(delta, threshold);
    EXPECT_EQ(queue.next(), no_contact);
    queue.refresh(1);
    EXPECT_EQ(queue.next(), 1U);
}

TEST(FirstEntryQueue, GivesTheFirstOfTheListAndFillsHolesWithTheLast) {
    std::vector<double> delta = {0, -1, -3, -2};
    FirstEntryQueue queue;
    queue.reset(delta, threshold);
    for (std::uint32_t i = 0; i < 4; ++i) queue.refresh(i);
    EXPECT_EQ(queue.next(), 1U);  // list 1, 2, 3
    delta[1] = 0;
    queue.refresh(1);
    EXPECT_EQ(queue.next(), 3U);  // list 3, 2 (Figure 25)
    delta[0] = -9;
    queue.refresh(0);
    EXPECT_EQ(queue.next(), 3U);  // list 3, 2, 0 (Figure 24)
}

}  // namespace
}  // namespace cairn::test
