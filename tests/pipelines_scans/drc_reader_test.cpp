// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines_scans/scan_test_tools.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <draco/point_cloud/point_cloud_builder.h>

#include <gtest/gtest.h>

namespace hearth::import
{

namespace
{

using namespace test;

std::string encoded(draco::Mesh& mesh, int method)
{
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

/// Two triangles of a square with UVs and colours, encoded losslessly.
std::string square(int method)
{
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uvs = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const int colors = builder.AddAttribute(draco::GeometryAttribute::COLOR, 3, draco::DT_UINT8);
    constexpr float kPositions[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    constexpr float kUvs[4][2] = {{0, 0}, {1, 0}, {1, 0.75f}, {0, 0.75f}};
    constexpr uint8_t kColors[4][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}};
    constexpr size_t kFaces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (uint32_t face = 0; face < 2; ++face)
    {
        const size_t(&c)[3] = kFaces[face];
        const draco::FaceIndex index(face);
        builder.SetAttributeValuesForFace(positions, index, kPositions[c[0]], kPositions[c[1]],
                                          kPositions[c[2]]);
        builder.SetAttributeValuesForFace(uvs, index, kUvs[c[0]], kUvs[c[1]], kUvs[c[2]]);
        builder.SetAttributeValuesForFace(colors, index, kColors[c[0]], kColors[c[1]], kColors[c[2]]);
    }
    return encoded(*builder.Finalize(), method);
}

TEST(ReadDrc, readsBothMeshCodings)
{
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
    {
        const auto file = readText(readDrc, square(method));
        ASSERT_TRUE(file.ok()) << file.error().detail;
        EXPECT_EQ(file->vertex_count, 4u);
        EXPECT_EQ(file->face_ends, (std::vector<uint32_t>{3, 6}));
        ASSERT_EQ(file->positions.size(), 4u);
        for (size_t i = 0; i < 4; ++i)
        {
            const Float3 p = file->positions[i];
            EXPECT_EQ(file->uvs[i], (Float2{p.x, 1 - p.y * 0.75f}));
            const bool is_origin = p == Float3{0, 0, 0};
            EXPECT_EQ(file->colors[i] == (Float4{1, 0, 0, 1}), is_origin);
        }
    }
}

TEST(ReadDrc, readsPointClouds)
{
    draco::PointCloudBuilder builder;
    builder.Start(3);
    const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (uint32_t point = 0; point < 3; ++point)
    {
        const float value[3] = {static_cast<float>(point), 2, 3};
        builder.SetAttributeValueForPoint(positions, draco::PointIndex(point), value);
    }
    draco::Encoder encoder;
    draco::EncoderBuffer buffer;
    ASSERT_TRUE(encoder.EncodePointCloudToBuffer(*builder.Finalize(false), &buffer).ok());
    const auto file = readText(readDrc, {buffer.data(), buffer.size()});
    ASSERT_TRUE(file.ok());
    EXPECT_EQ(file->positions.size(), 3u);
    EXPECT_TRUE(file->face_ends.empty());
}

TEST(ReadDrc, refusesCutFiles)
{
    const std::string good = square(draco::MESH_SEQUENTIAL_ENCODING);
    for (size_t size = 0; size < good.size(); ++size)
    {
        const auto file = readText(readDrc, good.substr(0, size));
        ASSERT_FALSE(file.ok()) << size;
        EXPECT_EQ(file.error().issue, Issue::codec_failed);
    }
}

} // namespace

} // namespace hearth::import
