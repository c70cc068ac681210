#include "section.h"

#include <cmath>

namespace cairn::thesis {

namespace {

Json toJson(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json toJson(const Entry& entry) {
    const auto difference = differenceOf(entry);
    Json json = {{"id", entry.id},
                 {"what", entry.what},
                 {"unit", entry.unit},
                 {"thesis", toJson(entry.thesis)},
                 {"ours", toJson(entry.ours)},
                 {"difference_percent", difference ? Json(100 * *difference) : Json(nullptr)},
                 {"note", entry.note},
                 {"shortened", entry.shortened}};
    if (difference && std::abs(*difference) > explained_difference) json["explanation"] = explanationOf(entry);
    return json;
}

Json toJson(const Figure& figure) {
    Json json = {{"id", figure.id},       {"source", figure.source},
                 {"title", figure.title}, {"x", figure.x},
                 {"y", figure.y},         {"scale", figure.scale == Scale::logarithmic ? "log" : "linear"}};
    for (const Line& line : figure.lines) {
        json["lines"].push_back({{"label", line.label}, {"y", line.y}});  // NaN becomes null
        if (!line.x.empty()) json["lines"].back()["x"] = line.x;
    }
    json["references"] = Json::array();
    for (const Reference& reference : figure.references) {
        json["references"].push_back({{"label", reference.label}, {"y", reference.y}});
    }
    return json;
}

}  // namespace

std::vector<Section> allSections(const Plan& plan) {
    return {generalPerformance(plan), parallelEfficiency(plan), gravityDamping(plan),
            processingOrder(plan),    physicalAccuracy(plan),   furtherCapabilities(plan)};
}

std::optional<double> differenceOf(const Entry& entry) {
    if (entry.shortened || !entry.thesis || !entry.ours || *entry.thesis == 0) return {};
    return *entry.ours / *entry.thesis - 1;
}

Json toJson(const Section& section, const SectionResult& result) {
    Json json = {{"id", section.id}, {"title", section.title}, {"text", section.text}};
    for (const char* list : {"entries", "figures", "pictures", "goals", "checks"}) json[list] = Json::array();
    for (const Entry& entry : result.entries) json["entries"].push_back(toJson(entry));
    for (const Figure& figure : result.figures) json["figures"].push_back(toJson(figure));
    for (const PictureRow& row : result.pictures) {
        json["pictures"].push_back(
            {{"source", row.source}, {"caption", row.caption}, {"key", row.key}, {"camera", row.camera}});
    }
    for (const Goal& goal : result.goals) json["goals"].push_back({{"what", goal.what}, {"reached", goal.reached}});
    for (const Check& check : result.checks) json["checks"].push_back({{"what", check.what}, {"holds", check.holds}});
    return json;
}

}  // namespace cairn::thesis
