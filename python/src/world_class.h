/// @file How the calls of World become those of its Python class.
#pragma once

#include <type_traits>
#include <utility>

#include "owner.h"

namespace cairn::python {

using WorldClass = py::class_<PyWorld>;

/// A member function of World as one of the Python class.
template <class Result, class... Arguments>
auto on(Result (World::*method)(Arguments...)) {
    return [method](const PyWorld& self, Arguments... arguments) -> std::decay_t<Result> {
        return (self.use().*method)(std::forward<Arguments>(arguments)...);
    };
}
template <class Result, class... Arguments>
auto on(Result (World::*method)(Arguments...) const) {
    return [method](const PyWorld& self, Arguments... arguments) -> std::decay_t<Result> {
        return (self.use().*method)(std::forward<Arguments>(arguments)...);
    };
}
template <class Result, class... Arguments>
auto on(Result (World::*method)(Arguments...) const noexcept) {
    return [method](const PyWorld& self, Arguments... arguments) -> std::decay_t<Result> {
        return (self.use().*method)(std::forward<Arguments>(arguments)...);
    };
}

/// Adds what reads and writes the state of bodies.
void bindBodyCalls(WorldClass& world);

/// Adds questions about the bodies where they are.
void bindQueries(WorldClass& world);

/// Adds what says which bodies touch and how they move, and their properties that do not change by themselves.
void bindFiltersAndMotions(WorldClass& world);

}  // namespace cairn::python
