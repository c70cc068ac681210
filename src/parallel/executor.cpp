#include "parallel/executor.h"

#include <algorithm>
#include <exception>
#include <vector>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace cairn {

namespace {

/// Below this many items a parallel region costs more than it saves.
constexpr std::size_t serial_limit = 64;

/// Keeps the first exception of each thread; OpenMP regions must not leak exceptions.
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

void Executor::forBlocks(std::size_t count, const std::function<void(std::size_t, std::size_t, int)>& work) const {
    if (count == 0) return;
    if (threads_ == 1 || count < serial_limit) {
        work(0, count, 0);
        return;
    }
    Failures failures(threads_);
    const auto blocks = static_cast<std::size_t>(threads_);
#pragma omp parallel for schedule(static, 1) num_threads(threads_)
    for (int t = 0; t < threads_; ++t) {
        const std::size_t begin = count * static_cast<std::size_t>(t) / blocks;
        const std::size_t end = count * (static_cast<std::size_t>(t) + 1) / blocks;
        failures.guard(t, [&] { work(begin, end, t); });
    }
    failures.rethrow();
}

void Executor::forEachDynamic(std::size_t count, const std::function<void(std::size_t, int)>& work) const {
    if (threads_ == 1 || count < 2) {
        for (std::size_t i = 0; i < count; ++i) work(i, 0);
        return;
    }
    Failures failures(threads_);
    const auto items = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_)
    for (std::ptrdiff_t i = 0; i < items; ++i) {
#ifdef _OPENMP
        const int thread = omp_get_thread_num();
#else
        const int thread = 0;
#endif
        failures.guard(thread, [&] { work(static_cast<std::size_t>(i), thread); });
    }
    failures.rethrow();
}

}  // namespace cairn
