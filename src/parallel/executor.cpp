#include "parallel/executor.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <exception>
#include <mutex>

#ifdef _OPENMP
#include <omp.h>
#else
#include <thread>
#include <vector>
#endif

namespace cairn {

namespace {

#ifdef _OPENMP

/// Runs a function once on each of several threads.
template <class Work>
void onThreads(int threads, const Work& work) {
#pragma omp parallel num_threads(threads) default(none) shared(threads, work)
    {
        // Fewer threads than asked for may be given; the rest of the shares is then done by those there are.
        for (int t = omp_get_thread_num(); t < threads; t += omp_get_num_threads()) work(t);
    }
}

#else

/// Without OpenMP (which the thread sanitizer does not understand) every loop starts its own threads.
template <class Work>
void onThreads(int threads, const Work& work) {
    std::vector<std::thread> team;
    for (int t = 1; t < threads; ++t) team.emplace_back([&work, t] { work(t); });
    work(0);
    for (std::thread& thread : team) thread.join();
}

#endif

using Clock = std::chrono::steady_clock;

/// Processor time of the calling thread [s].
double threadSeconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The threads of one loop: keeps the exception of the lowest one (parallel regions must not leak exceptions) and how
/// long the longest of them worked. Takes no memory.
class Team {
  public:
    /// Runs a thread's whole share of the loop, which an exception ends.
    template <class Work>
    void run(int thread, const Work& work) {
        const double begin = threadSeconds();
        std::exception_ptr exception;
        try {
            work();
        } catch (...) {
            exception = std::current_exception();
        }
        const double worked = threadSeconds() - begin;
        const std::lock_guard lock(mutex_);
        longest_ = std::max(longest_, worked);
        if (!exception || (exception_ && thread_ < thread)) return;
        thread_ = thread;
        exception_ = exception;
    }

    void rethrow() const {
        if (exception_) std::rethrow_exception(exception_);
    }

    /// How much longer the loop took than its longest share [s]: the time that threads waited for a processor.
    double lateness() const { return std::chrono::duration<double>(Clock::now() - begin_).count() - longest_; }

  private:
    Clock::time_point begin_ = Clock::now();
    std::mutex mutex_;
    double longest_ = 0;  ///< processor time of the longest share [s]
    int thread_ = 0;
    std::exception_ptr exception_;
};

#ifdef __has_feature
constexpr bool has_thread_sanitizer = __has_feature(thread_sanitizer);
#else
constexpr bool has_thread_sanitizer = false;
#endif

/// Lateness up to this is not worth a reaction [s]. The thread sanitizer makes every loop late and shall still see
/// threads at work.
constexpr double noticed_lateness = has_thread_sanitizer ? 1e9 : 200e-6;
/// Most loops in a row on the caller's thread alone before other threads get another chance.
constexpr double most_paused = 16384;
/// What is left of the penalty after each loop in time.
constexpr double forgiveness = 0.9;

}  // namespace

Executor::Executor(int threads) : threads_(std::max(threads, 1)) {}

void Executor::forBlocks(std::size_t count, FunctionRef<void(std::size_t, std::size_t, int)> work,
                         std::size_t grain) const {
    if (count == 0) return;
    const std::size_t blocks = std::min(static_cast<std::size_t>(threads_), count / std::max<std::size_t>(grain, 1));
    if (blocks <= 1) {
        work(0, count, 0);
        return;
    }
    if (isPaused()) {
        --patience_.paused;
        work(0, count, 0);
        return;
    }
    Team team;
    onThreads(static_cast<int>(blocks), [&](int t) {
        const auto block = static_cast<std::size_t>(t);
        team.run(t, [&] { work(count * block / blocks, count * (block + 1) / blocks, t); });
    });
    judge(team.lateness());
    team.rethrow();
}

void Executor::judge(double lateness) const {
    if (lateness > noticed_lateness) {
        patience_.penalty = std::min(std::max(2 * patience_.penalty, 1.0), most_paused);
        patience_.paused = static_cast<int>(patience_.penalty);
    } else {
        patience_.penalty *= forgiveness;
    }
}

void Executor::forEachDynamic(std::size_t count, FunctionRef<void(std::size_t, int)> work) const {
    if (threads_ == 1 || count < 2 || isPaused()) {
        patience_.paused = std::max(patience_.paused - 1, 0);
        for (std::size_t i = 0; i < count; ++i) work(i, 0);
        return;
    }
    Team team;
    std::atomic<std::size_t> next = 0;
    onThreads(threads_, [&](int t) {
        team.run(t, [&] {
            for (std::size_t i = next++; i < count; i = next++) work(i, t);
        });
    });
    judge(team.lateness());
    team.rethrow();
}

}  // namespace cairn
