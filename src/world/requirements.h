/// @file What calls that write bodies demand of their values.
#pragma once

#include <string_view>

#include "body/body_storage.h"

namespace cairn {

/// Limit of forces, torques and impulses: far above any use, far below overflow.
inline constexpr double load_limit = 1e30;

/// @throws InputError if a component is not finite or beyond the limit
void requireWithin(const Vec3& value, double limit, std::string_view what, std::string_view unit);

/// The rotation with unit length. @throws InputError if it cannot be normalised
Quat requireRotation(const Quat& q);

/// Body that may be moved by the user. @throws StaleIdError, InputError for a fixed body
BodyIndex dynamicIndex(const BodyStorage& bodies, BodyId id, std::string_view what);

}  // namespace cairn
