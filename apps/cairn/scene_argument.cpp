#include "scene_argument.h"

#include <fmt/format.h>

namespace cairn::cli {

Scene loadScene(const std::string& argument) {
    if (isBuiltInScene(argument)) return builtInScene(argument);
    if (!std::filesystem::exists(argument)) {
        throw InputError(fmt::format(
            "there is no built-in scene and no file '{}'; 'cairn scenes' lists the built-in scenes", argument));
    }
    return readScene(argument);
}

}  // namespace cairn::cli
