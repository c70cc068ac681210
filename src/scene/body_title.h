/// @file How messages name a body of a scene.
#pragma once

#include <string>

#include "cairn/scene.h"

namespace cairn {

/// Such as "body 3 'ball'". @param index of the body in the scene
inline std::string bodyTitle(const SceneBody& body, std::size_t index) {
    const std::string number = "body " + std::to_string(index);
    return body.name.empty() ? number : number + " '" + body.name + "'";
}

}  // namespace cairn
