/// @file What the accelerated sweeps do with a batch, from what it is.
#pragma once

#include "resolution/sweep_progress.h"

namespace cairn {

/// What a batch is, as far as its sweeps depend on it.
struct BatchKind {
    bool framed = false;             ///< it has joints, which work with frames of the contacts
    bool two_frictions = false;      ///< some contact slides with another friction than it sticks with
    bool rests = false;              ///< its contacts hardly move: a pile that stands, or a jam
    bool may_step_directly = false;  ///< direct steps are taken where sweeps are not enough
    SweepOrder order = SweepOrder::one_by_one;
    bool pulled = false;      ///< forces of users, springs or joints act on some of its bodies
    std::size_t rolling = 0;  ///< contacts that resist rolling
    /// How its contacts moved before the step's gravity, along their normals alone where forces pull, in the measure of
    /// SweepChange.
    double motion = 0;
    double depth = 0;     ///< overlap of its contacts (mean square), as a multiple of what is allowed
    double safe_way = 0;  ///< nothing may get deeper into another body in a step by more [m]
};

BatchKind kindOf(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies,
                 const ResolutionSettings& settings);

SweepPlan planOf(const BatchKind& kind, const BodyState& bodies, const ResolutionSettings& settings);

}  // namespace cairn
