/// @file cairn replay: simulates a recording again and compares.
#include <fmt/format.h>

#include <memory>

#include "cairn/recording.h"
#include "cli/output.h"
#include "commands.h"

namespace cairn::cli {

namespace {

struct ReplayOptions {
    std::string file;
    std::int64_t threads = 1;
    bool verify = false;
};

std::string describe(const RecordingInfo& info, const RecordingDifference& difference) {
    std::string text = fmt::format("the replay differs from time step {} on", difference.step);
    if (difference.body) {
        const std::string& name = info.scene.bodies.at(*difference.body).name;
        text += fmt::format(", first body {}{}", *difference.body, name.empty() ? "" : fmt::format(" '{}'", name));
    }
    return text + ": " + difference.what;
}

int replay(const ReplayOptions& options) {
    const RecordingReader recording(options.file);
    const RecordingInfo& info = recording.info();
    if (const auto difference = verifyRecording(recording, options.threads)) {
        printError(describe(info, *difference));
        return run_failed;
    }
    const std::size_t frames = info.frames - 1;
    printOut(info.hashes_per_frame > 0
                 ? fmt::format("verified: {} time steps are equal bit by bit\n", frames * info.hashes_per_frame)
                 : fmt::format("verified: {} frames are equal bit by bit\n", frames));
    return fine;
}

}  // namespace

void addReplay(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("replay", "Simulate a recording again and prove that it is the same run");
    auto options = std::make_shared<ReplayOptions>();
    command->add_option("FILE", options->file, "A recording that 'cairn run --record' wrote")->required();
    command->add_flag("--verify", options->verify, "Compare every step; name the first step and body that differ")
        ->required();
    command->add_option("--threads", options->threads, "Threads of a step; results do not depend on them")
        ->check(CLI::Range(1, 1024));
    command->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace cairn::cli
