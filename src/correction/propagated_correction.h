/// @file The penetration correction of the thesis. @source thesis §2, Algorithm 2
#pragma once

#include <cstdint>
#include <vector>

#include "correction/correction.h"
#include "correction/loosening.h"
#include "correction/propagation.h"

namespace cairn {

/// Corrects penetrating contacts one by one, in ascending order of their index. Each is corrected by moving one of its
/// bodies, and whatever that one pushes, so that no other contact gets deeper than a part of the threshold.
///
/// In a tight pile every candidate of a contact can be invalid, which the thesis leaves as it is. Such contacts are
/// tried again (CorrectionSettings::spread_levels), as far as they are deeper than 1.14, 1.5, 3, 6, … times the
/// threshold, with as much overlap allowed to the contacts that are pushed. So one deep overlap becomes several shallow
/// ones, which later steps can correct. Batches whose bodies are inside many others are loosened instead.
class PropagatedCorrection final : public Correction {
  public:
    CorrectionCounts correct(const BatchView& batch, const ContactsOfBodies& contacts_of, std::span<Contact> contacts,
                             const BodyState& bodies, const CorrectionSettings& settings) override;

  private:
    /// Which contacts are corrected, and how deep those that remain or are pushed may be.
    struct Pass {
        double limit;      ///< contacts with a smaller distance are corrected [m], < 0
        double remaining;  ///< distance that they have afterwards, and down to which others are pushed [m], < 0
    };

    /// Corrects what is penetrating, with spreading. @return how many bodies were moved
    std::int64_t push(const ContactsOfBodies& contacts_of, std::span<Contact> contacts, const BodyState& bodies,
                      const CorrectionSettings& settings);
    std::int64_t run(const Pass& pass, const ContactsOfBodies& contacts_of, std::span<Contact> contacts,
                     const BodyState& bodies);
    /// Finds the best candidate of a contact and leaves it in best_. @return false if none is valid
    bool choose(const Contact& contact, const BodyState& bodies, double remaining);

    Loosening loosening_;
    Propagation best_;
    Propagation trial_;
    PushGraph graph_;
    std::vector<std::uint32_t> penetrating_;
};

}  // namespace cairn
