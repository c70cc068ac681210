#include "samples.h"

#include <array>
#include <span>
#include <string>

namespace cairn::view {

namespace {

constexpr std::uint32_t sample_kind = 2;

struct Column {
    std::string_view name;
    double (*get)(const Sample&);
};

/// A counter of the statistics as a number.
template <auto Member>
double counter(const Sample& sample) {
    return static_cast<double>(sample.statistics.*Member);
}

constexpr std::array columns = {
    Column{"contacts", counter<&Statistics::contacts>},
    Column{"penetrating_contacts", counter<&Statistics::penetrating_contacts>},
    Column{"corrected_contacts", counter<&Statistics::corrected_contacts>},
    Column{"uncorrected_contacts", counter<&Statistics::uncorrected_contacts>},
    Column{"displaced_bodies", counter<&Statistics::displaced_bodies>},
    Column{"global_iterations", counter<&Statistics::global_iterations>},
    Column{"shock_iterations", counter<&Statistics::shock_iterations>},
    Column{"batches", counter<&Statistics::batches>},
    Column{"largest_batch", counter<&Statistics::largest_batch>},
    Column{"asleep", counter<&Statistics::asleep>},
    Column{"woken", counter<&Statistics::woken>},
    Column{"largest_overlap", counter<&Statistics::largest_overlap>},
    Column{"mean_overlap", counter<&Statistics::mean_overlap>},
    Column{"kinetic_energy", [](const Sample& s) { return s.kinetic_energy; }},
    Column{"potential_energy", [](const Sample& s) { return s.potential_energy; }},
};

}  // namespace

nlohmann::json sampleFields() {
    nlohmann::json names = nlohmann::json::array({"time"});
    for (const std::string_view stage : stage_names) names.push_back(std::string(stage) + "_ms");
    for (const Column& column : columns) names.push_back(column.name);
    return names;
}

void appendSample(const Sample& sample, std::vector<double>& values) {
    values.push_back(sample.time);
    values.insert(values.end(), sample.statistics.stage_ms.begin(), sample.statistics.stage_ms.end());
    for (const Column& column : columns) values.push_back(column.get(sample));
}

SharedMessage makeSampleMessage(const std::vector<Sample>& samples) {
    std::vector<double> values;
    for (const Sample& sample : samples) appendSample(sample, values);
    ByteWriter out;
    out.put(sample_kind);
    out.put(static_cast<std::uint32_t>(1 + stage_count + columns.size()));
    out.putAll(std::span<const double>(values));
    return std::make_shared<const Message>(Message{Message::Kind::binary, out.take()});
}

}  // namespace cairn::view
