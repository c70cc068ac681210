/// @file Many grains in a container.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "validate/case.h"
#include "validate/random.h"
#include "validate/world_tools.h"

namespace cairn::validation {

/// Grains have this diameter, or edge [m], and this mass [kg].
inline constexpr double grain = 0.1;
inline constexpr double grain_mass = 1;

/// The performance preset with overlaps of at most 1 % of a grain.
/// They must not be much smaller than what grains fall in a few time steps: each correction then lifts more than falls
/// back until the next one, and grains without friction never come to rest.
inline Settings granularSettings(double rate = 480) {
    Settings settings = Settings::preset(Preset::performance, rate, g);
    settings.correction.penetration_threshold = 1e-3;
    settings.sleep.sleeping = false;
    settings.sleep.damping = 0;
    return settings;
}

/// Random numbers of the fillings over which a case takes the mean: each is another packing.
inline std::vector<std::uint64_t> seedsOfFillings(const Plan& plan, std::uint64_t count = 5) {
    std::vector<std::uint64_t> seeds(plan.isQuick() ? 1 : count);
    std::iota(seeds.begin(), seeds.end(), 7);
    return seeds;
}

/// A quantity of several fillings.
class Fillings {
  public:
    void add(double value) { values_.push_back(value); }
    double mean() const {
        return std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
    }
    /// Standard deviation of single fillings. @pre at least two
    double spread() const {
        double squares = 0;
        for (const double value : values_) squares += (value - mean()) * (value - mean());
        return std::sqrt(squares / static_cast<double>(values_.size() - 1));
    }
    /// "mean of 5 fillings, standard deviation 0.004"
    std::string text() const {
        if (values_.size() < 2) return "one filling";
        return fmt::format("mean of {} fillings, standard deviation {:.2g}", values_.size(), spread());
    }

  private:
    std::vector<double> values_;
};

/// How grains are turned when they are poured.
enum class Turned { a_little, any_way };

/// A world with grains of one material and walls of another.
struct Grains {
    Random random;
    World world;
    MaterialId wall;
    std::vector<BodyId> ids;

    Grains(const Settings& settings, const PairProperties& between, const PairProperties& at_walls,
           std::uint64_t seed = 7)
        : random(seed),
          world(makeWorld(settings, Vec3(0, 0, -g), between)),
          wall(world.addMaterial({.name = "wall", .density = 1000})) {
        world.setPairProperties(MaterialId{0}, wall, at_walls);
    }

    BodyId addWall(const Vec3& normal, double offset) {
        BodyDescription plane;
        plane.shape = HalfSpace{.normal = normal, .offset = offset};
        return addFixed(plane);
    }
    /// A fixed box between two corners.
    BodyId addBlock(const Vec3& lower, const Vec3& upper) {
        BodyDescription block;
        block.shape = Box{upper - lower};
        block.pose.position = (lower + upper) / 2;
        return addFixed(block);
    }
    /// Four upright walls about the z axis. @param width between them [m]
    void addShaft(double width) {
        for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
            addWall(normal, -width / 2);
        }
    }
    /// Grains in loose layers, a little displaced and turned. @param width of the square that they fill [m]
    void rain(const Shape& shape, int count, double width, double bottom, double spacing = 1.25 * grain,
              Turned turned = Turned::a_little) {
        const double extent = turned == Turned::any_way ? std::numbers::sqrt3 * grain : grain;
        const int across = std::max(1, static_cast<int>(width / spacing));
        const double pitch = width / across;
        for (int i = 0; i < count; ++i) {
            const Vec3 cell(i % across, i / across % across, i / (across * across));
            Vec3 position((cell.x() + 0.5) * pitch - width / 2, (cell.y() + 0.5) * pitch - width / 2,
                          bottom + (cell.z() + 0.5) * spacing);
            const double play = 0.4 * (std::min(pitch, spacing) - extent);
            for (int axis = 0; axis < 3; ++axis) position[axis] += random.uniform(-play, play);
            BodyDescription description = body(shape, grain_mass, position);
            if (!std::holds_alternative<Sphere>(shape)) description.pose.orientation = orientation(turned);
            description.linear_velocity = Vec3(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0);
            ids.push_back(world.addBody(description));
        }
    }
    /// Height of the highest grain [m]; 0 without any.
    double top() const {
        double highest = 0;
        for (const BodyId id : ids) highest = std::max(highest, world.pose(id).position.z());
        return highest;
    }
    /// Steps until the grains hardly move; what round ones without friction spin is no matter. @param longest [s] of
    /// simulated time
    void settle(double longest, const Plan& plan) {
        const double end = world.time() + longest;
        while (world.time() < end) {
            plan.alive();
            world.step();
            double squares = 0;
            for (const BodyId id : ids) squares += world.linearVelocity(id).squaredNorm();
            const bool slow = squares < static_cast<double>(ids.size()) * 1e-3 * 1e-3;
            if (slow && world.time() > end - 0.8 * longest) return;
        }
    }
    /// Height below which nine tenths of the grains are; some still fly about above [m].
    double level() const {
        std::vector<double> heights;
        for (const BodyId id : ids) heights.push_back(world.pose(id).position.z());
        std::sort(heights.begin(), heights.end());
        return heights[heights.size() * 9 / 10];
    }
    /// Impulse per time that a body gave upwards in the last step [N].
    double liftedBy(BodyId id) const {
        double impulse = 0;
        for (const ContactInfo& c : world.contacts()) {
            if (c.a == id) impulse -= c.impulse.z();
            if (c.b == id) impulse += c.impulse.z();
        }
        return impulse * world.settings().steps_per_second;
    }

  private:
    Quat orientation(Turned turned) {
        const Vec3 axis(random.normal(), random.normal(), random.normal());
        if (turned == Turned::a_little) return Quat(Eigen::AngleAxisd(random.uniform(0, 0.3), axis.normalized()));
        return Quat(random.normal(), axis.x(), axis.y(), axis.z()).normalized();
    }
    BodyId addFixed(BodyDescription& description) {
        description.fixed = true;
        description.material = wall;
        return world.addBody(description);
    }
};

inline PairProperties grainLaw(double friction, double rolling = 0) {
    PairProperties law = contactLaw(0.2, friction);
    law.rolling_friction = rolling;
    return law;
}

}  // namespace cairn::validation
