/// @file Parts of the text of a scene.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

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
/// A member of an object behind others; empty for the identity.
std::string orientationText(const Quat& q);

/// Three moments, and the three products if there are any.
std::string inertiaText(const Mat3& inertia);

/// All elements, each as a text of its own.
template <class Range, class ToText>
std::string arrayText(const Range& range, const ToText& toText) {
    std::string out = "[";
    for (const auto& element : range) {
        if (out.size() > 1) out += ',';
        out += toText(element);
    }
    return out + "]";
}

}  // namespace written

/// The shapes of a scene, of which those with many numbers are written once if several bodies have them.
class WrittenShapes {
  public:
    explicit WrittenShapes(const SceneSource::Tell& bodies);
    /// The shape as the value of a body's key.
    std::string textOf(const Shape& shape) const;
    /// The shapes that bodies name, as the value of the scene's key; empty if there are none.
    std::string shared() const;

  private:
    std::map<const void*, std::string> by_data_;  ///< texts of what copies of shapes share
    std::map<std::string, std::size_t> counts_;   ///< of bodies, by text
    std::map<std::string, std::string> names_;    ///< of shared shapes, by text
    std::vector<std::string> order_;              ///< texts of shared shapes as they are named
};

/// The text of a scene in pieces, so that it is nowhere as a whole. @param append takes them
void writeText(const SceneSource& source, const std::function<void(std::string_view)>& append);

std::string driveText(const SceneDrive& drive);
std::string gravityText(const Scene& scene);
std::string pairLawText(const PairLaw& law);
std::string jointText(const SceneJoint& scene_joint);

}  // namespace cairn
