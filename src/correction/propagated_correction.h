/// @file The penetration correction of the thesis. @source thesis §2, Algorithm 2
#pragma once

#include <cstdint>
#include <vector>

#include "correction/correction.h"
#include "correction/propagation.h"

namespace cairn {

/// Corrects penetrating contacts one by one, in ascending order of their index. Each is corrected by moving one of its
/// bodies, and whatever that one pushes, so that no other contact gets deeper than a part of the threshold.
/// In a tight pile every candidate of a contact can be invalid, which the thesis leaves as it is.
class PropagatedCorrection final : public Correction {
  public:
    CorrectionCounts correct(const BatchView& batch, const ContactsOfBodies& contacts_of, std::span<Contact> contacts,
                             const BodyState& bodies, double remaining) override;

  private:
    /// Finds the best candidate of a contact and leaves it in best_. @param remaining part of what the contact is
    /// allowed that is left, f (2.5.4) @return false if none is valid
    bool choose(const Contact& contact, const BodyState& bodies, double remaining);

    Propagation best_;
    Propagation trial_;
    PushGraph graph_;
    std::vector<std::uint32_t> penetrating_;
};

}  // namespace cairn
