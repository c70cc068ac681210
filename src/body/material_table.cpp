#include "body/material_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace cairn {

namespace {

std::pair<std::uint32_t, std::uint32_t> pairOf(const MaterialTable::LawOfPair& entry) {
    return {entry.a, entry.b};
}

/// @throws InputError
void validateCurve(const SpeedCurve& curve, double largest, std::string_view what) {
    if (curve.speeds.size() != curve.values.size()) {
        throw InputError(fmt::format("the {} curve of a pair has {} speeds and {} values; give as many", what,
                                     curve.speeds.size(), curve.values.size()));
    }
    double last = -1;
    for (const double speed : curve.speeds) {
        if (!(speed >= 0 && speed > last && std::isfinite(speed))) {
            throw InputError(
                fmt::format("the {} curve of a pair has the speed {} m/s after {}; speeds must be finite, at "
                            "least 0 and ascending",
                            what, speed, last));
        }
        last = speed;
    }
    for (const double value : curve.values) {
        if (value >= 0 && value <= largest) continue;
        throw InputError(
            fmt::format("the {} curve of a pair has the value {}; it must be within 0 and {}", what, value, largest));
    }
}

}  // namespace

void validateLaw(const PairLaw& law) {
    validateCurve(law.restitution, 1, "restitution");
    validateCurve(law.friction, std::numeric_limits<double>::max(), "friction");
}

double valueAt(const SpeedCurve& curve, double speed) {
    const auto next = std::ranges::upper_bound(curve.speeds, speed);
    if (next == curve.speeds.begin()) return curve.values.front();
    if (next == curve.speeds.end()) return curve.values.back();
    const auto i = static_cast<std::size_t>(next - curve.speeds.begin());
    const double part = (speed - curve.speeds[i - 1]) / (curve.speeds[i] - curve.speeds[i - 1]);
    return curve.values[i - 1] + part * (curve.values[i] - curve.values[i - 1]);
}

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

void MaterialTable::requireKnown(MaterialId a, MaterialId b) const {
    for (const MaterialId id : {a, b}) {
        if (contains(id)) continue;
        throw InputError(fmt::format("material {} is unknown; the world has {} materials",
                                     static_cast<std::uint32_t>(id), materials_.size()));
    }
}

void MaterialTable::setPair(MaterialId a, MaterialId b, const PairProperties& properties) {
    requireKnown(a, b);
    validatePair(properties);
    const auto i = static_cast<std::size_t>(a);
    const auto j = static_cast<std::size_t>(b);
    pairs_[i * materials_.size() + j] = {true, properties};
    pairs_[j * materials_.size() + i] = {true, properties};
}

void MaterialTable::setLaw(MaterialId a, MaterialId b, const PairLaw& law) {
    requireKnown(a, b);
    validateLaw(law);
    const auto low = std::min(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    const auto high = std::max(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    const auto at = std::ranges::lower_bound(laws_, std::pair(low, high), {}, pairOf);
    const bool is_there = at != laws_.end() && pairOf(*at) == std::pair(low, high);
    const bool is_none = law.restitution.speeds.empty() && law.friction.speeds.empty();
    if (is_there && is_none) {
        laws_.erase(at);
    } else if (is_there) {
        at->law = law;
    } else if (!is_none) {
        laws_.insert(at, {low, high, law});
    }
}

const PairLaw* MaterialTable::law(std::uint32_t a, std::uint32_t b) const {
    const std::pair<std::uint32_t, std::uint32_t> pair(std::min(a, b), std::max(a, b));
    const auto at = std::ranges::lower_bound(laws_, pair, {}, pairOf);
    return at != laws_.end() && pairOf(*at) == pair ? &at->law : nullptr;
}

}  // namespace cairn
