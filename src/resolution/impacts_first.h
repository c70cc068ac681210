/// @file Impacts that follow another rule than the resolution's own: they are resolved first, then all contacts.
#pragma once

#include "resolution/resolution.h"

namespace cairn {

/// Wraps a resolution. Without the settings for it, it is the resolution alone.
/// @param own how the resolution itself treats impacts in touching chains
std::unique_ptr<Resolution> makeImpactsFirst(std::unique_ptr<Resolution> resolution, Impacts own);

}  // namespace cairn
