/// Surfaces of triangles, given by arrays or read from files.
#include "arrays.h"
#include "parts.h"
#include "record.h"

namespace cairn::python {

namespace {

using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

std::vector<TriangleCorners> trianglesFrom(const py::object& source) {
    // Fractions are not to be cut off.
    const py::array given = py::array::ensure(source);
    const bool whole = given && (given.dtype().kind() == 'i' || given.dtype().kind() == 'u');
    const Indices array = whole ? Indices::ensure(given) : Indices();
    if (!whole || array.ndim() != 2 || array.shape(1) != 3) {
        PyErr_Clear();
        throw py::type_error("triangles must be whole numbers of the shape (n, 3)");
    }
    std::vector<TriangleCorners> triangles;
    for (py::ssize_t i = 0; i < array.shape(0); ++i) {
        TriangleCorners& corners = triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t index = array.at(i, static_cast<py::ssize_t>(k));
            if (index < 0 || index > INT64_C(0xffffffff)) {
                throw InputError("triangle " + std::to_string(i) + " of a mesh has the vertex " +
                                 std::to_string(index) + "; indices count from 0 and fit into 32 bits");
            }
            corners[k] = static_cast<std::uint32_t>(index);
        }
    }
    return triangles;
}

py::array trianglesOf(std::span<const TriangleCorners> triangles, const py::object& owner) {
    return shown(triangles.front().data(), triangles.size(), 3, owner);
}

py::array verticesOf(std::span<const Vec3> vertices, const py::object& owner) {
    return shown(vertices.front().data(), vertices.size(), 3, owner);
}

HeightField heightFieldFrom(const py::object& source, const Eigen::Vector2d& spacing) {
    const auto array = Doubles::ensure(source);
    if (!array || array.ndim() != 2) {
        PyErr_Clear();
        throw py::type_error("heights must be numbers of the shape (rows, columns)");
    }
    return HeightField(static_cast<std::size_t>(array.shape(1)), {array.data(), array.data() + array.size()}, spacing);
}

void bindRepairs(py::module_& module) {
    using R = SurfaceRepairs;
    Record<R>(module, "SurfaceRepairs", "What was mended when a surface was built.")
        .field("welded", &R::welded, "Vertices at the place of another one, or of no triangle.")
        .field("degenerate", &R::degenerate, "Triangles without an area, left out.")
        .field("duplicate", &R::duplicate, "Triangles given before, left out.")
        .field("open_edges", &R::open_edges, "Edges without exactly one neighbour of the same orientation.")
        .finish();
}

void bindMesh(py::module_& module) {
    py::class_<Mesh> mesh(module, "Mesh", "A surface of triangles; its body is fixed and may have a motion.");
    mesh.def(py::init(
                 [](const py::object& vertices, const py::object& triangles, SurfaceSides sides, const Vec3& scale) {
                     return Mesh(vectorsFrom(vertices, "vertices"), trianglesFrom(triangles), sides, scale);
                 }),
             py::arg("vertices"), py::arg("triangles"), py::arg("sides") = "one", py::arg("scale") = Vec3(1, 1, 1))
        .def_property_readonly(
            "vertices", [](const py::object& self) { return verticesOf(self.cast<const Mesh&>().vertices(), self); },
            "Those kept, scaled [m], shape (n, 3).")
        .def_property_readonly(
            "triangles", [](const py::object& self) { return trianglesOf(self.cast<const Mesh&>().triangles(), self); },
            "Those kept: indices of vertices, shape (m, 3); the parts of questions.")
        .def_property_readonly("sides", &Mesh::sides, "Which sides touch others.")
        .def_property_readonly("repairs", &Mesh::repairs, "What was mended.")
        .def_property_readonly("bytes", &Mesh::bytes, "Of memory that copies share.");
    finishRecord(mesh, {"vertices", "triangles", "sides"});
}

void bindHeightField(py::module_& module) {
    py::class_<HeightField> field(module, "HeightField",
                                  "Ground given by heights over a grid about the origin; otherwise as a mesh.");
    field.def(py::init(&heightFieldFrom), py::arg("heights"), py::arg("spacing"))
        .def_property_readonly(
            "heights",
            [](const py::object& self) {
                const auto& f = self.cast<const HeightField&>();
                return shown(f.heights().data(), f.rows(), f.columns(), self);
            },
            "[m], shape (rows, columns): rows along y, columns along x.")
        .def_property_readonly("spacing", &HeightField::spacing, "Of columns and rows [m], shape (2,).")
        .def_property_readonly("columns", &HeightField::columns, "Along x.")
        .def_property_readonly("rows", &HeightField::rows, "Along y.")
        .def_property_readonly(
            "vertices",
            [](const py::object& self) { return verticesOf(self.cast<const HeightField&>().vertices(), self); },
            "One per height [m], shape (n, 3).")
        .def_property_readonly(
            "triangles",
            [](const py::object& self) { return trianglesOf(self.cast<const HeightField&>().triangles(), self); },
            "Two per cell: indices of vertices, shape (m, 3); the parts of questions.")
        .def_property_readonly("bytes", &HeightField::bytes, "Of memory that copies share.");
    finishRecord(field, {"heights", "spacing"});
}

void bindDecomposition(py::module_& module) {
    using O = DecompositionOptions;
    Record<O>(module, "DecompositionOptions", "How finely a solid is divided.")
        .field("largest_error", &O::largest_error,
               "By how much the parts together may exceed the volume of the mesh, as a part of it; 0 to 1.")
        .field("most_parts", &O::most_parts, "Which comes before the error; 1 to 1000.")
        .field("hull_if_open", &O::hull_if_open,
               "Takes the hull of a mesh that is not watertight, which is refused otherwise.")
        .finish();
    using D = Decomposition;
    Record<D>(module, "Decomposition", "A solid in convex parts, and how well they fit.")
        .field("compound", &D::compound,
               "Of hulls, in the frame of the mesh, with the mass, centre and inertia of the mesh.")
        .field("volume", &D::volume, "Of the mesh [m³]; where it is taken as its hull, that of the hull.")
        .field("parts_volume", &D::parts_volume, "Of all parts; where two overlap it counts twice [m³].")
        .field("error", &D::error, "parts_volume beyond the volume, as a part of it.")
        .field("turned", &D::turned, "The mesh was inside out: all of its triangles were turned.")
        .field("took_hull", &D::took_hull, "The mesh is not watertight.")
        .finish(1);
    module.def("decompose", &decompose, py::arg("mesh"), py::arg("options") = O{},
               "Divides the solid inside a mesh into convex parts, which leave out nothing of it.");
    module.def("volume_error_of", &volumeErrorOf, py::arg("compound"),
               "By how much the volumes of all parts exceed that of the solid they stand for, as a part of it.");
}

}  // namespace

void bindSurfaces(py::module_& module) {
    bindRepairs(module);
    bindMesh(module);
    bindHeightField(module);
    bindDecomposition(module);
    module.def("read_mesh", &readMesh, py::arg("file"), py::arg("sides") = "one", py::arg("scale") = Vec3(1, 1, 1),
               "Reads a mesh from an STL, OBJ or PLY file.");
    module.def(
        "parse_mesh",
        [](const py::bytes& bytes, const std::string& source, SurfaceSides sides, const Vec3& scale) {
            return parseMesh(std::string_view(bytes), source, sides, scale);
        },
        py::arg("bytes"), py::arg("source"), py::arg("sides") = "one", py::arg("scale") = Vec3(1, 1, 1),
        "The same of a file's content.");
    module.def("read_height_field", &readHeightField, py::arg("file"), py::arg("spacing"), py::arg("scale"),
               "Reads heights from a greyscale PNG whose white is so high [m].");
    module.def(
        "parse_height_field",
        [](const py::bytes& bytes, const std::string& source, const Eigen::Vector2d& spacing, double scale) {
            return parseHeightField(std::string_view(bytes), source, spacing, scale);
        },
        py::arg("bytes"), py::arg("source"), py::arg("spacing"), py::arg("scale"), "The same of a file's content.");
}

}  // namespace cairn::python
