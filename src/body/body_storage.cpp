#include "body/body_storage.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>

#include "math/rotation.h"

namespace cairn {

BodyIndex BodyStorage::indexOf(BodyId id) const {
    if (contains(id)) return id.index;
    if (lends_slots_ && id.index < kind.size() && generation[id.index] == id.generation) {
        throw StaleIdError(
            fmt::format("body {}:{} is on another rank now: ask World::contains() first, or call World::gather() on "
                        "all ranks",
                        id.index, id.generation));
    }
    throw StaleIdError(
        fmt::format("body id {}:{} is not in the world: it was removed or belongs to another world; "
                    "ask World::contains() first",
                    id.index, id.generation));
}

BodyIndex BodyStorage::allocate(BodyKind new_kind) {
    BodyIndex i = 0;
    if (holes_.empty()) {
        i = static_cast<BodyIndex>(kind.size());
        forEachBodyField([&](const auto& field) { (this->*field.array).resize(std::size_t{i} + 1); });
    } else {
        std::pop_heap(holes_.begin(), holes_.end(), std::greater<>());
        i = holes_.back();
        holes_.pop_back();
    }
    forEachBodyField([&](const auto& field) {
        if (field.initial != nullptr) (this->*field.array)[i] = field.initial();
    });
    kind[i] = new_kind;
    number[i] = next_number_++;
    ++count_;
    ++layout_version_;
    return i;
}

void BodyStorage::release(BodyIndex i) {
    kind[i] = BodyKind::hole;
    ++generation[i];
    name[i].clear();
    mass_inv[i] = 0;
    asleep[i] = 0;
    filter.forget(i);
    holes_.push_back(i);
    std::push_heap(holes_.begin(), holes_.end(), std::greater<>());
    --count_;
    ++layout_version_;
}

void BodyStorage::adoptSlots(std::uint64_t next_number) {
    next_number_ = next_number;
    holes_.clear();
    for (BodyIndex i = 0; i < slots(); ++i) {
        // Ascending order is a min-heap.
        if (kind[i] == BodyKind::hole) holes_.push_back(i);
    }
    count_ = slots() - holes_.size();
    ++layout_version_;
}

void BodyStorage::updateMassProperties(BodyIndex i) {
    if (kind[i] == BodyKind::dynamic) {
        mass_inv[i] = 1 / mass[i];
        inertiaInv_B[i] = inertia_B[i].cwiseInverse();
        inertiaInv_W[i] = toWorldInertia(inertiaInv_B[i], orientation[i]);
    } else {
        mass_inv[i] = 0;
        inertiaInv_B[i].setZero();
        inertiaInv_W[i].setZero();
    }
}

BodyState BodyStorage::state() {
    return {.kind = kind,
            .position = position,
            .orientation = orientation,
            .v = v,
            .w = w,
            .mass_inv = mass_inv,
            .inertiaInv_B = inertiaInv_B,
            .inertiaInv_W = inertiaInv_W,
            .linear_step = linear_step,
            .asleep = asleep,
            .woken = woken,
            .gravity_factor = gravity_factor,
            .shock_stage = {}};
}

}  // namespace cairn
