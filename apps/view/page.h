/// @file The page that the build made of web/.
#pragma once

#include <string>
#include <string_view>

namespace cairn::view {

/// The page, compressed with gzip.
std::string_view compressedPage();
/// The page as text.
std::string page();

}  // namespace cairn::view
