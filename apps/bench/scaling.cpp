#include "scaling.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn::bench {

namespace {

constexpr std::int64_t tile_bodies = 512;  ///< 8 × 8 × 8
constexpr std::int64_t most_bodies = 1'000'000;
constexpr double wall = 0.2;  ///< thickness [m]
constexpr std::int64_t most_settled = 20'000;

/// When a heap is measured.
struct Phase {
    const char* name;
    double begin;  ///< [s]
    int steps;     ///< time steps that are measured
};

constexpr std::array<Phase, 2> phases = {{{"falling", 0.5, 24}, {"settled", 4, 24}}};

/// What is the same in every repetition, and the times.
struct ScalingEntry {
    std::string name;
    std::string series;  ///< entries of one series differ in the number of bodies only
    std::size_t bodies = 0;
    std::int64_t threads = 1;
    double body_us = 0;       ///< of a time step, per body
    double processor_us = 0;  ///< the same in processor time
    double response_us = 0;   ///< correction and resolution, the same
    double contacts = 0;      ///< per body
    double memory = 0;        ///< per body [bytes]
    std::uint64_t state_hash = 0;
};

bool isFixedBox(const SceneBody& body) {
    return body.fixed && std::holds_alternative<Box>(body.shape);
}

/// A fixed box from one corner to the other.
SceneBody wallBetween(const SceneBody& like, const Vec3& lower, const Vec3& upper) {
    SceneBody made = like;
    made.shape = Box{upper - lower};
    made.position = 0.5 * (lower + upper);
    return made;
}

std::size_t bytesInUse() {
    const auto info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

/// A state from which runs with several numbers of threads begin.
struct Start {
    std::vector<std::byte> snapshot;
    double memory = 0;  ///< per body [bytes]
};

/// Keeps one world and takes it from phase to phase.
class Heap {
  public:
    Heap(const Scene& scene, const Settings& settings) : before_(bytesInUse()), world_(makeWorld(scene, settings)) {}

    Start at(double time, const std::function<void()>& progress) {
        while (world_.time() < time) {
            progress();
            world_.step();
        }
        const auto bytes = static_cast<double>(bytesInUse() - before_);
        return {world_.save(), bytes / static_cast<double>(world_.bodyCount())};
    }

  private:
    /// Without the scene, which is no part of what a world needs.
    static World makeWorld(const Scene& scene, const Settings& settings) {
        SceneRun run(scene, settings);
        return std::move(run.world());
    }

    std::size_t before_;
    World world_;
};

/// Some time steps from a start on.
struct ScalingRun {
    Times times;
    Statistics total;
};

ScalingRun measure(const Start& start, std::int64_t threads, int steps, ScalingEntry& entry) {
    World world = World::restore(start.snapshot);
    Settings settings = world.settings();
    settings.parallel.threads = threads;
    world.setSettings(settings);
    world.step();  // makes room
    ScalingRun run;
    const Stopwatch stopwatch;
    for (int i = 0; i < steps; ++i) {
        world.step();
        run.total.add(world.statistics());
    }
    run.times = stopwatch.read();
    entry.state_hash = world.stateHash();
    return run;
}

double sumOf(const Statistics& statistics, std::initializer_list<Stage> stages) {
    double sum = 0;
    for (const Stage stage : stages) sum += statistics.stage_ms[static_cast<std::size_t>(stage)];
    return sum;
}

/// Repetitions of one entry.
void measureEntry(const Start& start, int steps, std::size_t repetitions, ScalingEntry& entry) {
    std::vector<double> all, processor, response;
    const double share = 1e3 / (static_cast<double>(steps) * static_cast<double>(entry.bodies));
    for (std::size_t i = 0; i < repetitions; ++i) {
        const ScalingRun run = measure(start, entry.threads, steps, entry);
        all.push_back(share * run.times.wall_ms);
        processor.push_back(share * run.times.processor_ms);
        response.push_back(share * sumOf(run.total, {Stage::correction, Stage::resolution}));
        entry.contacts = 1e-3 * share * static_cast<double>(run.total.contacts);
    }
    entry.body_us = median(all);
    entry.processor_us = median(processor);
    entry.response_us = median(response);
    entry.memory = start.memory;
}

Settings settingsOf(const Scene& scene, const Variant& variant, const ScalingOptions& options) {
    SettingOverrides all = combined(options.overrides, variant);
    const std::int64_t most = *std::max_element(options.threads.begin(), options.threads.end());
    all.fields.emplace_back("threads", fmt::format("{}", most));
    all.fields.emplace_back("sleeping", "false");
    return settingsFor(scene, all);
}

/// Every phase of one heap.
std::vector<ScalingEntry> measureHeap(const std::string& layout, std::int64_t bodies, const Variant& variant,
                                      const ScalingOptions& options,
                                      const std::function<void(const std::string&)>& progress) {
    const Scene scene = scalingScene(layout, bodies);
    Heap heap(scene, settingsOf(scene, variant, options));
    std::vector<ScalingEntry> entries;
    for (const Phase& phase : phases) {
        const bool settled = &phase != &phases.front();
        if (settled && (bodies > most_settled || options.extent == Extent::quick)) break;
        const std::string series =
            fmt::format("{}{}{}/{}", variant.name, variant.name.empty() ? "" : "/", layout, phase.name);
        const Start start = heap.at(phase.begin, [&] { progress(fmt::format("{}/{}", series, bodies)); });
        for (const std::int64_t threads : options.threads) {
            progress(fmt::format("{}/{}", series, bodies));
            ScalingEntry entry;
            entry.series = fmt::format("{}/threads{}", series, threads);
            entry.name = fmt::format("{}/{}/threads{}", series, bodies, threads);
            entry.bodies = scene.bodies.size();
            entry.threads = threads;
            measureEntry(start, phase.steps, options.extent == Extent::quick ? 1 : options.repetitions, entry);
            entries.push_back(std::move(entry));
        }
    }
    return entries;
}

/// The first entry of the same series: what the growth is measured from.
const ScalingEntry& firstOf(const std::vector<ScalingEntry>& entries, const ScalingEntry& entry) {
    return *std::find_if(entries.begin(), entries.end(),
                         [&](const ScalingEntry& other) { return other.series == entry.series; });
}

Json jsonOf(const ScalingEntry& entry, const std::vector<ScalingEntry>& entries) {
    return {{"name", entry.name},
            {"bodies", entry.bodies},
            {"threads", entry.threads},
            {"values",
             {{"body_step_us", entry.body_us},
              {"response_us", entry.response_us},
              {"processor_us", entry.processor_us},
              {"growth", entry.processor_us / firstOf(entries, entry).processor_us},
              {"contacts_per_body", entry.contacts},
              {"bytes_per_body", entry.memory}}},
            {"state_hash", fmt::format("{:016x}", entry.state_hash)}};
}

std::string tableOf(const std::vector<ScalingEntry>& entries) {
    constexpr const char* head = "{:<46} {:>7} {:>9} {:>9} {:>9} {:>7} {:>9} {:>7}\n";
    std::string text =
        "µs per body and time step\n"
        "sleeping off\n\n";
    text += fmt::format(fmt::runtime(head), "", "", "wall", "processor", "response,", "", "contacts", "bytes");
    text += fmt::format(fmt::runtime(head), "heap", "bodies", "us", "us", "wall us", "growth", "a body", "a body");
    for (const ScalingEntry& entry : entries) {
        text += fmt::format("{:<46} {:>7} {:>9.3f} {:>9.3f} {:>9.3f} {:>7.2f} {:>9.2f} {:>7.0f}\n", entry.name,
                            entry.bodies, entry.body_us, entry.processor_us, entry.response_us,
                            entry.processor_us / firstOf(entries, entry).processor_us, entry.contacts, entry.memory);
    }
    return text;
}

}  // namespace

const std::vector<std::int64_t>& scalingSizes() {
    static const std::vector<std::int64_t> sizes = {1000, 3000, 10000, 30000, 100000};
    return sizes;
}

Scene scalingScene(const std::string& layout, std::int64_t bodies) {
    if (bodies < 1 || bodies > most_bodies) {
        throw InputError(fmt::format("a size of {} bodies is not allowed; give 1 to {}", bodies, most_bodies));
    }
    const Scene tile = builtInScene(fmt::format("heap:{}", tile_bodies));
    const SceneBody& a_wall = *std::find_if(tile.bodies.begin(), tile.bodies.end(), isFixedBox);
    const double height = std::get<Box>(a_wall.shape).size.z();
    const bool apart = layout == "many";
    Vec3 inner = Vec3::Zero();  // half edges of the pit of a tile
    for (const SceneBody& body : tile.bodies) {
        if (isFixedBox(body)) inner = inner.cwiseMax(body.position.cwiseAbs() - Vec3::Constant(wall / 2));
    }
    const Vec3 pitch = 2 * (inner + Vec3::Constant(apart ? wall : 0));

    const std::int64_t tiles = std::max<std::int64_t>(1, (bodies + tile_bodies / 2) / tile_bodies);
    const auto columns = static_cast<std::int64_t>(std::sqrt(static_cast<double>(tiles)));
    const std::int64_t rows = (tiles + columns - 1) / columns;
    Scene scene = tile;
    scene.name = fmt::format("{}/{}", layout, bodies);
    std::erase_if(scene.bodies, [](const SceneBody& body) { return !body.fixed || isFixedBox(body); });
    for (std::int64_t i = 0; i < columns * rows; ++i) {
        const Vec3 offset(pitch.x() * static_cast<double>(i % columns), pitch.y() * static_cast<double>(i / columns),
                          0);
        for (SceneBody body : tile.bodies) {
            if (body.fixed && !(apart && isFixedBox(body))) continue;
            body.position += offset;
            scene.bodies.push_back(std::move(body));
        }
    }
    if (apart) return scene;
    const Vec3 lower(-inner.x(), -inner.y(), 0);
    const Vec3 upper(pitch.x() * static_cast<double>(columns) - inner.x(),
                     pitch.y() * static_cast<double>(rows) - inner.y(), height);
    const double x0 = lower.x() - wall;
    const double y0 = lower.y() - wall;
    const double x1 = upper.x() + wall;
    const double y1 = upper.y() + wall;
    scene.bodies.push_back(wallBetween(a_wall, {x0, y0, 0}, {lower.x(), y1, height}));
    scene.bodies.push_back(wallBetween(a_wall, {upper.x(), y0, 0}, {x1, y1, height}));
    scene.bodies.push_back(wallBetween(a_wall, {lower.x(), y0, 0}, {upper.x(), lower.y(), height}));
    scene.bodies.push_back(wallBetween(a_wall, {lower.x(), upper.y(), 0}, {upper.x(), y1, height}));
    return scene;
}

Outcome runScaling(const ScalingOptions& options) {
    std::vector<std::int64_t> sizes = options.sizes.empty() ? scalingSizes() : options.sizes;
    if (options.extent == Extent::quick) sizes.resize(1);
    std::vector<Variant> variants{{}};
    variants.insert(variants.end(), options.variants.begin(), options.variants.end());
    const std::array<std::string, 2> layouts = {"one", "many"};
    for (const std::int64_t size : sizes) {  // refused before hours of work
        for (const Variant& variant : variants)
            settingsOf(scalingScene("one", std::min(size, tile_bodies)), variant, options);
        if (size > most_bodies) scalingScene("one", size);
    }
    // The work grows with the number of bodies.
    double all_work = 0;
    for (const std::int64_t size : sizes) all_work += static_cast<double>(size);
    all_work *= static_cast<double>(variants.size() * layouts.size());
    double done = 0;
    std::vector<ScalingEntry> entries;
    for (const Variant& variant : variants) {
        for (const std::string& layout : layouts) {
            for (const std::int64_t size : sizes) {
                const auto progress = [&](const std::string& what) { options.progress(done / all_work, what); };
                for (ScalingEntry& entry : measureHeap(layout, size, variant, options, progress)) {
                    entries.push_back(std::move(entry));
                }
                done += static_cast<double>(size);
            }
        }
    }
    Outcome outcome;
    outcome.table = tableOf(entries);
    outcome.json = originOf("scaling", options.extent);
    outcome.json["entries"] = Json::array();
    for (const ScalingEntry& entry : entries) outcome.json["entries"].push_back(jsonOf(entry, entries));
    return outcome;
}

}  // namespace cairn::bench
