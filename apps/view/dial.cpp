#include "dial.h"

#include <cmath>

namespace cairn::view {

namespace {

constexpr std::string_view steps_field = "steps_per_second";

double between(double from, double to, double part) {
    return from * std::pow(to / from, part);
}

}  // namespace

DialEnds dialEnds(const Scene& scene) {
    // A scene's own steps per second would hold both ends at the same place.
    Scene own = scene;
    std::erase_if(own.settings, [](const auto& field) { return field.first == steps_field; });
    return {settingsFor(own, {Preset::performance, {}, {}}), settingsFor(own, {Preset::accuracy, {}, {}})};
}

Settings settingsAt(const DialEnds& ends, double value, const Settings& now) {
    Settings settings = value < 0.5 ? ends.performance : ends.accuracy;
    if (value > 0 && value < 1) {
        for (const SettingField& field : settingFields()) {
            const SettingValue from = field.get(ends.performance);
            const SettingValue to = field.get(ends.accuracy);
            const auto* a = std::get_if<double>(&from);
            const auto* b = std::get_if<double>(&to);
            if (a == nullptr || *a <= 0 || *b <= 0) continue;
            field.set(settings, between(*a, *b, value));
        }
    }
    settings.parallel = now.parallel;
    return settings;
}

bool sameApartFromThreads(const Settings& a, const Settings& b) {
    for (const SettingField& field : settingFields()) {
        if (field.stage != "parallel" && field.get(a) != field.get(b)) return false;
    }
    return true;
}

}  // namespace cairn::view
