/// @file The options that share a run among ranks.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "runner.h"

namespace cairn::cli {

/// As given; empty = not given.
struct RanksOptions {
    std::string ranks;
    std::string partition;
    std::string delay;
    std::int64_t rebalance_every = 0;
    double patience = 600;  ///< [s]; 0 = for ever
};

/// Adds --ranks, --partition, --rebalance-every, --message-delay and --patience. @param options must outlive the
/// command
void addRanksOptions(CLI::App& command, RanksOptions& options);

/// A run, and where its checkpoints go if the option names no file.
struct PreparedRun {
    SceneRun run;
    std::filesystem::path usual_checkpoint;
};

/// Makes a run that ranks share, with its world cut in this way; by a rank alone if there are none (null).
using Prepare = std::function<PreparedRun(Ranks* ranks, const Partition& partition)>;

/// Prepares a run and simulates it to its end: on the ranks that mpirun started, on as many threads as --ranks says,
/// or without other ranks. @param prepare called once for every rank, with the same result @return the exit code
/// @throws InputError, IoError before it begins
int runOnRanks(const RanksOptions& options, const OutputOptions& outputs, const Prepare& prepare);

}  // namespace cairn::cli
