#include "casters.h"

namespace cairn::python {

py::array readOnly(py::array array) {
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}

py::object ofModule(const char* name) {
    return py::module_::import("cairn._core").attr(name);
}

bool readEnum(py::handle source, const char* name, long& value) {
    const py::object type = ofModule(name);
    if (py::isinstance<py::str>(source)) {
        const py::object members = type.attr("__members__");
        if (!members.contains(source)) {
            throw InputError(std::string(name) + " is '" + source.cast<std::string>() + "'; choose one of " +
                             py::str(", ").attr("join")(members).cast<std::string>());
        }
        value = members[source].attr("value").cast<long>();
        return true;
    }
    if (!py::isinstance(source, type)) return false;
    value = source.attr("value").cast<long>();
    return true;
}

}  // namespace cairn::python
