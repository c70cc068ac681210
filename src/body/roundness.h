/// @file Which turns of a body take its surface nowhere.
#pragma once

#include <variant>

#include "body/body_storage.h"

namespace cairn {

enum class Roundness {
    none,        ///< every turn moves it
    about_axis,  ///< it may turn about the z axis of its shape
    everywhere
};

/// Of a body that turns about its centre of mass. What is round about anything else is not.
inline Roundness roundnessOf(const BodyStorage& bodies, BodyIndex i) {
    if (!bodies.p_BS[i].isZero(0)) return Roundness::none;
    const Shape& shape = bodies.shape[i];
    if (std::holds_alternative<Sphere>(shape)) return Roundness::everywhere;
    const bool tube = std::holds_alternative<Capsule>(shape) || std::holds_alternative<Cylinder>(shape);
    return tube ? Roundness::about_axis : Roundness::none;
}

}  // namespace cairn
