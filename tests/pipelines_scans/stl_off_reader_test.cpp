// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines_scans/scan_test_tools.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace hearth::import
{

namespace
{

using namespace test;

ScanPolygons readGood(ScanReader reader, const std::string& text)
{
    auto file = readText(reader, text);
    EXPECT_TRUE(file.ok()) << outcome(file);
    return file.ok() ? std::move(file).value() : ScanPolygons{};
}

const std::string kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
const std::string kSolid = "solid a b\n" + kFacet + "endsolid a b\n";

std::string binaryStl(uint32_t count, size_t stored, std::string_view start = "")
{
    std::string file(80, ' ');
    file.replace(0, start.size(), start);
    file.append(reinterpret_cast<const char*>(&count), 4);
    for (size_t i = 0; i < stored; ++i)
    {
        const std::array<float, 12> triangle = {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, static_cast<float>(i + 1), 0};
        file.append(reinterpret_cast<const char*>(triangle.data()), sizeof(triangle));
        file.append(2, '\0');
    }
    return file;
}

TEST(ReadStl, refusesWhatIsNoStl)
{
    std::string not_finite = binaryStl(1, 1);
    const float infinity = HUGE_VALF;
    std::memcpy(not_finite.data() + 84 + 12, &infinity, 4);
    const RefusedFile files[] = {
        {"empty", "", Issue::mesh_counts, "byte 0"},
        {"79 bytes", std::string(79, '\0'), Issue::mesh_counts, "byte 0"},
        {"more triangles than the file has", binaryStl(0xFFFFFFFF, 1), Issue::mesh_counts, "byte 80"},
        {"not finite", not_finite, Issue::mesh_syntax, "byte 84"},
        {"letters", "solid x\nfacet normal 0 0 1\nouter loop\nvertex q 0 0\n", Issue::mesh_syntax, "line 4"},
        {"two corners",
         "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n",
         Issue::mesh_syntax, "line 6"},
        {"four corners",
         "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 0\nvertex 1 0 "
         "0\nendloop\n",
         Issue::mesh_syntax, "line 7"},
        {"cut off in a facet", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", Issue::mesh_counts,
         "line 5"},
        {"cut off behind a facet", "solid x\n" + kFacet, Issue::mesh_counts, "line 9"},
        {"a word too many", "solid x\n" + kFacet + "hello\n", Issue::mesh_syntax, "line 9"},
        {"ascii not finite", "solid x\nfacet normal 0 0 1\nouter loop\nvertex inf 0 0\n", Issue::mesh_syntax,
         "line 4"},
    };
    for (const RefusedFile& file : files)
        EXPECT_EQ(outcome(readText(readStl, file.text)), outcome(file)) << file.name;
}

TEST(ReadStl, weldsCornersAndCountsThemAsTheFile)
{
    const ScanPolygons file =
        readGood(readStl, "SOLID\n" + kFacet +
                              "facet normal nan nan nan\nouter loop\nvertex 1 0 -0\nvertex "
                              "0 1 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid\n" +
                              kSolid);
    EXPECT_EQ(file.face_ends.size(), 3u);
    EXPECT_EQ(file.vertex_count, 9u);
    EXPECT_EQ(file.positions.size(), 4u);
    EXPECT_EQ(file.corner_positions, (std::vector<uint32_t>{0, 1, 2, 1, 2, 3, 0, 1, 2}));
}

TEST(ReadStl, knowsABinaryFileByItsSize)
{
    EXPECT_EQ(readGood(readStl, binaryStl(2, 2)).face_ends.size(), 2u);
    EXPECT_EQ(readGood(readStl, binaryStl(2, 2, "solid made by a program")).face_ends.size(), 2u);
}

TEST(ReadStl, bytesBehindTheTrianglesAreNamed)
{
    const ScanPolygons file = readGood(readStl, binaryStl(2, 2) + "xyz");
    EXPECT_EQ(file.face_ends.size(), 2u);
    EXPECT_TRUE(hasNote(file, Issue::dropped, "3 bytes"));
}

TEST(ReadOff, refusesWhatIsNoOff)
{
    const RefusedFile files[] = {
        {"empty", "", Issue::mesh_syntax, "line 1"},
        {"no keyword", "hello\n", Issue::mesh_syntax, "line 1"},
        {"four dimensions", "4OFF\n1 0 0\n0 0 0 0\n", Issue::mesh_syntax, "line 1"},
        {"binary", "OFF BINARY\n", Issue::mesh_syntax, "line 1"},
        {"no counts", "OFF\n", Issue::mesh_syntax, "line 2"},
        {"one count", "OFF\n3\n", Issue::mesh_syntax, "line 2"},
        {"negative count", "OFF\n-3 1 0\n", Issue::mesh_syntax, "line 2"},
        {"more vertices than fit", "OFF\n353535235358 6 0\n0 0 0\n", Issue::mesh_counts, "line 2"},
        {"more faces than fit", "OFF\n1 1000 0\n0 0 0\n", Issue::mesh_counts, "line 2"},
        {"cut off", "OFF\n3 1 0\n0 0 0\n1 1 1 1 1 1\n", Issue::mesh_counts, "line 5"},
        {"two coordinates", "OFF\n2 0 0\n0 0\n1 1 1 1 1 1\n", Issue::mesh_syntax, "line 3"},
        {"letters", "OFF\n1 0 0\n0 0 x\n", Issue::mesh_syntax, "line 3"},
        {"not finite", "OFF\n1 0 0\n0 0 inf\n", Issue::mesh_syntax, "line 3"},
        {"index too large", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n", Issue::index_out_of_range,
         "line 6"},
        {"index negative", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", Issue::index_out_of_range,
         "line 6"},
        {"too few corners", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1000000000 0 1 2\n", Issue::mesh_counts,
         "line 6"},
        {"no face", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", Issue::mesh_counts, "line 6"},
    };
    for (const RefusedFile& file : files)
        EXPECT_EQ(outcome(readText(readOff, file.text)), outcome(file)) << file.name;
}

TEST(ReadOff, readsFacesOfAnySizeAndComments)
{
    const ScanPolygons file =
        readGood(readOff, "# made\nOFF # here\n\n4 2 0 # counts\n0 0 0\n1 0 0 # "
                          "corner\n\n1 1 0\n0 1 0\n# faces\n4 0 1 2 3\n3 0 1 2 255 0 0\n");
    EXPECT_EQ(file.positions.size(), 4u);
    EXPECT_EQ(file.face_ends, (std::vector<uint32_t>{4, 7}));
    EXPECT_TRUE(hasNote(file, Issue::dropped, "colours of faces"));
}

TEST(ReadOff, theKeywordMayBeMissing)
{
    EXPECT_EQ(readGood(readOff, "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").face_ends.size(), 1u);
}

TEST(ReadOff, readsColoursNormalsAndUvs)
{
    const ScanPolygons colored = readGood(readOff, "COFF\n2 0\n0 0 0 255 0 0 255\n1 1 1 0.0 1.0 0.0 0.5\n");
    EXPECT_EQ(colored.colors[0], (Float4{1, 0, 0, 1}));
    EXPECT_EQ(colored.colors[1], (Float4{0, 1, 0, 0.5f}));
    const ScanPolygons all = readGood(readOff, "STCNOFF\n1 0\n1 2 3 0 0 1 1 1 1 0.25 0.25\n");
    EXPECT_EQ(all.normals[0], (Float3{0, 0, 1}));
    EXPECT_EQ(all.colors[0], (Float4{1, 1, 1, 1}));
    EXPECT_EQ(all.uvs[0], (Float2{0.25f, 0.75f}));
}

} // namespace

} // namespace hearth::import
