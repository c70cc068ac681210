/// @file Worlds and runs as Python holds them: one thread at a time may use one, and a second one is told so.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

#include "casters.h"

namespace cairn::python {

/// The arrays of bodies' fields that were last taken. Each is given again while the layout of the world is the same: a
/// new one costs more, most of all where a step has driven everything else out of the caches.
class TakenArrays {
  public:
    /// @param field number of the field @param layout of the world @param make gives the array anew
    template <class Make>
    py::array get(std::size_t field, std::uint64_t layout, Make make) {
        if (layout != layout_) {
            taken_ = {};
            layout_ = layout;
        }
        Taken& taken = taken_.at(field);
        if (!taken.isAsMade()) taken = Taken(make());
        return py::reinterpret_borrow<py::array>(taken.array);
    }

  private:
    /// An array, and what its holder can set although its numbers cannot be written.
    struct Taken {
        py::object array;
        py::ssize_t dimensions = 0;
        py::ssize_t rows = 0;
        PyObject* dtype = nullptr;

        Taken() = default;
        explicit Taken(const py::array& made)
            : array(made), dimensions(made.ndim()), rows(made.shape(0)), dtype(made.dtype().ptr()) {}
        bool isAsMade() const {
            if (!array) return false;
            const auto a = py::reinterpret_borrow<py::array>(array);
            return a.ndim() == dimensions && a.shape(0) == rows && (a.flags() & py::array::c_style) != 0 &&
                   a.dtype().ptr() == dtype;
        }
    };

    std::array<Taken, 8> taken_;
    std::uint64_t layout_ = 0;
};

/// A world, or a run with the world in it. Whoever holds the interpreter's lock may read and write `in_use`.
class Owner {
  public:
    explicit Owner(World world) : what_(std::move(world)) {}
    explicit Owner(SceneRun run) : what_(std::move(run)) {}

    /// @throws RuntimeError while another thread is in a call that let the interpreter go
    void requireIdle() const {
        if (!in_use_) return;
        throw std::runtime_error("another thread is using this world; give each thread a world of its own");
    }
    World& world() {
        requireIdle();
        if (auto* run = std::get_if<SceneRun>(&what_)) return run->world();
        return std::get<World>(what_);
    }
    SceneRun& run() {
        requireIdle();
        return std::get<SceneRun>(what_);
    }

    /// Works without the interpreter's lock while nobody else may use the world.
    template <class Work>
    auto alone(Work work) {
        requireIdle();
        const InUse in_use(in_use_);
        const py::gil_scoped_release released;
        return work();
    }

    /// Whoever holds the interpreter's lock may use them.
    TakenArrays& arrays() { return arrays_; }

  private:
    /// Ends when the lock is held again, also after an exception.
    struct InUse {
        explicit InUse(bool& flag) : in_use(flag) { in_use = true; }
        ~InUse() { in_use = false; }
        InUse(const InUse&) = delete;
        InUse& operator=(const InUse&) = delete;
        bool& in_use;
    };

    std::variant<World, SceneRun> what_;
    TakenArrays arrays_;
    bool in_use_ = false;
};

/// What a Python object of one of these classes is.
struct PyWorld {
    std::shared_ptr<Owner> owner;
    py::object bodies{};  ///< a PyBodies, once it was asked for

    World& use() const { return owner->world(); }
};
struct PyBodies {
    std::shared_ptr<Owner> owner;

    World& use() const { return owner->world(); }
};
struct PyRun {
    std::shared_ptr<Owner> owner;

    SceneRun& use() const { return owner->run(); }
};

/// Snapshots as Python's bytes and back.
py::bytes bytesOf(std::span<const std::byte> data);
py::bytes contiguous(const py::buffer& buffer);
std::span<const std::byte> bytesIn(const py::bytes& bytes);

/// Steps so often, without the interpreter's lock but with an ear for Ctrl-C. @throws InputError for less than 0
template <class Step>
void stepOften(Owner& owner, std::int64_t steps, Step step) {
    if (steps < 0) throw InputError("steps is " + std::to_string(steps) + "; it must be at least 0");
    for (std::int64_t i = 0; i < steps; ++i) {
        owner.alone(step);
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
}

}  // namespace cairn::python
