/// @file What the files of kernels share.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cairn/types.h"

namespace cairn::kernels {

/// The work of one pass over many items. Only `run` is timed.
struct Pass {
    std::function<void()> prepare;  ///< puts back what the last pass changed
    std::function<void()> run;
    std::int64_t items = 0;  ///< contacts, pairs, bodies or operations of a pass
    std::int64_t bytes = 0;  ///< of memory that a pass must read or write at least; 0 = not counted
};

/// An inner loop of the engine, or a limit of the machine to compare it with.
struct Kernel {
    std::string name;            ///< room/what, or limit/what
    std::string item;            ///< what is counted: "contact"
    std::function<Pass()> make;  ///< called before the time is taken
};

/// Makes sure that the compiler does not drop a result that nobody reads.
template <class T>
void keep(T& value) {
    benchmark::DoNotOptimize(value);
    benchmark::ClobberMemory();
}

/// splitmix64: the same numbers everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double uniform(double low, double high) {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        z ^= z >> 31;
        return low + (high - low) * static_cast<double>(z >> 11) * 0x1.0p-53;
    }
    Vec3 direction() {
        for (;;) {
            const double x = uniform(-1, 1);
            const double y = uniform(-1, 1);
            const double z = uniform(-1, 1);
            const Vec3 v(x, y, z);
            if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
        }
    }
    Quat orientation() {
        const Vec3 axis = direction();
        return Quat(Eigen::AngleAxisd(uniform(0, 3), axis));
    }

  private:
    std::uint64_t state_;
};

/// Kernels of each file.
std::vector<Kernel> limitKernels();
std::vector<Kernel> narrowPhaseKernels();
std::vector<Kernel> broadPhaseKernels();
std::vector<Kernel> correctionKernels();
std::vector<Kernel> resolutionKernels();

}  // namespace cairn::kernels
