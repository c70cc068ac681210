/// @file Readers of files of meshes, one per format.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/shape.h"

namespace cairn {

/// What a file of a mesh holds.
struct MeshContent {
    std::vector<Vec3> vertices;
    std::vector<TriangleCorners> triangles;

    /// A face of three and more corners, as a fan. @param corners indices of vertices
    void addFace(const std::vector<std::uint32_t>& corners);
};

/// A file that is read.
struct MeshText {
    std::string_view bytes;
    std::string_view source;  ///< shown in messages

    /// @throws InputError always: "SOURCE: TEXT"
    [[noreturn]] void refuse(std::string_view text) const;
    /// @param line counts from 1
    [[noreturn]] void refuseLine(std::size_t line, std::string_view text) const;
};

/// The lines of a text and the words of each.
class LineReader {
  public:
    explicit LineReader(const MeshText& text) : text_(&text), left_(text.bytes) {}

    /// Goes to the next line. @return false after the last
    bool next();
    /// The next word of the line; empty after the last.
    std::string_view word();
    /// The next word of the line as a number. @throws InputError with the line if it is none
    double number();
    Vec3 vector() {
        const double x = number();
        const double y = number();
        return {x, y, number()};
    }
    /// The next word as a whole number. @throws InputError
    std::int64_t whole();
    [[noreturn]] void refuse(std::string_view text) const { text_->refuseLine(line_, text); }
    /// Where the next line begins.
    std::size_t position() const { return static_cast<std::size_t>(left_.data() - text_->bytes.data()); }

  private:
    const MeshText* text_;
    std::string_view left_;
    std::string_view words_;
    std::size_t line_ = 0;
};

/// A whole number at the beginning of a word. @param rest what follows it
std::optional<std::int64_t> wholeOf(std::string_view word, std::string_view& rest);

/// Whether a file has the length that it names as a binary STL, whose head has any content.
bool isBinaryStl(const MeshText& text);
MeshContent readStl(const MeshText& text);
MeshContent readObj(const MeshText& text);
MeshContent readPly(const MeshText& text);

/// The content of a file. @param kind of file, for the message @throws IoError
std::string fileContent(const std::string& file, std::string_view kind);

}  // namespace cairn
