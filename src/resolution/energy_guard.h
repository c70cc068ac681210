/// @file No resolution may raise the kinetic energy of a batch.
#pragma once

#include <vector>

#include "batches/batch_motion.h"
#include "resolution/energy_gain.h"

namespace cairn {

/// Watches over the resolution of one batch that begins with the impulses of the last step and ends early. Where it
/// raised the kinetic energy, it begins anew without those impulses; if the energy is still above what it was, all
/// impulses are taken by the one factor below 1 that leaves it as it was, which keeps momentum and the friction cones.
/// Limits of joints take energy only. Where motors, servos or springs act, or a fixed body or its surface moves, their
/// work may be added, and a hundredth of the energy besides.
class EnergyGuard {
  public:
    /// To be called before the batch is resolved.
    void begin(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies);
    /// To be called afterwards. @return whether the batch is as it was before and to be resolved anew: its contacts
    /// have forgotten the last step
    bool refuses(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies);
    /// To be called after that.
    void bound(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies) const;

  private:
    EnergyGain gainOf(const BatchView& batch, const BodyState& bodies) const;
    double givenTo(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) const;
    double givenBySupports(const BatchView& batch, std::span<const Contact> contacts, const BodyState& bodies) const;
    double givenByJoints(const BatchView& batch, const BodyState& bodies) const;
    bool isAboveRounding(const EnergyGain& gain, double given, const BatchView& batch, const BodyState& bodies) const;
    void keepPart(double part, const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies) const;

    bool driven_ = false;             ///< joints may give energy
    bool carried_ = false;            ///< supports may
    std::vector<BodyMotion> before_;  ///< [bodies of the batch]
};

}  // namespace cairn
