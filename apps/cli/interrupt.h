/// @file Signals that end a run.
#pragma once

namespace cairn::cli {

/// A write to a closed pipe fails with an error instead of ending the program, so that a recording is kept.
void ignoreBrokenPipes();

/// From now on the first SIGINT or SIGTERM is only noted; a second one ends the program at once.
void catchInterrupts();

/// True once a signal was noted.
bool interrupted();

}  // namespace cairn::cli
