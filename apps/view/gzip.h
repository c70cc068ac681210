/// @file Compression as browsers understand it.
#pragma once

#include <string>
#include <string_view>

namespace cairn::view {

/// @throws IoError if the memory does not suffice
std::string gzip(std::string_view bytes);
/// @throws IoError if the bytes are not a complete gzip stream
std::string gunzip(std::string_view bytes);

}  // namespace cairn::view
