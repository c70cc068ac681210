#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <string>
#include <thread>

#include "cairn/ranks.h"
#include "cairn/types.h"
#include "messages/packing.h"

namespace cairn {
namespace {

class ManyRanks : public testing::TestWithParam<int> {};

TEST_P(ManyRanks, EveryoneGetsWhatWasSentToHimInEveryRound) {
    runRanks(GetParam(), [](Ranks& ranks) {
        for (int round = 0; round < 50; ++round) {
            Ranks::Messages out(static_cast<std::size_t>(ranks.size()));
            for (std::size_t to = 0; to < out.size(); ++to) {
                // Of different lengths, some of them empty.
                for (std::size_t n = 0; n < (to + static_cast<std::size_t>(round)) % 3; ++n) {
                    pack(out[to], 1000 * ranks.rank() + static_cast<int>(to) + round);
                }
            }
            const Ranks::Messages in = ranks.exchange(std::move(out));
            for (int from = 0; from < ranks.size(); ++from) {
                const auto& message = in[static_cast<std::size_t>(from)];
                ASSERT_EQ(message.size(), static_cast<std::size_t>((ranks.rank() + round) % 3) * sizeof(int));
                for (Unpacker reader(message); !reader.isAtEnd();) {
                    ASSERT_EQ(reader.get<int>(), 1000 * from + ranks.rank() + round);
                }
            }
        }
    });
}

TEST_P(ManyRanks, ValuesAreGatheredByRank) {
    runRanks(GetParam(), [](Ranks& ranks) {
        std::vector<int> expected(static_cast<std::size_t>(ranks.size()));
        std::iota(expected.begin(), expected.end(), 7);
        EXPECT_EQ(gatherAll(ranks, ranks.rank() + 7), expected);
    });
}

INSTANTIATE_TEST_SUITE_P(Numbers, ManyRanks, testing::Values(1, 2, 3, 8));

TEST(Ranks, CountTheirTraffic) {
    runRanks(3, [](Ranks& ranks) {
        gatherAll(ranks, std::uint64_t{1});
        ranks.exchange(Ranks::Messages(3));
        EXPECT_EQ(ranks.traffic().rounds, 2);
        EXPECT_EQ(ranks.traffic().messages, 2);
        EXPECT_EQ(ranks.traffic().bytes, 16);
    });
}

TEST(Ranks, AnErrorOfOneEndsAll) {
    std::atomic<int> lost = 0;
    try {
        runRanks(4, [&](Ranks& ranks) {
            gatherAll(ranks, 1);
            if (ranks.rank() == 2) throw InputError("no more");
            try {
                for (;;) gatherAll(ranks, 1);
            } catch (const RankLostError& error) {
                EXPECT_STREQ(error.what(), "rank 2 ended before the others");
                ++lost;
                throw;
            }
        });
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "no more");
    }
    EXPECT_EQ(lost, 3);
}

TEST(Ranks, WaitForMessagesThatAreLateOnPurpose) {
    const auto begin = std::chrono::steady_clock::now();
    runRanks(2,
             [](Ranks& ranks) {
                 for (int round = 0; round < 5; ++round) gatherAll(ranks, round);
             },
             {.per_message = 0.002, .jitter = 0.001});
    EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(10));
}

TEST(Ranks, SayForWhomTheyWaitedTooLong) {
    std::atomic<int> lost = 0;
    const auto work = [&](Ranks& ranks) {
        EXPECT_THROW(ranks.setPatience(0), InputError);
        ranks.setPatience(ranks.rank() == 2 ? 0.02 : 60);
        gatherAll(ranks, 1);
        if (ranks.rank() == 1) std::this_thread::sleep_for(std::chrono::milliseconds(200));
        try {
            for (;;) gatherAll(ranks, 1);
        } catch (const RankLostError&) {
            ++lost;
            throw;
        }
    };
    try {
        runRanks(3, work);
        FAIL();
    } catch (const RankLateError& error) {
        EXPECT_STREQ(error.what(), "rank 2 waited 0.02 s for rank 1, in round 2, and gave up");
    }
    EXPECT_EQ(lost, 2);
}

TEST(Ranks, RefuseNumbersAndDelaysThatCannotBe) {
    const auto nothing = [](Ranks&) {};
    EXPECT_THROW(runRanks(0, nothing), InputError);
    EXPECT_THROW(runRanks(1025, nothing), InputError);
    EXPECT_THROW(runRanks(1, nothing, {.per_message = -1}), InputError);
    EXPECT_THROW(runRanks(1, nothing, {.jitter = -1}), InputError);
}

TEST(Partition, IsNamed) {
    EXPECT_EQ(partitionNamed("y"), PartitionKind::y);
    EXPECT_EQ(partitionNamed("hash"), PartitionKind::hash);
    try {
        partitionNamed("w");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "partition 'w' is unknown; there are boxes, x, y, z and hash");
    }
}

TEST(Unpacker, TellsMessagesThatEndEarly) {
    std::vector<std::byte> message;
    pack(message, 1);
    Unpacker in(message);
    EXPECT_THROW(in.get<double>(), std::logic_error);
}

}  // namespace
}  // namespace cairn
