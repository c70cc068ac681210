/// @file Materials and their pair properties.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/material.h"
#include "cairn/types.h"

namespace cairn {

/// Their pair table grows with the square.
inline constexpr std::size_t most_materials = 256;

/// All materials of a world and a symmetric table of pair properties.
class MaterialTable {
  public:
    /// @throws InputError
    MaterialId add(const Material& material);
    std::span<const Material> all() const { return materials_; }
    bool contains(MaterialId id) const { return static_cast<std::uint32_t>(id) < materials_.size(); }
    /// @throws InputError
    void setDefault(const PairProperties& properties);
    /// @throws InputError
    void setPair(MaterialId a, MaterialId b, const PairProperties& properties);
    /// @pre both indices are valid
    const PairProperties& pair(std::uint32_t a, std::uint32_t b) const {
        const Entry& entry = pairs_[a * materials_.size() + b];
        return entry.own ? entry.properties : default_;
    }

    /// A law of a pair of its own.
    struct LawOfPair {
        std::uint32_t a = 0, b = 0;  ///< a ≤ b
        PairLaw law;
    };
    /// A law without curves is none. @throws InputError
    void setLaw(MaterialId a, MaterialId b, const PairLaw& law);
    std::span<const LawOfPair> laws() const { return laws_; }  ///< by (a, b)
    /// The law of a pair, or none.
    const PairLaw* law(std::uint32_t a, std::uint32_t b) const;

    const PairProperties& defaultPair() const { return default_; }
    /// The properties that the pair has of its own, or none. @pre both indices are valid
    const PairProperties* ownPair(std::uint32_t a, std::uint32_t b) const {
        const Entry& entry = pairs_[a * materials_.size() + b];
        return entry.own ? &entry.properties : nullptr;
    }

  private:
    struct Entry {
        bool own = false;
        PairProperties properties;
    };
    std::vector<Material> materials_;
    std::vector<Entry> pairs_;  ///< [material × material]
    PairProperties default_;
    std::vector<LawOfPair> laws_;  ///< by (a, b)

    void requireKnown(MaterialId a, MaterialId b) const;
};

/// @throws InputError with the member, its value and what is allowed
void validatePair(const PairProperties& properties);

/// @throws InputError with the curve, its value and what is allowed
void validateLaw(const PairLaw& law);

/// The value of a curve. @pre it has points @param speed [m/s]
double valueAt(const SpeedCurve& curve, double speed);

}  // namespace cairn
