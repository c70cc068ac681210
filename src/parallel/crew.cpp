#include "parallel/crew.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace cairn {

namespace {

/// How long helpers spin before they go to sleep: longer than most of what lies between two loops of a step.
constexpr std::chrono::microseconds patience{200};

/// Rounds of spinning between two looks at the clock, and before a waiting caller lets others have its processor.
constexpr int spin_rounds = 256;

/// Number of shares that sends the helpers home. The rest of the news, 48 bits, numbers the loops.
constexpr std::uint64_t dismissed = 0xffff;

std::uint64_t newsOf(std::uint64_t round, std::uint64_t shares) {
    return round << 16 | shares;
}

std::uint64_t roundOf(std::uint64_t news) {
    return news >> 16;
}

std::uint64_t sharesOf(std::uint64_t news) {
    return news & dismissed;
}

/// Processors that the threads of this program may use; as many as anybody may ask for where that is not known.
int processors() {
    const unsigned known = std::thread::hardware_concurrency();
    return known == 0 ? Crew::most_threads : static_cast<int>(known);
}

void relax() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
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

Crew::Crew(int threads) : present_(std::min(threads, processors())), claims_(static_cast<std::size_t>(threads)) {}

Crew::~Crew() {
    if (!foreman_.joinable()) return;
    announce(newsOf(++round_, dismissed));
    foreman_.join();
}

void Crew::run(int shares, FunctionRef<void(int)> work) {
    if (present_ > 1 && !foreman_.joinable()) {
        foreman_ = std::thread([this] { onThreads(present_ - 1, [this](int thread) { help(thread + 1); }); });
    }
    work_ = &work;
    unfinished_.store(shares, std::memory_order_relaxed);
    const std::uint64_t news = newsOf(++round_, static_cast<std::uint64_t>(shares));
    announce(news);
    takeShare(news, 0);
    // Helpers begin with their own share: those of the last are the least likely to be here already.
    for (int share = shares; --share > 0;) takeShare(news, share);
    for (int i = 1; unfinished_.load(std::memory_order_acquire) > 0; ++i) {
        if (i % spin_rounds == 0) std::this_thread::yield();
        relax();
    }
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Crew::help(int helper) {
    for (std::uint64_t news = awaitNews(0); sharesOf(news) != dismissed; news = awaitNews(news)) {
        const auto shares = static_cast<int>(sharesOf(news));
        if (helper < shares) takeShare(news, helper);
        for (int share = 1; share < shares; ++share) takeShare(news, share);
    }
}

/// Returns once there is something else to do than what is known.
std::uint64_t Crew::awaitNews(std::uint64_t known) {
    const auto begin = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - begin < patience) {
        for (int i = 0; i < spin_rounds; ++i) {
            const std::uint64_t news = news_.load(std::memory_order_acquire);
            if (news != known) return news;
            relax();
        }
    }
    std::unique_lock lock(sleep_);
    ++sleeping_;
    awaken_.wait(lock, [&] { return news_ != known; });
    --sleeping_;
    return news_;
}

void Crew::announce(std::uint64_t news) {
    // Sequentially consistent, as the count of sleepers: either a helper sees the news or it is seen to sleep.
    news_ = news;
    if (sleeping_ == 0) return;
    const std::lock_guard lock(sleep_);
    awaken_.notify_all();
}

/// Does a share unless somebody else has taken it. Every share of a loop is taken before the loop ends, so that a
/// helper who is late finds nothing left of an old loop.
void Crew::takeShare(std::uint64_t news, int share) {
    std::atomic<std::uint64_t>& claim = claims_[static_cast<std::size_t>(share)].round;
    const std::uint64_t round = roundOf(news);
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
