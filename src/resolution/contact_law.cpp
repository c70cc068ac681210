#include "resolution/contact_law.h"

#include <algorithm>
#include <cmath>

#include "resolution/energetic_impulse.h"
#include "resolution/impulse.h"

namespace cairn {

void ContactLaw::begin(const BatchView& batch, std::span<const Contact> contacts, const ResolutionSettings& settings) {
    restitution_law_ = settings.restitution_law;
    restitution_threshold_ = settings.restitution_threshold;
    const bool rolls_freely =
        std::ranges::none_of(batch.contacts, [&](std::uint32_t i) { return resistsRolling(contacts[i]); });
    touch_.clear();
    if (settings.restitution_speed == RestitutionSpeed::touching) {
        for (const std::uint32_t i : batch.contacts) {
            touch_.push_back({contacts[i].forced, contacts[i].fall, contacts[i].climb});
        }
    }
    allowed_closing_.clear();
    if (std::ranges::any_of(batch.contacts, [&](std::uint32_t i) { return contacts[i].isForeseen(); })) {
        // What closes by more than the threshold only is resolved: what is foreseen shall not lose that.
        for (const std::uint32_t i : batch.contacts) {
            allowed_closing_.push_back(std::max(0.0, contacts[i].allowed_closing - settings.resolution_threshold));
        }
    }
    thesis_ = restitution_law_ == RestitutionLaw::newton && touch_.empty() && allowed_closing_.empty() && rolls_freely;
}

double ContactLaw::separatingSpeed(std::size_t contact, const ContactFrame& frame, double closing) const {
    if (!touch_.empty()) return touchingSpeed(frame.restitution, restitution_threshold_, touch_[contact], closing);
    const bool bounces = frame.restitution > 0 && closing <= -restitution_threshold_;
    return bounces ? -frame.restitution * closing : -allowedClosing(contact);
}

double ContactLaw::separatingSpeed(const ResolutionSettings& settings, const Contact& contact, double closing) {
    if (settings.restitution_speed == RestitutionSpeed::touching) {
        return touchingSpeed(contact.restitution, settings.restitution_threshold,
                             {contact.forced, contact.fall, contact.climb}, closing);
    }
    const bool bounces = isImpact(contact, closing, settings.restitution_threshold);
    return bounces ? -contact.restitution * closing : -contact.allowed_closing;
}

double ContactLaw::touchingSpeed(double restitution, double threshold, const Touch& touch, double closing) {
    const double approach = touch.forced - closing;
    if (!(approach > 0)) return 0;
    const double touched = approach * approach + touch.fall;
    if (!(touched >= threshold * threshold)) return 0;
    return std::sqrt(std::max(0.0, restitution * restitution * touched - touch.climb));
}

ContactWrench ContactLaw::resolve(std::size_t contact, const LocalBatch& local, const Vec3& velocity) const {
    const ContactFrame& frame = local.contacts[contact];
    const double e = separatingSpeed(contact, frame, velocity[0]) / -velocity[0];
    if (frame.rolling != ContactFrame::rolls_freely) return resolveRolling(local, frame, velocity, e);
    // What does not bounce loses energy by the thesis's law already.
    if (restitution_law_ == RestitutionLaw::energetic) return {energeticImpulse(frame, velocity, e)};
    return {newtonImpulse(frame, velocity, e)};
}

ContactWrench ContactLaw::resolveRolling(const LocalBatch& local, const ContactFrame& frame, const Vec3& velocity,
                                         double restitution) const {
    const RollingContact& contact = local.rolling[frame.rolling];
    const Vec6 twist = relativeTwist(frame, local.bodies[frame.a], local.bodies[frame.b]);
    if (restitution > 0 && restitution_law_ == RestitutionLaw::energetic) {
        const Vec3 impulse = energeticImpulse(frame, velocity, restitution);
        const Vec3 turning = twist.tail<3>() + contact.k.bottomLeftCorner<3, 3>() * impulse;
        return {impulse, rollingImpulse(contact, impulse[0], turning)};
    }
    Vec6 excess = twist;
    excess[0] += restitution * velocity[0];
    const Vec6 wrench = solveRolling(contact, frame.static_friction, frame.kinetic_friction, excess, Vec6::Zero());
    return {wrench.head<3>(), wrench.tail<3>()};
}

}  // namespace cairn
