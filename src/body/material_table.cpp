#include "body/material_table.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

namespace cairn {

void validatePair(const PairProperties& p) {
    if (!(p.restitution >= 0 && p.restitution <= 1)) {
        throw InputError(fmt::format("restitution is {}; it must be within 0 and 1", p.restitution));
    }
    if (!(p.static_friction >= 0 && std::isfinite(p.static_friction))) {
        throw InputError(fmt::format("static_friction is {}; it must be finite and at least 0", p.static_friction));
    }
    if (!(p.kinetic_friction >= 0 && std::isfinite(p.kinetic_friction))) {
        throw InputError(fmt::format("kinetic_friction is {}; it must be finite and at least 0", p.kinetic_friction));
    }
    for (const auto& [name, value] :
         {std::pair{"rolling_friction", p.rolling_friction}, std::pair{"spinning_friction", p.spinning_friction}}) {
        if (value >= 0 && std::isfinite(value)) continue;
        throw InputError(fmt::format("{} is {} m; it must be finite and at least 0", name, value));
    }
    if (p.kinetic_friction > p.static_friction) {
        throw InputError(
            fmt::format("kinetic_friction {} exceeds static_friction {}; kinetic friction is never larger "
                        "than static friction",
                        p.kinetic_friction, p.static_friction));
    }
}

MaterialId MaterialTable::add(const Material& material) {
    if (material.name.empty()) throw InputError("a material needs a name");
    if (!(material.density > 0 && std::isfinite(material.density))) {
        throw InputError(fmt::format("density of material '{}' is {}; it must be finite and above 0 kg/m³",
                                     material.name, material.density));
    }
    for (const Material& other : materials_) {
        if (other.name == material.name) {
            throw InputError(
                fmt::format("a material named '{}' exists already; give the new one another name", material.name));
        }
    }
    if (materials_.size() >= most_materials) {
        throw InputError(fmt::format("material '{}' is one too many; a world has at most {} materials", material.name,
                                     most_materials));
    }
    const std::size_t n = materials_.size();
    std::vector<Entry> grown((n + 1) * (n + 1));
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) grown[a * (n + 1) + b] = pairs_[a * n + b];
    }
    pairs_ = std::move(grown);
    materials_.push_back(material);
    return static_cast<MaterialId>(n);
}

void MaterialTable::setDefault(const PairProperties& properties) {
    validatePair(properties);
    default_ = properties;
}

void MaterialTable::setPair(MaterialId a, MaterialId b, const PairProperties& properties) {
    for (const MaterialId id : {a, b}) {
        if (!contains(id)) {
            throw InputError(fmt::format("material {} is unknown; the world has {} materials",
                                         static_cast<std::uint32_t>(id), materials_.size()));
        }
    }
    validatePair(properties);
    const auto i = static_cast<std::size_t>(a);
    const auto j = static_cast<std::size_t>(b);
    pairs_[i * materials_.size() + j] = {true, properties};
    pairs_[j * materials_.size() + i] = {true, properties};
}

}  // namespace cairn
