// Tests buffers, URIs and accessors: the numbers read from given bytes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/uri.h"
#include "tests/pipelines/gltf_fixture.h"

namespace hearth::import::test
{

namespace
{

/// Import the four corners with an additional accessor as attribute `semantic`, and return the mesh.
template <typename T>
mesh::SourceMesh withAttribute(const std::string& semantic, const std::string& type,
                               const std::vector<T>& values, const std::string& extra = "")
{
    GltfData data;
    data.add("VEC3", kSquare);
    data.add(type, values, extra);
    data.add("SCALAR", kSquareIndices);
    const Imported result = data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,")" +
                                        semantic + R"(":1},"indices":2}]}])");
    EXPECT_TRUE(result.ok()) << result.message();
    // flat normals may split and reorder vertices; the square is one plane, so they do not
    return result.ok() ? result.mesh() : mesh::SourceMesh{};
}

TEST(GltfAccessors, readNormalizedIntegersAsTheSpecificationSays)
{
    const auto u8 =
        withAttribute<uint8_t>("TEXCOORD_0", "VEC2", {0, 255, 51, 102, 0, 0, 0, 0}, R"("normalized":true)");
    ASSERT_EQ(u8.uvs[0].size(), 4u);
    EXPECT_EQ(u8.uvs[0][0], (Float2{0, 1}));
    EXPECT_FLOAT_EQ(u8.uvs[0][1].x, 0.2f);
    EXPECT_FLOAT_EQ(u8.uvs[0][1].y, 0.4f);

    const auto i8 = withAttribute<int8_t>("TEXCOORD_0", "VEC2", {-128, -127, 127, 0, 64, 0, 0, 0},
                                          R"("normalized":true)");
    EXPECT_EQ(i8.uvs[0][0], (Float2{-1, -1})); // both smallest values mean -1
    EXPECT_EQ(i8.uvs[0][1], (Float2{1, 0}));
    EXPECT_FLOAT_EQ(i8.uvs[0][2].x, 64.0f / 127.0f);

    const auto u16 = withAttribute<uint16_t>("TEXCOORD_0", "VEC2", {0, 65535, 13107, 0, 0, 0, 0, 0},
                                             R"("normalized":true)");
    EXPECT_EQ(u16.uvs[0][0], (Float2{0, 1}));
    EXPECT_FLOAT_EQ(u16.uvs[0][1].x, 0.2f);

    const auto i16 = withAttribute<int16_t>("TEXCOORD_0", "VEC2", {-32768, 32767, 16384, 0, 0, 0, 0, 0},
                                            R"("normalized":true)");
    EXPECT_EQ(i16.uvs[0][0], (Float2{-1, 1}));
    EXPECT_FLOAT_EQ(i16.uvs[0][1].x, 16384.0f / 32767.0f);
}

TEST(GltfAccessors, readPlainIntegersAsTheirValue)
{
    const auto mesh = withAttribute<int16_t>("TEXCOORD_0", "VEC2", {-3, 7, 300, 0, 0, 0, 0, 0});
    EXPECT_EQ(mesh.uvs[0][0], (Float2{-3, 7}));
    EXPECT_EQ(mesh.uvs[0][1], (Float2{300, 0}));
}

TEST(GltfAccessors, readColorsOfThreeAndFourComponents)
{
    const auto rgb = withAttribute<float>("COLOR_0", "VEC3", {1, 0.5f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(rgb.colors.size(), 4u);
    EXPECT_EQ(rgb.colors[0], (Float4{1, 0.5f, 0, 1}));
    const auto rgba = withAttribute<uint16_t>(
        "COLOR_0", "VEC4", {65535, 0, 0, 13107, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, R"("normalized":true)");
    EXPECT_EQ(rgba.colors[0].x, 1.0f);
    EXPECT_FLOAT_EQ(rgba.colors[0].w, 0.2f);
}

TEST(GltfAccessors, clampColorsAndReplaceWhatIsNotFinite)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto colors = withAttribute<float>("COLOR_0", "VEC3", {2, -1, nan, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_EQ(colors.colors[0], (Float4{1, 0, 0, 1}));
    const auto uvs = withAttribute<float>("TEXCOORD_0", "VEC2", {nan, 1, 0.5f, 0.5f, 0, 0, 0, 0});
    EXPECT_EQ(uvs.uvs[0][0], (Float2{0, 0}));
    EXPECT_EQ(uvs.uvs[0][1], (Float2{0.5f, 0.5f}));
}

TEST(GltfAccessors, withoutDataHaveABudgetOfDecodedBytes)
{
    // 57 MiB of positions, and 19 MiB of colours that become 76 MiB
    const Imported result = importBytes(R"({"asset":{"version":"2.0"},
        "accessors":[{"componentType":5126,"type":"VEC3","count":4999998},
                     {"componentType":5121,"normalized":true,"type":"VEC4","count":4999998}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1}}]}],"nodes":[{"mesh":0}]})");
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.error().issue, Issue::input_too_large);
    EXPECT_EQ(result.status.error().where, "/accessors/1");
}

TEST(GltfAccessors, followTheStrideOfInterleavedViews)
{
    // position and UV of four vertices in one view: 20 bytes a vertex
    std::vector<float> vertices;
    for (size_t i = 0; i < 4; ++i)
    {
        vertices.insert(vertices.end(), kSquare.begin() + static_cast<std::ptrdiff_t>(i * 3),
                        kSquare.begin() + static_cast<std::ptrdiff_t>(i * 3 + 3));
        vertices.insert(vertices.end(), {static_cast<float>(i), static_cast<float>(i * 10)});
    }
    GltfData data;
    const uint32_t view = data.addView(toBytes(vertices), R"("byteStride":20)");
    data.addAccessor(view, 5126, "VEC3", 4);
    data.addAccessor(view, 5126, "VEC2", 4, R"("byteOffset":12)");
    data.add("SCALAR", kSquareIndices);
    const Imported result = data.import(
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2}]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.mesh().positions[2], (Float3{1, 1, 0}));
    EXPECT_EQ(result.mesh().uvs[0][3], (Float2{3, 30}));
}

TEST(GltfAccessors, replaceSparseElements)
{
    GltfData data;
    const uint32_t base = data.addView(toBytes(kSquare));
    const uint32_t indices = data.addView(toBytes<uint16_t>({1, 3}));
    const uint32_t values = data.addView(toBytes<float>({5, 6, 0, 7, 8, 0}));
    const std::string sparse = R"("sparse":{"count":2,"indices":{"bufferView":)" + std::to_string(indices) +
                               R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(values) +
                               "}}";
    data.addAccessor(base, 5126, "VEC3", 4, sparse);
    data.addAccessor(std::nullopt, 5126, "VEC3", 4, sparse);
    data.add("SCALAR", kSquareIndices);
    data.add("VEC3",
             // given normals: generated flat ones would split vertices
             std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const Imported result =
        data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":3},"indices":2}]},
                                                     {"primitives":[{"attributes":{"POSITION":1,"NORMAL":3},"indices":2}]}])");
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.mesh(0).positions, (std::vector<Float3>{{0, 0, 0}, {5, 6, 0}, {1, 1, 0}, {7, 8, 0}}));
    EXPECT_EQ(result.mesh(1).positions, (std::vector<Float3>{{0, 0, 0}, {5, 6, 0}, {0, 0, 0}, {7, 8, 0}}));
}

TEST(GltfAccessors, refuseASparseIndexBeyondTheElements)
{
    GltfData data;
    const uint32_t indices = data.addView(toBytes<uint16_t>({4}));
    const uint32_t values = data.addView(toBytes<float>({0, 0, 0}));
    data.addAccessor(std::nullopt, 5126, "VEC3", 4,
                     R"("sparse":{"count":1,"indices":{"bufferView":)" + std::to_string(indices) +
                         R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(values) + "}}");
    const Imported result = data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])");
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.error().issue, Issue::gltf_data);
}

TEST(GltfUri, decodesPercentSignsOnce)
{
    EXPECT_EQ(decodePercent("a%20b.bin"), "a b.bin");
    EXPECT_EQ(decodePercent("%252e"), "%2e");
    EXPECT_EQ(decodePercent("%zz"), std::nullopt);
    EXPECT_EQ(decodePercent("abc%4"), std::nullopt);
}

TEST(GltfUri, decodesStrictBase64Only)
{
    const auto text = [](const char* uri) -> std::optional<std::string>
    {
        const auto bytes = decodeDataUri(uri);
        if (!bytes)
            return std::nullopt;
        return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    };
    EXPECT_EQ(text("data:application/octet-stream;base64,SGVhcnRo"), "Hearth");
    EXPECT_EQ(text("data:;base64,SGVhcnQ="), "Heart");
    EXPECT_EQ(text("DATA:;base64,SGVhcg=="), "Hear");
    EXPECT_EQ(text("data:;base64,"), "");
    EXPECT_EQ(text("data:"), std::nullopt);
    EXPECT_EQ(text("data:;base64"), std::nullopt);
    EXPECT_EQ(text("data:,Hearth"), std::nullopt);
    EXPECT_EQ(text("data:;base64,SGVhcnQ"), std::nullopt);  // no padding
    EXPECT_EQ(text("data:;base64,SGV=cnRo"), std::nullopt); // padding inside
    EXPECT_EQ(text("data:;base64,SGV!cnRo"), std::nullopt);
    EXPECT_EQ(text("data:;base64,SGV\ncnR"), std::nullopt);
}

/// Triangle whose buffer is the file or data that `uri` names.
std::string triangleDocument(const std::string& uri)
{
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" + uri +
           R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})";
}

std::string triangleData()
{
    return toBytes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
}

TEST(GltfBuffers, readFilesBesideAndBelowTheAsset)
{
    const TemporaryFolder folder;
    folder.write("data.bin", triangleData());
    folder.write("below/my data.bin", triangleData());
    EXPECT_TRUE(importBytes(triangleDocument("data.bin"), &folder).ok());
    EXPECT_TRUE(importBytes(triangleDocument("./data.bin"), &folder).ok());
    EXPECT_TRUE(importBytes(triangleDocument("below/my%20data.bin"), &folder).ok());
}

TEST(GltfBuffers, tolerateALongerFileButNotAShorterOne)
{
    const TemporaryFolder folder;
    folder.write("long.bin", triangleData() + "more");
    folder.write("short.bin", triangleData().substr(1));
    EXPECT_TRUE(importBytes(triangleDocument("long.bin"), &folder).ok());
    const Imported result = importBytes(triangleDocument("short.bin"), &folder);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.error().issue, Issue::buffer_short);
}

TEST(GltfBuffers, readDataUris)
{
    const Imported result = importBytes(triangleDocument(
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"));
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.mesh().positions[1], (Float3{1, 0, 0}));
}

TEST(GltfBuffers, neverLeaveTheFolderOfTheAsset)
{
    const TemporaryFolder outside;
    outside.write("secret.bin", triangleData());
    const TemporaryFolder folder;
    folder.write("inside.bin", triangleData());
    folder.write("below/x", "");
    const std::string secret = outside.path("secret.bin");
    std::filesystem::create_symlink(secret, folder.path("link.bin"));
    std::filesystem::create_directory_symlink(outside.path(""), folder.path("linked"));
    std::filesystem::create_symlink(folder.path("inside.bin"), folder.path("good.bin"));

    const std::pair<std::string, Issue> cases[] = {
        {secret, Issue::uri_outside},
        {"file://" + secret, Issue::uri_outside},
        {"http://127.0.0.1:9/x.bin", Issue::uri_outside},
        {"below/../inside.bin", Issue::uri_outside},
        {"%2e%2e/secret.bin", Issue::uri_outside},
        {"..\\\\secret.bin", Issue::uri_outside},
        {"C:\\\\secret.bin", Issue::uri_outside},
        {"\\\\\\\\host\\\\secret.bin", Issue::uri_outside},
        {"link.bin", Issue::uri_outside},
        {"linked/secret.bin", Issue::uri_outside},
        {"%252e%252e/secret.bin", Issue::buffer_missing},
        {"", Issue::uri_malformed},
        {"inside.bin%00.png", Issue::uri_malformed},
        {".", Issue::buffer_missing},
        {"below", Issue::buffer_missing},
        {" ", Issue::buffer_missing},
    };
    for (const auto& [uri, issue] : cases)
    {
        const Imported result = importBytes(triangleDocument(uri), &folder);
        ASSERT_FALSE(result.ok()) << uri;
        EXPECT_EQ(issueInfo(result.status.error().issue).name, issueInfo(issue).name) << uri;
    }
    EXPECT_TRUE(importBytes(triangleDocument("good.bin"), &folder).ok())
        << "a link that stays inside is fine";
}

TEST(GltfContainer, ignoresChunksThatItDoesNotKnow)
{
    std::string bytes = glb(replaced(triangleDocument("x"), R"(,"uri":"x")", ""), triangleData());
    bytes += std::string("\4\0\0\0WHAT1234", 12);
    const auto size = static_cast<uint32_t>(bytes.size());
    std::memcpy(bytes.data() + 8, &size, sizeof(size));
    EXPECT_TRUE(importBytes(bytes).ok());
}

TEST(GltfContainer, refusesAGlbWithoutTheBufferThatItRefersTo)
{
    const Imported result = importBytes(glb(replaced(triangleDocument("x"), R"(,"uri":"x")", ""), ""));
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.error().issue, Issue::buffer_missing);
}

} // namespace

} // namespace hearth::import::test
