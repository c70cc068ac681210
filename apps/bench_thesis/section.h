/// @file A section of the thesis's benchmarks: what it measures, and what comes out of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment.h"

namespace cairn::thesis {

/// One number of the thesis beside ours.
struct Entry {
    std::string id;    ///< unique: section/scene/quantity
    std::string what;  ///< the row's text
    std::string unit;
    std::optional<double> thesis;  ///< none where the thesis gives no number
    std::optional<double> ours;    ///< none where it did not come out, such as a time of something that never happens
    std::string note;              ///< what else is to be known, may be empty
    std::string explanation = {};  ///< of a difference; empty = that of explanations.cpp
    bool shortened = false;  ///< found in a part of the thesis's scene, so that there is no factor between the two
};

/// One line of a figure.
struct Line {
    std::string label;
    std::vector<double> y;
    std::vector<double> x = {};  ///< empty = 1, 2, 3, ...
};

/// A horizontal line in a figure.
struct Reference {
    std::string label;
    double y = 0;
};

/// How an axis of values runs.
enum class Scale { linear, logarithmic };

/// A plot.
struct Figure {
    std::string id;
    std::string source;  ///< "Figure 28(a)" of the thesis, may be empty
    std::string title;
    std::string x;  ///< with its unit
    std::string y;  ///< with its unit
    std::vector<Line> lines;
    std::vector<Reference> references = {};
    Scale scale = Scale::linear;
};

/// A row of pictures, one for each moment; of several rows each has its caption.
struct PictureRow {
    std::string source;               ///< "Figure 27(a)"
    std::string caption;              ///< scene and settings
    std::string key;                  ///< of the experiment whose moments are shown
    std::vector<double> camera = {};  ///< position and the point looked at [m]; empty = everything is seen
};

/// A number of the project's own aims.
struct Goal {
    std::string what;
    bool reached = false;
};

/// A sign or a rule that holds on every machine.
struct Check {
    std::string what;
    bool holds = false;
};

/// What a section says.
struct SectionResult {
    std::vector<Entry> entries;
    std::vector<Figure> figures;
    std::vector<PictureRow> pictures;
    std::vector<Goal> goals;
    std::vector<Check> checks;
};

/// A section before it is measured.
struct Section {
    std::string id;  ///< "5.3"
    std::string title;
    std::string text;  ///< what is measured and how
    std::vector<Experiment> experiments;
    std::function<SectionResult(const Results&)> evaluate;
};

/// What the sections depend on.
struct Plan {
    Extent extent = Extent::full;
    std::int64_t cores = 1;                       ///< of this machine
    std::optional<double> processor_rating = {};  ///< single-thread rating of this processor (machine.h)
};

Section generalPerformance(const Plan& plan);
Section parallelEfficiency(const Plan& plan);
Section gravityDamping(const Plan& plan);
Section processingOrder(const Plan& plan);
Section physicalAccuracy(const Plan& plan);
Section furtherCapabilities(const Plan& plan);

/// §5.1 to §5.6.
std::vector<Section> allSections(const Plan& plan);

/// Why a number differs by more than 30 % from the thesis's. @return empty if nothing is known
std::string explanationOf(const Entry& entry);
/// Ours / thesis − 1, if both are known and are of the same scene.
std::optional<double> differenceOf(const Entry& entry);
/// Above this difference an entry owes an explanation.
inline constexpr double explained_difference = 0.3;

Json toJson(const Section& section, const SectionResult& result);

}  // namespace cairn::thesis
