#include <fmt/format.h>

#include "integration/motion_curve.h"
#include "scene/scene_reading.h"

namespace cairn {
namespace {

std::vector<double> readNumbers(const JsonNode& node) {
    node.expectArray("an array of numbers");
    std::vector<double> numbers;
    numbers.reserve(node.size());
    for (std::size_t i = 0; i < node.size(); ++i) numbers.push_back(node.element(i).number());
    return numbers;
}

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

Motion readAccelerogram(const JsonNode& node, const JsonNode& accelerations) {
    node.expectKeys({"type", "interval", "accelerations", "baseline", "pivot"});
    const double interval = node.required("interval", "the time between two samples [s], above 0").positive();
    Baseline baseline = Baseline::none;
    if (const auto value = node.find("baseline")) {
        const std::string name = value->text();
        if (name != "none" && name != "at_rest") value->refuse("none or at_rest");
        baseline = name == "at_rest" ? Baseline::at_rest : Baseline::none;
    }
    const std::vector<Vec3> samples = readVectors(accelerations);
    try {
        return integrateAccelerogram(interval, samples, baseline);
    } catch (const InputError& error) {
        node.fail(fmt::format("is not allowed: {}", error.what()));
    }
}

Motion readTable(const JsonNode& node) {
    if (const auto accelerations = node.find("accelerations")) return readAccelerogram(node, *accelerations);
    node.expectKeys({"type", "times", "displacements", "turns", "velocities", "end", "pivot"});
    TableMotion motion;
    motion.times = readNumbers(node.required("times", "an array of ascending times [s]"));
    if (const auto value = node.find("displacements")) motion.displacements = readVectors(*value);
    if (const auto value = node.find("turns")) motion.turns = readVectors(*value);
    if (const auto value = node.find("velocities")) motion.velocities = readVectors(*value);
    if (const auto value = node.find("end")) {
        const std::string name = value->text();
        if (name != "hold" && name != "repeat") value->refuse("hold or repeat");
        motion.end = name == "repeat" ? TableEnd::repeat : TableEnd::hold;
    }
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
