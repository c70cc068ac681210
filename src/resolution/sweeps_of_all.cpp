#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "resolution/algorithms.h"
#include "resolution/batch_plan.h"
#include "resolution/energy_guard.h"
#include "resolution/impacts_first.h"
#include "resolution/sweeps.h"

namespace cairn {

namespace {

/// Batches with at least so many contacts are worth all threads together.
constexpr std::size_t shared_contacts = 1024;

/// Fewest batches worth a thread of their own in simple loops.
constexpr std::size_t batch_grain = 64;

/// What a visit of a vector of contacts costs, as a multiple of one of a single contact.
constexpr double vector_cost = 2;

/// More than any batch takes.
constexpr std::uint32_t most_sweeps = UINT32_MAX;

/// One batch by itself.
class SweepsOfOne final : public BatchResolution {
  public:
    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor& executor) override {
        const BatchKind kind = kindOf(batch, contacts, bodies, settings);
        const auto sweep = [&](auto& sweeps) {
            return sweeps.resolve({&batch, 1}, {&kind, 1}, contacts, bodies, settings, executor);
        };
        return {.global_iterations = kind.coloured ? sweep(coloured_) : sweep(alone_)};
    }

  private:
    Sweeps<Lanes> coloured_;
    Sweeps<double> alone_;
};

/// Divides the batches of a step: the largest get all threads together, one after the other, and the others a thread
/// each; small ones share the lanes of its vectors.
class SweepsOfAll final : public Resolution {
  public:
    ResolutionCounts resolve(const ResolutionInput& input) override {
        input_ = &input;
        const auto threads = static_cast<std::size_t>(input.executor.threads());
        workers_.resize(std::max(workers_.size(), threads));
        counts_.assign(threads, {});
        divide();
        for (const std::uint32_t batch : shared_) resolvePack({&batch, 1}, 0, input.executor);
        const Executor alone;
        input.executor.forEachDynamic(packs_.size(), [&](std::size_t i, int thread) {
            resolvePack(std::span(packed_).subspan(packs_[i].begin, packs_[i].size), static_cast<std::size_t>(thread),
                        alone);
        });
        ResolutionCounts sum;
        for (const ResolutionCounts& counts : counts_) sum.add(counts);
        return sum;
    }

  private:
    /// What batches are sorted by.
    struct Rank {
        std::uint32_t sweeps;
        std::size_t contacts;
        std::uint32_t batch;

        /// More sweeps and more contacts come first, and else the lower index.
        bool operator<(const Rank& other) const {
            if (sweeps != other.sweeps) return sweeps > other.sweeps;
            return contacts != other.contacts ? contacts > other.contacts : batch < other.batch;
        }
    };

    /// Batches that are solved together; one that is solved alone is a pack, too.
    struct Pack {
        std::size_t begin = 0;  ///< in packed_
        std::size_t size = 0;
    };

    /// What a thread works with.
    struct Worker {
        Sweeps<Lanes> packed;
        Sweeps<double> alone;
        std::unique_ptr<BatchResolution> with_impacts = makeImpactsFirst(makeSweepsOfOne(), Impacts::simultaneous);
        std::array<EnergyGuard, lane_count> guards;
    };

    /// Finds out which batches are solved how. Batches of one pack should need about as many sweeps: as many as in the
    /// last step is the best guess, and a wrong one costs time only.
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
        packed_.clear();
        for (std::uint32_t b = 0; b < in.batches.size(); ++b) {
            const bool shared = kinds_[b].coloured && sizeOf(b) - kinds_[b].rolling >= shared_contacts;
            (shared ? shared_ : packed_).push_back(b);
        }
        last_sweeps_.resize(in.bodies.size(), 1);
        sortBy(shared_, [&](std::uint32_t b) { return Rank{0, sizeOf(b), b}; });
        sortBy(packed_, [&](std::uint32_t b) { return Rank{mayPack(b) ? sweepsOf(b) : most_sweeps, sizeOf(b), b}; });
        pack();
    }

    /// @param rankOf higher ones come first
    template <class RankOf>
    void sortBy(std::vector<std::uint32_t>& batches, const RankOf& rankOf) {
        ranks_.clear();
        for (const std::uint32_t b : batches) ranks_.push_back(rankOf(b));
        std::sort(ranks_.begin(), ranks_.end());
        for (std::size_t n = 0; n < batches.size(); ++n) batches[n] = ranks_[n].batch;
    }

    std::size_t sizeOf(std::uint32_t batch) const { return input_->batches[batch].contacts.size(); }
    bool mayPack(std::uint32_t batch) const {
        return !kinds_[batch].coloured && !kinds_[batch].framed && !impacts_first_;
    }

    /// Sweeps that a batch is expected to need.
    std::uint32_t& sweepsOf(std::uint32_t batch) { return last_sweeps_[input_->batches[batch].bodies.front()]; }

    /// Puts next batches together, unless that would leave too many lanes empty for too long.
    void pack() {
        packs_.clear();
        for (std::size_t begin = 0; begin < packed_.size();) {
            const std::size_t most = mayPack(packed_[begin]) ? std::min(lane_count, packed_.size() - begin) : 1;
            std::size_t visits = 0;
            std::size_t largest = 0;
            for (std::size_t n = 0; n < most; ++n) {
                const std::uint32_t batch = packed_[begin + n];
                visits += sweepsOf(batch) * sizeOf(batch);
                largest = std::max(largest, sizeOf(batch));
            }
            const bool fills =
                static_cast<double>(visits) >= vector_cost * static_cast<double>(sweepsOf(packed_[begin]) * largest);
            packs_.push_back({begin, fills ? most : 1});
            begin += packs_.back().size;
        }
    }

    void resolvePack(std::span<const std::uint32_t> pack, std::size_t thread, const Executor& executor) {
        const ResolutionInput& in = *input_;
        Worker& worker = workers_[thread];
        std::array<BatchView, lane_count> views;
        std::array<BatchKind, lane_count> kinds;
        for (std::size_t n = 0; n < pack.size(); ++n) {
            views[n] = in.batches[pack[n]];
            kinds[n] = kinds_[pack[n]];
            worker.guards[n].begin(views[n], in.contacts, in.bodies);
        }
        sweep(std::span(views).first(pack.size()), std::span(kinds).first(pack.size()), thread, executor);
        for (std::size_t n = 0; n < pack.size(); ++n) {
            if (!worker.guards[n].refuses(views[n], in.contacts, in.bodies)) continue;
            const BatchKind kind = kindOf(views[n], in.contacts, in.bodies, in.settings);
            sweep({&views[n], 1}, {&kind, 1}, thread, executor);
            worker.guards[n].bound(views[n], in.contacts, in.bodies);
        }
    }

    void sweep(std::span<const BatchView> views, std::span<const BatchKind> kinds, std::size_t thread,
               const Executor& executor) {
        const ResolutionInput& in = *input_;
        Worker& worker = workers_[thread];
        if (impacts_first_) {
            counts_[thread].add(worker.with_impacts->resolve(views[0], in.contacts, in.bodies, in.settings, executor));
            return;
        }
        const auto sweepWith = [&](auto& sweeps) {
            counts_[thread].global_iterations +=
                sweeps.resolve(views, kinds, in.contacts, in.bodies, in.settings, executor);
            for (std::size_t n = 0; n < views.size(); ++n) last_sweeps_[views[n].bodies.front()] = sweeps.sweepsOf(n);
        };
        if (views.size() > 1 || kinds[0].coloured) {
            sweepWith(worker.packed);
        } else {
            sweepWith(worker.alone);
        }
    }

    const ResolutionInput* input_ = nullptr;  ///< during resolve()
    std::vector<Worker> workers_;             ///< [threads]
    std::vector<ResolutionCounts> counts_;    ///< [threads]
    std::vector<BatchKind> kinds_;            ///< [batches]
    std::vector<std::uint32_t> shared_;       ///< batches that get all threads
    std::vector<std::uint32_t> packed_;       ///< the others, pack after pack
    std::vector<Pack> packs_;
    std::vector<Rank> ranks_;                 ///< kept memory
    std::vector<std::uint32_t> last_sweeps_;  ///< [slots] that the batch of a body needed in the last step
    bool impacts_first_ = false;              ///< impacts follow another rule
};

}  // namespace

std::unique_ptr<BatchResolution> makeSweepsOfOne() {
    return std::make_unique<SweepsOfOne>();
}

std::unique_ptr<Resolution> makeSweepsOfAll() {
    return std::make_unique<SweepsOfAll>();
}

}  // namespace cairn
