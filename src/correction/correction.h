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
};

/// Part of the overlap allowed that a correction leaves, f. @source thesis (2.5.4)
inline constexpr double remaining_penetration = 0.7;

/// Moves overlapping bodies apart. One object per thread: it owns its scratch memory.
class Correction {
  public:
    virtual ~Correction() = default;
    /// Corrects one batch: moves bodies (and wakes those it moves), updates point and distance of their contacts.
    /// @param remaining part of what a contact is allowed that is left, in (0, 1)
    virtual CorrectionCounts correct(const BatchView& batch, const ContactsOfBodies& contacts_of,
                                     std::span<Contact> contacts, const BodyState& bodies, double remaining) = 0;
};

std::unique_ptr<Correction> makeCorrection(CorrectionKind kind);

}  // namespace cairn
