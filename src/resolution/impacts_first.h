/// @file Impacts that follow another rule than the resolution's own: they are resolved first, then all contacts.
#pragma once

#include "resolution/batch_resolution.h"

namespace cairn {

/// Whether impacts follow another rule. @param own how the resolution itself treats impacts in touching chains
bool putsImpactsFirst(const ResolutionSettings& settings, Impacts own);

/// Wraps a resolution. Without the settings for it, it is the resolution alone.
/// @param own how the resolution itself treats impacts in touching chains
std::unique_ptr<BatchResolution> makeImpactsFirst(std::unique_ptr<BatchResolution> resolution, Impacts own);

}  // namespace cairn
