/// @file The option --checkpoint: a run that is written to a file again and again, so that it can be continued.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "cairn/checkpoint.h"

namespace cairn::cli {

inline constexpr const char* checkpoint_help =
    "Write the run to a file at least that often, of wall time, and when it is interrupted; 'cairn resume' goes on";
inline constexpr const char* checkpoint_form = "every=SECONDSs[,file=FILE]";

/// What the option says.
struct CheckpointOption {
    std::chrono::duration<double> every{};
    std::filesystem::path file;
};

/// @param text of the option, empty = not given @param usual_file if the text names none @throws InputError
std::optional<CheckpointOption> parseCheckpoint(const std::string& text, const std::filesystem::path& usual_file);

/// The file of a run whose option names none: NAME.checkpoint in the current folder.
std::filesystem::path usualCheckpointFile(const std::string& scene_name);

/// Writes checkpoints when they are due.
class Checkpointer {
  public:
    explicit Checkpointer(CheckpointOption option) : option_(std::move(option)) {}

    bool isDue() const { return Clock::now() - last_ >= option_.every; }
    /// @throws IoError; the older checkpoint is kept
    void write(const SceneRun& run);
    const std::filesystem::path& file() const { return option_.file; }

  private:
    using Clock = std::chrono::steady_clock;

    CheckpointOption option_;
    Clock::time_point last_ = Clock::now();
};

}  // namespace cairn::cli
