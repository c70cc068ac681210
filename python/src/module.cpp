/// The compiled part of the package: the public interface of the C++ library, and nothing else.
#include "parts.h"

#include "casters.h"

PYBIND11_MODULE(_core, module) {
    using namespace cairn::python;
    module.doc() = "Cairn's C++ library.";
    bindErrors(module);
    bindEnums(module);
    bindSurfaces(module);
    bindBodyRecords(module);
    bindSettings(module);
    bindReports(module);
    bindQueryRecords(module);
    bindFilterAndMotionRecords(module);
    bindSceneRecords(module);
    bindBodies(module);
    bindWorld(module);
    bindRuns(module);
    bindRecordings(module);
    module.attr("version") = std::string(cairn::version);
    module.attr("stage_names") = pybind11::tuple(pybind11::cast(cairn::stage_names));
    module.attr("simulation_steps_per_second") = cairn::simulation_steps_per_second;
}
