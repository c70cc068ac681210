/// @file Shapes in snapshots.
#pragma once

#include "cairn/shape.h"
#include "world/byte_stream.h"

namespace cairn {

void saveShape(const Shape& shape, ByteWriter& out);
/// @throws InputError naming the offset, for a shape that no world holds
Shape loadShape(ByteReader& in);

}  // namespace cairn
