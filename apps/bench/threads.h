/// @file Whether threads ever cost: scenes on one and on two threads, on a free machine and on a busy one.
#pragma once

#include "common.h"

namespace cairn::bench {

/// What is measured.
struct ThreadsOptions {
    std::vector<std::string> scenes;  ///< names or files; empty = stacks5, well392, cage384
    SettingOverrides overrides;       ///< of all runs
    double seconds = 2;               ///< longest simulated time of a run
    std::size_t pairs = 15;           ///< runs on one and on two threads, in turns
    Extent extent = Extent::full;
    Progress progress;
};

/// Ratios of the wall time on two threads to that on one, of runs next to each other: with nothing else, with all
/// threads on one processor (Linux only), and beside a thread that never rests.
/// @throws InputError, IoError, Interrupted
Outcome runThreads(const ThreadsOptions& options);

}  // namespace cairn::bench
