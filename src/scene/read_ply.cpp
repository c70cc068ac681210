#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "scene/mesh_reading.h"

namespace cairn {

namespace {

/// Names of a type of numbers, and its size [bytes].
struct PlyType {
    std::string_view name, other_name;
    std::size_t size;
    double (*read)(const char*);
};

template <class T>
double readAs(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

constexpr std::array<PlyType, 8> ply_types = {{{"char", "int8", 1, readAs<std::int8_t>},
                                               {"uchar", "uint8", 1, readAs<std::uint8_t>},
                                               {"short", "int16", 2, readAs<std::int16_t>},
                                               {"ushort", "uint16", 2, readAs<std::uint16_t>},
                                               {"int", "int32", 4, readAs<std::int32_t>},
                                               {"uint", "uint32", 4, readAs<std::uint32_t>},
                                               {"float", "float32", 4, readAs<float>},
                                               {"double", "float64", 8, readAs<double>}}};

struct PlyProperty {
    std::string name;
    const PlyType* type = nullptr;
    const PlyType* count = nullptr;  ///< of a list
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHead {
    bool is_text = true;
    std::vector<PlyElement> elements;
    std::size_t end = 0;  ///< where the numbers begin
};

const PlyType* typeNamed(LineReader& lines) {
    const std::string_view name = lines.word();
    const auto* type =
        std::ranges::find_if(ply_types, [&](const PlyType& t) { return t.name == name || t.other_name == name; });
    if (type == ply_types.end()) lines.refuse(fmt::format("has the unknown type '{}'", name.substr(0, 40)));
    return type;
}

void readFormat(LineReader& lines, PlyHead& head) {
    const std::string_view format = lines.word();
    head.is_text = format == "ascii";
    if (head.is_text || format == "binary_little_endian") return;
    lines.refuse(
        fmt::format("has the format '{}'; save the file as ascii or binary_little_endian", format.substr(0, 40)));
}

void readProperty(LineReader& lines, PlyHead& head) {
    if (head.elements.empty()) lines.refuse("is a property of no element");
    PlyProperty property;
    property.type = typeNamed(lines);
    property.name = lines.word();
    head.elements.back().properties.push_back(std::move(property));
}

void readList(LineReader& lines, PlyHead& head) {
    if (head.elements.empty()) lines.refuse("is a property of no element");
    PlyProperty property;
    property.count = typeNamed(lines);
    property.type = typeNamed(lines);
    property.name = lines.word();
    head.elements.back().properties.push_back(std::move(property));
}

PlyHead readHead(const MeshText& text) {
    PlyHead head;
    bool formatted = false;
    LineReader lines(text);
    while (lines.next()) {
        LineReader ahead = lines;
        const std::string_view key = lines.word();
        if (key == "format") {
            readFormat(lines, head);
            formatted = true;
        } else if (key == "element") {
            PlyElement& element = head.elements.emplace_back();
            element.name = lines.word();
            const std::int64_t count = lines.whole();
            if (count < 0) lines.refuse("has a number of elements below 0");
            element.count = static_cast<std::size_t>(count);
        } else if (key == "property") {
            ahead.word();
            if (ahead.word() == "list") {
                lines.word();
                readList(lines, head);
            } else {
                readProperty(lines, head);
            }
        } else if (key == "end_header") {
            if (!formatted) text.refuse("is a PLY file without a format");
            head.end = lines.position();
            return head;
        }
    }
    text.refuse("is a PLY file whose head does not end");
}

/// The numbers behind the head, one after the other.
class PlyNumbers {
  public:
    PlyNumbers(const MeshText& text, const PlyHead& head)
        : body_{text.bytes.substr(head.end), text.source}, is_text_(head.is_text), lines_(body_) {}

    /// @throws InputError behind the last one
    double next(const PlyType& type) {
        if (is_text_) return nextOfText();
        if (body_.bytes.size() - at_ < type.size) refuseEnd();
        at_ += type.size;
        return type.read(body_.bytes.data() + at_ - type.size);
    }

  private:
    double nextOfText() {
        for (;;) {
            LineReader before = lines_;
            if (begun_ && !lines_.word().empty()) {
                lines_ = before;
                return lines_.number();
            }
            if (!lines_.next()) refuseEnd();
            begun_ = true;
        }
    }
    [[noreturn]] void refuseEnd() const {
        body_.refuse("ends before the elements that its head names; the file is not complete");
    }

    MeshText body_;
    bool is_text_;
    LineReader lines_;
    bool begun_ = false;
    std::size_t at_ = 0;
};

std::uint32_t indexOf(const MeshText& text, double value) {
    if (value >= 0 && value < 4294967295.0) return static_cast<std::uint32_t>(value);
    text.refuse(fmt::format("has a face with the vertex {}; indices count from 0", value));
}

}  // namespace

MeshContent readPly(const MeshText& text) {
    const PlyHead head = readHead(text);
    PlyNumbers numbers(text, head);
    MeshContent content;
    std::vector<std::uint32_t> corners;
    for (const PlyElement& element : head.elements) {
        const bool is_vertex = element.name == "vertex";
        // An element without properties takes no bytes, and any number of them may be named.
        for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
            Vec3 vertex = Vec3::Zero();
            corners.clear();
            for (const PlyProperty& property : element.properties) {
                const bool is_face = property.name == "vertex_indices" || property.name == "vertex_index";
                const double count = property.count != nullptr ? numbers.next(*property.count) : 1;
                if (!(count >= 0)) text.refuse("has a list of fewer than 0 numbers");
                for (double k = 0; k < count; ++k) {
                    const double value = numbers.next(*property.type);
                    if (is_face && property.count != nullptr) corners.push_back(indexOf(text, value));
                    if (is_vertex && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') {
                        vertex[property.name[0] - 'x'] = value;
                    }
                }
            }
            if (is_vertex) content.vertices.push_back(vertex);
            content.addFace(corners);
        }
    }
    return content;
}

}  // namespace cairn
