#include <fmt/format.h>

#include <algorithm>

#include "cairn/version.h"
#include "engine.h"

namespace cairn::bench {

namespace {

class CairnEngine final : public Engine {
  public:
    CairnEngine(const Scene& scene, const Settings& settings) : run_(scene, settings) {}

    void step() override { run_.step(); }
    void poses(std::vector<Pose>& poses) const override {
        poses.resize(run_.ids().size());
        for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = run_.world().pose(run_.ids()[i]);
    }
    std::size_t asleep() const override { return static_cast<std::size_t>(run_.world().statistics().asleep); }

  private:
    SceneRun run_;
};

std::string describe(const SettingOverrides& overrides, std::int64_t threads) {
    std::string text = fmt::format("preset {}", nameOf(overrides.preset.value_or(Preset::performance)));
    for (const auto& [field, value] : overrides.fields) text += fmt::format(", {}={}", field, value);
    return text + fmt::format(", {} {}", threads, threads == 1 ? "thread" : "threads");
}

}  // namespace

EngineKind cairnEngine(std::string name, SettingOverrides overrides, std::int64_t threads) {
    EngineKind kind;
    kind.name = std::move(name);
    kind.version = fmt::format("Cairn {}, double precision", version);
    kind.settings = describe(overrides, threads);
    kind.make = [overrides = std::move(overrides), threads](const Scene& scene, const RigidScene&,
                                                            const EngineOptions& options) {
        SettingOverrides all = overrides;
        all.steps_per_second = options.steps_per_second;
        all.fields.emplace_back("threads", fmt::format("{}", threads));
        if (!options.sleeping) all.fields.emplace_back("sleeping", "false");
        return std::make_unique<CairnEngine>(scene, settingsFor(scene, all));
    };
    return kind;
}

}  // namespace cairn::bench
