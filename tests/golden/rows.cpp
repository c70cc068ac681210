#include "golden/rows.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace cairn::golden {

std::string describe(const RowKey& key) {
    return fmt::format("{}, {}, step {}", key.scene, key.preset, key.step);
}

void addRows(const GoldenScene& scene, Kind kind, Rows& rows) {
    if (scene.hashSteps(kind).empty()) return;
    GoldenRun run(scene, kind, 1);
    for (const std::int64_t step : scene.hashSteps(kind)) {
        run.stepUntil(step);
        rows[{std::string(scene.name), std::string(nameOf(kind)), step}] =
            fmt::format("{:#018x}", run.world().stateHash());
    }
}

Rows readRows(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw IoError(fmt::format("{} cannot be read", file.string()));
    Rows rows;
    const nlohmann::json kept = nlohmann::json::parse(in);
    for (const nlohmann::json& row : kept.at("rows")) {
        rows[{row.at("scene"), row.at("preset"), row.at("step")}] = row.at("hash");
    }
    return rows;
}

void writeRows(const Rows& rows, const std::filesystem::path& file) {
    std::string lines;
    for (const GoldenScene& scene : goldenScenes()) {
        for (const Kind kind : kinds) {
            for (const std::int64_t step : scene.hashSteps(kind)) {
                const RowKey key{std::string(scene.name), std::string(nameOf(kind)), step};
                lines += fmt::format(R"({}{{"scene": "{}", "preset": "{}", "step": {}, "hash": "{}"}})",
                                     lines.empty() ? "" : ",\n", key.scene, key.preset, step, rows.at(key));
            }
        }
    }
    std::ofstream out(file);
    out << fmt::format("{{\"build\": \"{}\",\n\"rows\": [\n{}\n]}}\n", kept_build, lines);
    out.close();
    if (!out) throw IoError(fmt::format("{} cannot be written", file.string()));
}

}  // namespace cairn::golden
