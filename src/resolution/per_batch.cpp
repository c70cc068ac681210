#include <utility>
#include <vector>

#include "batches/schedule.h"
#include "resolution/batch_resolution.h"

namespace cairn {

namespace {

class PerBatch final : public Resolution {
  public:
    explicit PerBatch(BatchResolutionMaker make) : make_(std::move(make)) {}

    ResolutionCounts resolve(const ResolutionInput& input) override {
        const auto threads = static_cast<std::size_t>(input.executor.threads());
        while (workers_.size() < threads) workers_.push_back(make_());
        counts_.assign(threads, {});
        schedule_.arrange(input.batches);
        const Executor alone;
        schedule_.forEach(input.executor, [&](std::uint32_t batch, int thread) {
            const auto t = static_cast<std::size_t>(thread);
            counts_[t].add(
                workers_[t]->resolve(input.batches[batch], input.contacts, input.bodies, input.settings, alone));
        });
        ResolutionCounts sum;
        for (const ResolutionCounts& counts : counts_) sum.add(counts);
        return sum;
    }

  private:
    BatchResolutionMaker make_;
    std::vector<std::unique_ptr<BatchResolution>> workers_;  ///< [threads]
    std::vector<ResolutionCounts> counts_;                   ///< [threads]
    BatchSchedule schedule_;
};

}  // namespace

std::unique_ptr<Resolution> makePerBatch(BatchResolutionMaker make) {
    return std::make_unique<PerBatch>(std::move(make));
}

}  // namespace cairn
