// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines_scans/scan_test_tools.h"

#include <gtest/gtest.h>

namespace hearth::import
{

namespace
{

using namespace test;
constexpr std::string_view kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

ScanPolygons readGood(const std::string& text)
{
    auto file = readText(readObj, text);
    EXPECT_TRUE(file.ok()) << text << "\n" << outcome(file);
    return file.ok() ? std::move(file).value() : ScanPolygons{};
}

TEST(ReadObj, refusesWhatIsNoObj)
{
    const std::string v(kTriangle);
    const RefusedFile files[] = {
        {"index zero", v + "f 0 1 2\n", Issue::index_out_of_range, "line 4"},
        {"index too large", v + "f 1 2 4\n", Issue::index_out_of_range, "line 4"},
        {"index too small", v + "f 1 2 -99\n", Issue::index_out_of_range, "line 4"},
        {"index beyond 32 bits", v + "f 1 2 4294967297\n", Issue::index_out_of_range, "line 4"},
        {"index beyond 64 bits", v + "f 1 2 99999999999999999999\n", Issue::mesh_syntax, "line 4"},
        {"the last of the worst forward references", v + "f 1 2 4\n\nf 1 2 5\nf 1 2 4\n",
         Issue::index_out_of_range, "line 6"},
        {"UV index zero", v + "vt 0 0\nf 1/0 2/1 3/1\n", Issue::index_out_of_range, "line 5"},
        {"letters as indices", v + "f a b c\n", Issue::mesh_syntax, "line 4"},
        {"letters behind an index", v + "f 1x 2 3\n", Issue::mesh_syntax, "line 4"},
        {"four parts of a corner", v + "f 1/1/1/1 2 3\n", Issue::mesh_syntax, "line 4"},
        {"letters as coordinates", "v a b c\n", Issue::mesh_syntax, "line 1"},
        {"two coordinates", "\nv 0 0\n", Issue::mesh_syntax, "line 2"},
        {"five coordinates", "v 0 0 0 1 1\n", Issue::mesh_syntax, "line 1"},
        {"nine coordinates", "v 0 0 0 1 1 1 1 1 1\n", Issue::mesh_syntax, "line 1"},
        {"not finite", "v nan 0 0\n", Issue::mesh_syntax, "line 1"},
        {"infinite as a float", "v 1e39 0 0\n", Issue::mesh_syntax, "line 1"},
        {"infinite as a double", "v 1e999 0 0\n", Issue::mesh_syntax, "line 1"},
        {"normal of two numbers", "vn 0 1\n", Issue::mesh_syntax, "line 1"},
        {"UV without numbers", "vt\n", Issue::mesh_syntax, "line 1"},
        {"hexadecimal", "v 0x10 0 0\n", Issue::mesh_syntax, "line 1"},
        {"comma", "v 0,5 0 0\n", Issue::mesh_syntax, "line 1"},
        {"compressed", "\x1F\x8B\x08\x01 x\n", Issue::mesh_syntax, "line 1"},
        {"bytes no text has", std::string("v \0 1 2\n", 8), Issue::mesh_syntax, "line 1"},
    };
    for (const RefusedFile& file : files)
        EXPECT_EQ(outcome(readText(readObj, file.text)), outcome(file)) << file.name;
}

TEST(ReadObj, obeysTheLimits)
{
    ImportLimits limits;
    limits.max_vertices = 2;
    EXPECT_EQ(readText(readObj, kTriangle, limits).error().issue, Issue::input_too_large);
    limits.max_vertices = 3;
    limits.max_triangles = 1;
    EXPECT_TRUE(readText(readObj, std::string(kTriangle) + "f 1 2 3\n", limits).ok());
    EXPECT_EQ(readText(readObj, std::string(kTriangle) + "f 1 2 3 1\n", limits).error().issue,
              Issue::input_too_large);
}

TEST(ReadObj, readsNumbersAsTheyAreWritten)
{
    const ScanPolygons file =
        readGood("v 1 +2. -3e2\nv .5 1E-2 0\t\r\nv 1e-60 -0 7 1.0\nv 1 2 3 # comment\n");
    ASSERT_EQ(file.positions.size(), 4u);
    EXPECT_EQ(file.positions[0], (Float3{1, 2, -300}));
    EXPECT_EQ(file.positions[1], (Float3{0.5f, 0.01f, 0}));
    EXPECT_EQ(file.positions[2], (Float3{0, 0, 7}));
    EXPECT_EQ(file.positions[3], (Float3{1, 2, 3}));
}

TEST(ReadObj, mendsTheSignBeforeTheExponent)
{
    const ScanPolygons file = readGood("v 3.1+e2 -2.5-e1 0\n");
    EXPECT_EQ(file.positions[0], (Float3{310, -0.25f, 0}));
    EXPECT_TRUE(hasNote(file, Issue::repaired, "2 numbers"));
}

TEST(ReadObj, linesMayEndInAnyWay)
{
    for (const std::string end : {"\n", "\r\n", "\r"})
    {
        std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n# comment\n\nf 1 2 3";
        for (size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
            text.replace(at, 1, end);
        EXPECT_EQ(readGood(text).face_ends.size(), 1u) << text;
        EXPECT_EQ(readText(readObj, text + end + "f 9 1 2").error().where, "line 7");
    }
}

TEST(ReadObj, aBackslashJoinsLines)
{
    const ScanPolygons file = readGood(std::string(kTriangle) + "f 1 \\\n2 \\\r\n3\nv 1 \\\n 2 3\n");
    EXPECT_EQ(file.face_ends.size(), 1u);
    EXPECT_EQ(file.positions.size(), 4u);
}

TEST(ReadObj, readsAllFormsOfCorners)
{
    const ScanPolygons file =
        readGood(std::string(kTriangle) +
                 "vt 0.25 0.25\nvt 1\nvn 0 0 2\n"
                 "f 1 2 3\nf 1/1 2/2 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/2/1 3/1/1\nf 1// 2// 3//\n");
    EXPECT_EQ(file.face_ends, (std::vector<uint32_t>{3, 6, 9, 12, 15}));
    EXPECT_EQ(file.corner_uvs, (std::vector<uint32_t>{kInvalidIndex, kInvalidIndex, kInvalidIndex, 0, 1, 0,
                                                      kInvalidIndex, kInvalidIndex, kInvalidIndex, 0, 1, 0,
                                                      kInvalidIndex, kInvalidIndex, kInvalidIndex}));
    EXPECT_EQ(file.corner_normals,
              (std::vector<uint32_t>{kInvalidIndex, kInvalidIndex, kInvalidIndex, kInvalidIndex,
                                     kInvalidIndex, kInvalidIndex, 0, 0, 0, 0, 0, 0, kInvalidIndex,
                                     kInvalidIndex, kInvalidIndex}));
    // v counts from the bottom in the file and from the top here
    EXPECT_EQ(file.uvs[0], (Float2{0.25f, 0.75f}));
    EXPECT_EQ(file.uvs[1], (Float2{1, 1}));
}

TEST(ReadObj, negativeIndicesCountBack)
{
    const ScanPolygons file =
        readGood("v 9 9 9\n" + std::string(kTriangle) + "f -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n");
    EXPECT_EQ(file.corner_positions, (std::vector<uint32_t>{1, 2, 3, 4, 3, 2}));
}

TEST(ReadObj, facesMayStandBeforeTheirVertices)
{
    EXPECT_EQ(readGood("f 1 2 3\n" + std::string(kTriangle)).face_ends.size(), 1u);
}

TEST(ReadObj, cornersWithoutTheirNormalOrUvAreRepaired)
{
    const ScanPolygons file = readGood(std::string(kTriangle) + "vt 0 0\nf 1/1/7 2/2/8 3/1/9\n");
    EXPECT_TRUE(file.corner_normals.empty());
    EXPECT_EQ(file.corner_uvs, (std::vector<uint32_t>{0, kInvalidIndex, 0}));
    EXPECT_TRUE(hasNote(file, Issue::repaired, "3 corners name a normal"));
    EXPECT_TRUE(hasNote(file, Issue::repaired, "1 corners name a texture coordinate"));
}

TEST(ReadObj, groupsBecomeOneMeshAndMaterialsStay)
{
    const ScanPolygons file =
        readGood("mtllib some file.mtl\n" + std::string(kTriangle) +
                 "f 1 2 3\no a\nusemtl  Red Plastic \nf 1 2 3\ng An f Three Other\nusemtl "
                 "b\nf 1 3 2\nusemtl Red Plastic\nf 1 2 3\n");
    EXPECT_EQ(file.material_names, (std::vector<std::string>{"Red Plastic", "b"}));
    EXPECT_EQ(file.face_materials, (std::vector<uint32_t>{kInvalidIndex, 0, 1, 0}));
    EXPECT_EQ(file.material_libraries, std::vector<std::string>{"some file.mtl"});
}

TEST(ReadObj, readsColoursBehindTheCoordinates)
{
    const ScanPolygons file = readGood("v 0 0 0\nv 1 0 0 1 0.5 0\nv 0 1 0 nan 0 0\n");
    ASSERT_EQ(file.colors.size(), 3u);
    EXPECT_EQ(file.colors[0], (Float4{1, 1, 1, 1}));
    EXPECT_NEAR(file.colors[1].y, 0.2140411, 1e-5); // sRGB 0.5 as linear light
    EXPECT_EQ(file.colors[2], (Float4{1, 1, 1, 1}));
    EXPECT_TRUE(hasNote(file, Issue::repaired, "colours"));
}

TEST(ReadObj, namesWhatIsNotKept)
{
    const ScanPolygons file =
        readGood(std::string(kTriangle) + "l 1 2\nl 2 3\np 1\ncstype bezier\nf 1 2\nf\nf 1 2 3\n");
    EXPECT_EQ(file.face_ends.size(), 1u);
    EXPECT_TRUE(hasNote(file, Issue::dropped, "2 statements 'l'"));
    EXPECT_TRUE(hasNote(file, Issue::dropped, "1 statements 'p'"));
    EXPECT_TRUE(hasNote(file, Issue::dropped, "1 statements 'cstype'"));
    EXPECT_TRUE(hasNote(file, Issue::dropped, "2 faces with fewer than three corners"));
}

TEST(ReadObj, smallFacesLeaveNoCorners)
{
    const ScanPolygons file =
        readGood(std::string(kTriangle) + "vt 0 0\nf 1/1 2/1\nf 1 2 3\nf 1/1\nf 1/1 2/1 3/1\n");
    EXPECT_EQ(file.corner_positions, (std::vector<uint32_t>{0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(file.corner_uvs, (std::vector<uint32_t>{kInvalidIndex, kInvalidIndex, kInvalidIndex, 0, 0, 0}));
}

} // namespace

} // namespace hearth::import
