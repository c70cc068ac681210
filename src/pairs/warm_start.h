/// @file Carries the impulses of a pair's contacts from one step to the next, so that a resolution can begin where the
/// last one ended (warm starting).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_storage.h"
#include "body/contact.h"
#include "pairs/foreseen.h"
#include "pairs/found_contacts.h"

namespace cairn {

/// Whether contacts begin with the impulses of the last step.
enum class WarmStart : std::uint8_t { off, on };

/// What contacts begin a step with, or a part of one.
struct ContactsBegin {
    WarmStart warm_start = WarmStart::on;
    double part = 1;            ///< of the impulses that they have, as they act for a shorter or longer time
    double reference_part = 1;  ///< of the reference impulses
    bool goes_on = false;       ///< the impulses are of earlier parts of the same step
};

/// Makes what the response left of contacts the beginning of what comes.
void beginContacts(std::span<Contact> contacts, const ContactsBegin& begins, const Executor& executor);

/// Gives every contact of a pair the last_impulse and the reference_impulse of the nearest contact that the pair had,
/// after that one moved along with either body. Places survive a change of the reference face better than the numbers
/// of features do.
/// @param before what the pair had where the bodies were detected (BodyArrays::detected_position)
/// @param now what it has where they are; out: the impulses, zero where nothing was near
/// @param left out: those that pushed and that nothing is near to
void inheritImpulses(const BodyStorage& bodies, std::span<const Contact> before, std::span<FoundContact> now,
                     std::vector<const Contact*>& left);

/// A contact with its impulse, seen from where its bodies are since they went back, or stayed.
/// @param before from where they were detected @param allowed_overlap [m] @param time until they may be there again [s]
FoundContact foreseenAgain(const BodyStorage& bodies, const Contact& before, double allowed_overlap, double time);

/// Keeps the contacts of a pair that pushed where its bodies would be if they had not gone back, or would go if they
/// could: without them whoever turns until it meets another side falls anew in every step, and carries nobody.
/// @param left as of inheritImpulses() @param went_back one of its bodies was detected where it does not stay
/// @param found out: they are appended @return whether there are any
bool keepAhead(const BodyStorage& bodies, const DetectionRange& range, std::span<const Contact* const> left,
               bool went_back, std::vector<FoundContact>& found);

}  // namespace cairn
