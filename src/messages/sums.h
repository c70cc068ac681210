/// @file What ranks count, added up.
#pragma once

#include "cairn/statistics.h"

namespace cairn {

/// Adds what another rank counted in the same steps: numbers, the largest sizes and the times of the slowest. The
/// diagnostics are of the whole world on all ranks; the mean overlap stays.
void addRank(Statistics& sum, const Statistics& other);

}  // namespace cairn
