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

/// Moves overlapping bodies apart. One object per thread: it owns its scratch memory.
class Correction {
  public:
    virtual ~Correction() = default;
    /// Corrects one batch: moves bodies (and wakes those it moves), updates point and distance of their contacts.
    virtual CorrectionCounts correct(const BatchView& batch, const ContactsOfBodies& contacts_of,
                                     std::span<Contact> contacts, const BodyState& bodies,
                                     const CorrectionSettings& settings) = 0;
};

std::unique_ptr<Correction> makeCorrection(CorrectionKind kind);

}  // namespace cairn
