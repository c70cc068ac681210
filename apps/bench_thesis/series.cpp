#include "series.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace cairn::thesis {

namespace {

/// Step by step the median of the repetitions.
std::vector<double> medians(const std::vector<Json>& repetitions, const char* member) {
    std::vector<double> result(repetitions.front().at(member).size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        std::vector<double> values;
        values.reserve(repetitions.size());
        for (const Json& repetition : repetitions) values.push_back(repetition.at(member).at(i).get<double>());
        result[i] = median(std::move(values));
    }
    return result;
}

}  // namespace

Series seriesOf(const Results& results, const std::string& key) {
    const auto found = results.find(key);
    if (found == results.end() || found->second.empty()) throw std::logic_error(fmt::format("no result of {}", key));
    const std::vector<Json>& repetitions = found->second;
    const Json& first = repetitions.front();
    Series series;
    series.total_ms = medians(repetitions, "total_ms");
    series.detection_ms = medians(repetitions, "detection_ms");
    series.response_ms = medians(repetitions, "response_ms");
    series.iterations = medians(repetitions, "iterations");
    series.contacts = medians(repetitions, "contacts");
    series.largest_batch = medians(repetitions, "largest_batch");
    series.asleep = medians(repetitions, "asleep");
    std::vector<double> totals;
    totals.reserve(repetitions.size());
    for (const Json& repetition : repetitions) {
        totals.push_back(sum(repetition.at("total_ms").get<std::vector<double>>()) / 1000);
    }
    series.total_s = median(std::move(totals));
    series.bodies = first.at("bodies");
    series.threads = first.at("threads");
    series.lost = first.at("lost");
    series.state_hash = first.at("state_hash");
    series.repetitions = repetitions.size();
    return series;
}

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

double sumOfFirst(const std::vector<double>& values, std::size_t count) {
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(count, values.size()));
    return std::accumulate(values.begin(), end, 0.0);
}

double largest(const std::vector<double>& values) {
    return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

BestStep bestStep(const std::vector<double>& first, const std::vector<double>& second, double floor) {
    const double least = floor * largest(first);
    BestStep best;
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
        if (first[i] < least || second[i] <= 0) continue;
        if (first[i] / second[i] > best.ratio) best = {first[i] / second[i], i + 1};
    }
    return best;
}

}  // namespace cairn::thesis
