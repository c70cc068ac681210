/// @file Which friction contacts slide with, once sweeps have found out who slides.
#pragma once

#include "resolution/pgs_batch.h"
#include "resolution/pgs_contact.h"

namespace cairn {

/// Gives the contacts that slide their kinetic friction, where that is another one. @param first, contacts of the
/// batch: so many from there on @param contactAt returns the PgsContact of one of them, counted from the first
/// @param release called with it and the friction
/// @return whether any has another one now
template <class ContactAt, class Release>
bool releaseSlidingOf(const PgsBatch& pgs, std::size_t first, std::size_t contacts, const ContactAt& contactAt,
                      const Release& release) {
    bool released = false;
    for (std::size_t i = 0; i < contacts; ++i) {
        const Contact& contact = pgs.contacts[pgs.batch.contacts[first + i]];
        if (!(contact.kinetic_friction < contact.static_friction)) continue;
        const PgsContact s = contactAt(i);
        const std::vector<LocalBody>& bodies = pgs.local.bodies;
        if (!slides(s, bodies[s.a], bodies[s.b], pgs.settings.resolution_threshold)) continue;
        release(i, contact.kinetic_friction);
        released = true;
    }
    return released;
}

}  // namespace cairn
