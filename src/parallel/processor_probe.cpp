#include "parallel/processor_probe.h"

#include <time.h>

#include <algorithm>

#include "parallel/relax.h"

namespace cairn {

namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

/// What each thread takes: as long as schedulers leave a processor to one program before another gets it.
constexpr std::chrono::milliseconds taken{5};

/// Processors are free if they gave at least this part of it: one that is shared with one program gives a half.
constexpr double free_part = 0.75;

/// Times between two askings: while they are free, and while they are not, where each is twice the last.
constexpr std::chrono::milliseconds while_free{1000}, shortest_pause{250}, longest_pause{4000};

/// Rounds of waiting between two looks at the clock.
constexpr int rounds_of_waiting = 256;

/// Time that this thread has had a processor; as much as has passed where that is not known.
Milliseconds givenTime() {
#ifdef CLOCK_THREAD_CPUTIME_ID
    timespec t{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t) == 0) {
        return std::chrono::seconds(t.tv_sec) + std::chrono::nanoseconds(t.tv_nsec);
    }
#endif
    return std::chrono::steady_clock::now().time_since_epoch();
}

}  // namespace

ProcessorProbe::ProcessorProbe(int others) : others_(others), pause_(shortest_pause) {}

ProcessorProbe::~ProcessorProbe() {
    given_up_ = true;
    for (std::thread& thread : threads_) thread.join();
}

bool ProcessorProbe::areFree() {
    if (asks_) {
        if (unfinished_.load(std::memory_order_acquire) > 0) return false;
        end();
    } else if (Clock::now() >= next_) {
        begin();
        return false;
    }
    return free_;
}

void ProcessorProbe::begin() {
    asks_ = true;
    given_ = 0;
    unfinished_ = others_;
    for (int i = 0; i < others_; ++i) threads_.emplace_back([this] { take(); });
}

void ProcessorProbe::end() {
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
    asks_ = false;
    free_ = given_ >= free_part * others_;
    next_ = Clock::now() + (free_ ? while_free : pause_);
    pause_ = free_ ? shortest_pause : std::min<Clock::duration>(2 * pause_, longest_pause);
}

/// What each of the threads does.
void ProcessorProbe::take() {
    const Clock::time_point begin = Clock::now();
    const Milliseconds given_before = givenTime();
    Clock::duration passed{};
    while (passed < taken && !given_up_.load(std::memory_order_relaxed)) {
        for (int i = 0; i < rounds_of_waiting; ++i) relax();
        passed = Clock::now() - begin;
    }
    given_ += (givenTime() - given_before) / Milliseconds(passed);
    unfinished_.fetch_sub(1, std::memory_order_release);
}

}  // namespace cairn
