#include "threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <thread>

#ifdef __linux__
#include <sched.h>
#endif

namespace cairn::bench {

namespace {

/// What else the machine does.
enum class Beside { nothing, one_processor, spinning };
constexpr std::array<const char*, 3> beside_names = {"free", "one processor", "beside a spinning thread"};

/// Keeps this thread, and those that it starts, on one of its processors.
class Pinned {
  public:
    /// @param pins false = nothing happens
    explicit Pinned(bool pins) : pins_(pins) {
#ifdef __linux__
        if (!pins_) return;
        sched_getaffinity(0, sizeof before_, &before_);
        cpu_set_t one;
        CPU_ZERO(&one);
        for (std::size_t i = 0; i < CPU_SETSIZE; ++i) {
            if (!CPU_ISSET(i, &before_)) continue;
            CPU_SET(i, &one);
            break;
        }
        sched_setaffinity(0, sizeof one, &one);
#endif
    }
    ~Pinned() {
#ifdef __linux__
        if (pins_) sched_setaffinity(0, sizeof before_, &before_);
#endif
    }
    Pinned(const Pinned&) = delete;
    Pinned& operator=(const Pinned&) = delete;

  private:
    bool pins_;
#ifdef __linux__
    cpu_set_t before_{};
#endif
};

/// Takes all that it gets of a processor until it ends.
class Spinning {
  public:
    explicit Spinning(bool spins) {
        if (!spins) return;
        thread_ = std::jthread([](const std::stop_token& stop) {
            std::atomic<std::uint64_t> rounds = 0;
            while (!stop.stop_requested()) ++rounds;
        });
    }

  private:
    std::jthread thread_;
};

/// Wall time of a run [ms].
double timeOf(const Scene& scene, Settings settings, std::int64_t threads, const std::function<void()>& alive) {
    settings.parallel.threads = threads;
    SceneRun run(scene, settings);
    run.step();  // makes room
    const Stopwatch stopwatch;
    while (run.world().time() < scene.duration) {
        alive();
        run.step();
    }
    return stopwatch.read().wall_ms;
}

/// A quartile of sorted values, the nearest one. @param part 0.5 or 0.75
double quantile(const std::vector<double>& sorted, double part) {
    const auto last = static_cast<double>(sorted.size() - 1);
    return sorted[static_cast<std::size_t>(part * last + 0.5)];
}

}  // namespace

Outcome runThreads(const ThreadsOptions& options) {
    const bool quick = options.extent == Extent::quick;
    const std::vector<std::string> names =
        options.scenes.empty() ? std::vector<std::string>{"stacks5", "well392", "cage384"} : options.scenes;
    const std::size_t pairs = quick ? 3 : options.pairs;
    Outcome outcome;
    outcome.json = originOf("threads", options.extent);
    outcome.table =
        fmt::format("{:<16} {:<26} {:>12} {:>8} {:>15}\n", "scene", "machine", "1 thread", "ratio", "upper quartile");
    double done = 0;
    const double all = static_cast<double>(names.size() * beside_names.size());
    for (const std::string& name : names) {
        const Scene scene =
            shortened(benchScene(name), quick ? std::min(quick_seconds, options.seconds) : options.seconds);
        const Settings settings = settingsFor(scene, options.overrides);
        for (std::size_t k = 0; k < beside_names.size(); ++k) {
            const auto beside = static_cast<Beside>(k);
            const auto alive = [&] { options.progress(done / all, fmt::format("{}, {}", name, beside_names[k])); };
            const Spinning spinning(beside == Beside::spinning);
            std::vector<double> ones, ratios;
            for (std::size_t i = 0; i < pairs; ++i) {
                const Pinned pinned(beside == Beside::one_processor);
                // Whoever comes first changes from pair to pair.
                const double first = timeOf(scene, settings, i % 2 == 0 ? 1 : 2, alive);
                const double second = timeOf(scene, settings, i % 2 == 0 ? 2 : 1, alive);
                ones.push_back(i % 2 == 0 ? first : second);
                ratios.push_back(i % 2 == 0 ? second / first : first / second);
            }
            std::ranges::sort(ratios);
            const double ratio = quantile(ratios, 0.5);
            const double upper = quantile(ratios, 0.75);
            outcome.table += fmt::format("{:<16} {:<26} {:>9.1f} ms {:>8.3f} {:>15.3f}\n", name, beside_names[k],
                                         median(ones), ratio, upper);
            outcome.json["entries"].push_back({{"scene", name},
                                               {"machine", beside_names[k]},
                                               {"pairs", pairs},
                                               {"one_thread_ms", median(ones)},
                                               {"ratio", ratio},
                                               {"upper_quartile", upper},
                                               {"ratios", ratios}});
            done += 1;
        }
    }
    return outcome;
}

}  // namespace cairn::bench
