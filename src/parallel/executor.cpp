#include "parallel/executor.h"

#include <algorithm>
#include <atomic>
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

/// Keeps the exception of the lowest thread; parallel regions must not leak exceptions. Takes no memory.
class Failure {
  public:
    /// Runs a thread's whole share of a loop, which an exception ends.
    template <class Work>
    void guard(int thread, const Work& work) {
        try {
            work();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (exception_ && thread_ < thread) return;
            thread_ = thread;
            exception_ = std::current_exception();
        }
    }

    void rethrow() const {
        if (exception_) std::rethrow_exception(exception_);
    }

  private:
    std::mutex mutex_;
    int thread_ = 0;
    std::exception_ptr exception_;
};

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
    Failure failure;
    onThreads(static_cast<int>(blocks), [&](int t) {
        const auto block = static_cast<std::size_t>(t);
        failure.guard(t, [&] { work(count * block / blocks, count * (block + 1) / blocks, t); });
    });
    failure.rethrow();
}

void Executor::forEachDynamic(std::size_t count, FunctionRef<void(std::size_t, int)> work) const {
    if (threads_ == 1 || count < 2) {
        for (std::size_t i = 0; i < count; ++i) work(i, 0);
        return;
    }
    Failure failure;
    std::atomic<std::size_t> next = 0;
    onThreads(threads_, [&](int t) {
        failure.guard(t, [&] {
            for (std::size_t i = next++; i < count; i = next++) work(i, t);
        });
    });
    failure.rethrow();
}

}  // namespace cairn
