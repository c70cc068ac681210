/// @file Resolutions that know nothing of other batches than the one at hand.
#pragma once

#include <functional>
#include <memory>

#include "resolution/resolution.h"

namespace cairn {

/// Resolves one batch at a time. One object per thread: it owns its scratch memory.
class BatchResolution {
  public:
    virtual ~BatchResolution() = default;
    /// As Resolution::resolve(). @param executor for algorithms that work on one batch with several threads
    virtual ResolutionCounts resolve(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                                     const ResolutionSettings& settings, const Executor& executor) = 0;
};

using BatchResolutionMaker = std::function<std::unique_ptr<BatchResolution>()>;

/// Hands each batch to a thread. @param make one per thread
std::unique_ptr<Resolution> makePerBatch(BatchResolutionMaker make);

}  // namespace cairn
