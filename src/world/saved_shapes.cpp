#include "world/saved_shapes.h"

#include <array>
#include <cmath>

#include "geometry/geometry.h"

namespace cairn {

namespace {

/// In place of the index of a compound that stands for a solid.
constexpr std::uint8_t solid_compound = 9;

/// The dimensions of a shape.
using ShapeNumbers = std::array<double, 4>;

void putOptional(const std::optional<double>& value, ByteWriter& out) {
    out.put(static_cast<std::uint8_t>(value.has_value()));
    out.put(value.value_or(0));
}

std::optional<double> getOptional(ByteReader& in) {
    const bool given = in.get<std::uint8_t>() != 0;
    const auto value = in.get<double>();
    return given ? std::optional(value) : std::nullopt;
}

struct SaveShape {
    ByteWriter& out;

    void numbers(const ShapeNumbers& values) const {
        for (const double value : values) out.put(value);
    }
    void operator()(const Sphere& s) const { numbers({s.radius}); }
    void operator()(const Box& b) const { numbers({b.size.x(), b.size.y(), b.size.z()}); }
    void operator()(const Capsule& c) const { numbers({c.radius, c.length}); }
    void operator()(const HalfSpace& h) const { numbers({h.normal.x(), h.normal.y(), h.normal.z(), h.offset}); }
    void operator()(const Cylinder& c) const { numbers({c.radius, c.length}); }
    void operator()(const ConvexHull& hull) const { out.putArray(hull.points()); }
    void operator()(const Compound& compound) const {
        out.put(std::uint64_t{compound.parts.size()});
        for (const CompoundPart& part : compound.parts) {
            saveShape(part.shape, out);
            out.put(part.pose.position);
            out.put(part.pose.orientation);
            putOptional(part.mass, out);
            putOptional(part.density, out);
        }
        if (!compound.solid) return;
        out.put(compound.solid->volume);
        out.put(compound.solid->centre);
        out.put(compound.solid->inertia);
    }
    void operator()(const Mesh& mesh) const {
        out.put(mesh.sides());
        out.putArray(mesh.vertices());
        out.putArray(mesh.triangles());
    }
    void operator()(const HeightField& field) const {
        out.put(std::uint64_t{field.columns()});
        out.put(field.spacing().x());
        out.put(field.spacing().y());
        out.putArray(field.heights());
    }
};

/// Does what refuses a shape, with the offset in its message.
template <class Use>
void sound(const ByteReader& in, const Use& use) {
    try {
        use();
    } catch (const InputError& error) {
        in.refuse(error.what());
    }
}

Shape loadHull(ByteReader& in) {
    std::vector<Vec3> points;
    in.getArray(points);
    std::optional<Shape> hull;
    sound(in, [&] { hull = ConvexHull(std::move(points)); });
    return *hull;
}

Shape loadMesh(ByteReader& in) {
    const auto sides = in.getEnum(SurfaceSides::two);
    std::vector<Vec3> vertices;
    std::vector<TriangleCorners> triangles;
    in.getArray(vertices);
    in.getArray(triangles);
    std::optional<Shape> mesh;
    sound(in, [&] { mesh = Mesh(std::move(vertices), std::move(triangles), sides); });
    return *mesh;
}

Shape loadHeightField(ByteReader& in) {
    const auto columns = in.get<std::uint64_t>();
    const auto column_spacing = in.get<double>();
    const auto row_spacing = in.get<double>();
    std::vector<double> heights;
    in.getArray(heights);
    std::optional<Shape> field;
    sound(in, [&] { field = HeightField(columns, std::move(heights), {column_spacing, row_spacing}); });
    return *field;
}

/// Parts hold no compounds, so that damaged bytes cannot nest without end.
enum class Nesting { allowed, refused };

Shape load(ByteReader& in, Nesting nesting);

Compound loadCompound(ByteReader& in) {
    Compound compound;
    for (auto left = in.get<std::uint64_t>(); left > 0; --left) {
        CompoundPart part{load(in, Nesting::refused), {}, {}, {}};
        part.pose.position = in.get<Vec3>();
        part.pose.orientation = in.get<Quat>();
        part.mass = getOptional(in);
        part.density = getOptional(in);
        compound.parts.push_back(std::move(part));
    }
    return compound;
}

Compound loadSolidCompound(ByteReader& in) {
    Compound compound = loadCompound(in);
    SolidProperties& solid = compound.solid.emplace();
    solid.volume = in.get<double>();
    solid.centre = in.get<Vec3>();
    solid.inertia = in.get<Mat3>();
    return compound;
}

Shape load(ByteReader& in, Nesting nesting) {
    const auto kind = in.get<std::uint8_t>();
    if (kind == 5) return loadHull(in);
    if (kind == 6 && nesting == Nesting::allowed) return loadCompound(in);
    if (kind == 7 && nesting == Nesting::allowed) return loadMesh(in);
    if (kind == 8 && nesting == Nesting::allowed) return loadHeightField(in);
    if (kind == solid_compound && nesting == Nesting::allowed) return loadSolidCompound(in);
    if (kind > 4) in.refuse("an unknown kind of shape");
    ShapeNumbers n{};
    for (double& number : n) number = in.get<double>();
    switch (kind) {
        case 0:
            return Sphere{n[0]};
        case 1:
            return Box{Vec3(n[0], n[1], n[2])};
        case 2:
            return Capsule{n[0], n[1]};
        case 3:
            return HalfSpace{Vec3(n[0], n[1], n[2]), n[3]};
        default:
            return Cylinder{n[0], n[1]};
    }
}

}  // namespace

void saveShape(const Shape& shape, ByteWriter& out) {
    const auto* compound = std::get_if<Compound>(&shape);
    const bool solid = compound != nullptr && compound->solid;
    out.put(solid ? solid_compound : static_cast<std::uint8_t>(shape.index()));
    std::visit(SaveShape{out}, shape);
}

Shape loadShape(ByteReader& in) {
    Shape shape = load(in, Nesting::allowed);
    sound(in, [&] { validateShape(shape); });
    indexParts(shape);
    return shape;
}

}  // namespace cairn
