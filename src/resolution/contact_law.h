/// @file Which law a contact follows: the thesis's, or one of the options. The resolutions ask once per batch whether
/// anything else than the thesis's law is wanted, so that the options cost nothing while they are off.
#pragma once

#include <span>
#include <vector>

#include "resolution/local_batch.h"
#include "resolution/rolling.h"

namespace cairn {

/// What resolves one contact.
struct ContactWrench {
    Vec3 impulse;                 ///< on A [N·s, contact coordinates]
    Vec3 angular = Vec3::Zero();  ///< on A besides [N·m·s, contact coordinates]
};

/// Whether a contact bounces: bodies that are apart only where they meet before the next detection.
/// @param closing normal velocity [m/s], < 0 where they close @param threshold thr_restitution [m/s]
inline bool isImpact(const Contact& contact, double closing, double threshold) {
    return contact.restitution > 0 && closing <= -threshold && closing < -contact.allowed_closing;
}

/// The law of the contacts of one batch.
class ContactLaw {
  public:
    void begin(const BatchView& batch, std::span<const Contact> contacts, const ResolutionSettings& settings);

    /// Whether every contact follows the thesis: contactImpulse() says all.
    bool isThesis() const { return thesis_; }

    /// How fast a contact may close [m/s], ≥ 0. @param contact its index in the batch
    double allowedClosing(std::size_t contact) const {
        return allowed_closing_.empty() ? 0 : allowed_closing_[contact];
    }

    /// The speed with which a contact shall separate [m/s]; < 0 = it may go on closing. @param contact its index in the
    /// batch @param closing normal velocity [m/s], < −allowedClosing()
    double separatingSpeed(std::size_t contact, const ContactFrame& frame, double closing) const;

    /// The same of a contact outside of a batch.
    static double separatingSpeed(const ResolutionSettings& settings, const Contact& contact, double closing);

    /// Resolves a closing contact by itself. @param contact its index in the batch @param velocity ϑA − ϑB [m/s,
    /// contact coordinates], velocity[0] < 0
    ContactWrench resolve(std::size_t contact, const LocalBatch& local, const Vec3& velocity) const;

  private:
    /// What RestitutionSpeed::touching needs of a contact.
    struct Touch {
        double forced;  ///< [m/s], as in Contact
        double fall;    ///< [m²/s²], as in Contact
        double climb;   ///< [m²/s²], as in Contact
    };

    static double touchingSpeed(double restitution, double threshold, const Touch& touch, double closing);
    ContactWrench resolveRolling(const LocalBatch& local, const ContactFrame& frame, const Vec3& velocity,
                                 double restitution) const;

    bool thesis_ = true;
    RestitutionLaw restitution_law_ = RestitutionLaw::newton;
    double restitution_threshold_ = 0;  ///< [m/s]
    std::vector<Touch> touch_;          ///< [contacts]; empty = the closing speed counts
    /// [contacts] [m/s]; empty = all bodies touch.
    std::vector<double> allowed_closing_;
};

}  // namespace cairn
