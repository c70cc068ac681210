/// @file What is measured: an experiment has a key, can be repeated, and gives a JSON value that is kept.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cairn/scene.h"

namespace cairn::thesis {

using Json = nlohmann::ordered_json;

/// How much is run.
enum class Extent {
    full,  ///< everything, several times
    quick  ///< shortened, once; for the signs, not for the numbers
};

/// Somebody asked to stop; what was measured so far is kept.
struct Interrupted {};

/// What an experiment may use while it runs.
struct Surroundings {
    /// Called often, with the part that is done, 0 to 1. @throws Interrupted
    std::function<void(double)> progress;
    /// Where pictures are drawn from: a recording with the moments to show is put here.
    std::filesystem::path recording;
};

/// One measurement.
struct Experiment {
    std::string key;          ///< unique, also the name of its files
    double weight = 1;        ///< expected cost, relative to stacks5 with the performance settings
    bool timed = false;       ///< repeated, because its times scatter
    std::string fingerprint;  ///< of scene and settings; a result with another one is not this experiment's
    std::function<Json(const Surroundings&)> run;
};

/// The results that exist, by key; each has one value or more, of the repetitions.
using Results = std::map<std::string, std::vector<Json>>;

/// A scene with settings as an experiment: what happens in each simulation step.
struct SceneExperiment {
    std::string key;
    Scene scene;
    Settings settings;
    double weight = 1;
    std::vector<double> moments;  ///< that are shown in pictures [s]
};

/// @return an experiment whose value has the members of Series (series.h)
Experiment measureScene(SceneExperiment what);

/// A scene for `seconds` at most.
Scene shortened(Scene scene, double seconds);

}  // namespace cairn::thesis
