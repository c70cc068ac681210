/// @file cairn info: what stands in a recording or a scene.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cairn/decompose.h"
#include "cairn/recording.h"
#include "cli/output.h"
#include "cli/scene_argument.h"
#include "commands.h"

namespace cairn::cli {

namespace {

/// The names of the alternatives of Shape, in their order.
constexpr std::array<std::string_view, std::variant_size_v<Shape>> shape_names = {
    "sphere", "box", "capsule", "plane", "cylinder", "hull", "compound", "mesh", "height_field"};

std::string line(std::string_view name, std::string_view value) {
    return fmt::format("{:<14} {}\n", name, value);
}

std::string describeBodies(const Scene& scene) {
    std::map<std::size_t, std::size_t> count;
    std::size_t fixed = 0;
    for (const SceneBody& body : scene.bodies) {
        ++count[body.shape.index()];
        if (body.fixed) ++fixed;
    }
    std::string text = fmt::format("{} ({} fixed)", scene.bodies.size(), fixed);
    for (const auto& [shape, bodies] : count) text += fmt::format(", {} {}", shape_names[shape], bodies);
    return text;
}

/// How well convex parts stand for a concave solid; empty for other shapes.
std::string solidText(const Shape& shape) {
    const auto* compound = std::get_if<Compound>(&shape);
    if (compound == nullptr || !compound->solid) return "";
    return fmt::format("{} parts, volume {:.6g} m³, error {:.2g} of it", compound->parts.size(),
                       compound->solid->volume, volumeErrorOf(*compound));
}

/// How large a surface of triangles is, and what was mended of it; empty for other shapes.
std::string surfaceText(const Shape& shape) {
    constexpr double megabyte = 1e6;
    if (const auto* field = std::get_if<HeightField>(&shape)) {
        return fmt::format("{} × {} heights, {} triangles, {:.3g} MB", field->columns(), field->rows(),
                           field->triangles().size(), static_cast<double>(field->bytes()) / megabyte);
    }
    const auto* mesh = std::get_if<Mesh>(&shape);
    if (mesh == nullptr) return "";
    const SurfaceRepairs& repairs = mesh->repairs();
    std::string text = fmt::format("{} triangles, {:.3g} MB, {} open edges", mesh->triangles().size(),
                                   static_cast<double>(mesh->bytes()) / megabyte, repairs.open_edges);
    if (repairs.degenerate > 0) text += fmt::format(", {} without an area left out", repairs.degenerate);
    if (repairs.duplicate > 0) text += fmt::format(", {} given twice left out", repairs.duplicate);
    if (repairs.welded > 0) text += fmt::format(", {} of the vertices welded", repairs.welded);
    return text;
}

/// A line for each text that bodies have, by the first of them, with their number.
std::string describeAlike(const Scene& scene, std::string_view name, std::string (*textOf)(const Shape&)) {
    std::vector<std::pair<std::string, std::size_t>> found;
    for (const SceneBody& body : scene.bodies) {
        const std::string text = textOf(body.shape);
        if (text.empty()) continue;
        const auto same = std::ranges::find(found, text, &std::pair<std::string, std::size_t>::first);
        if (same == found.end()) {
            found.emplace_back(text, 1);
        } else {
            ++same->second;
        }
    }
    std::string lines;
    for (const auto& [text, count] : found) lines += line(name, fmt::format("{} × {}", count, text));
    return lines;
}

std::string describeScene(const Scene& scene) {
    std::string text = line("scene", scene.name);
    text += line("bodies", describeBodies(scene));
    text += describeAlike(scene, "solid", solidText);
    text += describeAlike(scene, "surface", surfaceText);
    text += line("duration", fmt::format("{} s", scene.duration));
    text += line("gravity", fmt::format("{} {} {} m/s²{}", scene.gravity.x(), scene.gravity.y(), scene.gravity.z(),
                                        scene.gravity_law ? ", changes by a law" : ""));
    for (const Material& material : scene.materials) {
        text += line("material", fmt::format("{}, {} kg/m³", material.name, material.density));
    }
    text += line("springs", fmt::format("{}", scene.springs.size()));
    text += line("joints", fmt::format("{}", scene.joints.size()));
    text += line("events", fmt::format("{}", scene.events.size()));
    return text;
}

std::string describeRecording(const RecordingReader& recording) {
    const RecordingInfo& info = recording.info();
    std::string text = line("recording", fmt::format("{} frames", info.frames));
    if (info.frames > 0) {
        const Frame last = recording.frame(info.frames - 1);
        text += line("time", fmt::format("0 to {:.6g} s", last.time));
        text += line("energy at end",
                     fmt::format("{:.6g} J kinetic, {:.6g} J potential", last.kinetic_energy, last.potential_energy));
        text += line("asleep at end", fmt::format("{}", last.statistics.asleep));
    }
    text += line("made by", "cairn " + info.version);
    text += line("machine", info.machine);
    text += describeScene(info.scene);
    for (const auto& [name, value] : info.settings) text += line("setting", fmt::format("{} = {}", name, value));
    return text;
}

}  // namespace

void addInfo(CLI::App& app, int&) {
    CLI::App* command = app.add_subcommand("info", "Tell what stands in a recording or a scene");
    auto file = std::make_shared<std::string>();
    command->add_option("FILE", *file, "A recording, a scene file or the name of a built-in scene")->required();
    command->callback([file] {
        const bool recording = !isBuiltInScene(*file) && looksLikeRecording(*file);
        printOut(recording ? describeRecording(RecordingReader(*file)) : describeScene(loadScene(*file)));
    });
}

}  // namespace cairn::cli
