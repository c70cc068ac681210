/// @file The thesis's scenes with the thesis's settings, under keys by which sections share them.
#pragma once

#include "section.h"
#include "series.h"
#include "thesis_settings.h"

namespace cairn::thesis {

/// A machine of the thesis.
struct ThesisMachine {
    std::string name;
    int threads = 1;    ///< of the benchmarks on it
    double rating = 0;  ///< single-thread rating of its processor (machine.h)
};

/// A scene of §5.1.
struct ThesisScene {
    std::string name;  ///< of the built-in scene
    std::string title;
    ThesisMachine machine;
    double total_s = 0;                ///< whole simulation, Tables 2 and 3 [s]
    double average_ms = 0;             ///< of a simulation step, Tables 2 and 3 [ms]
    std::string figure;                ///< its graph
    std::string pictures;              ///< its pictures
    std::vector<double> camera = {};   ///< of its pictures: position and the point looked at [m]; empty = everything
    double weight = 1;                 ///< expected cost relative to stacks5
    std::vector<double> moments = {};  ///< start, middle and end [s]
};

/// The six scenes; the first three are those of all other sections. @source thesis Tables 2 and 3
const std::vector<ThesisScene>& thesisScenes();
const ThesisScene& thesisScene(const std::string& name);

/// A run of a scene.
struct Run {
    std::string scene;
    Preset preset = Preset::thesis;  ///< or Preset::thesis_accuracy
    Variant variant = Variant::plain;
    std::int64_t threads = 2;
};

std::string keyOf(const Run& run);
/// Runs that differ in nothing have the same key and are measured once for all sections.
Experiment experimentOf(const Run& run, const Plan& plan);

/// Marks the entries of a result from one on if a quick run ends their scene before the thesis's does: a number of a
/// part of a scene is not to be compared with that of the whole. @param run that ends first
void markShortened(SectionResult& result, std::size_t first, const Run& run, const Plan& plan);

/// The threads that stand for the thesis's: as many, but no more than there are cores, and two at least.
std::int64_t threadsFor(const ThesisScene& scene, const Plan& plan);

/// The run of §5.1.
Run plainRun(const std::string& scene, const Plan& plan);

/// The processor's part of a difference in time, and the rest, as a sentence. @param speedup over the thesis
std::string processorPart(const ThesisScene& scene, const Plan& plan, double speedup);

/// "stacks5: what", for rows of tables.
std::string rowText(const ThesisScene& scene, const std::string& what);

}  // namespace cairn::thesis
