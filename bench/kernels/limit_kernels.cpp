/// @file What the machine can do at best, to compare the kernels with.
#include <array>
#include <memory>

#include "kernel.h"

namespace cairn::kernels {

namespace {

/// Reads numbers and adds them up, as fast as they come.
Pass readPass(std::size_t bytes, std::int64_t rounds) {
    const auto numbers = std::make_shared<std::vector<double>>(bytes / sizeof(double), 1.0);
    Pass pass;
    pass.items = rounds * static_cast<std::int64_t>(numbers->size());
    pass.bytes = pass.items * static_cast<std::int64_t>(sizeof(double));
    pass.prepare = [] {};
    pass.run = [numbers, rounds] {
        const Eigen::Map<const Eigen::ArrayXd> all(numbers->data(), static_cast<Eigen::Index>(numbers->size()));
        for (std::int64_t i = 0; i < rounds; ++i) {
            double sum = all.sum();
            keep(sum);
        }
    };
    return pass;
}

/// Independent multiplications and additions in registers.
Pass multiplyPass() {
    constexpr std::size_t chains = 8;  // more than an addition and a multiplication take to finish
    constexpr std::int64_t rounds = 20000;
    Pass pass;
    pass.items = 2 * 2 * static_cast<std::int64_t>(chains) * rounds;
    pass.prepare = [] {};
    pass.run = [] {
        std::array<Eigen::Array2d, chains> sums;
        sums.fill(Eigen::Array2d::Constant(1));
        Eigen::Array2d factor = Eigen::Array2d::Constant(0.5);
        keep(factor);
        for (std::int64_t i = 0; i < rounds; ++i) {
            for (Eigen::Array2d& sum : sums) sum = sum * factor + factor;
        }
        keep(sums);
    };
    return pass;
}

}  // namespace

std::vector<Kernel> limitKernels() {
    return {{"limit/read_memory", "number", [] { return readPass(std::size_t{128} << 20U, 1); }},
            {"limit/read_cache", "number", [] { return readPass(std::size_t{128} << 10U, 100); }},
            {"limit/multiply_add", "operation", multiplyPass}};
}

}  // namespace cairn::kernels
