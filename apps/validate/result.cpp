#include "result.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace cairn::validation {

namespace {

const char* nameOf(Rule rule) {
    switch (rule) {
        case Rule::relative:
            return "relative";
        case Rule::absolute:
            return "absolute";
        case Rule::at_most:
            return "at most";
        case Rule::at_least:
            return "at least";
        case Rule::shown:
            break;
    }
    return "shown";
}

/// NaN and infinity have no JSON number.
Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json toJson(const Quantity& q) {
    return {{"what", q.what},
            {"unit", q.unit},
            {"setup", q.setup},
            {"rule", nameOf(q.rule)},
            {"expected", q.expected ? number(*q.expected) : Json(nullptr)},
            {"measured", number(q.measured)},
            {"error", q.rule == Rule::shown && !q.expected ? Json(nullptr) : number(q.error())},
            {"allowed", q.rule == Rule::shown ? Json(nullptr) : number(q.allowed)},
            {"passed", q.rule == Rule::shown ? Json(nullptr) : Json(q.passed())},
            {"order", q.order},
            {"note", q.note}};
}

Json toJson(const Convergence& c) {
    const std::optional<double> order = c.order();
    return {{"what", c.what},
            {"unit", c.unit},
            {"time_steps", c.time_steps},
            {"errors", c.errors},
            {"order", order ? Json(*order) : Json(nullptr)}};
}

Json toJson(const Figure& figure) {
    // The members that the plots of the page expect, which are those of the report of the thesis's benchmarks.
    Json json = {{"id", figure.title},
                 {"source", ""},
                 {"title", figure.title},
                 {"x", figure.x},
                 {"y", figure.y},
                 {"scale", figure.logarithmic ? "log" : "linear"},
                 {"references", Json::array()}};
    json["lines"] = Json::array();
    for (const Line& line : figure.lines) {
        json["lines"].push_back({{"label", line.label}, {"x", line.x}, {"y", line.y}, {"dashed", line.dashed}});
    }
    return json;
}

}  // namespace

double Quantity::error() const {
    const double difference = expected ? std::abs(measured - *expected) : measured;
    switch (rule) {
        case Rule::relative:
            return difference / std::abs(*expected);
        case Rule::at_most:
        case Rule::at_least:
            return measured;
        case Rule::absolute:
        case Rule::shown:
            break;
    }
    return difference;
}

bool Quantity::passed() const {
    if (rule == Rule::shown) return true;
    if (rule == Rule::at_least) return measured >= allowed;
    return error() <= allowed;
}

std::optional<double> Convergence::order() const {
    /// Errors below this are rounding, whose slope means nothing.
    constexpr double round_off = 1e-11;
    if (errors.size() < 2 || !(errors.front() > round_off) || !(errors.back() > round_off)) return {};
    return std::log(errors.front() / errors.back()) / std::log(time_steps.front() / time_steps.back());
}

std::string Convergence::orderText() const {
    const std::optional<double> power = order();
    return power ? fmt::format("{:.1f}", *power) : "rounding";
}

bool Result::passed() const {
    return std::all_of(quantities.begin(), quantities.end(), [](const Quantity& q) { return q.passed(); });
}

void Result::relative(std::string what, std::string unit, double expected, double measured, double allowed,
                      std::string setup, std::string note) {
    quantities.push_back({std::move(what), std::move(unit), Rule::relative, expected, measured, allowed,
                          std::move(setup), std::move(note)});
}

void Result::absolute(std::string what, std::string unit, double expected, double measured, double allowed,
                      std::string setup, std::string note) {
    quantities.push_back({std::move(what), std::move(unit), Rule::absolute, expected, measured, allowed,
                          std::move(setup), std::move(note)});
}

void Result::atMost(std::string what, std::string unit, double measured, double allowed, std::string setup,
                    std::string note) {
    quantities.push_back(
        {std::move(what), std::move(unit), Rule::at_most, {}, measured, allowed, std::move(setup), std::move(note)});
}

void Result::atLeast(std::string what, std::string unit, double measured, double allowed, std::string setup,
                     std::string note) {
    quantities.push_back(
        {std::move(what), std::move(unit), Rule::at_least, {}, measured, allowed, std::move(setup), std::move(note)});
}

void Result::show(std::string what, std::string unit, double measured, std::string setup, std::string note) {
    quantities.push_back(
        {std::move(what), std::move(unit), Rule::shown, {}, measured, 0, std::move(setup), std::move(note)});
}

void Result::onlyShowFrom(std::size_t first) {
    for (Quantity& q : std::span(quantities).subspan(first)) {
        q.rule = Rule::shown;
        q.expected.reset();
    }
}

std::string timeStepText(double steps_per_second) {
    return fmt::format("Δt = 1/{:g} s", steps_per_second);
}

void measureOver(Result& result, const std::vector<double>& rates, const std::vector<Target>& targets,
                 const std::function<std::vector<double>(double)>& measure) {
    std::vector<Convergence> convergences;
    for (const Target& target : targets) {
        const std::string label = target.setup.empty() ? target.what : target.what + ", " + target.setup;
        convergences.push_back({label, target.rule == Rule::relative ? "" : target.unit, {}, {}});
    }
    const double last = rates.back();
    for (const double rate : rates) {
        const std::vector<double> values = measure(rate);
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const Target& target = targets[i];
            const std::string setup = (target.setup.empty() ? "" : target.setup + ", ") + timeStepText(rate);
            Quantity q{target.what,  target.unit,    target.rule, target.expected,
                       values.at(i), target.allowed, setup,       target.note};
            if (target.rule == Rule::at_most) q.expected.reset();
            convergences[i].time_steps.push_back(1 / rate);
            convergences[i].errors.push_back(q.error());
            if (rates.size() > 1 && rate == last) q.order = convergences[i].orderText();
            if (rate < std::min(target.decisive, last)) q.rule = Rule::shown;
            result.quantities.push_back(std::move(q));
        }
    }
    if (rates.size() > 1) {
        for (Convergence& convergence : convergences) result.convergences.push_back(std::move(convergence));
    }
}

Json toJson(const Result& result) {
    Json json = {{"passed", result.passed()}};
    for (const char* list : {"quantities", "convergences", "figures"}) json[list] = Json::array();
    for (const Quantity& q : result.quantities) json["quantities"].push_back(toJson(q));
    for (const Convergence& c : result.convergences) json["convergences"].push_back(toJson(c));
    for (const Figure& f : result.figures) json["figures"].push_back(toJson(f));
    return json;
}

}  // namespace cairn::validation
