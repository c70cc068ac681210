#include "cli/scene_argument.h"

#include <fmt/format.h>

#include <array>
#include <fstream>

namespace cairn::cli {

namespace {

void requireFile(const std::string& argument) {
    if (std::filesystem::exists(argument)) return;
    throw InputError(
        fmt::format("there is no built-in scene and no file '{}'; 'cairn scenes' lists the built-in scenes", argument));
}

}  // namespace

Scene loadScene(const std::string& argument) {
    if (isBuiltInScene(argument)) return builtInScene(argument);
    requireFile(argument);
    return readScene(argument);
}

SceneSource openScene(const std::string& argument) {
    if (isBuiltInScene(argument)) return builtInSource(argument);
    requireFile(argument);
    return readSceneSource(argument);
}

bool looksLikeRecording(const std::filesystem::path& file) {
    if (file.extension() == ".h5" || file.extension() == ".hdf5") return true;
    std::array<char, 4> begin{};
    std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
    return std::string_view(begin.data(), begin.size()) == "\x89HDF";
}

}  // namespace cairn::cli
