/// @file A run with its outputs, shared by the subcommands that simulate to a scene's end.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "cairn/recording.h"
#include "checkpoint_option.h"
#include "cli/progress.h"
#include "measurements.h"
#include "report.h"
#include "stats_csv.h"
#include "together.h"

namespace cairn::cli {

/// What a run checks, and where its results go.
struct OutputOptions {
    std::string record;
    bool hashes = false;
    std::optional<double> frame_rate;  ///< default: 30, or one per time step if there are fewer
    bool record_contacts = false;
    bool record_joints = false;
    std::string stats;
    std::string checkpoint;
    bool check = false;
    bool json = false;
    bool quiet = false;
};

/// Adds --record, --hashes, --frame-rate, --record-contacts, --record-joints, --stats, --checkpoint, --check, --json
/// and --quiet. @param options must outlive the command
void addOutputOptions(CLI::App& command, OutputOptions& options);

/// Two outputs must not be one file, nor any of them the input. @param input empty = no file @throws InputError
void refuseSameFiles(const OutputOptions& options, const std::string& input);

/// Checks a duration of the command line [s]. @throws InputError
double requireDuration(double duration);

/// Simulates to the end of the scene, with outputs and a report, and notes signals.
/// @param usual_checkpoint file of the checkpoints if the option names none
/// @param ranks that the run's world is shared with, all of which call it: the first one has the outputs; null = none
/// @return the exit code @throws InputError, IoError before it begins
int runToTheEnd(SceneRun run, const OutputOptions& options, const std::filesystem::path& usual_checkpoint,
                Ranks* ranks = nullptr);

}  // namespace cairn::cli
