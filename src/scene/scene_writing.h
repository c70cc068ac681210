/// @file Parts of the text of a scene.
#pragma once

#include <string>

#include "cairn/scene.h"

namespace cairn {

namespace written {

/// The shortest text that is read back as the same number. @throws InputError unless it is finite
std::string number(double value);
std::string vector(const Vec3& v);

/// Tells minus zero from zero, so that what is left out is read back bit by bit.
bool same(double a, double b);
/// Whether a vector is zero, which is left out.
bool isOmitted(const Vec3& v);

}  // namespace written

std::string pairLawText(const PairLaw& law);
std::string jointText(const SceneJoint& scene_joint);

}  // namespace cairn
