/// @file Contact resolution: what every algorithm for it sees and gives. @source thesis §3.3–3.8
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>

#include "batches/batches.h"
#include "body/contact.h"
#include "cairn/settings.h"
#include "parallel/executor.h"

namespace cairn {

/// What a resolution counted.
struct ResolutionCounts {
    std::int64_t global_iterations = 0;
    std::int64_t shock_iterations = 0;
    std::int64_t shock_batches = 0;

    void add(const ResolutionCounts& other) {
        global_iterations += other.global_iterations;
        shock_iterations += other.shock_iterations;
        shock_batches += other.shock_batches;
    }
};

/// What a resolution reads and writes.
struct ResolutionInput {
    std::span<const BatchView> batches;  ///< no two of them share a body that moves
    std::span<Contact> contacts;
    const BodyState& bodies;
    const ResolutionSettings& settings;
    const Executor& executor;
};

/// Changes velocities so that no contact closes any more. It gets all batches of a step at once, so that it may divide
/// them among threads and vectors as suits it. Owns its scratch memory.
class Resolution {
  public:
    virtual ~Resolution() = default;
    /// Changes v and w, wakes sleeping bodies whose contact is processed (wake condition 3), adds to the contacts'
    /// impulses. The same on any number of threads.
    virtual ResolutionCounts resolve(const ResolutionInput& input) = 0;
};

/// Most sweeps over a batch, for the algorithms that sweep.
inline std::int64_t sweepLimit(const ResolutionSettings& settings) {
    constexpr std::int64_t no_limit = 1'000'000;
    return settings.iterations > 0 ? static_cast<std::int64_t>(std::ceil(settings.iterations)) : no_limit;
}

std::unique_ptr<Resolution> makeResolution(ResolutionKind kind);

}  // namespace cairn
