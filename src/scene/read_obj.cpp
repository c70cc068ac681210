#include <fmt/format.h>

#include "scene/mesh_reading.h"

namespace cairn {

MeshContent readObj(const MeshText& text) {
    MeshContent content;
    std::vector<std::uint32_t> corners;
    LineReader lines(text);
    while (lines.next()) {
        const std::string_view key = lines.word();
        if (key == "v") content.vertices.push_back(lines.vector());
        if (key != "f") continue;
        corners.clear();
        for (std::string_view word = lines.word(); !word.empty(); word = lines.word()) {
            // Behind a slash stand texture and normal.
            std::string_view rest;
            const std::optional<std::int64_t> index = wholeOf(word, rest);
            if (!index || (!rest.empty() && rest.front() != '/')) {
                lines.refuse(fmt::format("has '{}' where the index of a vertex must be", word.substr(0, 40)));
            }
            // Counted from 1, or backwards from the last vertex so far.
            const auto count = static_cast<std::int64_t>(content.vertices.size());
            const std::int64_t at = *index > 0 ? *index - 1 : count + *index;
            if (*index == 0 || at < 0 || at >= INT64_C(0xffffffff)) {
                lines.refuse(fmt::format("names the vertex {}; indices count from 1, or from −1 backwards", *index));
            }
            corners.push_back(static_cast<std::uint32_t>(at));
        }
        if (corners.size() < 3) lines.refuse("is a face of fewer than three vertices");
        content.addFace(corners);
    }
    if (content.vertices.empty()) text.refuse("is no mesh: it has no vertex; give an STL, OBJ or PLY file");
    return content;
}

}  // namespace cairn
