#include "parallel/executor.h"

#include <algorithm>
#include <atomic>

namespace cairn {

Executor::Executor(int threads)
    : threads_(std::clamp(threads, 1, ThreadPool::most_threads)),
      pool_(threads_ > 1 ? std::make_unique<ThreadPool>(threads_) : nullptr) {
    if (pool_ != nullptr && pool_->present() > 1) probe_ = std::make_unique<ProcessorProbe>(pool_->present() - 1);
}

void Executor::forBlocks(std::size_t count, FunctionRef<void(std::size_t, std::size_t, int)> work,
                         std::size_t grain) const {
    if (count == 0) return;
    const std::size_t blocks = std::min(static_cast<std::size_t>(threads_), count / std::max<std::size_t>(grain, 1));
    if (blocks <= 1 || !helped_) {
        work(0, count, 0);
        return;
    }
    pool_->run(static_cast<int>(blocks), [&](int thread) {
        const auto block = static_cast<std::size_t>(thread);
        work(count * block / blocks, count * (block + 1) / blocks, thread);
    });
}

void Executor::forEachDynamic(std::size_t count, FunctionRef<void(std::size_t, int)> work) const {
    if (threads_ == 1 || !helped_ || count < 2) {
        for (std::size_t i = 0; i < count; ++i) work(i, 0);
        return;
    }
    std::atomic<std::size_t> next = 0;
    pool_->run(threads_, [&](int thread) {
        for (std::size_t i = next++; i < count; i = next++) work(i, thread);
    });
}

}  // namespace cairn
