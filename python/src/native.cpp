#include "native.h"

namespace cairn::python {

PyObject* raised() noexcept {
    try {
        // pybind11 knows how exceptions are called in Python, but translates only those that leave functions of its
        // own.
        const py::cpp_function again([] { throw; });
        return PyObject_CallNoArgs(again.ptr());
    } catch (...) {
        PyErr_SetString(PyExc_SystemError, "an exception could not be translated");
        return nullptr;
    }
}

void bindMethod(py::handle type, const char* name, _PyCFunctionFastWithKeywords call, const char* doc) {
    // As long-lived as the class: to the end of the process.
    auto* definition = new PyMethodDef{name, reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(call)),
                                       METH_FASTCALL | METH_KEYWORDS, doc};
    const auto method =
        py::reinterpret_steal<py::object>(PyDescr_NewMethod(reinterpret_cast<PyTypeObject*>(type.ptr()), definition));
    if (!method) throw py::error_already_set();
    py::setattr(type, name, method);
}

std::int64_t countIn(PyObject* const* arguments, Py_ssize_t by_place, PyObject* names, const char* method,
                     const char* name, std::int64_t otherwise) {
    const Py_ssize_t by_name = names == nullptr ? 0 : PyTuple_GET_SIZE(names);
    if (by_place + by_name == 0) return otherwise;
    const auto refuse = [&](const std::string& what) { throw py::type_error(std::string(method) + "() " + what); };
    if (by_place + by_name > 1) refuse("takes one argument, " + std::string(name));
    if (by_name == 1 && py::handle(PyTuple_GET_ITEM(names, 0)).cast<std::string>() != name) {
        refuse("got an argument that it does not have; its argument is " + std::string(name));
    }
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(arguments[0]));
    if (!number) throw py::error_already_set();
    const long long count = PyLong_AsLongLong(number.ptr());
    if (count == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
    return count;
}

}  // namespace cairn::python
