#include "resolution/resolution.h"

#include <algorithm>

#include "resolution/algorithms.h"
#include "resolution/energy_bound.h"
#include "resolution/impacts_first.h"

namespace cairn {

namespace {

/// Leaves everything as it is: bodies fall through each other.
class NoResolution final : public Resolution {
  public:
    ResolutionCounts resolve(const BatchView&, std::span<Contact>, const BodyState&, const ResolutionSettings&,
                             const Executor&) override {
        return {};
    }
};

/// Leaves out batches of which nothing moves or may move: their contacts go on with the impulses that they had.
class ResolutionOfTheAwake final : public Resolution {
  public:
    explicit ResolutionOfTheAwake(std::unique_ptr<Resolution> resolution) : resolution_(std::move(resolution)) {}

    ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                             const ResolutionSettings& settings, const Executor& executor) override {
        if (!isAtSleep(batch, contacts, bodies)) {
            return resolution_->resolve(batch, contacts, bodies, settings, executor);
        }
        for (const std::uint32_t i : batch.contacts) contacts[i].impulse += contacts[i].last_impulse;
        return {};
    }

    std::size_t sharedFrom() const override { return resolution_->sharedFrom(); }

  private:
    static bool isAtSleep(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) {
        if (!batch.joints.empty()) return false;
        const auto rests = [&](BodyIndex i) { return bodies.v[i].isZero(0) && bodies.w[i].isZero(0); };
        const auto sleeps = [&](BodyIndex i) { return bodies.asleep[i] != 0 && rests(i); };
        if (!std::ranges::all_of(batch.bodies, sleeps)) return false;
        return std::ranges::all_of(batch.contacts, [&](std::uint32_t i) {
            const Contact& contact = contacts[i];
            return (!bodies.isFixed(contact.a) || rests(contact.a)) && (!bodies.isFixed(contact.b) || rests(contact.b));
        });
    }

    std::unique_ptr<Resolution> resolution_;
};

std::unique_ptr<Resolution> makeAlgorithm(ResolutionKind kind) {
    switch (kind) {
        case ResolutionKind::impulse_queue:
            return makeImpactsFirst(makeImpulseQueueResolution(), Impacts::sequential);
        case ResolutionKind::sweep:
            return makeImpactsFirst(makeSweepResolution(), Impacts::sequential);
        case ResolutionKind::accelerated_sweeps:
            return makeEnergyBound(makeImpactsFirst(makeAcceleratedSweepsResolution(), Impacts::simultaneous));
        case ResolutionKind::none:
            break;
    }
    return std::make_unique<NoResolution>();
}

}  // namespace

std::unique_ptr<Resolution> makeResolution(ResolutionKind kind) {
    return std::make_unique<ResolutionOfTheAwake>(makeAlgorithm(kind));
}

}  // namespace cairn
