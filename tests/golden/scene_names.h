/// @file Tests with every golden scene and all settings.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "golden/scenes.h"

namespace cairn::golden {

/// Shown where a test with these settings fails.
inline void PrintTo(Kind kind, std::ostream* out) {
    *out << nameOf(kind);
}

/// The name of a scene and the settings that it runs with.
using SceneAndKind = std::tuple<std::string_view, Kind>;

/// Those that are kept.
inline std::vector<SceneAndKind> everySceneWithEveryKind() {
    std::vector<SceneAndKind> all;
    for (const GoldenScene& scene : goldenScenes()) {
        for (const Kind kind : kinds) {
            if (!scene.hashSteps(kind).empty()) all.emplace_back(scene.name, kind);
        }
    }
    return all;
}

/// Such as "stacks5_performance".
inline std::string nameOfSceneAndKind(const testing::TestParamInfo<SceneAndKind>& test) {
    const auto [scene, kind] = test.param;
    return std::string(scene) + "_" + std::string(nameOf(kind));
}

}  // namespace cairn::golden
