/// @file Bodies, materials and settings as JSON for the page.
#pragma once

#include <nlohmann/json.hpp>

#include "cairn/scene.h"
#include "cairn/settings.h"
#include "cairn/world.h"

namespace cairn::view {

nlohmann::json toJson(const Vec3& v);
/// As w, x, y, z.
nlohmann::json toJson(const Quat& q);
nlohmann::json toJson(const Shape& shape);
nlohmann::json toJson(const SettingValue& value);
nlohmann::json toJson(std::span<const Material> materials);

/// A shape in words: "box 10 × 10 × 20 cm".
std::string describeShape(const Shape& shape);

/// What the page needs to draw a body of a world.
nlohmann::json describeBody(const World& world, BodyId id);
/// Every field of the settings, by name.
nlohmann::json describeSettings(const Settings& settings);
/// Name, stage, unit, meaning, kind, range and choices of every field.
nlohmann::json describeFields();
/// Name, description and example of every built-in scene.
nlohmann::json describeScenes();
/// The names of the stages of a time step.
nlohmann::json describeStages();

/// The name of a body, or its number where it has none.
std::string bodyTitle(const World& world, BodyId id);

}  // namespace cairn::view
