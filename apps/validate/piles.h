/// @file Piles of all kinds, poured into a pit until they rest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cairn/world.h"

namespace cairn::validation {

/// What the bodies of a pile are.
enum class PileShape { box, ball, plate, rod, cylinder, hull, compound, mixed };

/// One pile: bodies on a loose grid in a pit with a floor and four walls, all falling at once.
struct Pile {
    PileShape shape = PileShape::box;
    bool graded = false;      ///< whether sizes are 1 : 20 in place of 0.75 : 1.25
    std::size_t count = 200;  ///< bodies
    int depth = 10;           ///< bodies above each other when they lie; 1 = a shaft that is one body wide
    double impact = 0;        ///< speed downwards at the beginning, as a multiple of √(|g|·d)
    double step = 1;          ///< steps per second as a multiple of the default for d
    double extent = 0.1;      ///< d: median extent of the bodies [m]
    double friction = 0.2;    ///< coefficient, static and kinetic
    double restitution = 0;   ///< coefficient
    std::uint64_t seed = 1;   ///< of sizes, orientations and places
    /// Whether it would roll for ever without rolling friction.
    bool isRound() const {
        return shape == PileShape::ball || shape == PileShape::cylinder || shape == PileShape::rod ||
               shape == PileShape::mixed;
    }
};

/// What came of it.
struct PileResult {
    double gain = 0;          ///< largest rise of the energy above its lowest so far, as a part of E₀
    double rest_time = 0;     ///< since the last body came down until 98 % slept [s]; −1 = they never did
    double allowed_time = 0;  ///< for that [s]
    double asleep = 0;        ///< part of the bodies at the end
    double motion = 0;        ///< kinetic energy at the end as a part of E₀
    std::size_t lost = 0;     ///< bodies out of the pit
    double rest_overlap = 0;  ///< largest at the end, as a part of the smaller body's smallest extent
    double fall_overlap = 0;  ///< largest of the run, likewise
    double way = 0;           ///< largest way of a body in a step as a part of its smallest extent
    double ms = 0;            ///< mean wall time of a step [ms]
    double peak_ms = 0;       ///< longest [ms]
    double visits = 0;        ///< mean visits of contacts in a step
    double ns_per_visit = 0;  ///< time of the resolution per visit [ns]
    std::size_t steps = 0;
};

std::string nameOf(PileShape shape);
/// The setting of a pile in words, without blanks.
std::string nameOf(const Pile& pile);

/// Default of the steps per second for bodies of a median extent [m] under gravity [m/s²].
double defaultStepsPerSecond(double extent, double gravity);

/// Fills a pit and runs until 98 % of the bodies sleep or the time is over. @param settings changes what the preset
/// says @param alive called in every step
PileResult runPile(const Pile& pile, const std::function<void(Settings&)>& settings,
                   const std::function<void(const World&)>& alive);

}  // namespace cairn::validation
