/// @file Ranks that mpirun started. The only place that knows MPI.
#include <cstdlib>

#include "cairn/ranks.h"
#include "cairn/types.h"

#if CAIRN_MPI
#include <mpi.h>

#include <algorithm>
#include <cstdio>
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

/// Calls use(first byte, count) for the pieces of a message.
template <class Use>
void forPieces(std::vector<std::byte>& message, const Use& use) {
    for (std::size_t begin = 0; begin < message.size(); begin += largest_piece) {
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
        std::vector<std::uint64_t> sent(count), coming(count);
        for (std::size_t to = 0; to < count; ++to) sent[to] = out[to].size();
        MPI_Alltoall(sent.data(), 1, MPI_UINT64_T, coming.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
        std::vector<MPI_Request> requests;
        const auto own = static_cast<std::size_t>(rank());
        for (std::size_t other = 0; other < count; ++other) {
            if (other == own) continue;
            in[other].resize(coming[other]);
            const int peer = static_cast<int>(other);
            forPieces(in[other], [&](std::byte* first, int size) {
                MPI_Irecv(first, size, MPI_BYTE, peer, 0, MPI_COMM_WORLD, &requests.emplace_back());
            });
            forPieces(out[other], [&](std::byte* first, int size) {
                MPI_Isend(first, size, MPI_BYTE, peer, 0, MPI_COMM_WORLD, &requests.emplace_back());
            });
        }
        MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    }
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
