/// @file Arrays of numpy that show or copy arrays of C++.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "casters.h"

namespace cairn::python {

/// A read-only array over memory that lives as long as it does. @param rows of it @param columns of each; 0 = numbers
template <class Number>
py::array shown(const Number* data, std::size_t rows, std::size_t columns, const py::object& owner) {
    const auto size = static_cast<py::ssize_t>(sizeof(Number));
    const auto n = static_cast<py::ssize_t>(rows);
    const auto m = static_cast<py::ssize_t>(columns);
    if (columns == 0) return readOnly(py::array(py::dtype::of<Number>(), {n}, {size}, data, owner));
    return readOnly(py::array(py::dtype::of<Number>(), {n, m}, {m * size, size}, data, owner));
}

/// A copy of vectors, quaternions (w, x, y, z) or numbers, one a row.
py::array copied(const std::vector<Vec3>& rows);
py::array copied(const std::vector<Quat>& rows);
template <class Number>
py::array copied(const std::vector<Number>& numbers) {
    return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

/// Rows of an array-like of shape (n, 3) or (n, 4). @throws TypeError that names what it is for
std::vector<Vec3> vectorsFrom(py::handle source, const char* what);
std::vector<Quat> quaternionsFrom(py::handle source, const char* what);
template <class Number>
std::vector<Number> numbersFrom(py::handle source, const char* what) {
    const auto array = py::array_t<Number, py::array::c_style | py::array::forcecast>::ensure(source);
    if (!array || array.ndim() != 1) {
        PyErr_Clear();
        throw py::type_error(std::string(what) + " must be a sequence of numbers");
    }
    return {array.data(), array.data() + array.size()};
}

/// Ids of bodies: a sequence of them, or an array as Bodies.id. @throws TypeError
std::vector<BodyId> idsFrom(py::handle source);

/// The data types of the structured arrays; their fields are named as the members in C++.
py::dtype idDtype();
py::dtype contactDtype();
py::dtype eventDtype();
py::array idArray(const std::vector<BodyId>& ids);
py::array contactArray(const std::vector<ContactInfo>& contacts);
py::array eventArray(std::span<const Event> events);

}  // namespace cairn::python
