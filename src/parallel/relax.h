/// @file What a thread does that waits for another for a moment.
#pragma once

namespace cairn {

/// Leaves the units of the processor to its other threads for some cycles.
inline void relax() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

}  // namespace cairn
