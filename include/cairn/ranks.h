/// @file Ranks: programs, or threads of one program, that simulate one world together, each a part of its bodies.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "cairn/statistics.h"

namespace cairn {

/// What a rank has sent so far, and waited for.
struct Traffic {
    std::int64_t rounds = 0;    ///< in which all ranks told each other something
    std::int64_t messages = 0;  ///< with content, to other ranks
    std::int64_t bytes = 0;     ///< of these
    double waiting = 0;         ///< wall time in rounds [s]
};

/// Another rank failed or gave up, so that this one cannot go on.
class RankLostError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Another rank did not answer for longer than this one was to wait; the text says which.
class RankLateError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Who simulates together, as one of them sees it. Every call of exchange() is made by all ranks, in the same order.
class Ranks {
  public:
    /// What is sent to each rank, or came from it [ranks].
    using Messages = std::vector<std::vector<std::byte>>;

    virtual ~Ranks() = default;
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    int rank() const { return rank_; }  ///< 0 to size() − 1
    int size() const { return size_; }
    /// Sends a message to every rank, an empty one where there is nothing to say, and waits for theirs. The one to
    /// itself a rank gets as it is. @param out [ranks] @return [ranks] @throws RankLostError if another rank failed,
    /// RankLateError if one did not answer in time
    Messages exchange(Messages out);
    /// How long this rank waits for others in one round; for ever at first. @param seconds [s], > 0, or infinite
    /// @throws InputError
    void setPatience(double seconds);
    const Traffic& traffic() const { return traffic_; }
    /// Ends all ranks, after an error that only this one knows of: those that wait get a RankLostError, or the program
    /// ends. @param exit_code of the program, where ranks are programs
    virtual void abandon(int exit_code) noexcept = 0;

  protected:
    Ranks(int rank, int size) : rank_(rank), size_(size) {}
    /// The messages of the other ranks; the one to itself is left out.
    virtual void deliver(Messages& out, Messages& in) = 0;
    double patience() const { return patience_; }  ///< [s]
    /// @param late ranks that did not answer @throws RankLateError, always
    [[noreturn]] void tellLate(const std::vector<int>& late) const;

  private:
    int rank_, size_;
    double patience_ = std::numeric_limits<double>::infinity();
    Traffic traffic_;
};

/// How late messages between threads come, on purpose: for tests and to see what a slow network would cost.
struct MessageDelay {
    double per_message = 0;  ///< [s], ≥ 0
    double per_byte = 0;     ///< [s], ≥ 0
    double jitter = 0;       ///< up to so much more, another time for each message [s], ≥ 0
};

/// Runs some work on so many ranks that are threads of this program, and returns when all have ended it. Where some
/// throw, the others end with a RankLostError, and the error of the lowest rank that failed by itself is thrown here.
/// @param count 1 to 1024 @throws InputError out of range; what the work throws
void runRanks(int count, const std::function<void(Ranks&)>& work, const MessageDelay& delay = {});

/// Whether the program was started by mpirun or the like, as one of several.
bool isStartedByMpi();
/// The ranks that mpirun started, one program each. To be called once, and to be kept to the end of the program.
/// @throws InputError if Cairn was built without MPI: the text says how to build it with
std::unique_ptr<Ranks> mpiRanks();

/// What says whose a place is.
enum class PartitionKind : std::uint8_t {
    boxes,  ///< cut in halves of as many bodies, again and again, across the longest extent
    x,      ///< slabs of as many bodies along an axis
    y,
    z,
    grid,  ///< slabs along x, each cut along y, each of these along z
    hash   ///< by number, wherever bodies are: everything is a border, for tests
};

/// How bodies are dealt out to ranks. No result depends on it.
struct Partition {
    PartitionKind kind = PartitionKind::boxes;  ///< of the cuts
    std::array<int, 3> parts{1, 1, 1};          ///< of a grid, along each axis; their product is the number of ranks
    bool restless = false;                      ///< all bodies change hands in every step, for tests
    std::int64_t rebalance_every = 0;           ///< time steps after which the cuts are made anew; 0 = never
};

/// The kind with a name: boxes, x, y, z or hash. @throws InputError for another name; the text names all
PartitionKind partitionNamed(std::string_view name);

/// What all ranks counted: the sums of numbers, the largest sizes, the times of the slowest, and the diagnostics, which
/// are of the whole world already; without the mean overlap, which stands in World::sums(). To be called by all ranks.
/// @param own of this rank
Statistics sumOverRanks(Ranks& ranks, const Statistics& own);
/// The sum of a number of every rank, modulo 2⁶⁴: of World::stateHash() it is that of the whole world.
std::uint64_t sumOverRanks(Ranks& ranks, std::uint64_t own);

}  // namespace cairn
