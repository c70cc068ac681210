/// @file Shapes of another size.
#pragma once

#include "cairn/shape.h"

namespace cairn {

/// The same shape, larger, of the same densities. @param factor of its lengths @throws InputError unless it is finite
/// and above 0
Shape scaledShape(const Shape& shape, double factor);

}  // namespace cairn
