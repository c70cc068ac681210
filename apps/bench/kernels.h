/// @file The inner loops of the engine, each alone: time per contact, pair or body.
#pragma once

#include "common.h"

namespace cairn::bench {

/// How the kernels are measured.
struct KernelsOptions {
    std::string filter;           ///< regular expression that a kernel's name must contain; empty = all
    std::size_t repetitions = 3;  ///< of each, taken in turns
    double seconds = 0.1;         ///< least time of one repetition [s]
    Extent extent = Extent::full;
    Progress progress;
};

/// @throws InputError if no kernel matches, or if this program was built without Google Benchmark; Interrupted
Outcome runKernels(const KernelsOptions& options);

}  // namespace cairn::bench
