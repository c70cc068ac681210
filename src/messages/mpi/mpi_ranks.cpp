/// @file Ranks that mpirun started. The only place that knows MPI.
#include <cstdlib>

#include "cairn/ranks.h"
#include "cairn/types.h"

#if CAIRN_MPI
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>
#endif

namespace cairn {

bool isStartedByMpi() {
    // Open MPI, MPICH and what follows its conventions, Slurm's PMI.
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) {
        if (std::getenv(name) != nullptr) return true;
    }
    return false;
}

#if CAIRN_MPI

namespace {

/// MPI counts with 32 bits: longer messages go in pieces.
constexpr std::size_t largest_piece = std::size_t{1} << 30U;

/// Bytes of a message that go along with its size: most are that short and need no second one.
constexpr std::size_t first_bytes = 4096 - sizeof(std::uint64_t);

/// Reading the clock takes longer than asking whether a message came.
constexpr std::uint64_t tests_between_looks = 256;

/// How a message begins.
struct Opening {
    std::uint64_t size;  ///< of the message [bytes]
    std::array<std::byte, first_bytes> first;
};

/// Tags of openings and of what follows them.
enum Tag { opening = 0, following = 1 };

int rankOfWorld() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

int sizeOfWorld() {
    int size = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
}

/// Calls use(first byte, count) for the pieces of what follows the first bytes of a message.
template <class Use>
void forPieces(std::vector<std::byte>& message, const Use& use) {
    for (std::size_t begin = first_bytes; begin < message.size(); begin += largest_piece) {
        use(message.data() + begin, static_cast<int>(std::min(largest_piece, message.size() - begin)));
    }
}

class MpiRanks final : public Ranks {
  public:
    MpiRanks() : Ranks(rankOfWorld(), sizeOfWorld()) {}
    ~MpiRanks() override { MPI_Finalize(); }
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;

    void abandon(int exit_code) noexcept override {
        std::fflush(nullptr);
        MPI_Abort(MPI_COMM_WORLD, exit_code);
    }

  private:
    void deliver(Messages& out, Messages& in) override {
        const auto count = static_cast<std::size_t>(size());
        const auto own = static_cast<std::size_t>(rank());
        sent_.resize(count);
        coming_.resize(count);
        for (std::size_t other = 0; other < count; ++other) {
            if (other == own) continue;
            const int peer = static_cast<int>(other);
            MPI_Irecv(&coming_[other], sizeof(Opening), MPI_BYTE, peer, opening, MPI_COMM_WORLD, &begin(peer));
            Opening& sent = sent_[other];
            sent.size = out[other].size();
            const std::size_t first = std::min(first_bytes, out[other].size());
            std::copy_n(out[other].begin(), first, sent.first.begin());
            const auto bytes = static_cast<int>(sizeof(sent.size) + first);
            MPI_Isend(&sent, bytes, MPI_BYTE, peer, opening, MPI_COMM_WORLD, &begin(peer));
        }
        await();
        for (std::size_t other = 0; other < count; ++other) {
            if (other == own) continue;
            const int peer = static_cast<int>(other);
            const Opening& came = coming_[other];
            in[other].resize(came.size);
            std::copy_n(came.first.begin(), std::min<std::size_t>(first_bytes, came.size), in[other].begin());
            forPieces(in[other], [&](std::byte* first, int bytes) {
                MPI_Irecv(first, bytes, MPI_BYTE, peer, following, MPI_COMM_WORLD, &begin(peer));
            });
            forPieces(out[other], [&](std::byte* first, int bytes) {
                MPI_Isend(first, bytes, MPI_BYTE, peer, following, MPI_COMM_WORLD, &begin(peer));
            });
        }
        await();
    }

    MPI_Request& begin(int peer) {
        peers_.push_back(peer);
        return requests_.emplace_back(MPI_REQUEST_NULL);
    }

    /// Waits for all that was begun. @throws RankLateError naming whom it waited for in vain
    void await() {
        const auto count = static_cast<int>(requests_.size());
        if (!std::isfinite(patience())) {
            MPI_Waitall(count, requests_.data(), MPI_STATUSES_IGNORE);
        } else {
            awaitInTime(count);
        }
        requests_.clear();
        peers_.clear();
    }

    void awaitInTime(int count) {
        const auto begun = std::chrono::steady_clock::now();
        for (std::uint64_t tests = 1;; ++tests) {
            int done = 0;
            MPI_Testall(count, requests_.data(), &done, MPI_STATUSES_IGNORE);
            if (done != 0) return;
            if (tests % tests_between_looks != 0) continue;
            std::this_thread::yield();
            const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begun;
            if (waited.count() > patience()) tellLate(unanswered());
        }
    }

    /// The ranks that something is still awaited of.
    std::vector<int> unanswered() {
        std::vector<int> late;
        for (std::size_t i = 0; i < requests_.size(); ++i) {
            int done = 0;
            MPI_Request_get_status(requests_[i], &done, MPI_STATUS_IGNORE);
            if (done == 0 && std::ranges::find(late, peers_[i]) == late.end()) late.push_back(peers_[i]);
        }
        return late;
    }

    std::vector<Opening> sent_, coming_;  ///< [ranks]
    std::vector<MPI_Request> requests_;
    std::vector<int> peers_;  ///< [requests]
};

}  // namespace

std::unique_ptr<Ranks> mpiRanks() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    if (provided < MPI_THREAD_FUNNELED) {
        throw InputError("this MPI cannot serve a program with threads; use one that has MPI_THREAD_FUNNELED");
    }
    return std::make_unique<MpiRanks>();
}

#else

std::unique_ptr<Ranks> mpiRanks() {
    throw InputError(
        "this Cairn was built without MPI: install libopenmpi-dev and openmpi-bin ('tools/install_packages ranks') and "
        "build again, or run ranks as threads of one program with --ranks");
}

#endif

}  // namespace cairn
