#include <fmt/format.h>

#include "scene/drives.h"
#include "scene/scene_writing.h"

namespace cairn {
namespace {

using written::number;
using written::vector;

/// A number, or three of a force or torque.
std::string valueText(const Vec3& value, DriveOf what) {
    return drivesJoint(what) ? number(value.x()) : vector(value);
}

std::string startText(const SceneDrive& drive) {
    return written::isOmitted(drive.start) ? "" : fmt::format(R"(,"start":{})", valueText(drive.start, drive.what));
}

std::string functionText(const SceneDrive& drive, const ConstantMotion& law) {
    return fmt::format(R"("constant"{},"rate":{})", startText(drive), valueText(law.velocity, drive.what));
}

std::string functionText(const SceneDrive& drive, const SineMotion& law) {
    return fmt::format(R"("sine"{},"amplitude":{},"frequency":{},"phase":{})", startText(drive),
                       valueText(law.amplitude, drive.what), number(law.frequency), number(law.phase));
}

std::string functionText(const SceneDrive& drive, const TableMotion& law) {
    const auto value = [&](const Vec3& v) { return valueText(v, drive.what); };
    return fmt::format(R"("table","times":{},"values":{}{})", written::arrayText(law.times, number),
                       written::arrayText(law.displacements, value),
                       law.end == TableEnd::repeat ? R"(,"end":"repeat")" : "");
}

}  // namespace

std::string gravityText(const Scene& scene) {
    if (!scene.gravity_law) return vector(scene.gravity);
    SceneDrive drive;
    drive.what = DriveOf::force;
    drive.start = scene.gravity;
    return fmt::format(R"({{"type":{}}})",
                       std::visit([&](const auto& law) { return functionText(drive, law); }, *scene.gravity_law));
}

std::string driveText(const SceneDrive& drive) {
    const std::string function = std::visit([&](const auto& law) { return functionText(drive, law); }, drive.law);
    return fmt::format(R"({{"{}":{}{},"{}":{{"type":{}}}}})", drivesJoint(drive.what) ? "joint" : "body", drive.target,
                       drive.axis == 0 ? "" : fmt::format(R"(,"axis":{})", drive.axis),
                       drive_names[static_cast<std::size_t>(drive.what)], function);
}

}  // namespace cairn
