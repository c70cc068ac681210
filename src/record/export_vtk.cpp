#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cairn/recording.h"
#include "record/force_lines.h"
#include "record/recorded_settings.h"
#include "record/surface.h"
#include "record/vtk_file.h"

namespace cairn {

namespace {

/// A body's surface and what does not change with time.
struct DrawnBody {
    Surface surface;
    std::int32_t material = 0;
    bool fixed = false;
};

/// A square around all bodies of the initial state, with a margin for those that will roll away.
struct SceneExtent {
    Vec3 centre = Vec3::Zero();  ///< [m, W]
    double half_edge = 1;        ///< [m]
};

SceneExtent extentOf(const Scene& scene) {
    Eigen::AlignedBox3d bounds;
    for (const SceneBody& body : scene.bodies) {
        if (!std::holds_alternative<HalfSpace>(body.shape)) bounds.extend(body.position);
    }
    if (bounds.isEmpty()) return {};
    return {bounds.center(), std::max(1.0, bounds.diagonal().norm())};
}

std::int32_t materialIndex(const Scene& scene, const std::string& name) {
    const auto is_it = [&](const Material& material) { return material.name == name; };
    return static_cast<std::int32_t>(std::find_if(scene.materials.begin(), scene.materials.end(), is_it) -
                                     scene.materials.begin());
}

std::vector<DrawnBody> drawnBodies(const Scene& scene) {
    const SceneExtent extent = extentOf(scene);
    std::vector<DrawnBody> drawn;
    std::size_t corners = 0;
    for (const SceneBody& body : scene.bodies) {
        const Pose pose{body.position, body.orientation.normalized()};
        const PlaneExtent plane{pose.toInner(extent.centre), extent.half_edge};
        drawn.push_back({makeSurface(body.shape, plane), materialIndex(scene, body.material), body.fixed});
        corners += drawn.back().surface.corners.size();
    }
    if (corners > std::numeric_limits<std::int32_t>::max()) {
        throw InputError(
            fmt::format("the scene has {} bodies, whose surfaces are too many for a VTK file; at most {} "
                        "corners fit, these are {}",
                        scene.bodies.size(), std::numeric_limits<std::int32_t>::max(), corners));
    }
    return drawn;
}

void addBody(VtkPolygons& out, const DrawnBody& drawn, const Frame& frame, std::size_t body) {
    const Pose pose{frame.position[body], frame.orientation[body]};
    const auto first = static_cast<std::int32_t>(out.points.size() / 3);
    const auto corners_before = static_cast<std::int32_t>(out.corners.size());
    for (const Vec3& point : drawn.surface.points) {
        const Vec3 p = pose.toOuter(point);
        for (int i = 0; i < 3; ++i) out.points.push_back(static_cast<float>(p[i]));
    }
    for (const std::int32_t corner : drawn.surface.corners) out.corners.push_back(first + corner);
    for (const std::int32_t end : drawn.surface.ends) out.ends.push_back(corners_before + end);
    const std::size_t cells = out.ends.size();
    out.body.resize(cells, static_cast<std::int32_t>(body));
    out.material.resize(cells, drawn.material);
    out.asleep.resize(cells, frame.asleep[body]);
    out.fixed.resize(cells, drawn.fixed ? 1 : 0);
    out.speed.resize(cells, static_cast<float>(frame.linear_velocity[body].norm()));
}

void draw(const std::vector<DrawnBody>& drawn, const Frame& frame, VtkPolygons& polygons) {
    polygons.clear();
    for (std::size_t body = 0; body < drawn.size(); ++body) {
        // Removed bodies have no position, nor have those of other ranks.
        if (frame.position[body].allFinite()) addBody(polygons, drawn[body], frame, body);
    }
}

void createFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw IoError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
}

/// A series of files in a folder, and the file that names them.
class VtkSeries {
  public:
    /// @param folder of the files @param kind that follows its name, for the .pvd file and the files
    VtkSeries(std::filesystem::path folder, std::string kind) : folder_(std::move(folder)), kind_(std::move(kind)) {}

    /// @param part of a recording in parts
    template <class Content>
    void add(std::size_t frame, double time, const Content& content, std::optional<std::size_t> part = {}) {
        const std::string rank = part ? fmt::format("_rank{}", *part) : "";
        const std::string name = fmt::format("{}{}{}_{:06}.vtp", folder_.filename().string(), kind_, rank, frame);
        writeVtp(content, folder_ / name);
        steps_.push_back({time, folder_.filename().string() + '/' + name, part.value_or(0)});
    }
    void close() const {
        std::filesystem::path file = folder_;
        file += kind_ + ".pvd";
        writePvd(steps_, file);
    }

  private:
    std::filesystem::path folder_;
    std::string kind_;
    std::vector<VtkTimeStep> steps_;
};

}  // namespace

void exportVtk(const RecordingReader& recording, const std::filesystem::path& file) {
    const RecordingInfo& info = recording.info();
    const std::vector<DrawnBody> drawn = drawnBodies(info.scene);
    // OUT and OUT.pvd both stand for OUT.pvd beside the folder OUT.
    std::filesystem::path folder = file;
    if (folder.extension() == ".pvd") folder.replace_extension();
    createFolder(folder);
    VtkPolygons polygons;
    VtkSeries surfaces(folder, "");
    VtkLines lines;
    VtkSeries forces(folder, "_forces");
    const bool has_forces = info.contacts || info.joints;
    const ForceLines force_lines(info.scene, settingsOf(info).steps_per_second);
    for (std::size_t f = 0; f < info.frames; ++f) {
        for (std::size_t part = 0; part < info.parts; ++part) {
            const Frame of_rank = recording.framePart(f, part);
            draw(drawn, of_rank, polygons);
            surfaces.add(f, of_rank.time, polygons, part);
        }
        if (info.parts > 0 && !has_forces) continue;
        const Frame frame = recording.frame(f);
        if (info.parts == 0) {
            draw(drawn, frame, polygons);
            surfaces.add(f, frame.time, polygons);
        }
        if (!has_forces) continue;
        force_lines.of(frame, lines);
        forces.add(f, frame.time, lines);
    }
    surfaces.close();
    if (has_forces) forces.close();
}

}  // namespace cairn
