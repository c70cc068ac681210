/// @file How values of the public interface become Python's and back: vectors, matrices and quaternions as read-only
/// numpy arrays, enumerations as Python's own enums, which may also be given by name.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/cairn.h"

namespace cairn::python {

namespace py = pybind11;

/// Numbers of any array-like, in C order.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Takes the right to write from an array.
py::array readOnly(py::array array);

/// What this module has under a name.
py::object ofModule(const char* name);

/// The number of an enum's member, or of the member with a name. @throws InputError for an unknown name
/// @return whether the object is a member or a name
bool readEnum(py::handle source, const char* name, long& value);

/// What the Python class of an enumeration is called; each has a specialisation below.
template <class Enum>
inline constexpr const char* enum_name = nullptr;

template <>
inline constexpr const char* enum_name<BodyKind> = "BodyKind";
template <>
inline constexpr const char* enum_name<WakeReason> = "WakeReason";
template <>
inline constexpr const char* enum_name<EventKind> = "EventKind";
template <>
inline constexpr const char* enum_name<EventLevel> = "EventLevel";
template <>
inline constexpr const char* enum_name<JointKind> = "JointKind";
template <>
inline constexpr const char* enum_name<JointAlong> = "JointAlong";
template <>
inline constexpr const char* enum_name<Preset> = "Preset";
template <>
inline constexpr const char* enum_name<CorrectionKind> = "CorrectionKind";
template <>
inline constexpr const char* enum_name<ResolutionKind> = "ResolutionKind";
template <>
inline constexpr const char* enum_name<RestitutionLaw> = "RestitutionLaw";
template <>
inline constexpr const char* enum_name<RestitutionSpeed> = "RestitutionSpeed";
template <>
inline constexpr const char* enum_name<Impacts> = "Impacts";
template <>
inline constexpr const char* enum_name<Stage> = "Stage";
template <>
inline constexpr const char* enum_name<DiagnosticsField::Fold> = "Fold";
template <>
inline constexpr const char* enum_name<Touch> = "Touch";
template <>
inline constexpr const char* enum_name<TableEnd> = "TableEnd";
template <>
inline constexpr const char* enum_name<Baseline> = "Baseline";
template <>
inline constexpr const char* enum_name<DriveOf> = "DriveOf";
template <>
inline constexpr const char* enum_name<SurfaceSides> = "SurfaceSides";
template <>
inline constexpr const char* enum_name<Tracing> = "Tracing";
template <>
inline constexpr const char* enum_name<Checks> = "Checks";

template <class Enum>
concept NamedEnum = std::is_enum_v<Enum> && enum_name<Enum>
!= nullptr;

}  // namespace cairn::python

namespace pybind11::detail {

/// Fixed-size Eigen types and quaternions from any array-like of the right shape.
template <class Value, int rows, int columns>
struct ArrayCaster {
    PYBIND11_TYPE_CASTER(Value, const_name("numpy.ndarray"));

    bool load(handle source, bool /*convert*/) {
        const auto array = cairn::python::Doubles::ensure(source);
        if (!array) {
            PyErr_Clear();
            return false;
        }
        const bool fits = columns == 1 ? array.ndim() == 1 && array.shape(0) == rows
                                       : array.ndim() == 2 && array.shape(0) == rows && array.shape(1) == columns;
        if (!fits) return false;
        assign(array.data());
        return true;
    }

    static handle cast(const Value& from, return_value_policy /*policy*/, handle /*parent*/) {
        std::vector<ssize_t> shape{rows};
        if (columns > 1) shape.push_back(columns);
        array_t<double> array(shape);
        write(from, array.mutable_data());
        return cairn::python::readOnly(std::move(array)).release();
    }

  private:
    void assign(const double* data) {
        if constexpr (std::is_same_v<Value, cairn::Quat>) {
            value = cairn::Quat(data[0], data[1], data[2], data[3]);
        } else {
            value = Eigen::Map<const Eigen::Matrix<double, rows, columns, columns == 1 ? 0 : Eigen::RowMajor>>(data);
        }
    }
    static void write(const Value& from, double* data) {
        if constexpr (std::is_same_v<Value, cairn::Quat>) {
            const std::array<double, 4> wxyz{from.w(), from.x(), from.y(), from.z()};
            std::copy(wxyz.begin(), wxyz.end(), data);
        } else {
            Eigen::Map<Eigen::Matrix<double, rows, columns, columns == 1 ? 0 : Eigen::RowMajor>>{data} = from;
        }
    }
};

template <>
struct type_caster<Eigen::Vector2d> : ArrayCaster<Eigen::Vector2d, 2, 1> {};
template <>
struct type_caster<cairn::Vec3> : ArrayCaster<cairn::Vec3, 3, 1> {};
template <>
struct type_caster<cairn::Mat3> : ArrayCaster<cairn::Mat3, 3, 3> {};
template <>
struct type_caster<cairn::Quat> : ArrayCaster<cairn::Quat, 4, 1> {};

/// Members of Python's enums, or their names.
template <cairn::python::NamedEnum Enum>
struct type_caster<Enum> {
    PYBIND11_TYPE_CASTER(Enum, const_name("enum"));

    bool load(handle source, bool /*convert*/) {
        long number = 0;
        if (!cairn::python::readEnum(source, cairn::python::enum_name<Enum>, number)) return false;
        value = static_cast<Enum>(number);
        return true;
    }
    static handle cast(Enum from, return_value_policy /*policy*/, handle /*parent*/) {
        return cairn::python::ofModule(cairn::python::enum_name<Enum>)(static_cast<long>(from)).release();
    }
};

}  // namespace pybind11::detail
