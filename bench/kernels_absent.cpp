#include "bench/kernels.h"

namespace cairn::bench {

Outcome runKernels(const KernelsOptions&) {
    throw InputError(
        "this program was built without the kernels; install the Debian package libbenchmark-dev and build again");
}

}  // namespace cairn::bench
