/// @file The comparison with the peers as a picture.
#pragma once

#include "common.h"

namespace cairn::bench {

/// Dots on two logarithmic scales, processor time and largest overlap: a row per engine, a group of rows per scene.
/// @param result of runPeers() @return the text of an SVG file
std::string peersPlot(const Json& result);

}  // namespace cairn::bench
