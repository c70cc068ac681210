/// @file Structs of the public interface as frozen records: classes of Python with one read-only property per member,
/// made from values in order or by name, compared by value, shown as written, copied with changes by replace().
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "casters.h"

namespace cairn::python {

/// The fields of a record, whatever its type: what is compiled for each type is little.
struct RecordFields {
    const char* record;
    std::vector<std::string> names;
    std::vector<std::function<void(void* record, py::handle value)>> setters;
    std::size_t required = 0;                               ///< how many of the first have no default
    std::function<void(const std::string& name)> refuse{};  ///< may throw better words for an unknown name
};

/// Sets the fields of a new record. @throws TypeError that names the field
void fillRecord(const RecordFields& fields, void* record, const py::args& args, const py::kwargs& kwargs);

/// Adds a property that is read by a function of the object.
void addProperty(py::object record, const char* name, std::function<py::object(py::handle)> get, const char* doc);

/// Gives a class what all records have. @param fields names of its members, in order
void finishRecord(py::object record, const std::vector<std::string>& fields);

/// @throws TypeError that names the field and the value
[[noreturn]] void refuseField(const char* record, const std::string& field, py::handle value);

template <class Type>
struct IsVector : std::false_type {};
template <class Element>
struct IsVector<std::vector<Element>> : std::true_type {};
template <class Element, std::size_t size>
struct IsVector<std::array<Element, size>> : std::true_type {};

/// Binds a struct, field by field; finish() ends it. Bases are records, too.
template <class Type, class... Bases>
class Record {
  public:
    Record(py::module_& module, const char* name, const char* doc)
        : class_(module, name, doc), fields_(std::make_shared<RecordFields>()) {
        fields_->record = name;
    }

    /// A member; lists become tuples, so that nobody changes a copy in vain.
    template <class Member, class Base>
    Record& field(const char* name, Member Base::*member, const char* doc) {
        return fieldBy(
            name,
            [member](const Type& record) -> py::object {
                py::object value = py::cast(record.*member, py::return_value_policy::copy);
                if constexpr (IsVector<Member>::value) return py::tuple(value);
                return value;
            },
            [member](Type& record, py::handle value) { record.*member = value.cast<Member>(); }, doc);
    }

    /// A member that is read and written in its own way.
    template <class Get, class Set>
    Record& fieldBy(const char* name, Get get, Set set, const char* doc) {
        addProperty(
            class_, name, [get](py::handle self) { return get(self.cast<const Type&>()); }, doc);
        return settable(name, set);
    }

    /// A member that a base reads.
    template <class Member, class Base>
    Record& inherited(const char* name, Member Base::*member) {
        return settable(name, [member](Type& record, py::handle value) { record.*member = value.cast<Member>(); });
    }

    /// @param refuse is called with an unknown name, and may throw better words for it
    Record& refusing(std::function<void(const std::string& name)> refuse) {
        fields_->refuse = std::move(refuse);
        return *this;
    }

    /// @param required how many of the first fields have no default
    py::class_<Type, Bases...>& finish(std::size_t required = 0) {
        fields_->required = required;
        class_.def(py::init([fields = fields_](const py::args& args, const py::kwargs& kwargs) {
            Type record{};
            fillRecord(*fields, &record, args, kwargs);
            return record;
        }));
        finishRecord(class_, fields_->names);
        return class_;
    }

  private:
    template <class Set>
    Record& settable(const char* name, Set set) {
        fields_->names.emplace_back(name);
        fields_->setters.emplace_back(
            [set](void* record, py::handle value) { set(*static_cast<Type*>(record), value); });
        return *this;
    }

    py::class_<Type, Bases...> class_;
    std::shared_ptr<RecordFields> fields_;
};

/// A record as it was given: itself, or what makes one. @throws TypeError, InputError
template <class Type>
Type recordFrom(const py::args& args, const py::kwargs& kwargs) {
    if (args.size() == 1 && kwargs.empty() && py::isinstance<Type>(args[0])) return args[0].cast<Type>();
    return py::type::of<Type>()(*args, **kwargs).template cast<Type>();
}

}  // namespace cairn::python
