#include <fmt/format.h>

#include "body/material_table.h"
#include "scene/scene_reading.h"
#include "scene/scene_writing.h"

namespace cairn {
namespace {

SpeedCurve readCurve(const JsonNode& node) {
    node.expectKeys({"speeds", "values"});
    SpeedCurve curve;
    curve.speeds = readNumbers(node.required("speeds", "an array of ascending speeds [m/s]"));
    curve.values = readNumbers(node.required("values", "an array with as many values"));
    return curve;
}

std::string numbersText(const std::vector<double>& numbers) {
    std::string out;
    for (const double value : numbers) out += (out.empty() ? "" : ",") + written::number(value);
    return "[" + out + "]";
}

std::string curveText(const SpeedCurve& curve) {
    return fmt::format(R"({{"speeds":{},"values":{}}})", numbersText(curve.speeds), numbersText(curve.values));
}

}  // namespace

std::vector<double> readNumbers(const JsonNode& node) {
    node.expectArray("an array of numbers");
    std::vector<double> numbers;
    numbers.reserve(node.size());
    for (std::size_t i = 0; i < node.size(); ++i) numbers.push_back(node.element(i).number());
    return numbers;
}

PairLaw readPairLaw(const JsonNode& node) {
    node.expectKeys({"restitution", "friction"});
    PairLaw law;
    if (const auto value = node.find("restitution")) law.restitution = readCurve(*value);
    if (const auto value = node.find("friction")) law.friction = readCurve(*value);
    try {
        validateLaw(law);
    } catch (const InputError& error) {
        node.fail(fmt::format("is not allowed: {}", error.what()));
    }
    return law;
}

std::string pairLawText(const PairLaw& law) {
    std::string out;
    if (!law.restitution.speeds.empty()) out += fmt::format(R"("restitution":{})", curveText(law.restitution));
    if (!law.friction.speeds.empty()) {
        out += fmt::format(R"({}"friction":{})", out.empty() ? "" : ",", curveText(law.friction));
    }
    return "{" + out + "}";
}

}  // namespace cairn
