/// @file Ranks that are threads of one program.
#include <fmt/core.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "cairn/ranks.h"
#include "cairn/types.h"

namespace cairn {

namespace {

constexpr int most_threads = 1024;

using Clock = std::chrono::steady_clock;

/// A message on its way.
struct Letter {
    std::vector<std::byte> content;
    Clock::time_point due;  ///< it is not read before
};

/// Where one rank finds what the others sent to it.
struct Mailbox {
    std::mutex mutex;
    std::condition_variable arrived;
    std::vector<std::deque<Letter>> from;  ///< [ranks] in the order of sending
    bool lost = false;                     ///< a rank gave up
};

/// What the ranks of one run share.
struct Post {
    Post(int count, const MessageDelay& late) : boxes(static_cast<std::size_t>(count)), delay(late) {
        for (Mailbox& box : boxes) box.from.resize(boxes.size());
    }
    std::vector<Mailbox> boxes;
    MessageDelay delay;
    std::atomic<int> first_lost = -1;  ///< rank that gave up before the others; −1 = none
};

class ThreadRanks final : public Ranks {
  public:
    ThreadRanks(int rank, Post& post) : Ranks(rank, static_cast<int>(post.boxes.size())), post_(post) {}

    void abandon(int) noexcept override {
        int none = -1;
        post_.first_lost.compare_exchange_strong(none, rank());
        for (Mailbox& box : post_.boxes) {
            const std::lock_guard lock(box.mutex);
            box.lost = true;
            box.arrived.notify_all();
        }
    }

  private:
    void deliver(Messages& out, Messages& in) override {
        const auto own = static_cast<std::size_t>(rank());
        for (std::size_t to = 0; to < out.size(); ++to) {
            if (to == own) continue;
            const std::chrono::duration<double> late(post_.delay.per_message +
                                                     post_.delay.per_byte * static_cast<double>(out[to].size()) +
                                                     post_.delay.jitter * draw());
            const auto due = Clock::now() + std::chrono::duration_cast<Clock::duration>(late);
            Mailbox& box = post_.boxes[to];
            const std::lock_guard lock(box.mutex);
            box.from[own].push_back({std::move(out[to]), due});
            box.arrived.notify_all();
        }
        Mailbox& box = post_.boxes[own];
        for (std::size_t from = 0; from < in.size(); ++from) {
            if (from != own) in[from] = take(box, static_cast<int>(from));
        }
    }

    /// Between 0 and 1, by the generator of Knuth and Lewis.
    double draw() {
        drawn_ = drawn_ * 1664525U + 1013904223U;
        return static_cast<double>(drawn_) / 4294967296.0;
    }

    std::vector<std::byte> take(Mailbox& box, int from) const {
        std::deque<Letter>& letters = box.from[static_cast<std::size_t>(from)];
        std::unique_lock lock(box.mutex);
        const auto is_over = [&] { return !letters.empty() || box.lost; };
        if (!std::isfinite(patience())) {
            box.arrived.wait(lock, is_over);
        } else if (!box.arrived.wait_for(lock, std::chrono::duration<double>(patience()), is_over)) {
            tellLate({from});
        }
        if (letters.empty()) {
            throw RankLostError(fmt::format("rank {} ended before the others", post_.first_lost.load()));
        }
        Letter letter = std::move(letters.front());
        letters.pop_front();
        lock.unlock();
        std::this_thread::sleep_until(letter.due);
        return std::move(letter.content);
    }

    Post& post_;
    std::uint32_t drawn_ = static_cast<std::uint32_t>(rank());
};

}  // namespace

void runRanks(int count, const std::function<void(Ranks&)>& work, const MessageDelay& delay) {
    if (count < 1 || count > most_threads) {
        throw InputError(fmt::format("{} ranks; threads of one program can be 1 to {}", count, most_threads));
    }
    if (!(delay.per_message >= 0 && delay.per_byte >= 0 && delay.jitter >= 0)) {
        throw InputError("the delay of messages is negative; give times that are not");
    }
    Post post(count, delay);
    std::vector<std::exception_ptr> failures(static_cast<std::size_t>(count));
    std::vector<std::exception_ptr> losses(failures.size());
    const auto run = [&](int rank) {
        const auto index = static_cast<std::size_t>(rank);
        ThreadRanks ranks(rank, post);
        try {
            work(ranks);
            return;
        } catch (const RankLostError&) {
            losses[index] = std::current_exception();
        } catch (...) {
            failures[index] = std::current_exception();
        }
        ranks.abandon(1);
    };
    std::vector<std::thread> threads;
    for (int rank = 1; rank < count; ++rank) threads.emplace_back(run, rank);
    run(0);
    for (std::thread& thread : threads) thread.join();
    for (const auto& errors : {failures, losses}) {
        for (const std::exception_ptr& error : errors) {
            if (error) std::rethrow_exception(error);
        }
    }
}

}  // namespace cairn
