/// @file Carries the impulses of a pair's contacts from one step to the next, so that a resolution can begin where the
/// last one ended (warm starting).
#pragma once

#include <cstdint>
#include <span>

#include "body/body_storage.h"
#include "body/contact.h"
#include "pairs/found_contacts.h"

namespace cairn {

/// Whether contacts begin with the impulses of the last step.
enum class WarmStart : std::uint8_t { off, on };

/// Makes what the response of the last step left of contacts the beginning of the present one.
void beginContacts(std::span<Contact> contacts, WarmStart warm_start, const Executor& executor);

/// Gives every contact of a pair the last_impulse and the reference_impulse of the nearest contact that the pair had,
/// after that one moved along with either body. Places survive a change of the reference face better than the numbers
/// of features do.
/// @param before what the pair had where the bodies were detected (BodyArrays::detected_position)
/// @param now what it has where they are; out: the impulses, zero where nothing was near
void inheritImpulses(const BodyStorage& bodies, std::span<const Contact> before, std::span<FoundContact> now);

}  // namespace cairn
