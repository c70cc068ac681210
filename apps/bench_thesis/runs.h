/// @file The thesis's scenes with the thesis's settings, under keys by which sections share them.
#pragma once

#include "section.h"
#include "series.h"
#include "thesis_settings.h"

namespace cairn::thesis {

/// A scene of §5.1.
struct ThesisScene {
    std::string name;  ///< of the built-in scene
    std::string title;
    std::string machine;  ///< of the thesis
    int threads = 2;      ///< in the thesis
    double total_s = 0;   ///< Tables 2 and 3
    double average_ms = 0;
    std::string figure;                ///< its graph
    std::string pictures;              ///< its pictures
    double rating = 0;                 ///< single-thread rating of the thesis's processor
    double weight = 1;                 ///< expected cost relative to stacks5
    std::vector<double> moments = {};  ///< start, middle and end [s]
};

/// The six scenes; the first three are those of all other sections. @source thesis Tables 2 and 3
const std::vector<ThesisScene>& thesisScenes();
const ThesisScene& thesisScene(const std::string& name);

/// A run of a scene.
struct Run {
    std::string scene;
    Preset preset = Preset::performance;
    Variant variant = Variant::plain;
    std::int64_t threads = 2;
};

std::string keyOf(const Run& run);
/// Runs that differ in nothing have the same key and are measured once for all sections.
Experiment experimentOf(const Run& run, const Plan& plan);

/// The threads that stand for the thesis's: as many, but no more than there are cores, and two at least.
std::int64_t threadsFor(const ThesisScene& scene, const Plan& plan);

/// The run of §5.1.
Run plainRun(const std::string& scene, const Plan& plan);

/// "stacks5: what", for rows of tables.
std::string rowText(const ThesisScene& scene, const std::string& what);

}  // namespace cairn::thesis
