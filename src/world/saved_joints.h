/// @file Joints of a snapshot.
#pragma once

#include "world/byte_stream.h"
#include "world/world_state.h"

namespace cairn {

bool isFiniteAndNotNegative(double value);

/// @throws InputError for joints that no world has
void loadJoints(ByteReader& in, const BodyStorage& bodies, std::vector<Joint>& joints);

}  // namespace cairn
