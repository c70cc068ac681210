/// @file Penetration correction: what every algorithm for it sees and gives. @source thesis §2
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "batches/batches.h"
#include "body/contact.h"
#include "cairn/settings.h"

namespace cairn {

/// What a correction counted.
struct CorrectionCounts {
    std::int64_t penetrating = 0;
    std::int64_t corrected = 0;
    std::int64_t uncorrected = 0;
    std::int64_t displaced = 0;

    void add(const CorrectionCounts& other) {
        penetrating += other.penetrating;
        corrected += other.corrected;
        uncorrected += other.uncorrected;
        displaced += other.displaced;
    }
};

/// Part of the overlap allowed that a correction leaves, f. @source thesis (2.5.4)
inline constexpr double remaining_penetration = 0.7;

/// Where bodies were before the correction, by slot.
struct PosesBefore {
    std::span<const Vec3> position;     ///< of the centre of mass [m, W]
    std::span<const Quat> orientation;  ///< B to W
};

/// Moves overlapping bodies apart. One object per thread: it owns its scratch memory.
class Correction {
  public:
    virtual ~Correction() = default;
    /// Corrects one batch: moves bodies, wakes those it moves and updates point and distance of their contacts, as far
    /// as this is not left to settle(). @param remaining part of what a contact is allowed that is left, in (0, 1)
    virtual CorrectionCounts correct(const BatchView& batch, const ContactsOfBodies& contacts_of,
                                     std::span<Contact> contacts, const BodyState& bodies, double remaining) = 0;
    /// Does the rest for one batch when it is known how far its bodies may go; they may be back where they were, or on
    /// the way there. @pre correct() found contacts that are too deep @return what was not counted yet
    virtual CorrectionCounts settle(const BatchView&, std::span<Contact>, const BodyState&, const PosesBefore&) {
        return {};
    }
};

std::unique_ptr<Correction> makeCorrection(CorrectionKind kind);

}  // namespace cairn
