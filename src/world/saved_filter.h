/// @file Filters and sensors in snapshots.
#pragma once

#include <span>
#include <vector>

#include "body/body_storage.h"
#include "world/byte_stream.h"

namespace cairn {

void saveFilter(const BodyStorage& bodies, ByteWriter& out);
/// @pre the bodies are loaded @throws InputError for groups or exceptions that no world has
void loadFilter(ByteReader& in, BodyStorage& bodies);

void saveSensed(std::span<const Sensed> sensed, ByteWriter& out);
void loadSensed(ByteReader& in, std::vector<Sensed>& sensed);

}  // namespace cairn
