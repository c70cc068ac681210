/// @file Contact resolution: what every algorithm for it sees and gives. @source thesis §3.3–3.8
#pragma once

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
};

/// Changes velocities so that no contact closes any more. One object per thread: it owns its scratch memory.
class Resolution {
  public:
    virtual ~Resolution() = default;
    /// Resolves one batch: changes v and w, wakes sleeping bodies whose contact is processed (wake condition 3), adds
    /// to the contacts' impulses.
    /// @param executor for algorithms that work on one batch with several threads
    virtual ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                                     const ResolutionSettings& settings, const Executor& executor) = 0;
    /// Whether a batch is worth all threads together, and can be divided among them.
    virtual bool wantsAllThreads(const BatchView&, std::span<const Contact>) const { return false; }
};

std::unique_ptr<Resolution> makeResolution(ResolutionKind kind);

}  // namespace cairn
