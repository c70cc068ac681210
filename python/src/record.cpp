#include "record.h"

#include <algorithm>

namespace cairn::python {

namespace {

/// Whether two values of fields are the same; arrays are compared as a whole, NaN equals NaN.
bool equal(const py::object& a, const py::object& b) {
    if (py::isinstance<py::array>(a) && py::isinstance<py::array>(b)) {
        const bool numbers = a.attr("dtype").attr("kind").cast<std::string>() == "f";
        return py::module_::import("numpy").attr("array_equal")(a, b, py::arg("equal_nan") = numbers).cast<bool>();
    }
    if (py::isinstance<py::tuple>(a) && py::isinstance<py::tuple>(b)) {
        if (py::len(a) != py::len(b)) return false;
        for (std::size_t i = 0; i < py::len(a); ++i) {
            if (!equal(a[py::int_(i)], b[py::int_(i)])) return false;
        }
        return true;
    }
    return a.equal(b);
}

py::tuple valuesOf(const py::object& self) {
    const py::tuple names = py::type::of(self).attr("__match_args__");
    py::tuple values(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) values[i] = self.attr(names[i]);
    return values;
}

py::str show(const py::object& self) {
    const py::tuple names = py::type::of(self).attr("__match_args__");
    std::string text = py::type::of(self).attr("__name__").cast<std::string>() + "(";
    for (std::size_t i = 0; i < names.size(); ++i) {
        py::object value = self.attr(names[i]);
        if (py::isinstance<py::array>(value)) value = value.attr("tolist")();
        text += (i > 0 ? ", " : "") + names[i].cast<std::string>() + "=" + py::repr(value).cast<std::string>();
    }
    return text + ")";
}

py::object replaced(const py::object& self, const py::kwargs& changes) {
    const py::tuple names = py::type::of(self).attr("__match_args__");
    py::dict values(changes);
    for (const py::handle name : names) {
        if (!values.contains(name)) values[name] = self.attr(name);
    }
    return py::type::of(self)(**values);
}

}  // namespace

void fillRecord(const RecordFields& fields, void* record, const py::args& args, const py::kwargs& kwargs) {
    const std::string called = fields.record;
    const auto set = [&](std::size_t i, py::handle value) {
        try {
            fields.setters[i](record, value);
        } catch (const py::cast_error&) {
            refuseField(fields.record, fields.names[i], value);
        }
    };
    if (args.size() > fields.names.size()) {
        throw py::type_error(called + " takes at most " + std::to_string(fields.names.size()) + " values");
    }
    for (std::size_t i = 0; i < args.size(); ++i) set(i, args[i]);
    for (std::size_t i = args.size(); i < fields.required; ++i) {
        if (kwargs.contains(fields.names[i])) continue;
        throw py::type_error(called + " needs the field '" + fields.names[i] + "'");
    }
    for (const auto& [key, value] : kwargs) {
        const auto name = key.cast<std::string>();
        const auto i = static_cast<std::size_t>(std::ranges::find(fields.names, name) - fields.names.begin());
        if (i == fields.names.size()) {
            if (fields.refuse) fields.refuse(name);
            throw py::type_error(called + " has no field '" + name + "'");
        }
        if (i < args.size()) throw py::type_error(called + " was given '" + name + "' twice");
        set(i, value);
    }
}

void addProperty(py::object record, const char* name, std::function<py::object(py::handle)> get, const char* doc) {
    const py::cpp_function getter(std::move(get), py::is_method(record));
    record.attr(name) = py::module_::import("builtins").attr("property")(getter, py::none(), py::none(), doc);
}

void finishRecord(py::object record, const std::vector<std::string>& fields) {
    const auto method = [&](const char* name, auto function, const char* doc) {
        record.attr(name) = py::cpp_function(function, py::name(name), py::is_method(record), doc);
    };
    py::tuple names(fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i) names[i] = fields[i];
    record.attr("__match_args__") = names;
    record.attr("__hash__") = py::none();
    method("__repr__", &show, "As it would be written.");
    method("replace", &replaced, "A copy in which the named fields have other values.");
    method(
        "__eq__",
        [](const py::object& self, const py::object& other) -> py::object {
            if (!py::type::of(self).is(py::type::of(other))) {
                return py::reinterpret_borrow<py::object>(Py_NotImplemented);
            }
            return py::bool_(equal(valuesOf(self), valuesOf(other)));
        },
        "Whether all fields are equal.");
    method(
        "__reduce__", [](const py::object& self) { return py::make_tuple(py::type::of(self), valuesOf(self)); },
        "For pickle and copy.");
}

void refuseField(const char* record, const std::string& field, py::handle value) {
    throw py::type_error(std::string(record) + "." + field + " cannot be " + py::repr(value).cast<std::string>());
}

}  // namespace cairn::python
