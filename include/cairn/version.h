/// @file The version of the library.
#pragma once

#include <string_view>

namespace cairn {

/// Major, minor and patch number, as in CMake's project version.
inline constexpr std::string_view version = "0.1.0";

}  // namespace cairn
