/// @file A body, and the contacts and joints that it takes along, as part of a message to another rank.
#pragma once

#include <cstddef>
#include <vector>

#include "body/body_storage.h"
#include "body/contact.h"
#include "geometry/geometry.h"
#include "joints/joint.h"
#include "messages/packing.h"

namespace cairn {

/// Whether a shape is sent with its body: it is of a few numbers. Others are on all ranks.
bool isSent(const Shape& shape);

void packBounds(std::vector<std::byte>& message, const Bounds& bounds);
Bounds unpackBounds(Unpacker& in);

/// Appends all fields of a body but a shape that is not sent.
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
/// A joint that is on another rank must not break here by what it bore.
void forgetLoad(Joint& joint);

}  // namespace cairn
