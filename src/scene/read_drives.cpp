#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "scene/drives.h"
#include "scene/scene_reading.h"

namespace cairn {
namespace {

/// A number, or three of a force or torque.
Vec3 readValue(const JsonNode& node, DriveOf what) {
    return drivesJoint(what) ? Vec3(node.number(), 0, 0) : node.vector();
}

Motion readTable(const JsonNode& node, SceneDrive& drive) {
    node.expectKeys({"type", "times", "values", "end"});
    TableMotion table;
    table.times = readNumbers(node.required("times", "an array of ascending times [s]"));
    const JsonNode values = node.required("values", "an array of as many values");
    values.expectArray("an array of as many values");
    for (std::size_t i = 0; i < values.size(); ++i) {
        table.displacements.push_back(readValue(values.element(i), drive.what));
    }
    if (!table.displacements.empty()) drive.start = table.displacements.front();
    if (const auto end = node.find("end")) table.end = readTableEnd(*end);
    return table;
}

Motion readSine(const JsonNode& node, DriveOf what) {
    node.expectKeys({"type", "start", "amplitude", "frequency", "phase"});
    SineMotion sine;
    sine.amplitude = readValue(node.required("amplitude", "the largest deviation"), what);
    sine.frequency = node.required("frequency", "a number above 0 [Hz]").positive();
    if (const auto value = node.find("phase")) sine.phase = value->number();
    return sine;
}

Motion readRamp(const JsonNode& node, DriveOf what) {
    node.expectKeys({"type", "start", "rate"});
    return ConstantMotion{readValue(node.required("rate", "the change per second"), what), Vec3::Zero()};
}

void readFunction(const JsonNode& node, SceneDrive& drive) {
    if (!node.value().is_object()) node.refuse("an object with the key type and what the type needs");
    constexpr std::string_view types = "table, sine or constant";
    const JsonNode type = node.required("type", types);
    const std::string name = type.text();
    if (const auto start = node.find("start")) drive.start = readValue(*start, drive.what);
    if (name == "table") {
        drive.law = readTable(node, drive);
    } else if (name == "sine") {
        drive.law = readSine(node, drive.what);
    } else if (name == "constant") {
        drive.law = readRamp(node, drive.what);
    } else {
        type.refuse(types);
    }
}

/// What it drives; exactly one.
DriveOf readWhat(const JsonNode& node) {
    std::optional<DriveOf> what;
    for (std::size_t i = 0; i < drive_names.size(); ++i) {
        if (!node.find(drive_names[i])) continue;
        if (what) node.fail("drives two things; give each its own drive");
        what = static_cast<DriveOf>(i);
    }
    if (!what) node.fail(fmt::format("drives nothing; it needs one of {}", fmt::join(drive_names, ", ")));
    return *what;
}

std::size_t readWhole(const JsonNode& node, std::size_t count, std::string_view allowed) {
    const double value = node.nonNegative();
    if (!(value < static_cast<double>(count)) || value != std::floor(value)) node.refuse(allowed);
    return static_cast<std::size_t>(value);
}

SceneDrive readDrive(const JsonNode& node, const SceneReading& reading) {
    node.expectKeys({"joint", "axis", "body", "position", "speed", "force", "torque"});
    SceneDrive drive;
    drive.what = readWhat(node);
    if (drivesJoint(drive.what)) {
        if (const auto body = node.find("body")) body->fail("is that of a drive of a joint; name the joint instead");
        constexpr std::string_view joint = "the index of a joint";
        drive.target = readWhole(node.required("joint", joint), reading.scene.joints.size(), joint);
        if (const auto axis = node.find("axis")) drive.axis = readWhole(*axis, 6, "the index of a free axis, 0 to 5");
    } else {
        if (node.find("joint") || node.find("axis")) node.fail("has a joint; a force or torque needs a body");
        drive.target = readBodyReference(node.required("body", "the index or the name of a body"), reading);
    }
    readFunction(node.required(drive_names[static_cast<std::size_t>(drive.what)], "a function of time"), drive);
    try {
        requireDrive(drive, reading.scene);
    } catch (const InputError& error) {
        node.fail(fmt::format("is not allowed: {}", error.what()));
    }
    return drive;
}

/// A servo follows a position or a speed.
bool isSameThing(const SceneDrive& a, const SceneDrive& b) {
    const bool joints = drivesJoint(a.what) && drivesJoint(b.what);
    return (joints || a.what == b.what) && a.target == b.target && a.axis == b.axis;
}

}  // namespace

void readGravity(const JsonNode& node, Scene& scene) {
    if (!node.value().is_object()) {
        scene.gravity = node.vector();
        return;
    }
    // Three numbers that follow a function of time, as those of a force do.
    SceneDrive drive;
    drive.what = DriveOf::force;
    readFunction(node, drive);
    try {
        requireFunction(drive.law, drive.start);
    } catch (const InputError& error) {
        node.fail(fmt::format("is not allowed: {}", error.what()));
    }
    scene.gravity = drive.start;
    scene.gravity_law = std::move(drive.law);
}

void readDrives(const JsonNode& node, SceneReading& reading) {
    node.expectArray("an array of drives");
    std::vector<SceneDrive>& drives = reading.scene.drives;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const JsonNode entry = node.element(i);
        const SceneDrive drive = readDrive(entry, reading);
        if (std::ranges::any_of(drives, [&](const SceneDrive& other) { return isSameThing(other, drive); })) {
            entry.fail("drives what another one drives; give it once");
        }
        drives.push_back(drive);
    }
}

}  // namespace cairn
