/// @file How messages name a body of a scene.
#pragma once

#include <string>

#include "cairn/scene.h"

namespace cairn {

/// Such as "body 3 'ball'". @pre index < scene.bodies.size()
inline std::string bodyTitle(const Scene& scene, std::size_t index) {
    const std::string& name = scene.bodies[index].name;
    const std::string number = "body " + std::to_string(index);
    return name.empty() ? number : number + " '" + name + "'";
}

}  // namespace cairn
