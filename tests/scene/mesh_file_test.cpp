/// Meshes and heights from files, whole and damaged.
#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "cairn/mesh_file.h"
#include "cairn/scene.h"
#include "temporary_folder.h"

namespace cairn {
namespace {

/// A tetrahedron of edge lengths about 1.
const std::vector<Vec3> tetrahedron_vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<TriangleCorners> tetrahedron_triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

void append(std::string& bytes, const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
}
void append(std::string& bytes, const Vec3& v) {
    const std::array<float, 3> values = {static_cast<float>(v.x()), static_cast<float>(v.y()),
                                         static_cast<float>(v.z())};
    append(bytes, values.data(), sizeof values);
}

std::string binaryStl(std::uint32_t count) {
    std::string bytes(80, ' ');
    bytes.replace(0, 5, "solid");  // as some programs begin a binary one, too
    append(bytes, &count, 4);
    for (const TriangleCorners& t : tetrahedron_triangles) {
        append(bytes, Vec3::Zero());
        for (const std::uint32_t corner : t) append(bytes, tetrahedron_vertices[corner]);
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string textStl() {
    std::string text = "solid tetrahedron\n";
    for (const TriangleCorners& t : tetrahedron_triangles) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (const std::uint32_t c : t) {
            const Vec3& v = tetrahedron_vertices[c];
            text += "      vertex " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " +
                    std::to_string(v.z()) + "\r\n";
        }
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid\n";
}

const std::string obj =
    "# a comment\no name\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 +1e0 0.5\nvn 0 0 1\n"
    "f 1 3 2\nf 1/1 2/2/3 4//1\nf 2 3 4\nf -2 -4 -1\n";

const std::string ply_head =
    "ply\nformat FORMAT 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";

std::string plyHead(const std::string& format) {
    std::string head = ply_head;
    return head.replace(head.find("FORMAT"), 6, format);
}

std::string textPly() {
    return plyHead("ascii") + "0 0 0 7\n1 0 0 7 0 1\n0 7\n0 0 1 7\n\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
}

std::string binaryPly() {
    std::string bytes = plyHead("binary_little_endian");
    for (const Vec3& v : tetrahedron_vertices) {
        append(bytes, v);
        bytes += '\7';
    }
    for (const TriangleCorners& t : tetrahedron_triangles) {
        bytes += '\3';
        append(bytes, t.data(), sizeof t);
    }
    return bytes;
}

void expectTetrahedron(const Mesh& mesh) {
    EXPECT_EQ(mesh.vertices().size(), 4U);
    EXPECT_EQ(mesh.triangles().size(), 4U);
    EXPECT_EQ(mesh.repairs().open_edges, 0U);
    for (const Vec3& vertex : mesh.vertices()) {
        EXPECT_EQ(std::ranges::count(tetrahedron_vertices, vertex), 1) << vertex.transpose();
    }
}

std::string refusalOf(const std::string& bytes) {
    try {
        parseMesh(bytes, "file.x");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(MeshFile, ReadsEveryFormat) {
    for (const std::string& bytes : {binaryStl(4), textStl(), obj, textPly(), binaryPly()}) {
        expectTetrahedron(parseMesh(bytes, bytes.substr(0, 20)));
    }
    const Mesh scaled = parseMesh(obj, "x", SurfaceSides::two, Vec3(1e-3, 2, 3));
    EXPECT_EQ(scaled.vertices()[3], Vec3(0, 0, 3));
    EXPECT_EQ(scaled.sides(), SurfaceSides::two);
}

TEST(MeshFile, LargerFacesBecomeFans) {
    const Mesh mesh = parseMesh("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "x");
    EXPECT_EQ(mesh.triangles().size(), 2U);
}

TEST(MeshFile, RefusesFilesThatLie) {
    for (const std::string& whole : {binaryStl(4), binaryPly(), textPly()}) {
        EXPECT_NE(refusalOf(whole.substr(0, whole.size() - 20)), "") << "cut short";
    }
    EXPECT_NE(refusalOf(binaryStl(4000000000U)).find("length"), std::string::npos);
    EXPECT_NE(refusalOf("v 0 0 0\nv 1 0 0\nv 0 1 x\n").find("line 3"), std::string::npos);
    EXPECT_NE(refusalOf("v 0 0 0\nf 1 2 3\n").find("vertex"), std::string::npos);
    EXPECT_NE(refusalOf("v 0 0 0\nf 1 0 1\n").find("line 2"), std::string::npos);
    EXPECT_NE(refusalOf("v 0 0 0\nf 1 1\n").find("fewer than three"), std::string::npos);
    EXPECT_NE(refusalOf("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").find("finite"), std::string::npos);
    EXPECT_NE(refusalOf("").find("no vertex"), std::string::npos);
    EXPECT_NE(refusalOf("import numpy\nprint(1)\n").find("is no mesh"), std::string::npos);
    EXPECT_NE(refusalOf(plyHead("binary_big_endian")).find("binary_little_endian"), std::string::npos);
    EXPECT_NE(refusalOf("ply\nformat ascii 1.0\nelement vertex 99999999999999\nproperty float x\nend_header\n1 2 3\n")
                  .find("not complete"),
              std::string::npos);
    EXPECT_NE(refusalOf("ply\nformat ascii 1.0\nelement vertex 9\n").find("does not end"), std::string::npos);
    EXPECT_NE(refusalOf("solid\nvertex 0 0 0\nvertex 1 0 0\n").find("not complete"), std::string::npos);
    EXPECT_THROW(readMesh("/nowhere/a.stl"), IoError);
    EXPECT_THROW(readMesh("/"), IoError);
}

/// A picture of 3 × 2 pixels.
std::string picture(png_uint_32 format) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 3;
    image.height = 2;
    image.format = format;
    const std::array<png_uint_16, 18> deep = {0, 100, 65535, 1, 2, 3};
    const std::array<png_byte, 18> flat = {0, 100, 255, 1, 2, 3};
    const bool is_deep = (format & PNG_FORMAT_FLAG_LINEAR) != 0;
    const void* pixels = is_deep ? static_cast<const void*>(deep.data()) : flat.data();
    std::string bytes(10000, '\0');
    png_alloc_size_t size = bytes.size();
    EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr), 0);
    bytes.resize(size);
    return bytes;
}

TEST(HeightFile, ReadsGreyPicturesWithTheirUpperEdgeTowardsY) {
    const HeightField deep = parseHeightField(picture(PNG_FORMAT_LINEAR_Y), "x", {1, 2}, 10);
    ASSERT_EQ(deep.heights().size(), 6U);
    EXPECT_EQ(deep.columns(), 3U);
    EXPECT_DOUBLE_EQ(deep.heights()[5], 10);
    EXPECT_DOUBLE_EQ(deep.heights()[4], 10 * 100 / 65535.0);
    EXPECT_DOUBLE_EQ(deep.heights()[0], 10 / 65535.0);
    const HeightField flat = parseHeightField(picture(PNG_FORMAT_GRAY), "x", {1, 2}, 255);
    EXPECT_NEAR(flat.heights()[4], 100, 1e-9);
    EXPECT_NEAR(flat.heights()[2], 3, 1e-9);
}

TEST(HeightFile, RefusesOthers) {
    const std::string whole = picture(PNG_FORMAT_GRAY);
    EXPECT_THROW(parseHeightField(picture(PNG_FORMAT_RGB), "x", {1, 1}, 1), InputError);
    EXPECT_THROW(parseHeightField("no picture", "x", {1, 1}, 1), InputError);
    EXPECT_THROW(parseHeightField("", "x", {1, 1}, 1), InputError);
    EXPECT_THROW(parseHeightField(whole, "x", {1, 1}, 0), InputError);
    EXPECT_THROW(parseHeightField(whole, "x", {0, 1}, 1), InputError);
    for (std::size_t size = 0; size + 12 < whole.size(); ++size) {
        EXPECT_THROW(parseHeightField(whole.substr(0, size), "x", {1, 1}, 1), InputError) << size;
    }
}

std::string sceneWith(const std::string& shape, const std::string& more = R"(,"fixed":true)") {
    return R"({"name":"ground","duration":1,"gravity":[0,0,-10],"materials":{"oak":{"density":800}},"bodies":[{"shape":)" +
           shape + R"(,"material":"oak")" + more + "}]}";
}

std::string sceneRefusal(const std::string& shape, const std::string& more = R"(,"fixed":true)") {
    try {
        parseScene(sceneWith(shape, more), "scene.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(SurfaceScene, IsReadAndWrittenAsTheSame) {
    for (const std::string shape :
         {R"({"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0.5]],"indices":[[0,1,2]],"sides":"two"})",
          R"({"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0.5]],"indices":[[0,1,2]]})",
          R"({"type":"height_field","heights":[[0,1,2],[3,4,5]],"spacing":[0.5,1]})"}) {
        const std::string written = formatScene(parseScene(sceneWith(shape), "x"));
        EXPECT_NE(written.find(shape), std::string::npos) << written;
        EXPECT_EQ(formatScene(parseScene(written, "y")), written);
    }
    const std::string square = R"({"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0],[1,1,0]],"indices":)";
    EXPECT_EQ(formatScene(parseScene(sceneWith(square + "[0,1,2,1,3,2]}"), "x")),
              formatScene(parseScene(sceneWith(square + "[[0,1,2],[1,3,2]]}"), "x")));
    const Scene scaled =
        parseScene(sceneWith(R"({"type":"height_field","heights":[[0,1],[3,4]],"spacing":2,"scale":0.1})"), "x");
    EXPECT_DOUBLE_EQ(std::get<HeightField>(scaled.bodies[0].shape).heights()[3], 0.4);
}

TEST(SurfaceScene, FilesStandBesideTheScene) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "ground.obj") << obj;
    std::ofstream(folder / "ground.png", std::ios::binary) << picture(PNG_FORMAT_LINEAR_Y);
    std::ofstream(folder / "a.json") << sceneWith(R"({"type":"mesh","file":"ground.obj","scale":[1,2,3]})");
    std::ofstream(folder / "b.json") << sceneWith(
        R"({"type":"height_field","file":"ground.png","spacing":1,"scale":5})");
    EXPECT_EQ(std::get<Mesh>(readScene(folder / "a.json").bodies[0].shape).vertices()[3], Vec3(0, 0, 3));
    EXPECT_EQ(std::get<HeightField>(readScene(folder / "b.json").bodies[0].shape).heights()[5], 5);
    SceneRun run(readScene(folder / "a.json"), Settings::preset(Preset::performance));
    run.step();
}

TEST(SurfaceScene, SaysWhatIsWrong) {
    const std::string triangle = R"("vertices":[[0,0,0],[1,0,0],[0,1,0]])";
    EXPECT_NE(sceneRefusal(R"({"type":"mesh"})").find("either file or vertices"), std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"mesh","file":"no.stl"})").find("no.stl"), std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"mesh","file":"no.stl","indices":[]})").find("remove them"), std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"mesh",)" + triangle + "}").find("indices"), std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"mesh",)" + triangle + R"(,"indices":[[0,1,3]]})").find("the vertex 3"),
              std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"mesh",)" + triangle + R"(,"indices":[[0,1,-1]]})").find("indices[0][2]"),
              std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"mesh",)" + triangle + R"(,"indices":[0,1,2,0]})").find("has 4 indices; give"),
              std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"mesh",)" + triangle + R"(,"indices":[0,1,[2]]})").find("indices[2]"),
              std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"mesh",)" + triangle + R"(,"indices":[[0,1,2],3,4]})").find("indices[1] is 3"),
              std::string::npos);
    EXPECT_NE(
        sceneRefusal(R"({"type":"mesh",)" + triangle + R"(,"indices":[[0,1,2]],"sides":"three"})").find("one or two"),
        std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"mesh",)" + triangle + R"(,"indices":[[0,1,2]]})", "").find("not fixed"),
              std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"height_field","heights":[[0,1],[2]],"spacing":1})").find("heights[1]"),
              std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"height_field","heights":[[0,1],[2,3]]})").find("spacing"), std::string::npos);
    EXPECT_NE(sceneRefusal(R"({"type":"height_field","heights":[],"spacing":1})").find("at least two"),
              std::string::npos);
}

}  // namespace
}  // namespace cairn
