#include "moments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cairn::thesis {

namespace {

std::string textOf(const SettingValue& value) {
    return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

/// 64-bit FNV-1a.
std::uint64_t hashOf(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

}  // namespace

Moments::Moments(const SceneExperiment& what, const std::filesystem::path& file) {
    if (what.moments.empty() || file.empty()) return;
    const double end = std::ceil(what.scene.duration * simulation_steps_per_second - 1e-6);
    for (const double moment : what.moments) {
        steps_.push_back(std::llround(std::min(end, moment * simulation_steps_per_second)));
    }
    std::filesystem::create_directories(file.parent_path());
    writer_.emplace(file, what.scene, what.settings);
}

void Moments::look(const SceneRun& run, std::int64_t step, const Statistics& statistics) {
    if (!writer_ || std::find(steps_.begin(), steps_.end(), step) == steps_.end()) return;
    writer_->append(captureFrame(run, statistics));
}

void Moments::close() {
    if (writer_) writer_->close();
}

std::string fingerprintOf(const Scene& scene, const Settings& settings) {
    std::string text = formatScene(scene);
    for (const SettingField& field : settingFields()) {
        text += fmt::format("{}={};", field.name, textOf(field.get(settings)));
    }
    return fmt::format("{:016x}", hashOf(text));
}

}  // namespace cairn::thesis
