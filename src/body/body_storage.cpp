#include "body/body_storage.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <type_traits>
#include <utility>

#include "math/rotation.h"

namespace cairn {

BodyIndex BodyStorage::indexOf(BodyId id) const {
    if (contains(id)) return slotOf(id.index);
    const BodyIndex i = slotOf(id.index);
    // What is gone from the whole world is a hole on all ranks.
    const bool is_lent = is_part_ && id.index < whole_slots_ && (i == no_slot || generation[i] == id.generation);
    if (is_lent) {
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

BodyIndex BodyStorage::slotOf(BodyIndex home) const {
    if (!is_part_) return home;
    const auto found = std::ranges::lower_bound(homes_, home);
    return found != homes_.end() && *found == home ? static_cast<BodyIndex>(found - homes_.begin()) : no_slot;
}

void BodyStorage::beginPart() {
    is_part_ = true;
    whole_slots_ = slots();
    homes_.resize(slots());
    std::iota(homes_.begin(), homes_.end(), 0U);
}

void BodyStorage::becomePart(std::vector<BodyIndex> homes, std::size_t whole_slots) {
    forEachBodyField([&](const auto& field) { (this->*field.array).resize(homes.size()); });
    std::ranges::fill(kind, BodyKind::hole);
    is_part_ = true;
    whole_slots_ = whole_slots;
    homes_ = std::move(homes);
}

void BodyStorage::endPart() {
    is_part_ = false;
    homes_ = {};
}

void BodyStorage::passOver(BodyIndex i) {
    kind[i] = BodyKind::hole;
    asleep[i] = 0;
    --count_;
    ++layout_version_;
    // In a slot that another body left before it stays a hole.
    if (std::size_t{i} + 1 != slots()) return;
    forEachBodyField([&](const auto& field) { (this->*field.array).resize(i); });
    homes_.pop_back();
}

SlotMove BodyStorage::takeHomes(std::vector<BodyIndex> homes) {
    SlotMove move;
    move.from.assign(homes.size(), no_slot);
    move.to.assign(slots(), no_slot);
    BodyIndex old = 0;
    for (BodyIndex i = 0; i < homes.size(); ++i) {
        while (old < homes_.size() && homes_[old] < homes[i]) ++old;
        if (old == homes_.size() || homes_[old] != homes[i]) continue;
        move.from[i] = old;
        move.to[old] = i;
    }
    forEachBodyField([&](const auto& field) {
        auto& values = this->*field.array;
        using Type = typename std::remove_cvref_t<decltype(values)>::value_type;
        const Type blank = field.initial != nullptr ? field.initial() : Type{};
        rearrange(values, move, blank);
    });
    for (BodyIndex i = 0; i < homes.size(); ++i) {
        if (move.from[i] == no_slot) kind[i] = BodyKind::hole;
    }
    filter.rename(move);
    homes_ = std::move(homes);
    adoptSlots(next_number_);
    return move;
}

BodyIndex BodyStorage::allocate(BodyKind new_kind) {
    BodyIndex i = 0;
    if (holes_.empty()) {
        i = static_cast<BodyIndex>(kind.size());
        if (is_part_) homes_.push_back(static_cast<BodyIndex>(whole_slots_++));
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
    forEachBodyField([&](const auto& field) {
        auto& array = this->*field.array;
        using Type = typename std::decay_t<decltype(array)>::value_type;
        if (array.size() != slots()) array.assign(slots(), blank<Type>());
    });
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
            .place = place,
            .asleep = asleep,
            .woken = woken,
            .gravity_factor = gravity_factor,
            .load = load,
            .denied = held,
            .shock_stage = {}};
}

}  // namespace cairn
