// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract.h"
#include "pipelines/command/extract/extract_bricks.h"
#include "pipelines/command/extract/extract_specular.h"

#include "formats/gpu_shared/brick_codes.h"
#include "pipelines/command/extract/open_pack.h"
#include "pipelines/command/inspect/verify.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

namespace hearth::test
{

using namespace formats;

namespace
{

/// Contents of a PLY file that extract writes, as a PLY reader sees them.
struct Ply
{
    std::vector<std::string> properties;
    std::vector<std::vector<float>> vertices;
    std::vector<std::array<uint32_t, 3>> triangles;
};

Ply readPly(const std::string& bytes)
{
    const std::string end = "end_header\n";
    const size_t data = bytes.find(end) + end.size();
    std::istringstream header(bytes.substr(0, data));
    Ply ply;
    size_t vertices = 0;
    size_t triangles = 0;
    std::string word, type, name;
    header >> word;
    EXPECT_EQ(word, "ply");
    header >> word >> type >> name;
    EXPECT_EQ(type, "binary_little_endian");
    while (header >> word && word != "end_header")
    {
        if (word == "element" && header >> name)
            header >> (name == "vertex" ? vertices : triangles);
        else if (word == "property" && header >> type && type == "float" && header >> name)
            ply.properties.push_back(name);
    }
    const char* at = bytes.data() + data;
    for (size_t i = 0; i < vertices; ++i)
    {
        std::vector<float> values(ply.properties.size());
        std::memcpy(values.data(), at, values.size() * 4);
        at += values.size() * 4;
        ply.vertices.push_back(values);
    }
    for (size_t i = 0; i < triangles; ++i)
    {
        EXPECT_EQ(*at, 3);
        std::array<uint32_t, 3> corners;
        std::memcpy(corners.data(), at + 1, 12);
        at += 13;
        ply.triangles.push_back(corners);
    }
    EXPECT_EQ(at, bytes.data() + bytes.size());
    return ply;
}

/// Area of the triangles as seen from above.
float areaFromAbove(const Ply& ply)
{
    float area = 0;
    for (const auto& [a, b, c] : ply.triangles)
    {
        const auto& p = ply.vertices[a];
        const auto& q = ply.vertices[b];
        const auto& r = ply.vertices[c];
        area += std::abs((q[0] - p[0]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[0] - p[0])) / 2;
    }
    return area;
}

struct TableRow
{
    double aperture = -1, roughness = -1, cos_beta = -2, value = -1;
};

std::vector<TableRow> readTable(const std::string& csv)
{
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "aperture,roughness,cos_beta,value");
    std::vector<TableRow> rows;
    while (std::getline(lines, line))
    {
        std::replace(line.begin(), line.end(), ',', ' ');
        TableRow row;
        std::istringstream(line) >> row.aperture >> row.roughness >> row.cos_beta >> row.value;
        rows.push_back(row);
    }
    return rows;
}

class ExtractCut : public ::testing::Test
{
protected:
    ExtractCut() { writePackFile(smallPack(), pack); }

    Ply cut(uint32_t mesh, float error, const std::optional<command::ClipTime>& clip = {})
    {
        const Status status = command::extractCut(pack, mesh, error, clip, sandbox / "cut.ply");
        if (!status.ok())
            ADD_FAILURE() << formatMessage(status.error());
        return readPly(sandbox.read("cut.ply"));
    }

    Sandbox sandbox;
    std::string pack = sandbox / "small.hearth";
};

} // namespace

TEST_F(ExtractCut, coversTheSurfaceOnceAtEveryError)
{
    for (const float error : {0.0f, 0.05f, 0.0999f, 0.1f, 0.2f, 1e30f})
        EXPECT_FLOAT_EQ(areaFromAbove(cut(0, error)), 4) << error; // the strip is 4 m by 1 m
}

TEST_F(ExtractCut, takesTheCoarserClustersFromTheirErrorOn)
{
    EXPECT_EQ(cut(0, 0).triangles.size(), 8u);
    EXPECT_EQ(cut(0, std::nextafter(0.1f, 0.0f)).triangles.size(), 8u);
    EXPECT_EQ(cut(0, 0.1f).triangles.size(), 4u);
}

TEST_F(ExtractCut, writesTheAttributesThatTheMeshHas)
{
    const Ply strip = cut(0, 0);
    EXPECT_EQ(strip.properties,
              (std::vector<std::string>{"x", "y", "z", "nx", "ny", "nz", "axis_x", "axis_y", "axis_z",
                                        "aperture", "scale", "ao", "m0", "m1_x", "m1_y", "m1_z", "s", "t"}));
    ASSERT_EQ(strip.vertices.size(), 16u); // four corners of four quads, shared only inside each cluster
    const std::vector<float>& vertex = strip.vertices[1];
    EXPECT_EQ(std::vector<float>(vertex.begin(), vertex.begin() + 6), (std::vector<float>{0, 0, 1, 0, 1, 0}));
    EXPECT_EQ(std::vector<float>(vertex.end() - 2, vertex.end()), (std::vector<float>{0, 1}));

    const Ply triangle = cut(2, 0);
    EXPECT_EQ(triangle.properties, (std::vector<std::string>{"x", "y", "z", "s", "t"}));
    EXPECT_EQ(triangle.triangles, (std::vector<std::array<uint32_t, 3>>{{0, 1, 2}}));
}

TEST_F(ExtractCut, writesWhatVerticesSee)
{
    // m0 = pi, m1 = (1, 2, 0), the normal is +Y
    const std::vector<float> vertex = cut(0, 0).vertices[1];
    const float size = std::sqrt(5.0f), pi = std::numbers::pi_v<float>, ratio = size / pi;
    EXPECT_NEAR(vertex[6], 1 / size, 0.005f);
    EXPECT_NEAR(vertex[7], 2 / size, 0.005f);
    EXPECT_NEAR(vertex[8], 0, 0.005f);
    EXPECT_NEAR(vertex[9], std::acos(2 * ratio - 1), 0.01f);
    EXPECT_NEAR(vertex[10], 0.25f / (1 - ratio), 0.01f);
    EXPECT_NEAR(vertex[11], 2 / pi, 1.0f / 1022);
    EXPECT_NEAR(vertex[12], pi, 0.05f);
    EXPECT_NEAR(vertex[13], 1, pi / 508);
    EXPECT_NEAR(vertex[14], 2, pi / 1022);
    EXPECT_NEAR(vertex[15], 0, pi / 508);
    // a clip that moves the mesh leaves it unchanged
    const std::vector<float> moved = cut(0, 0, command::ClipTime{"move", 2}).vertices[1];
    for (size_t i = 6; i < 16; ++i)
        EXPECT_NEAR(moved[i], vertex[i], 1e-5f) << i;
}

TEST_F(ExtractCut, posesWhatJointsAndMorphTargetsMove)
{
    // the target lifts the last vertex by a half: the rest pose has weight 0.5, the clip 0 at first, then 1
    EXPECT_EQ(cut(2, 0).vertices[2], (std::vector<float>{1, 0.25f, 0, 0.25f, 0}));
    EXPECT_EQ(cut(2, 0, command::ClipTime{"morph", 0.5}).vertices[2],
              (std::vector<float>{1, 0, 0, 0.25f, 0}));
    EXPECT_EQ(cut(2, 0, command::ClipTime{"morph", 7}).vertices[2],
              (std::vector<float>{1, 0.5f, 0, 0.25f, 0}));
}

TEST_F(ExtractCut, putsOtherMeshesInTheSceneWithAClip)
{
    const Ply still = cut(0, 0), moved = cut(0, 0, command::ClipTime{"move", 2});
    ASSERT_EQ(moved.vertices.size(), still.vertices.size());
    for (size_t v = 0; v < moved.vertices.size(); ++v)
        EXPECT_FLOAT_EQ(moved.vertices[v][0], still.vertices[v][0] + 2);
}

TEST_F(ExtractCut, saysWhichClipsThereAre)
{
    const Status status = command::extractCut(pack, 2, 0, command::ClipTime{"walk", 0}, sandbox / "cut.ply");
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::usage);
    EXPECT_NE(status.error().detail.find("move, morph"), std::string::npos) << status.error().detail;
    EXPECT_FALSE(sandbox.has("cut.ply"));
}

TEST_F(ExtractCut, aMeshWithoutTrianglesIsAnEmptyFile)
{
    const Ply empty = cut(1, 0);
    EXPECT_TRUE(empty.vertices.empty());
    EXPECT_TRUE(empty.triangles.empty());
}

TEST_F(ExtractCut, saysWhichMeshesThereAre)
{
    const Status status = command::extractCut(pack, 3, 0, {}, sandbox / "cut.ply");
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::usage);
    EXPECT_FALSE(sandbox.has("cut.ply"));
}

TEST_F(ExtractCut, refusesParts)
{
    writeParts(smallPack(), sandbox.path(), "a");
    EXPECT_EQ(command::extractCut(sandbox / "a.clusters.part", 0, 0, {}, sandbox / "cut.ply").error().issue,
              Issue::container_kind);
}

TEST_F(ExtractCut, refusesPacksThatMeanNothing)
{
    PackModel broken = smallPack();
    broken.clusters[0].refined_group = 99;
    writePackFile(broken, pack);
    EXPECT_EQ(command::extractCut(pack, 0, 0, {}, sandbox / "cut.ply").error().issue,
              Issue::meaning_reference);
}

TEST_F(ExtractCut, saysWhereItCannotWrite)
{
    const Status status = command::extractCut(pack, 0, 0, {}, sandbox / "nowhere/cut.ply");
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::cannot_write);
    EXPECT_EQ(sandbox.list(), std::vector<std::string>{"small.hearth"});
}

TEST(ExtractSpecular, writesEveryNodeOfTheTable)
{
    const Sandbox sandbox;
    PackModel model = smallPack();
    writePackFile(model, sandbox / "small.hearth");
    ASSERT_TRUE(command::extractSpecular(sandbox / "small.hearth", sandbox / "table.csv").ok());
    const std::vector<TableRow> rows = readTable(sandbox.read("table.csv"));
    ASSERT_EQ(rows.size(), 4096u);
    EXPECT_NEAR(rows[17].aperture, 1 / 15.0, 1e-6);
    EXPECT_NEAR(rows[17].roughness, 0.089 + 0.911 / 15, 1e-6);
    EXPECT_NEAR(rows[17].cos_beta, -1, 1e-6);
    EXPECT_NEAR(rows[17].value, 17 / 255.0, 1e-6);
    EXPECT_NEAR(rows[4095].roughness, 1, 1e-6);
    EXPECT_NEAR(rows[4095].cos_beta, 1, 1e-6);
    EXPECT_EQ(rows[4095].value, 1);

    model.specular_tables[0].spacing = 1;
    writeSpecularPart(model, sandbox / "specular.part");
    ASSERT_TRUE(command::extractSpecular(sandbox / "specular.part", sandbox / "table.csv").ok());
    const double half_sine = 1 - 1 / 15.0;
    EXPECT_NEAR(readTable(sandbox.read("table.csv"))[256].cos_beta, 1 - 2 * half_sine * half_sine, 1e-6);
}

TEST(ExtractSpecular, refusesFilesWithoutATable)
{
    const Sandbox sandbox;
    PackModel model = smallPack();
    model.specular_tables[0].masking = 9;
    writeSpecularPart(model, sandbox / "wrong.part");
    EXPECT_EQ(command::extractSpecular(sandbox / "wrong.part", sandbox / "t").error().issue,
              Issue::meaning_value);
    model.specular_tables.clear();
    writePackFile(model, sandbox / "small.hearth");
    EXPECT_EQ(command::extractSpecular(sandbox / "small.hearth", sandbox / "t").error().issue,
              Issue::chunk_missing);
    EXPECT_FALSE(sandbox.has("t"));
}

namespace
{

std::vector<std::string> splitLines(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

} // namespace

TEST(ExtractBricks, writesEveryFaceOfEverySolidVoxel)
{
    const Sandbox sandbox;
    writePackFile(smallPack(), sandbox / "small.hearth");
    ASSERT_TRUE(command::extractBricks(sandbox / "small.hearth", sandbox / "faces.csv").ok());
    const std::vector<std::string> lines = splitLines(sandbox.read("faces.csv"));
    ASSERT_EQ(lines.size(), 1 + 22u);
    EXPECT_EQ(lines[0], "x,y,z,face,opacity,albedo_r,albedo_g,albedo_b,normal_x,normal_y,normal_z,emissive_r,"
                        "emissive_g,emissive_b,lighting_r,lighting_g,lighting_b");
    // the row of two voxels: the first has no face towards the second
    EXPECT_EQ(lines[1], "2,4,2,x-,1,1,1,1,-1,0,0,0,0,0,0,0,0");
    EXPECT_EQ(lines[2].substr(0, 11), "2,4,2,y-,1,");
    EXPECT_EQ(lines[5].substr(0, 11), "2,4,2,z+,1,");
    EXPECT_EQ(lines[6].substr(0, 13), "3,4,2,x+,0.2,");
    EXPECT_EQ(lines[22].substr(0, 10), "18,4,2,z+,");
    // faces 2 and 3 of the first brick are the y- faces of its two voxels
    EXPECT_EQ(lines[2], "2,4,2,y-,1,1,0.200391,0,0,-1,0,0,0,0,0,0,0");
    EXPECT_EQ(lines[7], "3,4,2,y-,0.2,1,1,1,0,-1,0,4,2,0.5,4,2,0.5");

    writeBricksPart(smallPack(), sandbox / "bricks.part");
    ASSERT_TRUE(command::extractBricks(sandbox / "bricks.part", sandbox / "part.csv").ok());
    EXPECT_EQ(sandbox.read("part.csv"), sandbox.read("faces.csv"));
}

TEST(ExtractBricks, writesVoxelsWithoutFacesOnce)
{
    const Sandbox sandbox;
    PackModel model = smallPack();
    // 3 x 3 x 3 voxels: the middle one has no faces
    model.bricks = brickModel({3, 3, 3}, [](uint32_t, uint32_t, uint32_t) { return true; });
    model.brick_grids = {model.bricks.grid};
    writeBricksPart(model, sandbox / "bricks.part");
    ASSERT_TRUE(command::extractBricks(sandbox / "bricks.part", sandbox / "faces.csv").ok());
    const std::string text = sandbox.read("faces.csv");
    EXPECT_EQ(splitLines(text).size(), 1 + 54 + 1u);
    EXPECT_NE(text.find("\n1,1,1,none,1,0,0,0,0,0,0,0,0,0,0,0,0\n"), std::string::npos);
}

TEST(ExtractBricks, refusesFilesWithoutBricks)
{
    const Sandbox sandbox;
    PackModel model = smallPack();
    model.bricks.normals[0] = 0x8080;
    writeBricksPart(model, sandbox / "wrong.part");
    EXPECT_EQ(command::extractBricks(sandbox / "wrong.part", sandbox / "t").error().issue,
              Issue::meaning_value);
    EXPECT_FALSE(command::verifyFile(sandbox / "wrong.part").ok());
    writeSpecularPart(model, sandbox / "specular.part");
    EXPECT_EQ(command::extractBricks(sandbox / "specular.part", sandbox / "t").error().issue,
              Issue::chunk_missing);
    EXPECT_FALSE(sandbox.has("t"));
}

} // namespace hearth::test
