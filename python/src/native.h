/// @file Calls that a loop makes in every step. On pybind11's way from a call to its function lies memory that a step
/// has driven out of the caches, which takes microseconds; these go there at once. All else is bound with pybind11.
#pragma once

#include "casters.h"

namespace cairn::python {

/// What an object of one of our classes holds. @throws TypeError for one whose __init__ was not called
template <class Held>
Held& heldBy(PyObject* object) {
    const auto* instance = reinterpret_cast<const py::detail::instance*>(object);
    // Of a class with several of ours among its bases pybind11 knows which one is meant.
    if (!instance->simple_layout) return py::handle(object).cast<Held&>();
    void* const held = instance->simple_value_holder[0];
    if (held == nullptr) throw py::type_error("the object is not there yet; its __init__ must be called first");
    return *static_cast<Held*>(held);
}

/// Sets Python's error for the exception that is being handled. @return null
PyObject* raised() noexcept;

/// A property of a class. @param get its value, a py::object, from what an object holds
template <class Held, auto get>
void bindGetter(const py::class_<Held>& type, const char* name, const char* doc) {
    const getter call = [](PyObject* self, void*) -> PyObject* {
        try {
            return get(heldBy<Held>(self)).release().ptr();
        } catch (...) {
            return raised();
        }
    };
    // As long-lived as the class: to the end of the process.
    auto* definition = new PyGetSetDef{name, call, nullptr, doc, nullptr};
    const auto property =
        py::reinterpret_steal<py::object>(PyDescr_NewGetSet(reinterpret_cast<PyTypeObject*>(type.ptr()), definition));
    if (!property) throw py::error_already_set();
    py::setattr(type, name, property);
}

/// A method of a class. @param call handed its arguments as they are @param doc begins with the signature
void bindMethod(py::handle type, const char* name, _PyCFunctionFastWithKeywords call, const char* doc);

/// The only argument of a method, a number. @param names of the arguments that were given by name, or null
/// @param otherwise what it is if it was left out @throws TypeError, OverflowError
std::int64_t countIn(PyObject* const* arguments, Py_ssize_t by_place, PyObject* names, const char* method,
                     const char* name, std::int64_t otherwise);

}  // namespace cairn::python
