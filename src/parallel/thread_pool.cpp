#include "parallel/thread_pool.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "parallel/relax.h"

#ifdef __linux__
#include <sched.h>
#endif
#ifdef _OPENMP
#include <omp.h>
#endif

namespace cairn {

namespace {

/// How long workers spin before they go to sleep: longer than most of what lies between two loops of a step.
constexpr std::chrono::microseconds spin_time{200};

/// Rounds of spinning between two looks at the clock, and before a waiting caller lets others have its processor.
constexpr int spin_rounds = 256;

/// Number of shares that ends the workers. The rest of the job, 48 bits, numbers the loops.
constexpr std::uint64_t shutdown = 0xffff;

std::uint64_t jobOf(std::uint64_t round, std::uint64_t shares) {
    return round << 16 | shares;
}

std::uint64_t roundOf(std::uint64_t job) {
    return job >> 16;
}

std::uint64_t sharesOf(std::uint64_t job) {
    return job & shutdown;
}

/// Processors that the threads of this program may use; as many as anybody may ask for where that is not known.
int processors() {
#ifdef __linux__
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return CPU_COUNT(&allowed);
#endif
    const unsigned known = std::thread::hardware_concurrency();
    return known == 0 ? ThreadPool::most_threads : static_cast<int>(known);
}

#ifdef _OPENMP

/// Calls work(thread) once on each of several threads, or on fewer if no more are to be had.
void onThreads(int threads, FunctionRef<void(int)> work) {
#pragma omp parallel num_threads(threads) default(none) shared(work)
    work(omp_get_thread_num());
}

#else

/// Without OpenMP, which the thread sanitizer does not understand.
void onThreads(int threads, FunctionRef<void(int)> work) {
    std::vector<std::jthread> team;
    for (int t = 1; t < threads; ++t) team.emplace_back([&work, t] { work(t); });
    work(0);
}

#endif

}  // namespace

ThreadPool::ThreadPool(int threads)
    : present_(std::min(threads, processors())), claims_(static_cast<std::size_t>(threads)) {}

ThreadPool::~ThreadPool() {
    if (!leader_.joinable()) return;
    publish(jobOf(++round_, shutdown));
    leader_.join();
}

void ThreadPool::run(int shares, FunctionRef<void(int)> work) {
    if (present_ > 1 && !leader_.joinable()) {
        leader_ = std::thread([this] { onThreads(present_ - 1, [this](int thread) { serve(thread + 1); }); });
    }
    work_ = &work;
    unfinished_.store(shares, std::memory_order_relaxed);
    const std::uint64_t job = jobOf(++round_, static_cast<std::uint64_t>(shares));
    publish(job);
    takeShare(job, 0);
    // Workers begin with their own share: those of the last are the least likely to be here already.
    for (int share = shares; --share > 0;) takeShare(job, share);
    for (int i = 1; unfinished_.load(std::memory_order_acquire) > 0; ++i) {
        if (i % spin_rounds == 0) std::this_thread::yield();
        relax();
    }
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadPool::serve(int worker) {
    for (std::uint64_t job = awaitJob(0); sharesOf(job) != shutdown; job = awaitJob(job)) {
        const auto shares = static_cast<int>(sharesOf(job));
        if (worker < shares) takeShare(job, worker);
        for (int share = 1; share < shares; ++share) takeShare(job, share);
    }
}

/// Returns once there is something else to do than what is known.
std::uint64_t ThreadPool::awaitJob(std::uint64_t known) {
    const auto begin = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begin < spin_time) {
        for (int i = 0; i < spin_rounds; ++i) {
            const std::uint64_t job = job_.load(std::memory_order_acquire);
            if (job != known) return job;
            relax();
        }
    }
    std::unique_lock lock(sleep_);
    ++sleeping_;
    wake_.wait(lock, [&] { return job_ != known; });
    --sleeping_;
    return job_;
}

void ThreadPool::publish(std::uint64_t job) {
    // Sequentially consistent, as the count of sleepers: either a worker sees the job or it is seen to sleep.
    job_ = job;
    if (sleeping_ == 0) return;
    const std::lock_guard lock(sleep_);
    wake_.notify_all();
}

/// Does a share unless somebody else has taken it. Every share of a loop is taken before the loop ends, so that a
/// worker who is late finds nothing left of an old loop.
void ThreadPool::takeShare(std::uint64_t job, int share) {
    std::atomic<std::uint64_t>& claim = claims_[static_cast<std::size_t>(share)].round;
    const std::uint64_t round = roundOf(job);
    std::uint64_t taken = claim.load(std::memory_order_relaxed);
    if (taken >= round || !claim.compare_exchange_strong(taken, round, std::memory_order_acquire)) return;
    try {
        (*work_)(share);
    } catch (...) {
        const std::lock_guard lock(failing_);
        if (!failure_ || share < failed_share_) {
            failure_ = std::current_exception();
            failed_share_ = share;
        }
    }
    unfinished_.fetch_sub(1, std::memory_order_release);
}

}  // namespace cairn
