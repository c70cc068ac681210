#include "arrays.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <string>

namespace cairn::python {

namespace {

Doubles rowsOf(py::handle source, py::ssize_t columns, const char* what) {
    Doubles array = Doubles::ensure(source);
    if (array && array.ndim() == 2 && array.shape(1) == columns) return array;
    PyErr_Clear();
    throw py::type_error(std::string(what) + " must be an array of shape (n, " + std::to_string(columns) + ")");
}

/// A member of a struct that becomes a field of a structured array.
struct Column {
    const char* name;
    const char* format;  ///< as numpy writes it
    std::size_t offset;  ///< in the struct
    std::size_t size;    ///< [bytes]
};

/// The fields in order, aligned as in C.
py::dtype dtypeOf(std::span<const Column> columns) {
    py::list fields;
    for (const Column& column : columns) {
        const std::string format = column.format;
        const py::object type = format == "id" ? py::object(idDtype()) : py::str(format);
        fields.append(py::make_tuple(column.name, type));
    }
    return py::module_::import("numpy").attr("dtype")(fields, py::arg("align") = true);
}

/// A copy whose padding is zero, so that equal rows have equal bytes.
py::array rows(const py::dtype& dtype, std::span<const Column> columns, const std::byte* data, std::size_t stride,
               std::size_t count) {
    const py::object offsets = dtype.attr("fields");
    py::array array = py::module_::import("numpy").attr("zeros")(count, dtype);
    const auto row_size = static_cast<std::size_t>(dtype.itemsize());
    for (const Column& column : columns) {
        auto* to =
            static_cast<std::byte*>(array.mutable_data()) + offsets[column.name][py::int_(1)].cast<std::size_t>();
        const std::byte* from = data + column.offset;
        for (std::size_t row = 0; row < count; ++row, to += row_size, from += stride) {
            std::memcpy(to, from, column.size);
        }
    }
    return readOnly(std::move(array));
}

template <class Type>
py::array rowsOfStructs(const char* dtype, std::span<const Column> columns, std::span<const Type> structs) {
    return rows(ofModule(dtype), columns, reinterpret_cast<const std::byte*>(structs.data()), sizeof(Type),
                structs.size());
}

const std::array<Column, 8> contact_columns{{
    {"a", "id", offsetof(ContactInfo, a), sizeof(BodyId)},
    {"b", "id", offsetof(ContactInfo, b), sizeof(BodyId)},
    {"point", "3f8", offsetof(ContactInfo, point), sizeof(Vec3)},
    {"normal", "3f8", offsetof(ContactInfo, normal), sizeof(Vec3)},
    {"distance", "f8", offsetof(ContactInfo, distance), sizeof(double)},
    {"impulse", "3f8", offsetof(ContactInfo, impulse), sizeof(Vec3)},
    {"angular_impulse", "3f8", offsetof(ContactInfo, angular_impulse), sizeof(Vec3)},
    {"batch", "u4", offsetof(ContactInfo, batch), sizeof(std::uint32_t)},
}};

const std::array<Column, 10> event_columns{{
    {"kind", "u1", offsetof(Event, kind), sizeof(EventKind)},
    {"reason", "u1", offsetof(Event, reason), sizeof(WakeReason)},
    {"a", "id", offsetof(Event, a), sizeof(BodyId)},
    {"b", "id", offsetof(Event, b), sizeof(BodyId)},
    {"contacts", "u4", offsetof(Event, contacts), sizeof(std::uint32_t)},
    {"point", "3f8", offsetof(Event, point), sizeof(Vec3)},
    {"normal", "3f8", offsetof(Event, normal), sizeof(Vec3)},
    {"distance", "f8", offsetof(Event, distance), sizeof(double)},
    {"impulse", "3f8", offsetof(Event, impulse), sizeof(Vec3)},
    {"joint", "id", offsetof(Event, joint), sizeof(JointId)},
}};

const std::array<Column, 2> id_columns{{
    {"index", "u4", offsetof(BodyId, index), sizeof(std::uint32_t)},
    {"generation", "u4", offsetof(BodyId, generation), sizeof(std::uint32_t)},
}};

}  // namespace

py::array copied(const std::vector<Vec3>& rows) {
    py::array_t<double> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
    double* to = array.mutable_data();
    for (const Vec3& row : rows) to = std::copy(row.data(), row.data() + 3, to);
    return array;
}

py::array copied(const std::vector<Quat>& rows) {
    py::array_t<double> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{4}});
    double* to = array.mutable_data();
    for (const Quat& q : rows) {
        for (const double component : {q.w(), q.x(), q.y(), q.z()}) *to++ = component;
    }
    return array;
}

std::vector<Vec3> vectorsFrom(py::handle source, const char* what) {
    const Doubles array = rowsOf(source, 3, what);
    std::vector<Vec3> result(static_cast<std::size_t>(array.shape(0)));
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = Eigen::Map<const Vec3>(array.data() + 3 * i);
    return result;
}

std::vector<Quat> quaternionsFrom(py::handle source, const char* what) {
    const Doubles array = rowsOf(source, 4, what);
    std::vector<Quat> result(static_cast<std::size_t>(array.shape(0)));
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double* q = array.data() + 4 * i;
        result[i] = Quat(q[0], q[1], q[2], q[3]);
    }
    return result;
}

std::vector<BodyId> idsFrom(py::handle source) {
    if (!py::isinstance<py::array>(source)) {
        std::vector<BodyId> ids;
        for (const py::handle id : source) ids.push_back(id.cast<BodyId>());
        return ids;
    }
    const auto given = py::reinterpret_borrow<py::array>(source);
    if (!given.dtype().equal(ofModule("body_id_dtype")) || given.ndim() != 1) {
        throw py::type_error("ids must be a sequence of BodyId or a one-dimensional array of body_id_dtype");
    }
    const py::array array = py::array::ensure(source, py::array::c_style);
    std::vector<BodyId> ids(static_cast<std::size_t>(array.shape(0)));
    const auto* from = static_cast<const std::uint32_t*>(array.data());
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = {from[2 * i], from[2 * i + 1]};
    return ids;
}

py::dtype idDtype() {
    return dtypeOf(id_columns);
}

py::dtype contactDtype() {
    return dtypeOf(contact_columns);
}

py::dtype eventDtype() {
    return dtypeOf(event_columns);
}

py::array idArray(const std::vector<BodyId>& ids) {
    return rowsOfStructs<BodyId>("body_id_dtype", id_columns, ids);
}

py::array contactArray(const std::vector<ContactInfo>& contacts) {
    return rowsOfStructs<ContactInfo>("contact_dtype", contact_columns, contacts);
}

py::array eventArray(std::span<const Event> events) {
    return rowsOfStructs<Event>("event_dtype", event_columns, events);
}

}  // namespace cairn::python
