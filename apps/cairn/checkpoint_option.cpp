#include "checkpoint_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace cairn::cli {

namespace {

constexpr double longest_interval = 1e6;  ///< [s]
constexpr std::string_view every_key = "every=";
constexpr std::string_view file_key = ",file=";

std::chrono::duration<double> parseInterval(std::string_view text) {
    double seconds = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
    const std::string_view unit(end, text.data() + text.size());
    const bool sound = error == std::errc() && unit == "s" && seconds >= 0 && seconds <= longest_interval;
    if (sound) return std::chrono::duration<double>(seconds);
    throw InputError(fmt::format("--checkpoint is every '{}'; it must be 0 to {} seconds, for example every=10s", text,
                                 longest_interval));
}

}  // namespace

std::optional<CheckpointOption> parseCheckpoint(const std::string& text, const std::filesystem::path& usual_file) {
    if (text.empty()) return std::nullopt;
    if (!text.starts_with(every_key)) {
        throw InputError(
            fmt::format("--checkpoint is '{}'; it must be {}, for example every=10s", text, checkpoint_form));
    }
    const std::size_t at = text.find(file_key);
    const std::string interval = text.substr(every_key.size(), at == std::string::npos ? at : at - every_key.size());
    CheckpointOption option{parseInterval(interval), usual_file};
    if (at != std::string::npos) option.file = text.substr(at + file_key.size());
    if (option.file.empty()) throw InputError("--checkpoint names an empty file; leave out ',file=' or name one");
    return option;
}

std::filesystem::path usualCheckpointFile(const std::string& scene_name) {
    std::string name = scene_name.empty() ? "run" : scene_name;
    std::ranges::replace_if(
        name, [](char c) { return c == '/' || c == ':'; }, '-');
    return name + ".checkpoint";
}

void Checkpointer::write(const SceneRun& run) {
    writeCheckpoint(run, option_.file);
    last_ = Clock::now();
}

}  // namespace cairn::cli
