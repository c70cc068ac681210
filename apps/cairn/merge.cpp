/// @file cairn merge: makes one recording of what ranks recorded.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cairn/recording.h"
#include "cli/output.h"
#include "commands.h"

namespace cairn::cli {

namespace {

struct MergeOptions {
    std::vector<std::string> files;
    std::string out;
};

bool isSame(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code unknown;
    return a == b || std::filesystem::equivalent(a, b, unknown);
}

/// The file that names all parts; the others that are given must be these.
std::string namedFile(const MergeOptions& options, std::size_t parts) {
    for (std::size_t i = 1; i < options.files.size(); ++i) {
        bool known = false;
        for (std::size_t rank = 0; rank < parts; ++rank) {
            known = known || isSame(options.files[i], recordingPart(options.files.front(), rank));
        }
        if (!known) {
            throw InputError(fmt::format("'{}' is no part of the recording '{}'; name its first file alone",
                                         options.files[i], options.files.front()));
        }
    }
    return options.files.front();
}

int merge(const MergeOptions& options) {
    const RecordingReader recording(options.files.front());
    const RecordingInfo& info = recording.info();
    const std::string file = namedFile(options, info.parts);
    bool is_own = isSame(options.out, file);
    for (std::size_t rank = 0; rank < info.parts; ++rank) {
        is_own = is_own || isSame(options.out, recordingPart(file, rank));
    }
    if (is_own) throw InputError(fmt::format("'{}' is a file of the recording; name another for --out", options.out));
    mergeRecording(recording, options.out);
    printOut(
        fmt::format("{}: {} frames of {} bodies from {} ranks\n", options.out, info.frames, info.bodies, info.parts));
    return fine;
}

}  // namespace

void addMerge(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("merge", "Make one recording of those of several ranks");
    auto options = std::make_shared<MergeOptions>();
    command->add_option("FILES", options->files, "What 'cairn run --ranks … --record' was told; its parts may follow")
        ->required();
    command->add_option("--out", options->out, "The recording to write")->type_name("FILE")->required();
    command->callback([options, &exit_code] { exit_code = merge(*options); });
}

}  // namespace cairn::cli
