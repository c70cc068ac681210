/// @file What this computer is.
#pragma once

#include <string>

namespace cairn {

/// Processor, number of threads and operating system in one line.
std::string describeMachine();

}  // namespace cairn
