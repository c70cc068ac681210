/// @file A poured heap as the response sees it: bodies and contacts of a time step before they are resolved.
#pragma once

#include <vector>

#include "batches/batches.h"
#include "body/contact.h"
#include "cairn/settings.h"

namespace cairn::kernels {

/// Owns what BodyState and BatchView look at. Everything is one batch.
struct Pile {
    std::vector<BodyKind> kind;
    std::vector<Vec3> position, v, w, linear_step;
    std::vector<double> mass_inv;
    std::vector<Mat3> inertiaInv_W;
    std::vector<std::uint8_t> asleep;
    std::vector<WakeReason> woken;
    std::vector<Contact> contacts;
    std::vector<BodyIndex> bodies;       ///< the dynamic ones
    std::vector<std::uint32_t> indices;  ///< of all contacts
    Settings settings;

    BodyState state();
    BatchView batch() const { return {bodies, indices}; }
};

/// A heap of 500 mixed bodies, a second after it was poured. @param copies of it, side by side in memory
Pile makePile(std::size_t copies);

}  // namespace cairn::kernels
