/// @file Threads that stay at hand from loop to loop. The only place that knows OpenMP.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "parallel/function_ref.h"

namespace cairn {

/// A caller and its workers, who wait for loops between which the caller works alone. Starting a loop costs about a
/// microsecond. Whoever is free takes the next share of a loop that nobody has begun, and the caller waits for nothing
/// but shares that somebody has: workers who get their processor late, on a machine that is busy with other things,
/// find their share done and keep nobody waiting.
class ThreadPool {
  public:
    static constexpr int most_threads = 0xfffe;

    /// The workers come with the first loop. @param threads caller and workers together, 2 to most_threads
    explicit ThreadPool(int threads);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    /// Threads that come, the caller's with them: no more than there are processors, they take the shares of the
    /// others.
    int present() const { return present_; }

    /// Runs work(share) once for each share in [0, shares) and returns when all have been done. If some throw, the
    /// exception of the lowest share is thrown at the end. @pre shares ≤ threads, not called by a share
    void run(int shares, FunctionRef<void(int)> work);

  private:
    /// The last loop in which a share was taken, alone on its cache line.
    struct alignas(64) Claim {
        std::atomic<std::uint64_t> round = 0;
    };

    void serve(int worker);
    std::uint64_t awaitJob(std::uint64_t known);
    void publish(std::uint64_t job);
    void takeShare(std::uint64_t job, int share);

    int present_;
    std::uint64_t round_ = 0;  ///< number of the last loop
    std::vector<Claim> claims_;

    const FunctionRef<void(int)>* work_ = nullptr;
    std::mutex failing_;
    int failed_share_ = 0;
    std::exception_ptr failure_;

    alignas(64) std::atomic<std::uint64_t> job_ = 0;  ///< round and number of shares of the newest loop
    alignas(64) std::atomic<int> unfinished_ = 0;     ///< shares of the newest loop
    alignas(64) std::atomic<int> sleeping_ = 0;       ///< workers that wait for wake_
    std::mutex sleep_;
    std::condition_variable wake_;
    std::thread leader_;  ///< brings the workers, and is one of them; waits for the others when the pool is shut down
};

}  // namespace cairn
