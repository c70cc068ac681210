#include <fmt/format.h>

#include "integration/motion_curve.h"
#include "scene/number_table.h"
#include "scene/scene_reading.h"

namespace cairn {
namespace {

std::vector<Vec3> readVectors(const JsonNode& node) {
    node.expectArray("an array of vectors");
    std::vector<Vec3> vectors;
    vectors.reserve(node.size());
    for (std::size_t i = 0; i < node.size(); ++i) vectors.push_back(node.element(i).vector());
    return vectors;
}

Motion readConstant(const JsonNode& node) {
    node.expectKeys({"type", "velocity", "spin", "pivot"});
    ConstantMotion motion;
    if (const auto value = node.find("velocity")) motion.velocity = value->vector();
    if (const auto value = node.find("spin")) motion.spin = value->vector();
    return motion;
}

Motion readSine(const JsonNode& node) {
    node.expectKeys({"type", "amplitude", "turn", "frequency", "phase", "pivot"});
    SineMotion motion;
    if (const auto value = node.find("amplitude")) motion.amplitude = value->vector();
    if (const auto value = node.find("turn")) motion.turn = value->vector();
    motion.frequency = node.required("frequency", "a number above 0 [Hz]").positive();
    if (const auto value = node.find("phase")) motion.phase = value->number();
    return motion;
}

std::vector<Vec3> vectorsOf(const NumberTable& table, std::size_t column) {
    std::vector<Vec3> vectors;
    vectors.reserve(table.rows());
    for (std::size_t row = 0; row < table.rows(); ++row) {
        vectors.emplace_back(table.at(row, column), table.at(row, column + 1), table.at(row, column + 2));
    }
    return vectors;
}

/// @param samples accelerations [m/s²]
Motion accelerogramOf(const JsonNode& node, const std::vector<Vec3>& samples) {
    const double interval = node.required("interval", "the time between two samples [s], above 0").positive();
    Baseline baseline = Baseline::none;
    if (const auto value = node.find("baseline")) {
        const std::string name = value->text();
        if (name != "none" && name != "at_rest") value->refuse("none or at_rest");
        baseline = name == "at_rest" ? Baseline::at_rest : Baseline::none;
    }
    try {
        return integrateAccelerogram(interval, samples, baseline);
    } catch (const InputError& error) {
        node.fail(fmt::format("is not allowed: {}", error.what()));
    }
}

Motion readAccelerogram(const JsonNode& node, const JsonNode& accelerations) {
    node.expectKeys({"type", "interval", "accelerations", "baseline", "pivot"});
    return accelerogramOf(node, readVectors(accelerations));
}

TableEnd readEnd(const JsonNode& node) {
    const auto value = node.find("end");
    return value ? readTableEnd(*value) : TableEnd::hold;
}

/// Times with displacements and maybe turns; or accelerations where an interval is given.
Motion readTableFile(const JsonNode& node, const JsonNode& file) {
    if (node.find("interval")) {
        node.expectKeys({"type", "interval", "file", "baseline", "pivot"});
        const NumberTable table = readNumberTable(file);
        if (table.columns != 3) file.fail("must have three columns, the accelerations along x, y and z [m/s²]");
        return accelerogramOf(node, vectorsOf(table, 0));
    }
    node.expectKeys({"type", "file", "end", "pivot"});
    const NumberTable table = readNumberTable(file);
    if (table.columns != 4 && table.columns != 7) {
        file.fail(
            "must have four columns, the time [s] and the displacement along x, y and z [m], or three more, the "
            "rotation vector [rad]");
    }
    TableMotion motion;
    for (std::size_t row = 0; row < table.rows(); ++row) motion.times.push_back(table.at(row, 0));
    motion.displacements = vectorsOf(table, 1);
    if (table.columns == 7) motion.turns = vectorsOf(table, 4);
    motion.end = readEnd(node);
    return motion;
}

Motion readTable(const JsonNode& node) {
    if (const auto accelerations = node.find("accelerations")) return readAccelerogram(node, *accelerations);
    if (const auto file = node.find("file")) return readTableFile(node, *file);
    node.expectKeys({"type", "times", "displacements", "turns", "velocities", "end", "pivot"});
    TableMotion motion;
    motion.times = readNumbers(node.required("times", "an array of ascending times [s]"));
    if (const auto value = node.find("displacements")) motion.displacements = readVectors(*value);
    if (const auto value = node.find("turns")) motion.turns = readVectors(*value);
    if (const auto value = node.find("velocities")) motion.velocities = readVectors(*value);
    motion.end = readEnd(node);
    return motion;
}

Motion readLaw(const JsonNode& node) {
    const JsonNode type = node.required("type", "constant, sine or table");
    const std::string name = type.text();
    if (name == "constant") return readConstant(node);
    if (name == "sine") return readSine(node);
    if (name == "table") return readTable(node);
    type.refuse("constant, sine or table");
}

}  // namespace

TableEnd readTableEnd(const JsonNode& node) {
    const std::string name = node.text();
    if (name != "hold" && name != "repeat") node.refuse("hold or repeat");
    return name == "repeat" ? TableEnd::repeat : TableEnd::hold;
}

Motion readMotion(const JsonNode& node) {
    Motion motion = readLaw(node);
    try {
        static_cast<void>(MotionCurve(motion));
    } catch (const InputError& error) {
        node.fail(fmt::format("is not allowed: {}", error.what()));
    }
    return motion;
}

}  // namespace cairn
