#include "toss.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "cairn/world.h"

namespace cairn::validation {

namespace {

constexpr const char* columns = "time,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz";
constexpr std::size_t column_count = 14;
using Row = std::array<double, column_count>;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
    throw InputError(fmt::format("{}: {}; docs/cube-tosses.md describes the format", file.string(), what));
}

TossSample sampleOf(const Row& r, const std::filesystem::path& file, const std::string& place) {
    for (const double number : r) {
        if (!std::isfinite(number)) refuse(file, place + ": a number is not finite");
    }
    TossSample sample;
    sample.time = r[0];
    sample.pose.position = Vec3(r[1], r[2], r[3]);
    const Quat turned(r[4], r[5], r[6], r[7]);
    if (!(std::abs(turned.norm() - 1) < 0.01)) {
        refuse(file, fmt::format("{}: qw,qx,qy,qz has the length {:.3g}; it must be a unit quaternion", place,
                                 turned.norm()));
    }
    sample.pose.orientation = turned.normalized();
    sample.v = Vec3(r[8], r[9], r[10]);
    sample.w = Vec3(r[11], r[12], r[13]);
    return sample;
}

void setProperty(Toss& toss, const std::string& key, double value, const std::filesystem::path& file) {
    const std::array<std::pair<const char*, double*>, 5> known = {{{"side", &toss.side},
                                                                   {"mass", &toss.mass},
                                                                   {"friction", &toss.friction},
                                                                   {"restitution", &toss.restitution},
                                                                   {"gravity", &toss.gravity}}};
    for (const auto& [name, target] : known) {
        if (key != name) continue;
        const bool may_be_zero = key == "friction" || key == "restitution";
        if (!std::isfinite(value) || value < 0 || (value == 0 && !may_be_zero)) {
            refuse(file, fmt::format("{} is {}; it must be {} 0", key, value, may_be_zero ? "at least" : "above"));
        }
        *target = value;
        return;
    }
    refuse(file, fmt::format("'{}' is unknown; known are side, mass, friction, restitution and gravity", key));
}

double numberOf(std::string_view text, const std::filesystem::path& file, const std::string& place) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.remove_suffix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
        refuse(file, fmt::format("{}: '{}' is not a number", place, text));
    }
    return value;
}

/// "# side = 0.1048"
void readProperty(const std::string& line, Toss& toss, const std::filesystem::path& file, const std::string& place) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) return;  // a remark
    std::string key = line.substr(1, equals - 1);
    std::erase_if(key, [](char c) { return c == ' '; });
    setProperty(toss, key, numberOf(std::string_view(line).substr(equals + 1), file, place), file);
}

Toss readCsv(std::istream& in, const std::filesystem::path& file) {
    Toss toss;
    bool headed = false;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        const std::string place = fmt::format("line {}", ++number);
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.empty()) continue;
        if (line.front() == '#') {
            readProperty(line, toss, file, place);
            continue;
        }
        if (!headed) {
            if (line != columns) refuse(file, fmt::format("{}: the columns must be {}", place, columns));
            headed = true;
            continue;
        }
        Row row{};
        std::size_t count = 0;
        std::stringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) {
            if (count < column_count) row[count] = numberOf(cell, file, place);
            ++count;
        }
        if (count != column_count) {
            refuse(file, fmt::format("{}: {} numbers in place of {}", place, count, column_count));
        }
        toss.samples.push_back(sampleOf(row, file, place));
    }
    return toss;
}

Toss readJson(std::istream& in, const std::filesystem::path& file) {
    Toss toss;
    try {
        const nlohmann::json json = nlohmann::json::parse(in);
        for (const auto& [key, value] : json.items()) {
            if (key == "name" || key == "samples") continue;
            setProperty(toss, key, value.get<double>(), file);
        }
        std::size_t number = 0;
        for (const auto& sample : json.at("samples")) {
            const std::string place = fmt::format("samples[{}]", number++);
            if (sample.size() != column_count) {
                refuse(file, fmt::format("{}: {} numbers in place of {}", place, sample.size(), column_count));
            }
            toss.samples.push_back(sampleOf(sample.get<Row>(), file, place));
        }
    } catch (const nlohmann::json::exception& error) {
        refuse(file, error.what());
    }
    return toss;
}

World worldOf(const Toss& toss, const Settings& settings, BodyId& cube) {
    World world(settings);
    world.setGravity(Vec3(0, 0, -toss.gravity));
    world.addMaterial({.name = "cube", .density = 1000});
    world.setDefaultPairProperties(
        {.restitution = toss.restitution, .static_friction = toss.friction, .kinetic_friction = toss.friction});
    BodyDescription table;
    table.shape = HalfSpace{.normal = Vec3::UnitZ(), .offset = 0};
    table.fixed = true;
    world.addBody(table);
    const TossSample& first = toss.samples.front();
    BodyDescription description;
    description.shape = Box{Vec3::Constant(toss.side)};
    description.mass = toss.mass;
    description.pose = first.pose;
    description.linear_velocity = first.v;
    description.angular_velocity = first.w;
    cube = world.addBody(description);
    return world;
}

/// Calls see(sample index) after the step that comes nearest to each time. @param times since the first [s], ascending
template <class See>
void runAlong(World& world, const std::vector<double>& times, const See& see) {
    for (std::size_t i = 0; i < times.size(); ++i) {
        const auto step = static_cast<std::int64_t>(std::llround(times[i] * world.settings().steps_per_second));
        while (world.stepCount() < step) world.step();
        see(i);
    }
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

Toss readToss(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw IoError(fmt::format("{}: cannot be read", file.string()));
    Toss toss = file.extension() == ".json" ? readJson(in, file) : readCsv(in, file);
    toss.name = file.stem().string();
    if (toss.samples.size() < 2) refuse(file, fmt::format("{} samples; two are the least", toss.samples.size()));
    const auto later = [](const TossSample& a, const TossSample& b) { return b.time <= a.time; };
    const auto bad = std::adjacent_find(toss.samples.begin(), toss.samples.end(), later);
    if (bad != toss.samples.end()) {
        refuse(file, fmt::format("the sample after {} s is not later than it", bad->time));
    }
    if (toss.restitution > 1) refuse(file, fmt::format("restitution is {}; it must be at most 1", toss.restitution));
    return toss;
}

std::string formatTossCsv(const Toss& toss) {
    std::string text =
        fmt::format("# side = {}\n# mass = {}\n# friction = {}\n# restitution = {}\n# gravity = {}\n{}\n", toss.side,
                    toss.mass, toss.friction, toss.restitution, toss.gravity, columns);
    for (const TossSample& s : toss.samples) {
        const Vec3& p = s.pose.position;
        const Quat& q = s.pose.orientation;
        text += fmt::format(
            "{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},"
            "{:.9g}\n",
            s.time, p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), s.v.x(), s.v.y(), s.v.z(), s.w.x(), s.w.y(),
            s.w.z());
    }
    return text;
}

double TossErrors::meanPosition() const {
    return mean(position);
}

double TossErrors::meanAngle() const {
    return mean(angle);
}

TossErrors compareToss(const Toss& toss, const Settings& settings) {
    BodyId cube{};
    World world = worldOf(toss, settings, cube);
    TossErrors errors;
    for (const TossSample& sample : toss.samples) errors.time.push_back(sample.time - toss.samples.front().time);
    runAlong(world, errors.time, [&](std::size_t i) {
        const Pose pose = world.pose(cube);
        const Pose& measured = toss.samples[i].pose;
        errors.position.push_back((pose.position - measured.position).norm());
        errors.angle.push_back(pose.orientation.angularDistance(measured.orientation));
    });
    return errors;
}

Toss simulateToss(const Toss& begin, const Settings& settings, double rate, double duration) {
    BodyId cube{};
    World world = worldOf(begin, settings, cube);
    Toss toss = begin;
    toss.samples.clear();
    std::vector<double> times;
    for (int i = 0; i <= static_cast<int>(duration * rate); ++i) times.push_back(i / rate);
    runAlong(world, times, [&](std::size_t i) {
        toss.samples.push_back({times[i], world.pose(cube), world.linearVelocity(cube), world.angularVelocity(cube)});
    });
    return toss;
}

}  // namespace cairn::validation
