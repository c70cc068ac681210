/// @file Pulls bodies apart that stand more than half inside each other, such as a heap that was put into one place.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "batches/batches.h"
#include "body/contact.h"
#include "cairn/settings.h"

namespace cairn {

/// No push helps where bodies are inside many others: whatever moves out of one is pushed deeper into the next, and
/// finding that out costs a search through the whole batch for every contact. Such a batch is left to this: each body
/// moves by the mean of the ways out of the bodies that it overlaps, so that the heap grows from step to step until
/// pushes help again. A batch needs it if it is not small and has more than one contact of bodies that are half inside
/// each other for every four bodies.
class Loosening {
  public:
    /// Moves bodies and updates the contacts of a batch if it needs it. @return how many bodies were moved
    std::int64_t run(const BatchView& batch, std::span<Contact> contacts, const BodyState& bodies,
                     const CorrectionSettings& settings);

  private:
    /// What the contacts ask of a body.
    struct Wish {
        Vec3 sum = Vec3::Zero();  ///< [m, W]
        std::uint32_t count = 0;
    };

    void wish(BodyIndex body, const Vec3& way);

    std::vector<Wish> wishes_;  ///< [slots], those of the batch's bodies are empty between two runs
};

}  // namespace cairn
