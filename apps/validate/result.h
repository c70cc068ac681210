/// @file What a case of the validation says: quantities beside their expectations, orders of convergence and plots.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace cairn::validation {

using Json = nlohmann::ordered_json;

/// How a measured value is judged.
enum class Rule {
    relative,  ///< |measured − expected| ≤ allowed · |expected|
    absolute,  ///< |measured − expected| ≤ allowed
    at_most,   ///< measured ≤ allowed
    at_least,  ///< measured ≥ allowed
    shown      ///< not judged: a reference, or a time step at which the target does not apply
};

/// One measured value.
struct Quantity {
    std::string what;
    std::string unit;
    Rule rule = Rule::shown;
    std::optional<double> expected;
    double measured = 0;
    double allowed = 0;
    std::string setup;    ///< time step, resolver or other conditions
    std::string note;     ///< what else is to be known; why a target is missed
    std::string order{};  ///< with which power of the time step the error falls; at the shortest of several ones only

    /// Of the kind that the rule names; the measured value itself for bounds.
    double error() const;
    bool passed() const;
};

/// How an error falls with the time step.
struct Convergence {
    std::string what;
    std::string unit;  ///< of the error; empty = relative
    std::vector<double> time_steps;
    std::vector<double> errors;

    /// Slope of the error over the time step between the longest and the shortest one; none where the error is
    /// round-off.
    std::optional<double> order() const;
    /// "2.0", or "rounding".
    std::string orderText() const;
};

struct Line {
    std::string label;
    std::vector<double> x;
    std::vector<double> y;
    bool dashed = false;  ///< a formula beside what was measured
};

/// A plot.
struct Figure {
    std::string title;
    std::string x;  ///< with its unit
    std::string y;  ///< with its unit
    std::vector<Line> lines;
    bool logarithmic = false;  ///< the axis of values
};

/// All that a case found out.
struct Result {
    std::vector<Quantity> quantities;
    std::vector<Convergence> convergences;
    std::vector<Figure> figures;

    bool passed() const;

    void relative(std::string what, std::string unit, double expected, double measured, double allowed,
                  std::string setup = {}, std::string note = {});
    void absolute(std::string what, std::string unit, double expected, double measured, double allowed,
                  std::string setup = {}, std::string note = {});
    void atMost(std::string what, std::string unit, double measured, double allowed, std::string setup = {},
                std::string note = {});
    void atLeast(std::string what, std::string unit, double measured, double allowed, std::string setup = {},
                 std::string note = {});
    void show(std::string what, std::string unit, double measured, std::string setup = {}, std::string note = {});

    /// Judges the quantities from one on no more: they are there to compare with.
    void onlyShowFrom(std::size_t first);
};

/// A value that is measured at several time steps.
struct Target {
    std::string what;
    std::string unit;
    Rule rule = Rule::relative;
    double expected = 0;
    double allowed = 0;
    double decisive = 960;  ///< steps per second from which on the target must be met
    std::string note = {};
    std::string setup = {};  ///< conditions beside the time step
};

/// "Δt = 1/960 s"
std::string timeStepText(double steps_per_second);

/// Measures one target or more at every time step, adds the values and how their errors fall.
/// @param rates steps per second, ascending @param measure gives as many values as there are targets
void measureOver(Result& result, const std::vector<double>& rates, const std::vector<Target>& targets,
                 const std::function<std::vector<double>(double)>& measure);

Json toJson(const Result& result);

}  // namespace cairn::validation
