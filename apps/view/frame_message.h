/// @file Frames of a running world as compact binary messages.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "cairn/world.h"
#include "wire.h"

namespace cairn::view {

/// What a frame holds beside poses and flags; a set of bits.
enum class Layer : std::uint32_t {
    speed = 1,
    batch = 2,
    overlap = 4,
    level = 8,
    stage = 16,
    bounds = 32,
    moves = 64,
    contacts = 128,
    joints = 256
};
using Layers = std::uint32_t;

inline constexpr Layers bit(Layer layer) {
    return static_cast<Layers>(layer);
}

/// @return none for an unknown name
std::optional<Layer> layerFromName(std::string_view name);
/// All names, for messages.
std::string layerNames();

/// A line from a point of a body to where it is pulled [m, W].
struct SpringLine {
    Vec3 from;
    Vec3 to;
};

/// What viewers added to the world that is no part of it.
struct Additions {
    std::vector<SpringLine> springs{};
    std::vector<Ray> rays{};  ///< the frame holds where they hit
};

/// Whether the world must trace its steps for these layers.
inline constexpr Tracing tracingFor(Layers layers) {
    return (layers & (bit(Layer::stage) | bit(Layer::moves))) != 0 ? Tracing::on : Tracing::off;
}

/// @param bodies all bodies of the world, ascending @param epoch of the roster they belong to
SharedMessage makeFrameMessage(const World& world, const std::vector<BodyId>& bodies, std::uint32_t epoch,
                               Layers layers, const Additions& additions);

}  // namespace cairn::view
