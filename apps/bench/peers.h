/// @file Cairn beside Bullet and ODE: the same scenes in one run, time and quality.
#pragma once

#include "common.h"
#include "engine.h"

namespace cairn::bench {

/// How the peers are compared.
struct PeersOptions {
    std::vector<std::string> scenes;   ///< empty = peerScenes()
    std::vector<std::string> engines;  ///< of "cairn", "bullet", "ode"; empty = all
    SettingOverrides overrides;        ///< of Cairn
    std::vector<Variant> variants;     ///< of Cairn
    double steps_per_second = 240;     ///< of every engine, a multiple of 30
    std::int64_t threads = 1;          ///< of Cairn; the peers have one
    std::size_t repetitions = 3;       ///< runs of each engine, taken in turns
    bool sleeping = true;              ///< in every engine
    double longest = 1e7;              ///< scenes end then [s]
    Extent extent = Extent::full;
    Progress progress;
};

/// The scenes that are compared unless others are asked for.
const std::vector<std::string>& peerScenes();

/// @throws InputError, Interrupted
Outcome runPeers(const PeersOptions& options);

}  // namespace cairn::bench
