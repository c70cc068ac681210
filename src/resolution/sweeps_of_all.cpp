#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "resolution/algorithms.h"
#include "resolution/batch_plan.h"
#include "resolution/energy_guard.h"
#include "resolution/impacts_first.h"
#include "resolution/relay.h"
#include "resolution/sweeps.h"

namespace cairn {

namespace {

/// Batches with at least so many contacts are worth all threads together.
constexpr std::size_t shared_contacts = 1024;

/// Fewest batches worth a thread of their own in simple loops.
constexpr std::size_t batch_grain = 64;

/// Fewest contacts of small batches worth a thread of their own, and how many relays there are then per thread.
constexpr std::size_t relay_grain = 512;
constexpr std::size_t relays_per_thread = 2;

/// One batch by itself.
class SweepsOfOne final : public BatchResolution {
  public:
    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor& executor) override {
        const BatchKind kind = kindOf(batch, contacts, bodies, settings);
        const auto sweep = [&](auto& sweeps) {
            return sweeps.resolve(batch, kind, contacts, bodies, settings, executor);
        };
        return {.global_iterations = kind.order == SweepOrder::one_by_one ? sweep(one_by_one_) : sweep(in_lanes_)};
    }

  private:
    Sweeps<LaneSweeper> in_lanes_;
    Sweeps<OrderedSweeper> one_by_one_;
};

/// Divides the batches of a step: the largest get all threads together, one after the other, and the others a thread
/// each; small ones share the lanes of its vectors.
class SweepsOfAll final : public Resolution {
  public:
    ResolutionCounts resolve(const ResolutionInput& input) override {
        input_ = &input;
        const auto threads = static_cast<std::size_t>(input.executor.threads());
        while (workers_.size() < threads) workers_.push_back(std::make_unique<Worker>());
        counts_.assign(threads, {});
        divide();
        for (const std::uint32_t batch : shared_) resolveAlone(batch, 0, input.executor);
        input.executor.forEachDynamic(alone_.size() + relays_, [&](std::size_t i, int thread) {
            const auto t = static_cast<std::size_t>(thread);
            if (i < alone_.size()) {
                resolveAlone(alone_[i], t, one_thread_);
            } else {
                relay(i - alone_.size(), t);
            }
        });
        ResolutionCounts sum;
        for (const ResolutionCounts& counts : counts_) sum.add(counts);
        return sum;
    }

  private:
    /// What batches are sorted by.
    struct Rank {
        std::size_t work;
        std::uint32_t batch;

        /// More work comes first, and else the lower index.
        bool operator<(const Rank& other) const { return work != other.work ? work > other.work : batch < other.batch; }
    };

    /// What a thread works with.
    struct Worker {
        Sweeps<LaneSweeper> in_lanes;
        Sweeps<OrderedSweeper> one_by_one;
        Relay relay;
        std::unique_ptr<BatchResolution> with_impacts = makeImpactsFirst(makeSweepsOfOne(), Impacts::simultaneous);
        std::array<EnergyGuard, lane_count> guards;
        std::array<std::uint32_t, lane_count> batches{};  ///< in the lanes of the relay
    };

    /// Finds out which batches are solved how, those with more work first: as many sweeps as in the last step is the
    /// best guess, and a wrong one costs time only.
    void divide() {
        const ResolutionInput& in = *input_;
        kinds_.resize(in.batches.size());
        in.executor.forBlocks(
            in.batches.size(),
            [&](std::size_t begin, std::size_t end, int) {
                for (std::size_t b = begin; b < end; ++b) {
                    kinds_[b] = kindOf(in.batches[b], in.contacts, in.bodies, in.settings);
                }
            },
            batch_grain);
        impacts_first_ = putsImpactsFirst(in.settings, Impacts::simultaneous);
        shared_.clear();
        alone_.clear();
        relayed_.clear();
        std::size_t contacts = 0;
        for (std::uint32_t b = 0; b < in.batches.size(); ++b) {
            const SweepOrder order = kinds_[b].order;
            if (order == SweepOrder::by_colours && sizeOf(b) >= shared_contacts) {
                shared_.push_back(b);
            } else if (order != SweepOrder::one_by_one || !isPlain(kinds_[b]) || impacts_first_ || sizeOf(b) == 0) {
                alone_.push_back(b);
            } else {
                relayed_.push_back(b);
                contacts += sizeOf(b);
            }
        }
        const auto threads = static_cast<std::size_t>(in.executor.threads());
        const std::size_t most = std::min(relayed_.size(), threads == 1 ? 1 : relays_per_thread * threads);
        relays_ = std::min(most, std::max<std::size_t>(1, contacts / relay_grain));
        last_sweeps_.resize(in.bodies.size(), 1);
        sortBy(shared_, [&](std::uint32_t b) { return sizeOf(b); });
        sortBy(alone_, [&](std::uint32_t b) { return sizeOf(b); });
        sortBy(relayed_, [&](std::uint32_t b) { return sizeOf(b) * sweepsOf(b); });
    }

    /// Relays visit no other contacts.
    static bool isPlain(const BatchKind& kind) { return !kind.framed && kind.rolling == 0; }

    template <class WorkOf>
    void sortBy(std::vector<std::uint32_t>& batches, const WorkOf& workOf) {
        ranks_.clear();
        for (const std::uint32_t b : batches) ranks_.push_back({workOf(b), b});
        std::sort(ranks_.begin(), ranks_.end());
        for (std::size_t n = 0; n < batches.size(); ++n) batches[n] = ranks_[n].batch;
    }

    std::size_t sizeOf(std::uint32_t batch) const { return input_->batches[batch].contacts.size(); }

    /// Sweeps that a batch took last.
    std::uint32_t& sweepsOf(std::uint32_t batch) { return last_sweeps_[input_->batches[batch].bodies.front()]; }

    void resolveAlone(std::uint32_t batch, std::size_t thread, const Executor& executor) {
        const ResolutionInput& in = *input_;
        EnergyGuard& guard = workers_[thread]->guards[0];
        guard.begin(in.batches[batch], in.contacts, in.bodies);
        sweep(batch, kinds_[batch], thread, executor);
        if (!guard.refuses(in.batches[batch], in.contacts, in.bodies)) return;
        sweep(batch, kindOf(in.batches[batch], in.contacts, in.bodies, in.settings), thread, executor);
        guard.bound(in.batches[batch], in.contacts, in.bodies);
    }

    void sweep(std::uint32_t batch, const BatchKind& kind, std::size_t thread, const Executor& executor) {
        const ResolutionInput& in = *input_;
        Worker& worker = *workers_[thread];
        const BatchView& view = in.batches[batch];
        if (impacts_first_) {
            counts_[thread].add(worker.with_impacts->resolve(view, in.contacts, in.bodies, in.settings, executor));
            return;
        }
        const auto sweepWith = [&](auto& sweeps) {
            counts_[thread].global_iterations +=
                sweeps.resolve(view, kind, in.contacts, in.bodies, in.settings, executor);
            sweepsOf(batch) = sweeps.sweeps();
        };
        if (kind.order == SweepOrder::one_by_one) {
            sweepWith(worker.one_by_one);
        } else {
            sweepWith(worker.in_lanes);
        }
    }

    /// Resolves every so-manieth of the small batches.
    void relay(std::size_t first, std::size_t thread) {
        const ResolutionInput& in = *input_;
        if (first + relays_ >= relayed_.size()) return resolveAlone(relayed_[first], thread, one_thread_);
        Worker& worker = *workers_[thread];
        std::size_t next = first;
        const auto begin = [&](std::size_t lane, Sweeps<OrderedSweeper>& sweeps) {
            if (next >= relayed_.size()) return false;
            const std::uint32_t batch = worker.batches[lane] = relayed_[next];
            next += relays_;
            worker.guards[lane].begin(in.batches[batch], in.contacts, in.bodies);
            sweeps.prepare(in.batches[batch], kinds_[batch], in.contacts, in.bodies, in.settings, one_thread_);
            return true;
        };
        const auto end = [&](std::size_t lane, Sweeps<OrderedSweeper>& sweeps) {
            const std::uint32_t batch = worker.batches[lane];
            counts_[thread].global_iterations += sweeps.finish();
            sweepsOf(batch) = sweeps.sweeps();
            if (!worker.guards[lane].refuses(in.batches[batch], in.contacts, in.bodies)) return;
            sweep(batch, kindOf(in.batches[batch], in.contacts, in.bodies, in.settings), thread, one_thread_);
            worker.guards[lane].bound(in.batches[batch], in.contacts, in.bodies);
        };
        worker.relay.run(begin, end);
    }

    const ResolutionInput* input_ = nullptr;        ///< during resolve()
    const Executor one_thread_;                     ///< for what is solved beside others
    std::vector<std::unique_ptr<Worker>> workers_;  ///< [threads]
    std::vector<ResolutionCounts> counts_;          ///< [threads]
    std::vector<BatchKind> kinds_;                  ///< [batches]
    std::vector<std::uint32_t> shared_;             ///< batches that get all threads
    std::vector<std::uint32_t> alone_;              ///< those that get one thread, one after the other
    std::vector<std::uint32_t> relayed_;            ///< the others, of which several share one
    std::size_t relays_ = 0;                        ///< that relayed_ is divided among
    std::vector<Rank> ranks_;                       ///< kept memory
    std::vector<std::uint32_t> last_sweeps_;        ///< [slots] that the batch of a body needed in the last step
    bool impacts_first_ = false;                    ///< impacts follow another rule
};

}  // namespace

std::unique_ptr<BatchResolution> makeSweepsOfOne() {
    return std::make_unique<SweepsOfOne>();
}

std::unique_ptr<Resolution> makeSweepsOfAll() {
    return std::make_unique<SweepsOfAll>();
}

}  // namespace cairn
