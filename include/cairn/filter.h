/// @file Which bodies touch each other: named groups, pairs of groups, and exceptions of single pairs of bodies.
#pragma once

#include <cstdint>

#include "cairn/types.h"

namespace cairn {

/// The index of a group of bodies of a world.
enum class GroupId : std::uint32_t {};

/// Most groups of a world.
inline constexpr std::size_t most_groups = 64;

/// Whether two bodies may touch.
enum class Touch : std::uint8_t {
    never,   ///< they pass through each other
    always,  ///< they touch as bodies do
};

/// A body that a sensor holds.
struct Sensed {
    BodyId sensor{};  ///< a body that is a sensor
    BodyId body{};    ///< one that overlaps it and is no sensor

    friend bool operator==(const Sensed&, const Sensed&) = default;
};

}  // namespace cairn
