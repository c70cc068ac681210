/// @file A body, and the contacts and joints that it takes along, as part of a message to another rank.
#pragma once

#include <cstddef>
#include <vector>

#include "body/body_storage.h"
#include "body/contact.h"
#include "joints/joint.h"
#include "messages/packing.h"

namespace cairn {

/// Appends what another rank does not know of a body: the fields that steps change and those that calls change for its
/// holder alone. What was given when the body was added all ranks know.
void packBody(std::vector<std::byte>& message, const BodyStorage& bodies, BodyIndex i);
/// Reads the same into the body's slot.
void unpackBody(Unpacker& in, BodyStorage& bodies, BodyIndex i);

/// Appends what the next step needs of a contact of the last one.
void packContact(std::vector<std::byte>& message, const Contact& contact);
/// Reads the same.
Contact unpackContact(Unpacker& in);

/// Appends what steps change of a joint.
void packJoint(std::vector<std::byte>& message, const Joint& joint);
/// Reads the same into the joint.
void unpackJoint(Unpacker& in, Joint& joint);

}  // namespace cairn
