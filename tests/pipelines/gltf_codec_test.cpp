// Tests Draco and meshoptimizer decoding: encoded data comes back, and damage is an error.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines/gltf_fixture.h"

#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <algorithm>

namespace hearth::import::test
{

namespace
{

std::vector<std::array<float, 3>> sortedCorners(const mesh::SourceMesh& mesh)
{
    std::vector<std::array<float, 3>> result;
    for (const uint32_t index : mesh.indices)
        result.push_back({mesh.positions[index].x, mesh.positions[index].y, mesh.positions[index].z});
    std::sort(result.begin(), result.end());
    return result;
}

/// Square in Draco's form: positions (attribute 0), colours as normalised bytes (1) and joints (2).
std::string dracoSquare()
{
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, true);
    const int joint = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
    const std::array<uint8_t, 4> half{51, 102, 153, 255};
    const std::array<uint8_t, 4> joints{3, 0, 0, 0};
    for (uint32_t face = 0; face < 2; ++face)
    {
        const auto corner = [&](size_t k) { return kSquare.data() + kSquareIndices[face * 3 + k] * 3; };
        const draco::FaceIndex index(face);
        builder.SetAttributeValuesForFace(position, index, corner(0), corner(1), corner(2));
        builder.SetAttributeValuesForFace(color, index, half.data(), half.data(), half.data());
        builder.SetAttributeValuesForFace(joint, index, joints.data(), joints.data(), joints.data());
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::ExpertEncoder encoder(*mesh);
    encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
    return {buffer.data(), buffer.size()};
}

const std::string kDracoPrimitive =
    R"("extensionsRequired":["KHR_draco_mesh_compression"],"meshes":[{"primitives":[{
    "attributes":{"POSITION":0,"COLOR_0":1,"JOINTS_0":2,"WEIGHTS_0":3},"indices":4,"extensions":{"KHR_draco_mesh_compression":
    {"bufferView":0,"attributes":{"POSITION":0,"COLOR_0":1,"JOINTS_0":2}}}}]}],
    "skins":[{"joints":[1,2,3,4]}],"nodes":[{"mesh":0,"skin":0},{},{},{},{}])";

Imported importDraco(const std::string& compressed, const std::string& document = kDracoPrimitive,
                     size_t index_count = 6)
{
    GltfData data;
    data.addView(compressed);
    data.addAccessor(std::nullopt, 5126, "VEC3", 4);
    data.addAccessor(std::nullopt, 5121, "VEC4", 4, R"("normalized":true)");
    data.addAccessor(std::nullopt, 5121, "VEC4", 4);
    data.add("VEC4", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    data.addAccessor(std::nullopt, 5123, "SCALAR", index_count);
    data.addAccessor(std::nullopt, 5126, "VEC2", 4);
    data.addAccessor(std::nullopt, 5126, "VEC4", 4);
    return data.import(document);
}

TEST(Draco, givesBackTheTrianglesAndAttributes)
{
    const Imported result = importDraco(dracoSquare());
    ASSERT_TRUE(result.ok()) << result.message();
    const mesh::SourceMesh mesh = result.mesh();
    EXPECT_EQ(mesh.triangleCount(), 2u);
    EXPECT_EQ(sortedCorners(mesh), (std::vector<std::array<float, 3>>{
                                       {0, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}}));
    for (const Float4 color : mesh.colors)
    {
        EXPECT_FLOAT_EQ(color.x, 0.2f);
        EXPECT_FLOAT_EQ(color.z, 0.6f);
    }
    ASSERT_EQ(mesh.joint_sets.size(), 1u);
    for (const mesh::Joints4& joints : mesh.joint_sets[0])
        EXPECT_EQ(joints.joint[0], 3);
    for (const Float3 normal : mesh.normals)
        EXPECT_NEAR(normal.z, 1, 1e-6) << "the winding has stayed";
    EXPECT_EQ(result.counts.vertices, 4u);
}

TEST(Draco, leavesAttributesWithoutDataAtZero)
{
    const std::string skin = R"("skins":[{"joints":[1,2,3,4]}],"nodes":[{"mesh":0,"skin":0},{},{},{},{}])";
    const std::string document =
        replaced(replaced(kDracoPrimitive, R"("WEIGHTS_0":3})", R"("WEIGHTS_0":6,"TEXCOORD_0":5})"), skin,
                 R"("nodes":[{"mesh":0}])");
    const Imported result = importDraco(dracoSquare(), document);
    ASSERT_TRUE(result.ok()) << result.message();
    const mesh::SourceMesh mesh = result.mesh();
    EXPECT_EQ(mesh.triangleCount(), 2u);
    EXPECT_EQ(mesh.uvs[0], std::vector<Float2>(mesh.vertexCount()));
    EXPECT_TRUE(mesh.weight_sets.empty()) << "there is no skin";
}

TEST(Draco, warnsOfAnotherNumberOfIndices)
{
    const Imported result = importDraco(dracoSquare(), kDracoPrimitive, 9);
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.counts.triangles, 2u);
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_EQ(formatMessage(result.warnings[0]),
              "test.glb|/meshes/0/primitives/0: warning: counts of indices that Draco decodes differ from "
              "those of accessors: 6 are decoded, the accessor says 9 [W1403] hint: export the file again");
    EXPECT_TRUE(importDraco(dracoSquare()).warnings.empty());
    // a strip of four vertices counts four indices, and is decoded as two triangles
    const std::string strip = replaced(kDracoPrimitive, R"("indices":4,)", R"("indices":4,"mode":5,)");
    EXPECT_TRUE(importDraco(dracoSquare(), strip, 4).warnings.empty());
}

TEST(Draco, isRefusedWhenDamagedOrIncomplete)
{
    const std::string whole = dracoSquare();
    for (const size_t size : {size_t{1}, whole.size() / 4, whole.size() / 2, whole.size() - 1})
    {
        const Imported result = importDraco(whole.substr(0, size));
        ASSERT_FALSE(result.ok()) << size;
        EXPECT_EQ(result.status.error().issue, Issue::codec_failed);
        EXPECT_EQ(result.status.error().where,
                  "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression");
    }
    const std::pair<const char*, const char*> defects[] = {
        {R"("COLOR_0":1,"JOINTS_0":2}})", R"("COLOR_0":7,"JOINTS_0":2}})"}, // no such attribute
        {R"("POSITION":0,"COLOR_0":1,"JOINTS_0":2}})", R"("COLOR_0":1,"JOINTS_0":2}})"},
        {R"("POSITION":0,"COLOR_0":1,"JOINTS_0":2}})", "}}"},
        {R"({"bufferView":0)", R"({"bufferView":99)"},
    };
    for (const auto& [from, to] : defects)
        EXPECT_FALSE(importDraco(whole, replaced(kDracoPrimitive, from, to)).ok()) << to;
}

TEST(Draco, survivesFlippedBytes)
{
    const std::string whole = dracoSquare();
    for (size_t at = 0; at < whole.size(); ++at)
    {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
        const Imported result = importDraco(damaged);
        EXPECT_TRUE(result.ok() || exitCode(result.status.error()) == 65) << at;
    }
}

std::string meshoptVertices(const std::vector<float>& positions)
{
    const size_t count = positions.size() / 3;
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, 12));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), positions.data(), count, 12));
    return {bytes.begin(), bytes.end()};
}

std::string meshoptIndices(const std::vector<uint32_t>& indices, size_t vertex_count)
{
    std::vector<unsigned char> bytes(meshopt_encodeIndexBufferBound(indices.size(), vertex_count));
    bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
    return {bytes.begin(), bytes.end()};
}

std::string meshoptSequence(const std::vector<uint32_t>& indices, size_t vertex_count)
{
    std::vector<unsigned char> bytes(meshopt_encodeIndexSequenceBound(indices.size(), vertex_count));
    bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
    return {bytes.begin(), bytes.end()};
}

/// Document of two compressed views, vertices and indices, with a fallback buffer that does not exist.
std::string meshoptDocument(const std::string& vertices, const std::string& indices,
                            const std::string& index_mode)
{
    const auto number = [](size_t n) { return std::to_string(n); };
    return R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],"buffers":[{"byteLength":)" +
           number(vertices.size() + indices.size()) +
           R"(},{"byteLength":60,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews":[
        {"buffer":1,"byteLength":48,"byteStride":12,"extensions":{"EXT_meshopt_compression":
          {"buffer":0,"byteLength":)" +
           number(vertices.size()) + R"(,"byteStride":12,"count":4,"mode":"ATTRIBUTES"}}},
        {"buffer":1,"byteOffset":48,"byteLength":12,"extensions":{"EXT_meshopt_compression":
          {"buffer":0,"byteOffset":)" +
           number(vertices.size()) + R"(,"byteLength":)" + number(indices.size()) +
           R"(,"byteStride":2,"count":6,"mode":")" + index_mode + R"("}}}],
        "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":4},
                     {"bufferView":1,"componentType":5123,"type":"SCALAR","count":6}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]})";
}

TEST(Meshopt, givesBackVerticesAndIndices)
{
    const std::vector<uint32_t> indices(kSquareIndices.begin(), kSquareIndices.end());
    const std::string vertices = meshoptVertices(kSquare);
    for (const bool sequence : {false, true})
    {
        const std::string compressed = sequence ? meshoptSequence(indices, 4) : meshoptIndices(indices, 4);
        const Imported result =
            importBytes(glb(meshoptDocument(vertices, compressed, sequence ? "INDICES" : "TRIANGLES"),
                            vertices + compressed));
        ASSERT_TRUE(result.ok()) << result.message();
        EXPECT_EQ(sortedCorners(result.mesh()),
                  (std::vector<std::array<float, 3>>{
                      {0, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}}));
    }
}

TEST(Meshopt, refusesWhatTheLibraryTakesForGranted)
{
    const std::vector<uint32_t> triangles(kSquareIndices.begin(), kSquareIndices.end());
    const std::string vertices = meshoptVertices(kSquare);
    const std::string indices = meshoptIndices(triangles, 4);
    const std::string document = meshoptDocument(vertices, indices, "TRIANGLES");
    struct Case
    {
        const char* from;
        const char* to;
        Issue issue;
    };
    const Case cases[] = {
        {R"("byteStride":12,"count":4)", R"("byteStride":3,"count":4)", Issue::gltf_extension_value},
        {R"("byteStride":12,"count":4)", R"("byteStride":260,"count":4)", Issue::gltf_extension_value},
        {R"("byteStride":12,"count":4)", R"("byteStride":12,"count":3)", Issue::gltf_bounds},
        {R"("byteStride":12,"count":4)", R"("byteStride":12,"count":4294967295)", Issue::codec_failed},
        {R"("byteStride":2,"count":6)", R"("byteStride":8,"count":6)", Issue::gltf_extension_value},
        {R"("byteStride":2,"count":6)", R"("byteStride":2,"count":5)", Issue::gltf_extension_value},
        {R"("mode":"TRIANGLES")", R"("mode":"INDICES")", Issue::codec_failed},
        {R"("mode":"TRIANGLES")", R"("mode":"ZLIB")", Issue::gltf_extension_value},
        {R"("mode":"ATTRIBUTES")", R"("mode":"ATTRIBUTES","filter":"OCTAHEDRAL")",
         Issue::gltf_extension_value},
        {R"("mode":"ATTRIBUTES")", R"("mode":"ATTRIBUTES","filter":"QUATERNION")",
         Issue::gltf_extension_value},
        {R"("mode":"ATTRIBUTES")", R"("mode":"ATTRIBUTES","filter":"WAVES")", Issue::gltf_extension_value},
        {R"("mode":"TRIANGLES")", R"("mode":"TRIANGLES","filter":"EXPONENTIAL")",
         Issue::gltf_extension_value},
    };
    for (const Case& c : cases)
    {
        const Imported result = importBytes(glb(replaced(document, c.from, c.to), vertices + indices));
        ASSERT_FALSE(result.ok()) << c.to;
        EXPECT_EQ(issueInfo(result.status.error().issue).name, issueInfo(c.issue).name) << c.to;
    }
}

TEST(Meshopt, decodesFilters)
{
    // exponential: 2^e * m in each word, exponent in the top byte
    const std::vector<float> values{0.5f, -3, 1024, 0, 2, 8, 1, 1, 1, -1, -2, -4};
    std::vector<uint32_t> filtered(values.size());
    meshopt_encodeFilterExp(filtered.data(), 4, 12, 15, values.data());
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(4, 12));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), filtered.data(), 4, 12));
    const std::string vertices(bytes.begin(), bytes.end());
    const std::string indices = meshoptIndices({kSquareIndices.begin(), kSquareIndices.end()}, 4);
    const std::string document =
        replaced(meshoptDocument(vertices, indices, "TRIANGLES"), R"("mode":"ATTRIBUTES")",
                 R"("mode":"ATTRIBUTES","filter":"EXPONENTIAL")");
    const Imported result = importBytes(glb(document, vertices + indices));
    ASSERT_TRUE(result.ok()) << result.message();
    const auto corners = sortedCorners(result.mesh());
    EXPECT_NE(std::find(corners.begin(), corners.end(), std::array<float, 3>{0.5f, -3, 1024}), corners.end());
    EXPECT_NE(std::find(corners.begin(), corners.end(), std::array<float, 3>{-1, -2, -4}), corners.end());
}

TEST(Meshopt, refusesDamagedData)
{
    const std::string vertices = meshoptVertices(kSquare);
    const std::string indices = meshoptIndices({kSquareIndices.begin(), kSquareIndices.end()}, 4);
    std::string damaged = vertices;
    damaged[0] = static_cast<char>(damaged[0] ^ 0x40); // magic byte of the codec
    const Imported result =
        importBytes(glb(meshoptDocument(vertices, indices, "TRIANGLES"), damaged + indices));
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.error().issue, Issue::codec_failed);
    EXPECT_EQ(result.status.error().where, "/bufferViews/0");
}

} // namespace

} // namespace hearth::import::test
