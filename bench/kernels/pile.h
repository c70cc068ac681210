/// @file A poured heap as the response sees it: bodies and contacts of a time step before they are resolved.
#pragma once

#include <vector>

#include "batches/batches.h"
#include "body/body_storage.h"
#include "body/contact.h"
#include "cairn/settings.h"

namespace cairn::kernels {

/// A batch of its own with all that BodyState and BatchView look at.
struct Pile : BodyStorage {
    std::vector<Contact> contacts;
    std::vector<BodyIndex> bodies;       ///< the dynamic ones
    std::vector<std::uint32_t> indices;  ///< of all contacts
    Settings settings;

    BatchView batch() const { return {bodies, indices}; }
};

/// A heap of 500 mixed bodies, a second after it was poured. @param copies of it, side by side in memory
Pile makePile(std::size_t copies);

}  // namespace cairn::kernels
