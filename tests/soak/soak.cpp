/// @file A mixed pile in a pit: bodies are poured in and the oldest removed, for as long as asked. Prints one line per
/// simulated minute and fails on a leak, a slow-down, energy that creeps up, deep overlaps or a fault.
/// Usage: cairn_soak SIMULATED_SECONDS WALL_SECONDS [BODIES]
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <deque>
#include <fstream>
#include <string>
#include <vector>

#include "cairn/world.h"

namespace {

using namespace cairn;
using Clock = std::chrono::steady_clock;

constexpr std::size_t usual_pile = 100;  ///< bodies in the pit
constexpr int steps_per_body = 24;       ///< time steps between two poured bodies
constexpr double half_pit = 0.6;         ///< half the inner width of the pit [m]
constexpr double largest_body = 0.15;    ///< [m]
/// As thick as the thinnest body: deeper, and one may come out of another on the wrong side. Bodies fall in with 7 m/s,
/// which is 29 mm in a step.
constexpr double deepest_overlap = 0.048;  ///< [m]

/// What a simulated minute was like.
struct Minute {
    double step_ms = 0;         ///< mean of a time step, of the processor
    std::int64_t contacts = 0;  ///< mean
    double energy = 0;          ///< largest kinetic energy [J]
    double overlap = 0;         ///< largest [m]
    double mean_overlap = 0;    ///< mean [m]
    std::size_t heap = 0;       ///< bytes in use at the end
    std::size_t resident = 0;   ///< bytes of memory that the process occupies at the end
};

/// splitmix64 by Vigna.
std::uint64_t next(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

/// What the process occupies of the computer's memory, as Linux tells it [bytes].
std::size_t residentBytes() {
    std::ifstream in("/proc/self/statm");
    std::size_t total = 0;
    std::size_t resident = 0;
    in >> total >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

class Pit {
  public:
    explicit Pit(std::size_t pile) : pile_(pile), world_(Settings::preset(Preset::performance)) {
        oak_ = world_.addMaterial({"oak", 800});
        world_.setDefaultPairProperties({.restitution = 0.2, .static_friction = 0.4, .kinetic_friction = 0.3});
        world_.setGravity(Vec3(0, 0, -10));
        plane(Vec3::UnitZ(), 0);
        for (const Vec3& inward : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
            plane(inward, -half_pit);
        }
    }

    Minute minute() {
        Minute m;
        // The time of the processor: other programs on the computer are no slow-down of this one.
        const std::clock_t begin = std::clock();
        constexpr int steps = 60 * 240;
        for (int i = 0; i < steps; ++i) {
            if (i % steps_per_body == 0) pour();
            world_.step();
            const Statistics& s = world_.statistics();
            m.contacts += s.contacts;
            m.overlap = std::max(m.overlap, s.largest_overlap);
            m.mean_overlap += s.mean_overlap / steps;
            m.energy = std::max(m.energy, world_.kineticEnergy());
        }
        m.contacts /= steps;
        m.step_ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / steps;
        m.heap = mallinfo2().uordblks;
        m.resident = residentBytes();
        return m;
    }

    /// Bodies that left the pit.
    std::size_t lost() const {
        return static_cast<std::size_t>(std::ranges::count_if(poured_, [&](BodyId id) {
            const Vec3 p = world_.pose(id).position;
            return p.z() < 0 || std::abs(p.x()) > half_pit || std::abs(p.y()) > half_pit;
        }));
    }
    const World& world() const { return world_; }

  private:
    void plane(const Vec3& normal, double offset) {
        world_.addBody({.shape = HalfSpace{normal, offset}, .material = oak_, .fixed = true});
    }

    double uniform() { return static_cast<double>(next(random_) >> 11U) * 0x1p-53; }

    void pour() {
        const double size = 0.08 + (largest_body - 0.08) * uniform();
        const std::uint64_t kind = next(random_) % 3;
        Shape shape = Sphere{size / 2};
        if (kind == 1) shape = Box{Vec3(size, 0.7 * size, 0.8 * size)};
        if (kind == 2) shape = Capsule{0.3 * size, 0.5 * size};
        const double room = half_pit - largest_body;
        const Vec3 place((2 * uniform() - 1) * room, (2 * uniform() - 1) * room, 3);
        const Quat turn(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5, uniform() + 0.1);
        poured_.push_back(world_.addBody({.shape = shape, .material = oak_, .pose = {place, turn}}));
        if (poured_.size() <= pile_) return;
        world_.removeBody(poured_.front());
        poured_.pop_front();
    }

    std::size_t pile_;
    World world_;
    MaterialId oak_{};
    std::deque<BodyId> poured_;
    std::uint64_t random_ = 1;
};

/// The middle value of a part of the minutes, which one busy minute of the computer does not move.
template <class Of>
double median(std::vector<Minute>::const_iterator begin, std::vector<Minute>::const_iterator end, const Of& of) {
    std::vector<double> values;
    std::transform(begin, end, std::back_inserter(values), of);
    std::ranges::sort(values);
    return values[values.size() / 2];
}

int judge(const std::vector<Minute>& minutes, const Pit& pit) {
    int bad = 0;
    const auto expect = [&](bool fulfilled, const std::string& what) {
        if (!fulfilled) fmt::print(stderr, "soak: failed: {}\n", what);
        bad += fulfilled ? 0 : 1;
    };
    expect(pit.world().faults().empty(), "a body was frozen");
    expect(pit.lost() == 0, fmt::format("{} bodies left the pit", pit.lost()));
    for (const Minute& m : minutes) {
        expect(m.overlap <= deepest_overlap, fmt::format("bodies overlapped by {} m", m.overlap));
    }
    if (minutes.size() >= 8) {
        // The pile is full after the first quarter at the latest; from then on nothing may grow.
        const auto second = minutes.begin() + static_cast<std::ptrdiff_t>(minutes.size() / 4);
        const auto last = minutes.end() - static_cast<std::ptrdiff_t>(minutes.size() / 4);
        const auto grows = [&](const char* what, double factor, const auto& of) {
            const double early = median(second, last, of);
            const double late = median(last, minutes.end(), of);
            expect(late <= factor * early, fmt::format("{} grew from {} to {}", what, early, late));
        };
        grows("the resident memory", 1.05, [](const Minute& m) { return static_cast<double>(m.resident); });
        grows("the heap", 1.05, [](const Minute& m) { return static_cast<double>(m.heap); });
        grows("the time of a step per contact", 1.5,
              [](const Minute& m) { return m.step_ms / static_cast<double>(std::max<std::int64_t>(m.contacts, 1)); });
        grows("the kinetic energy", 1.5, [](const Minute& m) { return m.energy; });
        grows("the mean overlap", 1.5, [](const Minute& m) { return m.mean_overlap; });
    }
    return bad;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3 && argc != 4) {
        fmt::print(stderr, "usage: {} SIMULATED_SECONDS WALL_SECONDS [BODIES]\n", argv[0]);
        return 2;
    }
    const double simulated = std::atof(argv[1]);
    const std::chrono::duration<double> wall(std::atof(argv[2]));
    const auto begin = Clock::now();
    Pit pit(argc > 3 ? std::strtoul(argv[3], nullptr, 10) : usual_pile);
    std::vector<Minute> minutes;
    while (pit.world().time() < simulated && Clock::now() - begin < wall) {
        minutes.push_back(pit.minute());
        const Minute& m = minutes.back();
        fmt::print(
            "{:>6.0f} s: {:.3f} ms per step, {} contacts, overlap {:.2f} mm (mean {:.4f}), up to {:.1f} J, {} kB of {} "
            "kB\n",
            pit.world().time(), m.step_ms, m.contacts, 1e3 * m.overlap, 1e3 * m.mean_overlap, m.energy, m.heap / 1024,
            m.resident / 1024);
        std::fflush(stdout);
    }
    const int bad = judge(minutes, pit);
    fmt::print("soak: {:.0f} s simulated in {:.0f} s, {} failures\n", pit.world().time(),
               std::chrono::duration<double>(Clock::now() - begin).count(), bad);
    return bad == 0 ? 0 : 1;
}
