#include "rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "cairn/version.h"
#include "ray_casters.h"

namespace cairn::bench {

namespace {

/// A pile that stands still.
struct Pile {
    RigidScene rigid;
    SceneRun run;
    std::vector<Pose> poses;
    Vec3 lower, upper;  ///< of the centres of what can move

    Pile(const Scene& scene, const RaysOptions& options, double seconds) : rigid(scene), run(scene, settings(scene)) {
        while (run.world().time() < seconds) {
            options.progress(0.5 * run.world().time() / seconds, "the pile falls");
            run.step();
        }
        constexpr double infinity = std::numeric_limits<double>::infinity();
        lower.setConstant(infinity);
        upper.setConstant(-infinity);
        for (std::size_t i = 0; i < rigid.bodies().size(); ++i) {
            poses.push_back(run.world().pose(run.ids()[i]));
            if (rigid.bodies()[i].fixed) continue;
            lower = lower.cwiseMin(poses.back().position);
            upper = upper.cwiseMax(poses.back().position);
        }
        if (lower.x() > upper.x()) throw InputError(fmt::format("scene '{}' has no body that moves", scene.name));
    }
    static Settings settings(const Scene& scene) {
        SettingOverrides overrides;
        overrides.fields = {{"threads", "1"}};
        return settingsFor(scene, overrides);
    }
};

/// From a half ball around the pile to places in it, the same on every machine.
std::vector<Ray> raysInto(const Pile& pile, std::size_t count) {
    std::mt19937_64 random(5);
    const auto uniform = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
    const Vec3 middle = 0.5 * (pile.lower + pile.upper);
    const double radius = (pile.upper - pile.lower).norm();
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        const double up = 0.2 + 0.8 * uniform();
        const double turn = 2 * std::numbers::pi * uniform();
        const double across = std::sqrt(1 - up * up);
        ray.origin = middle + radius * Vec3(across * std::cos(turn), across * std::sin(turn), up);
        const Vec3 part(uniform(), uniform(), uniform());
        const Vec3 to = pile.lower + part.cwiseProduct(pile.upper - pile.lower);
        ray.direction = (to - ray.origin).normalized();
        ray.reach = 3 * radius;
    }
    return rays;
}

class CairnRays final : public RayCaster {
  public:
    explicit CairnRays(const SceneRun& run) : run_(run) {
        for (std::size_t i = 0; i < run.ids().size(); ++i) {
            body_.resize(std::max<std::size_t>(body_.size(), run.ids()[i].index + 1));
            body_[run.ids()[i].index] = i;
        }
    }
    void cast(std::span<const Ray> rays, std::vector<std::optional<CastHit>>& hits) override {
        hits.clear();
        for (const std::optional<RayHit>& hit : run_.world().castRays(rays)) {
            hits.emplace_back();
            if (hit) hits.back() = CastHit{body_[hit->body.index], hit->distance};
        }
    }

  private:
    const SceneRun& run_;
    std::vector<std::size_t> body_;  ///< by slot
};

/// How far a point is from the surface of a body, inside or outside [m].
double fromSurface(const RigidShape& rigid, const Pose& pose, const Vec3& point) {
    constexpr double radius = 1e-3;
    const Shape shape = std::visit([](const auto& s) -> Shape { return s; }, rigid);
    return std::abs(closestPoints(Sphere{radius}, Pose{point}, shape, pose).distance + radius);
}

/// What an engine's hits are like.
struct Agreement {
    std::size_t hits = 0;
    std::size_t other_body = 0;      ///< another than Cairn's, or none where Cairn has one
    std::size_t in_the_air = 0;      ///< ends farther from the surface that it names than its tolerance
    std::size_t passed = 0;          ///< ends behind Cairn's by more than its tolerance, or nowhere
    std::size_t before = 0;          ///< ends on a surface before Cairn's by more than its tolerance: Cairn passed it
    double middle_difference = 0;    ///< median distance between its end and Cairn's on the same body [m]
    double middle_from_surface = 0;  ///< median distance of its ends from the surface of the body that it names [m]
};

Agreement compared(const Pile& pile, std::span<const Ray> rays, std::span<const std::optional<CastHit>> ours,
                   std::span<const std::optional<CastHit>> theirs, double tolerance) {
    // Numbers of a few metres in single precision.
    constexpr double rounding = 1e-5;
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    const double reach = tolerance + rounding;
    Agreement result;
    std::vector<double> difference, from_surface;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const double our_end = ours[i] ? ours[i]->distance : nowhere;
        const double their_end = theirs[i] ? theirs[i]->distance : nowhere;
        if (theirs[i]) {
            ++result.hits;
            const Vec3 end = rays[i].origin + their_end * rays[i].direction;
            const std::size_t body = theirs[i]->body;
            from_surface.push_back(fromSurface(pile.rigid.bodies()[body].shape, pile.poses[body], end));
            if (from_surface.back() > reach) ++result.in_the_air;
            if (from_surface.back() <= rounding && their_end < our_end - reach) ++result.before;
        }
        if (ours[i] && their_end > our_end + reach) ++result.passed;
        if (ours[i] && theirs[i] && ours[i]->body == theirs[i]->body) {
            difference.push_back(std::abs(our_end - their_end));
        } else if (ours[i] || theirs[i]) {
            ++result.other_body;
        }
    }
    if (!difference.empty()) result.middle_difference = median(difference);
    if (!from_surface.empty()) result.middle_from_surface = median(from_surface);
    return result;
}

/// What was found about one engine.
struct RayEntry {
    RayCasterKind kind;
    double ray_us = 0;
    Agreement agreement;
};

/// All engines in turns, so that a disturbance does not hit one of them alone.
std::vector<RayEntry> measured(const Pile& pile, const std::vector<RayCasterKind>& kinds, std::span<const Ray> rays,
                               std::size_t repetitions, const Progress& progress) {
    std::vector<std::unique_ptr<RayCaster>> casters;
    for (const RayCasterKind& kind : kinds) casters.push_back(kind.make(pile.rigid, pile.poses));
    std::vector<std::vector<double>> times(kinds.size());
    std::vector<std::vector<std::optional<CastHit>>> hits(kinds.size());
    for (std::size_t repetition = 0; repetition <= repetitions; ++repetition) {
        const double done = static_cast<double>(repetition) / static_cast<double>(repetitions + 1);
        for (std::size_t k = 0; k < kinds.size(); ++k) {
            progress(0.5 + 0.5 * done, kinds[k].name);
            const Stopwatch stopwatch;
            casters[k]->cast(rays, hits[k]);
            // The first time a tree is made and the caches are filled.
            if (repetition > 0) times[k].push_back(1e3 * stopwatch.read().processor_ms);
        }
    }
    std::vector<RayEntry> entries;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        entries.push_back({kinds[k], median(times[k]) / static_cast<double>(rays.size()),
                           compared(pile, rays, hits[0], hits[k], kinds[k].tolerance)});
    }
    return entries;
}

Json valuesOf(const RayEntry& entry) {
    const Agreement& a = entry.agreement;
    return {{"ray_us", entry.ray_us},
            {"hits", a.hits},
            {"other_body", a.other_body},
            {"in_the_air", a.in_the_air},
            {"passed", a.passed},
            {"before", a.before},
            {"median_difference_mm", 1e3 * a.middle_difference},
            {"median_from_surface_mm", 1e3 * a.middle_from_surface},
            {"tolerance_mm", 1e3 * entry.kind.tolerance}};
}

std::string tableOf(const std::vector<RayEntry>& entries) {
    constexpr const char* head = "{:<12} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>11} {:>11} {:>10}\n";
    std::string text = fmt::format(fmt::runtime(head), "", "us per", "", "other", "in the", "", "", "median from",
                                   "median from", "tolerance");
    text += fmt::format(fmt::runtime(head), "engine", "ray", "hits", "body", "air", "passed", "before", "Cairn [mm]",
                        "body [mm]", "[mm]");
    for (const RayEntry& entry : entries) {
        const Agreement& a = entry.agreement;
        text += fmt::format("{:<12} {:>8.3f} {:>8} {:>7} {:>7} {:>7} {:>7} {:>11.5f} {:>11.5f} {:>10.4f}\n",
                            entry.kind.name, entry.ray_us, a.hits, a.other_body, a.in_the_air, a.passed, a.before,
                            1e3 * a.middle_difference, 1e3 * a.middle_from_surface, 1e3 * entry.kind.tolerance);
    }
    return text;
}

}  // namespace

Outcome runRays(const RaysOptions& options) {
    const bool quick = options.extent == Extent::quick;
    const std::size_t count = quick ? std::min<std::size_t>(options.rays, 2000) : options.rays;
    const std::size_t repetitions = quick ? 1 : options.repetitions;
    std::vector<RayCasterKind> kinds = bulletRayCasters();
    const Pile pile(benchScene(options.scene), options, quick ? std::min(options.seconds, 0.1) : options.seconds);
    const auto ours = [&](const RigidScene&, std::span<const Pose>) { return std::make_unique<CairnRays>(pile.run); };
    kinds.insert(kinds.begin(), {"cairn", fmt::format("Cairn {}, double precision, 1 thread", version), 1e-9, ours});
    const std::vector<RayEntry> entries = measured(pile, kinds, raysInto(pile, count), repetitions, options.progress);

    Outcome outcome;
    outcome.table = fmt::format("{} rays into {} after {:.3g} s, processor time, medians of {}\n", count, options.scene,
                                pile.run.world().time(), repetitions);
    outcome.json = originOf("rays", options.extent);
    outcome.json["scene"] = options.scene;
    outcome.json["seconds"] = pile.run.world().time();
    outcome.json["rays"] = count;
    outcome.json["repetitions"] = repetitions;
    for (const RayEntry& entry : entries) {
        const RayCasterKind& kind = entry.kind;
        outcome.table += fmt::format("{}: {}\n", kind.name, kind.settings);
        outcome.json["engines"][kind.name] = {{"settings", kind.settings}};
        outcome.json["entries"].push_back({{"name", options.scene + '/' + kind.name},
                                           {"scene", options.scene},
                                           {"engine", kind.name},
                                           {"values", valuesOf(entry)}});
    }
    outcome.table += '\n' + tableOf(entries);
    return outcome;
}

}  // namespace cairn::bench
