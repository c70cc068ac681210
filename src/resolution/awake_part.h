/// @file Resolves only the part of a batch that is awake; the sleeping rest holds still like fixed bodies.
#pragma once

#include <memory>

#include "resolution/resolution.h"

namespace cairn {

/// Whether sleeping bodies of a batch that is partly awake may stay asleep.
enum class Sleepers : std::uint8_t {
    wake,   ///< they are resolved with the others, and wake as soon as a contact of theirs is (the thesis)
    remain  ///< while their contacts push as they did: ResolutionSettings::wake_speed
};

/// Wraps a resolution. Batches that sleep as a whole are left out, and their contacts go on with the impulses that they
/// had. In a batch that sleeps in part, with Sleepers::remain, sleeping bodies are held still, and each contact between
/// one and a body that is awake is compared with what it gave when both were resolved last. A body that the difference
/// would move faster than wake_speed is disturbed: it is resolved along with its surroundings, the step's resolution
/// begins anew, and each time the surroundings are taken four times as wide; where most of the batch would be resolved,
/// all of it is. In the end those wake that are faster than wake_speed, and the others sleep on in silence where they
/// are. So an impact on a sleeping pile wakes as much of it as it moves, in the same step, while one restless body in a
/// large pile costs no more than its neighbourhood.
std::unique_ptr<Resolution> makeAwakePart(std::unique_ptr<Resolution> resolution, Sleepers sleepers);

}  // namespace cairn
