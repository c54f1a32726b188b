// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines_scans/scan_test_tools.h"

#include <gtest/gtest.h>

#include <cstring>

namespace hearth::import
{

namespace
{

using namespace test;

ScanPolygons readGood(const std::string& text)
{
    auto file = readText(readPly, text);
    EXPECT_TRUE(file.ok()) << text.substr(0, 400) << "\n" << outcome(file);
    return file.ok() ? std::move(file).value() : ScanPolygons{};
}

std::string header(std::string_view format, std::string_view rest)
{
    return "ply\nformat " + std::string(format) + " 1.0\n" + std::string(rest) + "end_header\n";
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFace = "property list uchar int vertex_indices\n";
const std::string kTriangleHeader = header("ascii", "element vertex 3\n" + kXyz + "element face 1\n" + kFace);
const std::string kTriangle = kTriangleHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(ReadPly, refusesWhatIsNoPly)
{
    const std::string face_header = "element vertex 3\n" + kXyz + "element face 1\n";
    const std::string body = "0 0 0\n1 0 0\n0 1 0\n";
    const RefusedFile files[] = {
        {"signature", "bla\n", Issue::mesh_syntax, "line 1"},
        {"only the signature", "ply\n", Issue::mesh_syntax, "line 1"},
        {"no end of the header", "ply\nformat ascii 1.0\nelement edge 25\n", Issue::mesh_syntax, "line 3"},
        {"no format", "ply\nend_header\n", Issue::mesh_syntax, "line 2"},
        {"unknown format", header("ascii7", ""), Issue::mesh_syntax, "line 2"},
        {"version 9", "ply\nformat ascii 9.0\nend_header\n", Issue::mesh_syntax, "line 2"},
        {"words behind the format", "ply\nformat ascii 1.0 x\nend_header\n", Issue::mesh_syntax, "line 2"},
        {"two formats", "ply\nformat ascii 1.0\nformat ascii 1.0\nend_header\n", Issue::mesh_syntax,
         "line 3"},
        {"words behind an element", header("ascii", "element vertex 4 x\n"), Issue::mesh_syntax, "line 3"},
        {"negative count", header("ascii", "element vertex -1\n"), Issue::mesh_syntax, "line 3"},
        {"count with a sign", header("ascii", "element vertex +1\n"), Issue::mesh_syntax, "line 3"},
        {"count with letters", header("ascii", "element vertex 1x\n"), Issue::mesh_syntax, "line 3"},
        {"property before an element", header("ascii", "property float x\n"), Issue::mesh_syntax, "line 3"},
        {"unknown type", header("ascii", "element vertex 1\nproperty quad x\n"), Issue::mesh_syntax,
         "line 4"},
        {"words behind a property", header("ascii", "element vertex 1\nproperty float x y\n"),
         Issue::mesh_syntax, "line 4"},
        {"words behind a list", header("ascii", "element face 1\nproperty list uchar int a b\n"),
         Issue::mesh_syntax, "line 4"},
        {"list counted in floats", header("ascii", "element face 1\nproperty list float int a\n"),
         Issue::mesh_syntax, "line 4"},
        {"a line of no header", header("ascii", "hello\n"), Issue::mesh_syntax, "line 3"},
        {"no y", header("ascii", "element vertex 1\nproperty float x\nproperty float z\n") + "1 2\n",
         Issue::mesh_syntax, "line 7"},
        {"x twice", header("ascii", "element vertex 1\nproperty float x\n" + kXyz) + "1 2 3 4\n",
         Issue::mesh_syntax, "line 9"},
        {"faces without indices", header("ascii", face_header + "property int a\n") + body + "1\n",
         Issue::mesh_syntax, "line 12"},
        {"float indices",
         header("ascii", face_header + "property list uchar float vertex_indices\n") + body + "3 0 1 2\n",
         Issue::mesh_syntax, "line 12"},
        {"element without properties", header("ascii", "element x 3\n"), Issue::mesh_syntax, "line 5"},
        {"two vertex elements",
         header("ascii", "element vertex 1\n" + kXyz + "element vertex 1\n" + kXyz) + "0 0 0\n1 1 1\n",
         Issue::mesh_syntax, "line 12"},
        {"index too large", kTriangleHeader + body + "3 0 1 3\n", Issue::index_out_of_range, "line 13"},
        {"index negative", kTriangleHeader + body + "3 0 1 -1\n", Issue::index_out_of_range, "line 13"},
        {"list too long", kTriangleHeader + body + "255 0 1 2\n", Issue::mesh_counts, "line 13"},
        {"list negative", kTriangleHeader + body + "-1 0 1 2\n", Issue::mesh_counts, "line 13"},
        {"too many values", kTriangleHeader + body + "3 0 1 2 2\n", Issue::mesh_syntax, "line 13"},
        {"too few values", kTriangleHeader + "0 0\n1 0 0\n0 1 0\n3 0 1 2\n", Issue::mesh_counts, "line 10"},
        {"letters", kTriangleHeader + "a 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", Issue::mesh_counts, "line 10"},
        {"not finite", kTriangleHeader + "nan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", Issue::mesh_syntax, "line 10"},
        {"more faces than the file holds",
         header("ascii", "element vertex 1\n" + kXyz + "element face 4294967295\n" + kFace) +
             "0 0 0\n3 0 0 0\n",
         Issue::mesh_counts, "line 10"},
        {"more vertices than fit",
         header("ascii", "element vertex 18446744073709551615\n" + kXyz) + "0 0 0\n", Issue::mesh_counts,
         "line 8"},
    };
    for (const RefusedFile& file : files)
        EXPECT_EQ(outcome(readText(readPly, file.text)), outcome(file)) << file.name;
}

TEST(ReadPly, refusesATextCutAnywhere)
{
    ASSERT_TRUE(readText(readPly, kTriangle).ok());
    for (size_t size = 0; size + 1 < kTriangle.size(); ++size) // the last line needs no end
        EXPECT_FALSE(readText(readPly, kTriangle.substr(0, size)).ok()) << size;
}

/// Bytes of a value, in the order of the file.
template <typename T>
void append(std::string& out, T value, bool big_endian)
{
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (big_endian)
        std::reverse(bytes, bytes + sizeof(T));
    out.append(bytes, sizeof(T));
}

/// Every scalar type once; the quad's corners are int8 counted in uint32.
std::string binaryFile(bool big_endian)
{
    std::string file =
        header(big_endian ? "binary_big_endian" : "binary_little_endian",
               "element vertex 4\nproperty double x\nproperty short y\nproperty uint z\n"
               "property uchar red\nproperty uint8 green\nproperty uchar blue\nproperty char gap\n"
               "property ushort s\nproperty int t\nproperty float nx\nproperty float ny\nproperty float nz\n"
               "element face 1\nproperty list uint32 int8 vertex_index\n");
    for (int i = 0; i < 4; ++i)
    {
        append(file, 0.5 * i, big_endian);
        append(file, static_cast<int16_t>(-i), big_endian);
        append(file, static_cast<uint32_t>(3000000000u), big_endian);
        for (const uint8_t color : std::initializer_list<uint8_t>{255, 0, 188})
            append(file, color, big_endian);
        append(file, static_cast<int8_t>(-1), big_endian);
        append(file, static_cast<uint16_t>(i), big_endian);
        append(file, -i, big_endian);
        for (const float n : {0.0f, 0.0f, 1.0f})
            append(file, n, big_endian);
    }
    append(file, uint32_t{4}, big_endian);
    for (const int8_t index : std::initializer_list<int8_t>{0, 1, 2, 3})
        append(file, index, big_endian);
    return file;
}

TEST(ReadPly, readsBothByteOrdersAndAllTypes)
{
    for (const bool big_endian : {false, true})
    {
        const ScanPolygons file = readGood(binaryFile(big_endian));
        ASSERT_EQ(file.positions.size(), 4u);
        EXPECT_EQ(file.positions[3], (Float3{1.5f, -3, 3e9f}));
        EXPECT_EQ(file.normals[3], (Float3{0, 0, 1}));
        EXPECT_EQ(file.uvs[3], (Float2{3, 4})); // t = -3 from the bottom is 4 from the top
        EXPECT_EQ(file.colors[3].x, 1);
        EXPECT_NEAR(file.colors[3].z, 0.5029, 1e-3);
        EXPECT_EQ(file.corner_positions, (std::vector<uint32_t>{0, 1, 2, 3}));
        EXPECT_TRUE(hasNote(file, Issue::dropped, "vertex.gap"));
    }
}

TEST(ReadPly, refusesABinaryCutAnywhere)
{
    const std::string file = binaryFile(true);
    for (size_t size = 0; size < file.size(); ++size)
        EXPECT_FALSE(readText(readPly, file.substr(0, size)).ok()) << size;
}

TEST(ReadPly, bytesBehindTheLastElementAreTolerated)
{
    EXPECT_EQ(readGood(binaryFile(false) + "\xAA\xAA").face_ends.size(), 1u);
}

TEST(ReadPly, headerLinesMayEndInAnyWay)
{
    for (const std::string end : {"\r\n", "\r"})
    {
        std::string text = binaryFile(false);
        const size_t body = text.find("end_header\n") + 11;
        std::string head = text.substr(0, body);
        for (size_t at = 0; (at = head.find('\n', at)) != std::string::npos; at += end.size())
            head.replace(at, 1, end);
        EXPECT_EQ(readGood(head + text.substr(body)).positions.size(), 4u);
    }
}

TEST(ReadPly, aBinaryBodyMayStartWithALineFeed)
{
    // x = 10 as an unsigned byte
    const std::string file = header(
        "binary_little_endian", "element vertex 1\nproperty uchar x\nproperty uchar y\nproperty uchar z\n");
    EXPECT_EQ(readGood(file + "\n\n\n").positions[0], (Float3{10, 10, 10}));
}

TEST(ReadPly, elementsMayStandInAnyOrder)
{
    const std::string text = header("ascii", "element face 1\n" + kFace + "element vertex 3\n" + kXyz);
    EXPECT_EQ(readGood(text + "3 0 1 2\n0 0 0\n1 0 0\n0 1 0").face_ends.size(), 1u);
    EXPECT_EQ(outcome(readText(readPly, text + "3 0 1 7\n0 0 0\n1 0 0\n0 1 0")), "error 1115 at line 10");
}

TEST(ReadPly, skipsElementsAndPropertiesWithoutAMeaning)
{
    const ScanPolygons file = readGood(
        header("ascii", "comment c\nobj_info o\nelement edge 2\nproperty list uchar int a\nproperty int "
                        "b\nelement vertex 3\n" +
                            kXyz +
                            "property list uchar float weights\nelement face 1\nproperty uchar flags\n" +
                            kFace) +
        "2 5 6 7\n0 8\n0 0 0 1 0.5\n1 0 0 0\n0 1 0 2 1 2\n9 3 0 1 2\n");
    EXPECT_EQ(file.positions[1], (Float3{1, 0, 0}));
    EXPECT_EQ(file.face_ends.size(), 1u);
    EXPECT_TRUE(hasNote(file, Issue::dropped, "edge, vertex.weights, face.flags"));
}

TEST(ReadPly, readsUvsOfCornersAndTheNameOfTheTexture)
{
    const ScanPolygons file =
        readGood(header("ascii", "comment TextureFile   a b.jpg \nelement vertex 3\n" + kXyz +
                                     "element face 2\n" + kFace + "property list uchar float texcoord\n") +
                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0\n3 0 1 2 6 0 0 1 0.25 0 1\n");
    EXPECT_EQ(file.texture_file, "a b.jpg");
    EXPECT_EQ(file.corner_uvs, (std::vector<uint32_t>{kInvalidIndex, kInvalidIndex, kInvalidIndex, 0, 1, 2}));
    EXPECT_EQ(file.uvs[1], (Float2{1, 0.75f}));
}

TEST(ReadPly, pointCloudsHaveNoFaces)
{
    const ScanPolygons file = readGood(
        header("ascii", "element vertex 2\n" + kXyz + "element face 0\n" + kFace) + "\n0 0 0\n\n1 1 1\n\n");
    EXPECT_EQ(file.positions.size(), 2u);
    EXPECT_TRUE(file.face_ends.empty());
}

TEST(ReadPly, facesWithFewerThanThreeCornersAreNotKept)
{
    const ScanPolygons file =
        readGood(header("ascii", "element vertex 3\n" + kXyz + "element face 3\n" + kFace) +
                 "0 0 0\n1 0 0\n0 1 0\n2 0 1\n0\n3 0 1 2\n");
    EXPECT_EQ(file.face_ends, std::vector<uint32_t>{3});
    EXPECT_TRUE(hasNote(file, Issue::dropped, "2 faces"));
}

} // namespace

} // namespace hearth::import
