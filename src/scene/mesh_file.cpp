#include "cairn/mesh_file.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <system_error>

#include "scene/mesh_reading.h"

namespace cairn {

namespace {

/// Largest file that is read [bytes]: about eighty million triangles.
constexpr std::uintmax_t largest_mesh_file = std::uintmax_t{4} << 30U;

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

MeshContent readAny(const MeshText& text) {
    if (text.bytes.starts_with("ply\n") || text.bytes.starts_with("ply\r")) return readPly(text);
    if (isBinaryStl(text) || text.bytes.starts_with("solid")) return readStl(text);
    if (text.bytes.find('\0') != std::string_view::npos) {
        text.refuse("is no mesh: neither PLY nor an STL of the length that it says; give an STL, OBJ or PLY file");
    }
    return readObj(text);
}

}  // namespace

void MeshContent::addFace(const std::vector<std::uint32_t>& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void MeshText::refuse(std::string_view text) const {
    throw InputError(fmt::format("{}: {}", source, text));
}

void MeshText::refuseLine(std::size_t line, std::string_view text) const {
    throw InputError(fmt::format("{}: line {} {}", source, line, text));
}

bool LineReader::next() {
    if (left_.empty()) return false;
    const std::size_t end = left_.find('\n');
    words_ = left_.substr(0, end);
    left_.remove_prefix(end == std::string_view::npos ? left_.size() : end + 1);
    ++line_;
    return true;
}

std::string_view LineReader::word() {
    while (!words_.empty() && isBlank(words_.front())) words_.remove_prefix(1);
    std::size_t end = 0;
    while (end < words_.size() && !isBlank(words_[end])) ++end;
    const std::string_view result = words_.substr(0, end);
    words_.remove_prefix(end);
    return result;
}

double LineReader::number() {
    std::string_view text = word();
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
        refuse(fmt::format("has '{}' where a number must be", text.substr(0, 40)));
    }
    return value;
}

std::int64_t LineReader::whole() {
    const std::string_view text = word();
    std::string_view rest;
    const std::optional<std::int64_t> value = wholeOf(text, rest);
    if (!value || !rest.empty()) refuse(fmt::format("has '{}' where a whole number must be", text.substr(0, 40)));
    return *value;
}

std::optional<std::int64_t> wholeOf(std::string_view word, std::string_view& rest) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    rest = word.substr(static_cast<std::size_t>(end - word.data()));
    if (error != std::errc()) return {};
    return value;
}

std::string fileContent(const std::string& file, std::string_view kind) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);  // fails for what is no regular file
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream) {
        throw IoError(fmt::format("{}: cannot be read ({}); give the path of {}", file,
                                  error ? error.message() : "not readable", kind));
    }
    if (size > largest_mesh_file) {
        throw InputError(fmt::format("{}: the file has {} bytes; at most {} are read", file, size, largest_mesh_file));
    }
    std::string content(size, '\0');
    stream.read(content.data(), static_cast<std::streamsize>(size));
    content.resize(static_cast<std::size_t>(stream.gcount()));
    return content;
}

Mesh parseMesh(std::string_view bytes, std::string_view source, SurfaceSides sides, const Vec3& scale) {
    const MeshText text{bytes, source};
    MeshContent content = readAny(text);
    try {
        return Mesh(std::move(content.vertices), std::move(content.triangles), sides, scale);
    } catch (const InputError& error) {
        text.refuse(error.what());
    }
}

Mesh readMesh(const std::filesystem::path& file, SurfaceSides sides, const Vec3& scale) {
    return parseMesh(fileContent(file.string(), "an STL, OBJ or PLY file"), file.string(), sides, scale);
}

}  // namespace cairn
