/// @file The parts of the module, each in a source of its own.
#pragma once

#include <pybind11/pybind11.h>

namespace cairn::python {

void bindErrors(pybind11::module_& module);
void bindEnums(pybind11::module_& module);
void bindBodyRecords(pybind11::module_& module);
void bindSurfaces(pybind11::module_& module);
void bindSettings(pybind11::module_& module);
void bindReports(pybind11::module_& module);
void bindQueryRecords(pybind11::module_& module);
void bindFilterAndMotionRecords(pybind11::module_& module);
void bindSceneRecords(pybind11::module_& module);
void bindWorld(pybind11::module_& module);
void bindBodies(pybind11::module_& module);
void bindRuns(pybind11::module_& module);
void bindRecordings(pybind11::module_& module);

}  // namespace cairn::python
