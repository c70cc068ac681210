#include "integration/motion_curve.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn {

namespace {

/// Largest components of velocities, spins and places of a law: far below where worlds end.
constexpr double speed_of_laws = 1e6;
constexpr double extent_of_laws = 1e9;

void requireWithin(const Vec3& value, double limit, std::string_view what) {
    if (value.allFinite() && value.cwiseAbs().maxCoeff() <= limit) return;
    throw InputError(fmt::format("the {} of a motion is ({}, {}, {}); every component must be finite and within ±{}",
                                 what, value.x(), value.y(), value.z(), limit));
}

void validate(const ConstantMotion& motion) {
    requireWithin(motion.velocity, speed_of_laws, "velocity");
    requireWithin(motion.spin, speed_of_laws, "spin");
}

void validate(const SineMotion& motion) {
    requireWithin(motion.amplitude, extent_of_laws, "amplitude");
    requireWithin(motion.turn, extent_of_laws, "turn");
    if (!(motion.frequency > 0 && motion.frequency <= speed_of_laws)) {
        throw InputError(fmt::format("the frequency of a motion is {} Hz; it must be above 0 and at most {} Hz",
                                     motion.frequency, speed_of_laws));
    }
    if (!(std::abs(motion.phase) <= extent_of_laws)) {
        throw InputError(fmt::format("the phase of a motion is {} rad; it must be finite and within ±{} rad",
                                     motion.phase, extent_of_laws));
    }
}

/// @param values one for each time, or none
void requireColumn(const TableMotion& table, const std::vector<Vec3>& values, double limit, std::string_view what) {
    if (!values.empty() && values.size() != table.times.size()) {
        throw InputError(fmt::format("a motion by a table has {} times and {} {}; give as many, or none",
                                     table.times.size(), values.size(), what));
    }
    for (const Vec3& value : values) requireWithin(value, limit, what);
    const bool closes = values.empty() || table.end == TableEnd::hold || values.front() == values.back();
    if (!closes) {
        throw InputError(
            fmt::format("a motion by a table repeats, but its first and last {} differ; make them the same", what));
    }
}

void validate(const TableMotion& table) {
    if (table.times.size() < 2) {
        throw InputError(fmt::format("a motion by a table has {} times; it needs at least two", table.times.size()));
    }
    for (std::size_t i = 0; i < table.times.size(); ++i) {
        const bool follows = i == 0 || table.times[i] > table.times[i - 1];
        if (std::abs(table.times[i]) <= extent_of_laws && follows) continue;
        throw InputError(
            fmt::format("time {} of a motion by a table is {} s; times must be finite and ascend", i, table.times[i]));
    }
    if (table.displacements.empty() && table.turns.empty()) {
        throw InputError("a motion by a table has neither displacements nor turns; give one of them");
    }
    requireColumn(table, table.displacements, extent_of_laws, "displacements");
    requireColumn(table, table.turns, extent_of_laws, "turns");
    requireColumn(table, table.velocities, speed_of_laws, "velocities");
    if (!table.velocities.empty() && table.displacements.empty()) {
        throw InputError("a motion by a table has velocities without displacements; give these, too");
    }
}

/// The shortest time between entries from the one before an interval to the one after it [s].
double shortestBeside(const std::vector<double>& times, std::size_t interval) {
    double shortest = times[interval + 1] - times[interval];
    if (interval > 0) shortest = std::min(shortest, times[interval] - times[interval - 1]);
    if (interval + 2 < times.size()) shortest = std::min(shortest, times[interval + 2] - times[interval + 1]);
    return shortest;
}

/// Slopes of a smooth curve through the entries: of the parabola through each entry and its neighbours.
std::vector<Vec3> slopesOf(const TableMotion& table, const std::vector<Vec3>& values) {
    const std::size_t count = values.size();
    std::vector<Vec3> slopes(count, Vec3::Zero());
    if (count == 0) return slopes;
    const auto step = [&](std::size_t i) { return table.times[i + 1] - table.times[i]; };
    const auto rise = [&](std::size_t i) -> Vec3 { return (values[i + 1] - values[i]) / step(i); };
    const auto between = [&](std::size_t before, std::size_t after) -> Vec3 {
        return (step(after) * rise(before) + step(before) * rise(after)) / (step(before) + step(after));
    };
    for (std::size_t i = 1; i + 1 < count; ++i) slopes[i] = between(i - 1, i);
    if (table.end == TableEnd::repeat) slopes.front() = slopes.back() = between(count - 2, 0);
    return slopes;
}

/// Refuses values through which the smooth curve leaves all bounds: it overshoots where a change within a short time
/// stands beside a long one, and whatever followed it would be nowhere. A cubic stays among its Bézier points.
void requireBounded(const TableMotion& table, const std::vector<Vec3>& values, const std::vector<Vec3>& slopes) {
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
        const double third = (table.times[i + 1] - table.times[i]) / 3;
        const Vec3 points[] = {values[i] + third * slopes[i], values[i + 1] - third * slopes[i + 1]};
        const bool bounded = std::ranges::all_of(points, [](const Vec3& point) {
            return point.allFinite() && point.cwiseAbs().maxCoeff() <= extent_of_laws;
        });
        if (bounded) continue;
        throw InputError(fmt::format(
            "between the times {} s and {} s the smooth curve of a motion by a table leaves ±{}, since the values "
            "change "
            "too fast there or beside; put these times farther apart than {} s, or spread the change over more of them",
            table.times[i], table.times[i + 1], extent_of_laws, shortestBeside(table.times, i)));
    }
}

/// One column of a table between two entries, by the cubic with given ends and slopes there. @param s from 0 to 1
Vec3 interpolate(const std::vector<Vec3>& values, const std::vector<Vec3>& slopes, std::size_t i, double s,
                 double step) {
    if (values.empty()) return Vec3::Zero();
    const Vec3 rise = values[i + 1] - values[i];
    const Vec3 begin = step * slopes[i] - rise;
    const Vec3 end = rise - step * slopes[i + 1];
    return values[i] - values.front() + s * (rise + (1 - s) * ((1 - s) * begin + s * end));
}

}  // namespace

MotionCurve::MotionCurve(Motion motion) : motion_(std::move(motion)) {
    std::visit([](const auto& law) { validate(law); }, motion_);
    if (const auto* table = std::get_if<TableMotion>(&motion_)) {
        velocities_ = table->velocities.empty() ? slopesOf(*table, table->displacements) : table->velocities;
        spins_ = slopesOf(*table, table->turns);
        requireBounded(*table, table->displacements, velocities_);
        requireBounded(*table, table->turns, spins_);
    }
}

Excursion MotionCurve::at(double time) const {
    if (const auto* constant = std::get_if<ConstantMotion>(&motion_)) {
        return {constant->velocity * time, constant->spin * time};
    }
    if (const auto* sine = std::get_if<SineMotion>(&motion_)) {
        const double swing =
            std::sin(2 * std::numbers::pi * sine->frequency * time + sine->phase) - std::sin(sine->phase);
        return {sine->amplitude * swing, sine->turn * swing};
    }
    return ofTable(*std::get_if<TableMotion>(&motion_), time);
}

Excursion MotionCurve::ofTable(const TableMotion& table, double time) const {
    const std::vector<double>& times = table.times;
    const double length = times.back() - times.front();
    if (table.end == TableEnd::repeat && time > times.back()) {
        time = times.front() + std::fmod(time - times.front(), length);
    }
    time = std::clamp(time, times.front(), times.back());
    const auto after = std::upper_bound(times.begin() + 1, times.end() - 1, time);
    const auto i = static_cast<std::size_t>(after - times.begin()) - 1;
    const double step = times[i + 1] - times[i];
    const double s = (time - times[i]) / step;
    return {interpolate(table.displacements, velocities_, i, s, step), interpolate(table.turns, spins_, i, s, step)};
}

std::optional<double> MotionCurve::end() const {
    const auto* table = std::get_if<TableMotion>(&motion_);
    if (table == nullptr || table->end == TableEnd::repeat) return {};
    return table->times.back();
}

bool MotionCurve::turns() const {
    if (const auto* constant = std::get_if<ConstantMotion>(&motion_)) return !constant->spin.isZero(0);
    if (const auto* sine = std::get_if<SineMotion>(&motion_)) return !sine->turn.isZero(0);
    return !std::get_if<TableMotion>(&motion_)->turns.empty();
}

namespace {

/// What of an acceleration a0 + slope·t is there after a time, from rest.
struct Travelled {
    Vec3 velocity;
    Vec3 displacement;
};

/// Integrates straight lines between samples exactly.
TableMotion integrate(double interval, std::span<const Vec3> a) {
    TableMotion table;
    Vec3 x = Vec3::Zero();
    Vec3 v = Vec3::Zero();
    for (std::size_t i = 0; i < a.size(); ++i) {
        table.times.push_back(static_cast<double>(i) * interval);
        table.displacements.push_back(x);
        table.velocities.push_back(v);
        if (i + 1 == a.size()) break;
        x += interval * v + interval * interval * (2 * a[i] + a[i + 1]) / 6;
        v += interval * (a[i] + a[i + 1]) / 2;
    }
    return table;
}

/// The line a0 + slope·t after which, from rest, a body has a velocity and a displacement at the time T:
/// a0·T + slope·T²/2 = v and a0·T²/2 + slope·T³/6 = x.
Travelled lineTo(const Travelled& end, double time) {
    const Vec3 slope = 12 * (end.velocity * time / 2 - end.displacement) / (time * time * time);
    return {end.velocity / time - slope * time / 2, slope};
}

}  // namespace

TableMotion integrateAccelerogram(double interval, std::span<const Vec3> accelerations, Baseline baseline) {
    if (!(interval > 0 && interval <= extent_of_laws)) {
        throw InputError(
            fmt::format("the interval of an accelerogram is {} s; it must be above 0 and finite", interval));
    }
    if (accelerations.size() < 2) {
        throw InputError(fmt::format("an accelerogram has {} samples; it needs at least two", accelerations.size()));
    }
    for (const Vec3& sample : accelerations) requireWithin(sample, speed_of_laws, "acceleration");
    const TableMotion recorded = integrate(interval, accelerations);
    if (baseline == Baseline::none) return recorded;
    const auto [offset, slope] =
        lineTo({recorded.velocities.back(), recorded.displacements.back()}, recorded.times.back());
    std::vector<Vec3> corrected(accelerations.begin(), accelerations.end());
    for (std::size_t i = 0; i < corrected.size(); ++i) corrected[i] -= offset + recorded.times[i] * slope;
    TableMotion table = integrate(interval, corrected);
    // What rounding leaves.
    table.velocities.back().setZero();
    table.displacements.back().setZero();
    return table;
}

}  // namespace cairn
