#include <cstring>

#include "scene/mesh_reading.h"

namespace cairn {

namespace {

Vec3 floatsAt(const char* bytes) {
    std::array<float, 3> values;
    std::memcpy(values.data(), bytes, sizeof values);
    return {values[0], values[1], values[2]};
}

/// Corners that stand one after the other, three to a triangle; a mesh welds them.
void addCorners(MeshContent& content, const std::array<Vec3, 3>& corners) {
    const auto first = static_cast<std::uint32_t>(content.vertices.size());
    content.vertices.insert(content.vertices.end(), corners.begin(), corners.end());
    content.triangles.push_back({first, first + 1, first + 2});
}

constexpr std::size_t stl_head = 84;
constexpr std::size_t stl_triangle = 50;  ///< normal, three corners, two bytes

MeshContent readBinaryStl(const MeshText& text) {
    constexpr std::size_t corner = 12;
    MeshContent content;
    const std::size_t count = (text.bytes.size() - stl_head) / stl_triangle;
    content.vertices.reserve(3 * count);
    content.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const char* at = text.bytes.data() + stl_head + i * stl_triangle + corner;
        addCorners(content, {floatsAt(at), floatsAt(at + corner), floatsAt(at + 2 * corner)});
    }
    return content;
}

}  // namespace

bool isBinaryStl(const MeshText& text) {
    if (text.bytes.size() < stl_head) return false;
    const auto* count = reinterpret_cast<const unsigned char*>(text.bytes.data()) + 80;
    const std::uint64_t named = count[0] | count[1] << 8U | count[2] << 16U | std::uint64_t{count[3]} << 24U;
    return text.bytes.size() == stl_head + named * stl_triangle;
}

MeshContent readStl(const MeshText& text) {
    if (isBinaryStl(text)) return readBinaryStl(text);
    if (text.bytes.find('\0') != std::string_view::npos) {
        text.refuse("is an STL that has not the length that it says; the file is not complete");
    }
    MeshContent content;
    std::array<Vec3, 3> corners;
    std::size_t count = 0;
    LineReader lines(text);
    while (lines.next()) {
        const std::string_view word = lines.word();
        if (word == "vertex") {
            if (count == 3) lines.refuse("is the fourth vertex of a facet; a facet has three");
            corners[count++] = lines.vector();
        } else if (word == "endfacet") {
            if (count != 3) lines.refuse("ends a facet that has no three vertices");
            addCorners(content, corners);
            count = 0;
        }
    }
    if (count > 0) text.refuse("ends within a facet; the file is not complete");
    return content;
}

}  // namespace cairn
