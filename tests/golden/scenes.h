/// @file The scenes whose results are kept: short, deterministic, and between them everything that the engine does,
/// with a scene on each side of every border where it changes its way of working.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "cairn/scene.h"

namespace cairn::golden {

/// The settings that scenes run with: the presets.
enum class Kind { performance, accuracy, thesis, thesis_accuracy };

inline constexpr std::array kinds = {Kind::performance, Kind::accuracy, Kind::thesis, Kind::thesis_accuracy};
/// Those that every scene runs with.
inline constexpr std::array kinds_of_all = {Kind::performance, Kind::accuracy, Kind::thesis};

/// As in the column "preset" of the kept rows.
std::string_view nameOf(Kind kind);

/// What happens to a run besides the events that a scene can hold, such as a body that is added.
struct Action {
    double time;  ///< at the first step that begins then or later [s]
    /// @param scales what the scene's values were multiplied by
    void (*act)(SceneRun& run, const Scales& scales);
};

/// The steps after which the state is hashed, ascending.
using HashSteps = std::array<std::int64_t, 3>;

/// One scene.
struct GoldenScene {
    std::string_view name;
    Scene (*make)();
    HashSteps steps;                    ///< at 240 steps per second: performance and thesis
    HashSteps accuracy_steps;           ///< at 960 steps per second, thesis_accuracy apart
    std::span<const Action> actions{};  ///< by time
    std::int64_t contacts = 0;  ///< of the largest batch at every one of the steps above; 0 = whatever there are

    /// None where a scene is not run with these settings.
    std::span<const std::int64_t> hashSteps(Kind kind) const;
};

/// All of them; names are unique.
std::span<const GoldenScene> goldenScenes();
/// @throws std::out_of_range for an unknown name
const GoldenScene& goldenScene(std::string_view name);

/// A scene that runs.
class GoldenRun {
  public:
    GoldenRun(const GoldenScene& golden, Kind kind, std::int64_t threads, const Scales& scales = {});

    /// Acts, then steps the world once.
    void step();
    void stepUntil(std::int64_t count);
    /// As World::share().
    void share(Ranks& ranks, const Partition& partition) { run_.world().share(ranks, partition); }
    /// As World::gather().
    void gather() { run_.world().gather(); }
    const World& world() const { return run_.world(); }
    double duration() const { return run_.scene().duration; }  ///< of the whole scene [s]

  private:
    std::span<const Action> left_;
    Scales scales_;
    SceneRun run_;
};

}  // namespace cairn::golden
