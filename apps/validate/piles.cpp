#include "validate/piles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>

#include "validate/random.h"
#include "validate/world_tools.h"

namespace cairn::validation {

namespace {

/// A body before it has its place.
struct Grain {
    Shape shape;
    double radius = 0;    ///< of the ball about its origin that holds it [m]
    double smallest = 0;  ///< its smallest extent [m]
};

constexpr std::array<PileShape, 7> single_shapes = {PileShape::box,     PileShape::ball,     PileShape::plate,
                                                    PileShape::rod,     PileShape::cylinder, PileShape::hull,
                                                    PileShape::compound};

Grain boxGrain(const Vec3& size) {
    return {Box{size}, 0.5 * size.norm(), size.minCoeff()};
}

Grain hullGrain(double d, Random& random) {
    std::vector<Vec3> points;
    for (int i = 0; i < 14; ++i) {
        const double z = random.uniform(-1, 1);
        const double angle = random.uniform(0, 2 * std::numbers::pi);
        const double across = std::sqrt(1 - z * z);
        points.push_back(0.5 * d * Vec3(across * std::cos(angle), across * std::sin(angle), z));
    }
    // The least width of what fourteen points on a ball span is about seven tenths of its diameter.
    return {ConvexHull(points), 0.5 * d, 0.7 * d};
}

/// A cross of two rods, or of three.
Grain compoundGrain(double d) {
    const Vec3 beam(d, 0.35 * d, 0.35 * d);
    Compound cross;
    cross.parts.push_back({Box{beam}, {}, {}, {}});
    cross.parts.push_back({Box{Vec3(0.35 * d, d, 0.35 * d)}, {}, {}, {}});
    return {cross, 0.5 * std::hypot(d, 0.35 * d, 0.35 * d), 0.35 * d};
}

Grain makeGrain(PileShape shape, double d, std::size_t number, Random& random) {
    const auto vary = [&] { return d * random.uniform(0.75, 1.25); };
    switch (shape) {
        case PileShape::box:
            return boxGrain({vary(), vary(), vary()});
        case PileShape::ball:
            return {Sphere{0.5 * d}, 0.5 * d, d};
        case PileShape::plate:
            return boxGrain({1.2 * d, 1.2 * d, 0.1 * d});
        case PileShape::rod:
            return {Capsule{0.2 * d, 1.6 * d}, d, 0.4 * d};
        case PileShape::cylinder:
            return {Cylinder{0.5 * d, d}, 0.5 * std::numbers::sqrt2 * d, d};
        case PileShape::hull:
            return hullGrain(1.2 * d, random);
        case PileShape::compound:
            return compoundGrain(1.2 * d);
        case PileShape::mixed:
            return makeGrain(single_shapes.at(number % single_shapes.size()), d, number, random);
    }
    return {};
}

Quat anyOrientation(Random& random) {
    const Eigen::Vector4d q(random.normal(), random.normal(), random.normal(), random.normal());
    return Quat(q[0], q[1], q[2], q[3]).normalized();
}

/// The pit, and how the bodies stand in it at the beginning.
struct Poured {
    World world;
    std::vector<BodyId> ids;
    std::vector<double> smallest;  ///< by index of the id [m]
    double width = 0;              ///< of the pit [m]
    double top = 0;                ///< of the highest body [m]
};

/// Width of the pit for grains that lie `depth` bodies deep.
double pitWidth(const Pile& pile, std::span<const Grain> grains) {
    double widest = 0;
    for (const Grain& grain : grains) widest = std::max(widest, 2 * grain.radius);
    if (pile.depth == 1) return 1.05 * widest;
    double volume = 0;
    for (const Grain& grain : grains) volume += std::pow(2 * grain.radius, 2) * grain.smallest;
    const double layer = volume / (pile.depth * pile.extent);
    return std::max(1.2 * widest, std::sqrt(layer));
}

/// Layers of grains of about one size, larger ones first; then in any order above each other.
void fill(const Pile& pile, std::vector<Grain>& grains, Random& random, Poured& poured) {
    std::stable_sort(grains.begin(), grains.end(), [](const Grain& x, const Grain& y) { return x.radius > y.radius; });
    struct Layer {
        std::size_t begin, end;
        int across;
        double spacing;
        double order;
    };
    std::vector<Layer> layers;
    for (std::size_t begin = 0; begin < grains.size();) {
        const double spacing = 2.02 * grains[begin].radius;
        const int across = std::max(1, static_cast<int>(poured.width / spacing));
        const std::size_t end = std::min(grains.size(), begin + static_cast<std::size_t>(across * across));
        layers.push_back({begin, end, across, spacing, random.uniform()});
        begin = end;
    }
    std::stable_sort(layers.begin(), layers.end(), [](const Layer& x, const Layer& y) { return x.order < y.order; });
    double height = 0;
    const double speed = pile.impact * std::sqrt(g * pile.extent);
    for (const Layer& layer : layers) {
        height += 0.5 * layer.spacing;
        const double cell = poured.width / layer.across;
        for (std::size_t i = layer.begin; i < layer.end; ++i) {
            const auto k = static_cast<int>(i - layer.begin);
            const double play = std::max(0.0, 0.5 * cell - 1.01 * grains[i].radius);
            BodyDescription d;
            d.shape = grains[i].shape;
            d.pose.position =
                Vec3(-0.5 * poured.width + (0.5 + k % layer.across) * cell + play * random.uniform(-1, 1),
                     -0.5 * poured.width + (0.5 + k / layer.across) * cell + play * random.uniform(-1, 1), height);
            d.pose.orientation = anyOrientation(random);
            d.linear_velocity = Vec3(0, 0, -speed);
            poured.ids.push_back(poured.world.addBody(d));
            const std::size_t index = poured.ids.back().index;
            if (poured.smallest.size() <= index) poured.smallest.resize(index + 1, 0);
            poured.smallest[index] = grains[i].smallest;
        }
        height += 0.5 * layer.spacing;
    }
    poured.top = height;
}

Poured pour(const Pile& pile, const Settings& settings) {
    Random random(pile.seed);
    std::vector<Grain> grains;
    for (std::size_t i = 0; i < pile.count; ++i) {
        const double size = pile.graded ? pile.extent * std::pow(20, random.uniform(-0.5, 0.5)) : pile.extent;
        grains.push_back(makeGrain(pile.shape, size, i, random));
    }
    PairProperties pair = contactLaw(pile.restitution, pile.friction);
    // Without the one it would roll for ever, without the other spin about where it touches.
    if (pile.isRound() && pile.friction > 0) pair.rolling_friction = pair.spinning_friction = 0.01 * pile.extent;
    Poured poured{makeWorld(settings, Vec3(0, 0, -g), pair), {}, {}, pitWidth(pile, grains), 0};
    addPlane(poured.world);
    for (const Vec3& inwards : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
        BodyDescription wall;
        wall.shape = HalfSpace{inwards, 0};
        wall.pose.position = -0.5 * poured.width * inwards;
        wall.fixed = true;
        poured.world.addBody(wall);
    }
    fill(pile, grains, random, poured);
    return poured;
}

double deepest(const Poured& poured) {
    double deepest = 0;
    for (const ContactInfo& contact : poured.world.contacts()) {
        if (!(contact.distance < 0)) continue;
        const auto extent = [&](BodyId id) {
            const double s = id.index < poured.smallest.size() ? poured.smallest[id.index] : 0;
            return s > 0 ? s : 1e300;
        };
        deepest = std::max(deepest, -contact.distance / std::min(extent(contact.a), extent(contact.b)));
    }
    return deepest;
}

std::size_t countLost(const Poured& poured) {
    const double half = 0.5 * poured.width;
    return static_cast<std::size_t>(std::ranges::count_if(poured.ids, [&](BodyId id) {
        const Vec3 p = poured.world.centreOfMass(id);
        return !p.allFinite() || p.z() < 0 || std::abs(p.x()) > half || std::abs(p.y()) > half;
    }));
}

/// E₀: kinetic energy, and that of each body above the floor, at least half a body.
double firstEnergy(const Poured& poured) {
    double energy = poured.world.kineticEnergy();
    for (const BodyId id : poured.ids) {
        const double height = std::max(poured.world.centreOfMass(id).z(), 0.5 * poured.smallest[id.index]);
        energy += poured.world.mass(id) * g * height;
    }
    return energy;
}

}  // namespace

std::string nameOf(PileShape shape) {
    constexpr std::array<const char*, 8> names = {"box",      "ball", "plate",    "rod",
                                                  "cylinder", "hull", "compound", "mixed"};
    return names.at(static_cast<std::size_t>(shape));
}

std::string nameOf(const Pile& pile) {
    return fmt::format("{}{}_n{}_deep{}_v{:g}_s{:g}_d{:g}_mu{:g}_e{:g}", nameOf(pile.shape), pile.graded ? "20" : "",
                       pile.count, pile.depth, pile.impact, pile.step, pile.extent, pile.friction, pile.restitution);
}

double defaultStepsPerSecond(double extent, double gravity) {
    const double k = -std::round(0.5 * std::log2(extent * 10 / (0.12 * gravity)));
    return 240 * std::exp2(k);
}

PileResult runPile(const Pile& pile, const std::function<void(Settings&)>& change,
                   const std::function<void(const World&)>& alive) {
    Settings settings = Settings::preset(Preset::performance, pile.step * defaultStepsPerSecond(pile.extent, g), g);
    change(settings);
    Poured poured = pour(pile, settings);
    World& world = poured.world;
    PileResult result;
    const double first = firstEnergy(poured);
    const double speed = pile.impact * std::sqrt(g * pile.extent);
    const double down = (std::sqrt(speed * speed + 2 * g * poured.top) - speed) / g;
    result.allowed_time = 20 * std::sqrt(pile.extent / g) + 3 * std::sqrt(2 * poured.top / g);
    result.rest_time = -1;
    double lowest = first;
    double resolution_ms = 0;
    const auto count = static_cast<double>(poured.ids.size());
    while (world.time() < down + result.allowed_time) {
        const auto begin = std::chrono::steady_clock::now();
        world.step();
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
        const Statistics& s = world.statistics();
        ++result.steps;
        result.ms += spent.count();
        result.peak_ms = std::max(result.peak_ms, spent.count());
        result.visits += static_cast<double>(s.global_iterations);
        resolution_ms += s.stage_ms[static_cast<std::size_t>(Stage::resolution)];
        const double energy = world.kineticEnergy() + world.potentialEnergy();
        lowest = std::min(lowest, energy);
        result.gain = std::max(result.gain, (energy - lowest) / first);
        result.fall_overlap = std::max(result.fall_overlap, deepest(poured));
        for (const BodyId id : poured.ids) {
            const double way = world.linearVelocity(id).norm() * world.settings().timeStep();
            result.way = std::max(result.way, way / poured.smallest[id.index]);
        }
        alive(world);
        if (static_cast<double>(s.asleep) >= 0.98 * count) {
            result.rest_time = std::max(0.0, world.time() - down);
            break;
        }
    }
    result.ns_per_visit = result.visits > 0 ? 1e6 * resolution_ms / result.visits : 0;
    result.ms /= static_cast<double>(result.steps);
    result.visits /= static_cast<double>(result.steps);
    result.asleep = static_cast<double>(world.statistics().asleep) / count;
    result.motion = world.kineticEnergy() / first;
    result.rest_overlap = deepest(poured);
    result.lost = countLost(poured);
    return result;
}

}  // namespace cairn::validation
