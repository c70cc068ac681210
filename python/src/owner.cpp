#include "owner.h"

#include <string_view>

namespace cairn::python {

py::bytes bytesOf(std::span<const std::byte> data) {
    return {reinterpret_cast<const char*>(data.data()), data.size()};
}

py::bytes contiguous(const py::buffer& buffer) {
    PyObject* bytes = PyBytes_FromObject(buffer.ptr());
    if (bytes == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::bytes>(bytes);
}

std::span<const std::byte> bytesIn(const py::bytes& bytes) {
    return std::as_bytes(std::span(std::string_view(bytes)));
}

}  // namespace cairn::python
