/// @file The state of all bodies of a world, side by side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "cairn/types.h"

namespace cairn {

/// What a slot of a world holds.
enum class BodyKind : std::uint8_t {
    hole,   ///< nothing: its body was removed
    fixed,  ///< a body that never moves
    dynamic,
};

/// A read-only array of a world's bodies, one entry per slot. What it shows follows the world; and as long as somebody
/// holds it, it can be read, also when the world keeps its bodies elsewhere by now or is gone: then it shows what was
/// there last.
template <class Element>
class BodyView {
  public:
    using value_type = Element;  ///< of an entry

    BodyView() = default;  ///< no entries
    BodyView(std::shared_ptr<const Element[]> entries, std::size_t size) : entries_(std::move(entries)), size_(size) {}

    std::size_t size() const { return size_; }  ///< slots, holes included
    const Element* data() const { return entries_.get(); }
    const Element* begin() const { return data(); }
    const Element* end() const { return data() + size_; }
    const Element& operator[](std::size_t slot) const { return entries_[slot]; }

  private:
    std::shared_ptr<const Element[]> entries_;
    std::size_t size_ = 0;
};

/// The state of all bodies without a copy. Entry i is that of the body with BodyId::index i; the entries of a hole mean
/// nothing. Take it anew when World::layoutVersion() has changed.
struct BodyViews {
    BodyView<BodyKind> kind;             ///< what the slot holds
    BodyView<std::uint32_t> generation;  ///< of the slot; with it, and but for holes, the slot is a BodyId
    BodyView<Vec3> centre_of_mass;       ///< [m, W]
    BodyView<Quat> principal_axes;       ///< of the principal inertia: B to W; in memory (x, y, z, w)
    BodyView<Vec3> linear_velocity;      ///< of the centre of mass [m/s, W]
    BodyView<Vec3> angular_velocity;     ///< [rad/s, W]
    BodyView<double> mass;               ///< [kg]; of fixed bodies what it were if they moved, 0 of half-spaces
    BodyView<std::uint8_t> asleep;       ///< 1 = asleep

    std::size_t slots() const { return kind.size(); }  ///< of every array
    /// The id of the body in a slot that is no hole.
    BodyId id(std::size_t slot) const { return {static_cast<std::uint32_t>(slot), generation[slot]}; }
};

}  // namespace cairn
