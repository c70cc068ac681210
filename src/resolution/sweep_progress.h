/// @file When the sweeps over a batch may end, and how they are accelerated.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "resolution/pgs_batch.h"

namespace cairn {

/// How far a batch is solved.
struct SweepPlan {
    std::int64_t limit = 1;   ///< of sweeps
    double steady_speed = 0;  ///< a sweep that changes no contact's velocity by more is the last one [m/s]
    double tolerance = 0;     ///< what may be left to change, as a part of the motion or of the first change; 0 = none
    double safe_speed = 0;    ///< with which nothing gets far into another body in a step [m/s]
    double motion = 0;        ///< how the contacts move, in the measure of SweepChange
};

/// The course of the sweeps over one batch. The change of the impulses by a sweep is taken as the negative gradient of
/// the nonsmooth nonlinear conjugate gradient method.
/// @source Silcowitz-Hansen, Niebe, Erleben: A nonsmooth nonlinear conjugate gradient method for interactive contact
///         force problems, The Visual Computer 26 (2010), doi:10.1007/s00371-010-0502-6
class SweepProgress {
  public:
    SweepProgress() = default;
    explicit SweepProgress(const SweepPlan& plan) : plan_(plan) {}

    /// Whether the next sweep is the last one whatever it changes.
    bool isLast() const { return sweeps_ + 1 >= plan_.limit; }
    std::int64_t sweeps() const { return sweeps_; }
    void countSweep() { ++sweeps_; }

    /// To be called after every sweep whose change is known. @return whether the impulses need no further sweep
    bool isSteady(const SweepChange& change) {
        const bool enough = isLittleLeft(std::sqrt(change.squared)) && change.largest_speed <= plan_.safe_speed;
        return !(change.largest_speed > plan_.steady_speed) || enough;
    }

    /// Whether there is a last direction.
    bool hasDirection() const { return gradient_ != 0; }
    double gradient() const { return gradient_; }
    /// How much of the last direction is added after a sweep. It is given up only where sweeps clearly diverge: what
    /// begins to slide or to part lets one sweep change more than the last, and the way so far is still a good one.
    double beta(const SweepChange& change) const {
        return gradient_ > 0 && change.squared <= most_growth * gradient_ ? change.squared / gradient_ : 0;
    }
    /// Notes the change of a sweep that was accelerated.
    void advance(const SweepChange& change) { gradient_ = change.squared; }
    void forgetDirection() { gradient_ = 0; }

  private:
    /// A direction is kept while the squared change is at most this multiple of the last one.
    static constexpr double most_growth = 1.5;
    /// How much less a sweep changes than the one before it: what is assumed after the second sweep, since the first
    /// one also changes what no other contact has a part in, and the bounds within which later ones are believed.
    /// Sweeps that seem not to converge at all count as slow ones.
    static constexpr double assumed_rate = 0.7, fastest_rate = 0.3, slowest_rate = 0.95;

    /// How much less a sweep changes than the one before it, of late or since the second sweep, whichever is slower:
    /// conjugate directions advance unevenly, and one sweep that changes little does not tell that all will.
    double rateOf(double change) const {
        if (!(last_ > 0)) return slowest_rate;
        const double late = change / last_;
        if (estimates_ == 1) return std::clamp(late, assumed_rate, slowest_rate);
        const double mean = second_ > 0 ? std::pow(change / second_, 1.0 / (estimates_ - 1)) : late;
        return std::clamp(std::max(late, mean), fastest_rate, slowest_rate);
    }

    /// Estimates what all further sweeps would change, from how fast the changes become smaller: after a change c of a
    /// part r of the one before it, a geometric series leaves c·r/(1 − r). Deep piles, through which impulses have a
    /// long way, converge slowly and so are solved longer than shallow ones.
    bool isLittleLeft(double change) {
        if (plan_.tolerance == 0) return false;
        const double rate = rateOf(change);
        const double left = estimates_ == 0 ? change : change * rate / (1 - rate);
        last_ = change;
        if (estimates_ == 0) first_ = change;
        if (estimates_ == 1) second_ = change;
        ++estimates_;
        const double scale = estimates_ == 1 ? plan_.motion : std::max(plan_.motion, first_);
        return left <= plan_.tolerance * scale;
    }

    SweepPlan plan_;
    std::int64_t sweeps_ = 0;
    double gradient_ = 0;  ///< squared change of the last sweep; 0 = there is no direction
    double first_ = 0;
    double second_ = 0;
    double last_ = 0;
    int estimates_ = 0;
};

}  // namespace cairn
