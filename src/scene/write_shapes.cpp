#include <fmt/format.h>

#include "scene/scene_writing.h"

namespace cairn {
namespace {

using written::arrayText;
using written::inertiaText;
using written::isOmitted;
using written::number;
using written::orientationText;
using written::vector;

std::string shapeText(const Sphere& s) {
    return fmt::format(R"("sphere","radius":{})", number(s.radius));
}
std::string shapeText(const Box& s) {
    return fmt::format(R"("box","size":{})", vector(s.size));
}
std::string shapeText(const Capsule& s) {
    return fmt::format(R"("capsule","radius":{},"length":{})", number(s.radius), number(s.length));
}
std::string shapeText(const Cylinder& s) {
    return fmt::format(R"("cylinder","radius":{},"length":{})", number(s.radius), number(s.length));
}
std::string shapeText(const HalfSpace& s) {
    return fmt::format(R"("plane","normal":{},"offset":{})", vector(s.normal), number(s.offset));
}
std::string shapeText(const ConvexHull& s) {
    return fmt::format(R"("hull","points":{})", arrayText(s.points(), vector));
}

std::string shapeText(const Mesh& s) {
    const auto triangle = [](const TriangleCorners& t) { return fmt::format("[{},{},{}]", t[0], t[1], t[2]); };
    return fmt::format(R"("mesh","vertices":{},"indices":{}{})", arrayText(s.vertices(), vector),
                       arrayText(s.triangles(), triangle), s.sides() == SurfaceSides::two ? R"(,"sides":"two")" : "");
}

std::string shapeText(const HeightField& s) {
    std::string rows;
    for (std::size_t row = 0; row < s.rows(); ++row) {
        if (row > 0) rows += ',';
        rows += arrayText(s.heights().subspan(row * s.columns(), s.columns()), number);
    }
    return fmt::format(R"("height_field","heights":[{}],"spacing":[{},{}])", rows, number(s.spacing().x()),
                       number(s.spacing().y()));
}

std::string shapeText(const Compound& s);

std::string objectText(const Shape& shape) {
    return fmt::format(R"({{"type":{}}})", std::visit([](const auto& s) { return shapeText(s); }, shape));
}

std::string shapeText(const Compound& s) {
    std::string out = R"("compound","parts":[)";
    for (const CompoundPart& part : s.parts) {
        if (out.back() != '[') out += ',';
        out += fmt::format(R"({{"shape":{})", objectText(part.shape));
        if (!isOmitted(part.pose.position)) out += fmt::format(R"(,"position":{})", vector(part.pose.position));
        out += orientationText(part.pose.orientation);
        if (part.mass) out += fmt::format(R"(,"mass":{})", number(*part.mass));
        if (part.density) out += fmt::format(R"(,"density":{})", number(*part.density));
        out += '}';
    }
    out += ']';
    if (s.solid) {
        out += fmt::format(R"(,"solid":{{"volume":{},"centre_of_mass":{},"inertia":{}}})", number(s.solid->volume),
                           vector(s.solid->centre), inertiaText(s.solid->inertia));
    }
    return out;
}

/// What copies of a shape share; none if there is nothing.
const void* dataOf(const Shape& shape) {
    if (const auto* hull = std::get_if<ConvexHull>(&shape)) return &hull->data();
    if (const auto* mesh = std::get_if<Mesh>(&shape)) return &mesh->data();
    if (const auto* field = std::get_if<HeightField>(&shape)) return &field->data();
    return nullptr;
}

/// Whether a shape is worth a name: the others have fewer numbers than a position and an orientation.
bool isLong(const Shape& shape) {
    return dataOf(shape) != nullptr || std::holds_alternative<Compound>(shape);
}

}  // namespace

WrittenShapes::WrittenShapes(const SceneSource::Tell& bodies) {
    bodies([this](const SceneBody& body) {
        if (!isLong(body.shape)) return;
        const void* data = dataOf(body.shape);
        if (data != nullptr && !by_data_.contains(data)) by_data_.emplace(data, objectText(body.shape));
        const std::string text = data != nullptr ? by_data_.at(data) : objectText(body.shape);
        if (++counts_[text] != 2) return;
        order_.push_back(text);
        names_.emplace(text, fmt::format("\"shape {}\"", order_.size()));
    });
}

std::string WrittenShapes::textOf(const Shape& shape) const {
    if (!isLong(shape)) return objectText(shape);
    const auto known = by_data_.find(dataOf(shape));
    const std::string text = known != by_data_.end() ? known->second : objectText(shape);
    const auto name = names_.find(text);
    return name != names_.end() ? name->second : text;
}

std::string WrittenShapes::shared() const {
    std::string out;
    for (const std::string& text : order_) {
        out += fmt::format("{}\n{}:{}", out.empty() ? "" : ",", names_.at(text), text);
    }
    return out.empty() ? out : "{" + out + "\n}";
}

}  // namespace cairn
