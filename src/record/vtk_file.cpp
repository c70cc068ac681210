#include "record/vtk_file.h"

#include <fmt/format.h>

#include <bit>
#include <iterator>
#include <string_view>

#include "record/output_file.h"

namespace cairn {

namespace {

constexpr std::string_view byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

template <typename Value>
struct TypeName;
template <>
struct TypeName<float> {
    static constexpr std::string_view name = "Float32";
};
template <>
struct TypeName<std::int32_t> {
    static constexpr std::string_view name = "Int32";
};
template <>
struct TypeName<std::uint8_t> {
    static constexpr std::string_view name = "UInt8";
};

template <typename Value>
std::string_view bytesOf(const std::vector<Value>& values) {
    // The only way to see the bytes of numbers that are to be written as they are in memory.
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

/// Collects arrays: their descriptions now, their bytes for the end of the file.
class Arrays {
  public:
    template <typename Value>
    std::string describe(std::string_view name, const std::vector<Value>& values, int components = 1) {
        const std::string text = fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
            TypeName<Value>::name, name, components, offset_);
        blocks_.push_back(bytesOf(values));
        offset_ += sizeof(std::uint64_t) + blocks_.back().size();
        return text;
    }

    void write(OutputFile& out) const {
        for (const std::string_view block : blocks_) {
            const std::uint64_t size = block.size();
            out.write({reinterpret_cast<const char*>(&size), sizeof(size)});
            out.write(block);
        }
    }

  private:
    std::vector<std::string_view> blocks_;
    std::uint64_t offset_ = 0;
};

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

}  // namespace

void VtkPolygons::clear() {
    points.clear();
    corners.clear();
    ends.clear();
    body.clear();
    material.clear();
    asleep.clear();
    fixed.clear();
    speed.clear();
}

namespace {

/// What stands before the arrays of a file.
std::string beginning(std::size_t points, std::size_t lines, std::size_t polygons) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n<PolyData>\n"
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"{}\">\n",
        byte_order, points, lines, polygons);
}

void writeFile(const std::string& head, const Arrays& arrays, const std::filesystem::path& file) {
    OutputFile out(file);
    out.write(head + "</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
    arrays.write(out);
    out.write("\n</AppendedData>\n</VTKFile>\n");
    out.close();
}

}  // namespace

void VtkLines::clear() {
    *this = {};
}

void writeVtp(const VtkPolygons& polygons, const std::filesystem::path& file) {
    Arrays arrays;
    std::string head = beginning(polygons.points.size() / 3, 0, polygons.ends.size());
    head += "<Points>\n" + arrays.describe("Points", polygons.points, 3) + "</Points>\n";
    head += "<Polys>\n" + arrays.describe("connectivity", polygons.corners);
    head += arrays.describe("offsets", polygons.ends) + "</Polys>\n";
    head += "<CellData Scalars=\"speed\">\n" + arrays.describe("body", polygons.body);
    head += arrays.describe("material", polygons.material) + arrays.describe("asleep", polygons.asleep);
    head += arrays.describe("fixed", polygons.fixed) + arrays.describe("speed", polygons.speed);
    writeFile(head, arrays, file);
}

void writeVtp(const VtkLines& lines, const std::filesystem::path& file) {
    std::vector<std::int32_t> ends(lines.force.size());
    std::vector<std::int32_t> corners(2 * lines.force.size());
    for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = static_cast<std::int32_t>(2 * i + 2);
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::int32_t>(i);
    Arrays arrays;
    std::string head = beginning(corners.size(), ends.size(), 0);
    head += "<Points>\n" + arrays.describe("Points", lines.points, 3) + "</Points>\n";
    head += "<Lines>\n" + arrays.describe("connectivity", corners);
    head += arrays.describe("offsets", ends) + "</Lines>\n";
    head += "<CellData Scalars=\"force\" Vectors=\"vector\">\n" + arrays.describe("force", lines.force);
    head += arrays.describe("normal_force", lines.normal_force) + arrays.describe("vector", lines.vector, 3);
    head += arrays.describe("body", lines.body) + arrays.describe("other", lines.other);
    head += arrays.describe("joint", lines.joint);
    writeFile(head, arrays, file);
}

void writePvd(const std::vector<VtkTimeStep>& steps, const std::filesystem::path& file) {
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"{}\">\n<Collection>\n",
        byte_order);
    for (const VtkTimeStep& step : steps) {
        fmt::format_to(std::back_inserter(text), "<DataSet timestep=\"{}\" group=\"\" part=\"{}\" file=\"{}\"/>\n",
                       step.time, step.part, escaped(step.file));
    }
    text += "</Collection>\n</VTKFile>\n";
    OutputFile out(file);
    out.write(text);
    out.close();
}

}  // namespace cairn
