/// @file The subcommands. A new one is a file of its own and a line in all_commands.
#pragma once

#include <array>

#include "cli/program.h"

namespace cairn::cli {

AddCommands addRun, addResume, addReplay, addMerge, addScenes, addInfo, addExport, addSettings;

inline constexpr std::array<AddCommands*, 8> all_commands = {addRun,    addResume, addReplay, addMerge,
                                                             addScenes, addInfo,   addExport, addSettings};

}  // namespace cairn::cli
