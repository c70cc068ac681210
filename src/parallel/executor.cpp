#include "parallel/executor.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <vector>

#ifdef _OPENMP
#include <omp.h>
#else
#include <thread>
#endif

namespace cairn {

namespace {

#ifdef _OPENMP

/// Runs a function once on each of several threads.
template <class Work>
void onThreads(int threads, const Work& work) {
#pragma omp parallel num_threads(threads)
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

/// Keeps the first exception of each thread; parallel regions must not leak exceptions.
class Failures {
  public:
    explicit Failures(int threads) : failures_(static_cast<std::size_t>(threads)) {}

    template <class Work>
    void guard(int thread, const Work& work) {
        auto& failure = failures_[static_cast<std::size_t>(thread)];
        if (failure) return;
        try {
            work();
        } catch (...) {
            failure = std::current_exception();
        }
    }

    void rethrow() const {
        for (const auto& failure : failures_) {
            if (failure) std::rethrow_exception(failure);
        }
    }

  private:
    std::vector<std::exception_ptr> failures_;
};

}  // namespace

Executor::Executor(int threads) : threads_(std::max(threads, 1)) {}

void Executor::forBlocks(std::size_t count, const std::function<void(std::size_t, std::size_t, int)>& work,
                         std::size_t grain) const {
    if (count == 0) return;
    const std::size_t blocks = std::min(static_cast<std::size_t>(threads_), count / std::max<std::size_t>(grain, 1));
    if (blocks <= 1) {
        work(0, count, 0);
        return;
    }
    Failures failures(threads_);
    onThreads(static_cast<int>(blocks), [&](int t) {
        const auto block = static_cast<std::size_t>(t);
        failures.guard(t, [&] { work(count * block / blocks, count * (block + 1) / blocks, t); });
    });
    failures.rethrow();
}

void Executor::forEachDynamic(std::size_t count, const std::function<void(std::size_t, int)>& work) const {
    if (threads_ == 1 || count < 2) {
        for (std::size_t i = 0; i < count; ++i) work(i, 0);
        return;
    }
    Failures failures(threads_);
    std::atomic<std::size_t> next = 0;
    onThreads(threads_, [&](int t) {
        for (std::size_t i = next++; i < count; i = next++) failures.guard(t, [&] { work(i, t); });
    });
    failures.rethrow();
}

}  // namespace cairn
