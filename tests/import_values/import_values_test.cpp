// Compares the values that the import reads of small generated glTF files with what tinygltf reads, and
// proves that the comparison sees errors.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/import_values/imported_source.h"
#include "tests/support/small_sources.h"

#include <cstring>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

namespace hearth::test
{

namespace
{

/// Small glTF document: views and accessors over one binary file.
class Document
{
public:
    template <typename T>
    size_t addView(const std::vector<T>& values, size_t stride = 0)
    {
        bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
        Json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(T)}};
        if (stride > 0)
            view["byteStride"] = stride;
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        json["bufferViews"].push_back(view);
        return json["bufferViews"].size() - 1;
    }

    size_t addAccessor(size_t view, int type, const char* shape, size_t count, size_t offset = 0)
    {
        json["accessors"].push_back({{"bufferView", view},
                                     {"byteOffset", offset},
                                     {"componentType", type},
                                     {"type", shape},
                                     {"count", count}});
        return json["accessors"].size() - 1;
    }

    template <typename T>
    size_t add(const std::vector<T>& values, const char* shape, bool is_normalised = false)
    {
        const size_t components = std::string_view(shape) == "SCALAR" ? 1
                                  : std::string_view(shape) == "VEC2" ? 2
                                  : std::string_view(shape) == "VEC3" ? 3
                                  : std::string_view(shape) == "VEC4" ? 4
                                                                      : 16;
        const size_t accessor =
            addAccessor(addView(values), componentType<T>(), shape, values.size() / components);
        if (is_normalised)
            json["accessors"][accessor]["normalized"] = true;
        return accessor;
    }

    void write(const Sandbox& folder)
    {
        json["asset"] = {{"version", "2.0"}};
        Json buffer{{"uri", "source.bin"}, {"byteLength", bytes_.size()}};
        json["buffers"] = Json::array();
        json["buffers"].push_back(buffer);
        folder.write("source.gltf", json.dump());
        folder.write("source.bin", bytes_);
    }

    /// Return the position in the binary file of the last byte of an accessor's first component.
    size_t firstByte(size_t accessor) const
    {
        const Json& json_accessor = json["accessors"][accessor];
        const auto type = json_accessor["componentType"].get<int>();
        const size_t size = type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4;
        return json["bufferViews"][json_accessor["bufferView"].get<size_t>()]["byteOffset"].get<size_t>() +
               json_accessor["byteOffset"].get<size_t>() + size - 1;
    }

    Json json = Json::object();

private:
    template <typename T>
    static int componentType()
    {
        return std::is_same_v<T, int8_t>     ? 5120
               : std::is_same_v<T, uint8_t>  ? 5121
               : std::is_same_v<T, int16_t>  ? 5122
               : std::is_same_v<T, uint16_t> ? 5123
               : std::is_same_v<T, uint32_t> ? 5125
                                             : 5126;
    }

    std::string bytes_;
};

const std::vector<float> kQuad{0, 0, 0, 1, 0, 0.25F, 1, 1.5F, 0, 0, 1, -0.125F};
const std::vector<float> kNormals{0, 0, 1, 0.6F, 0, 0.8F, 0, 0.6F, 0.8F, 1, 2, 2};

/// Interleave positions and normals of four vertices.
size_t addInterleaved(Document& document, Json& attributes)
{
    std::vector<float> both;
    for (size_t i = 0; i < 4; ++i)
    {
        both.insert(both.end(), kQuad.begin() + static_cast<std::ptrdiff_t>(i * 3),
                    kQuad.begin() + static_cast<std::ptrdiff_t>(i * 3 + 3));
        both.insert(both.end(), kNormals.begin() + static_cast<std::ptrdiff_t>(i * 3),
                    kNormals.begin() + static_cast<std::ptrdiff_t>(i * 3 + 3));
        both.push_back(99); // padding
    }
    const size_t view = document.addView(both, 28);
    attributes["POSITION"] = document.addAccessor(view, 5126, "VEC3", 4);
    attributes["NORMAL"] = document.addAccessor(view, 5126, "VEC3", 4, 12);
    return view;
}

/// Skinned, morphing, textured quad whose accessors have every layout.
Document richDocument()
{
    Document document;
    Json attributes = Json::object();
    addInterleaved(document, attributes);
    attributes["TANGENT"] = document.add<int8_t>(
        {90, 40, -30, 127, 100, 20, -30, -127, 0, 127, 0, 127, -128, 5, 5, 127}, "VEC4", true);
    attributes["TEXCOORD_0"] = document.add<uint16_t>({1, 2, 65535, 4, 500, 60000, 7, 8}, "VEC2", true);
    attributes["TEXCOORD_1"] = document.add<float>({0.5F, -2, 3, 0.25F, 5, 6, 7, 8.5F}, "VEC2");
    attributes["COLOR_0"] =
        document.add<uint8_t>({10, 20, 30, 0, 50, 60, 70, 0, 90, 100, 110, 0, 1, 2, 3, 0}, "VEC4", true);
    attributes["JOINTS_0"] = document.add<uint8_t>({1, 0, 1, 0, 0, 1, 0, 1, 1, 1, 0, 0, 0, 0, 1, 1}, "VEC4");
    attributes["WEIGHTS_0"] = document.add<uint8_t>(
        {128, 64, 32, 31, 200, 55, 0, 0, 100, 100, 40, 15, 85, 85, 40, 45}, "VEC4", true);
    const size_t indices = document.add<uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");

    // a sparse target without a view of its own, and one with
    const size_t sparse = document.add<float>({0, 0, 0, 0.5F, 0, 0, 0, 0, 0, 0, 0, 2}, "VEC3");
    const size_t places = document.addView<uint16_t>({1, 3});
    const size_t values = document.addView<float>({4, 5, 6, -1, -2, -3});
    document.json["accessors"][sparse]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", places}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    const size_t dense = document.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, "VEC3");
    Json primitive{{"attributes", attributes}, {"indices", indices}, {"material", 0}};
    primitive["targets"].push_back({{"POSITION", sparse}, {"NORMAL", dense}});
    document.json["meshes"].push_back({{"primitives", Json::array()}, {"weights", {0.25}}});
    document.json["meshes"][0]["primitives"].push_back(primitive);
    return document;
}

void addSkinAndNodes(Document& document)
{
    const size_t binds = document.add<float>(
        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, -2, -3, 1, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 2, 0, 4, 5, 6, 1},
        "MAT4");
    document.json["skins"].push_back({{"joints", {1, 2}}, {"inverseBindMatrices", binds}});
    document.json["nodes"] = Json::array();
    document.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
    document.json["nodes"].push_back({{"translation", {1.1, 2.2, 3.3}},
                                      {"rotation", {0.1, 0.2, 0.3, 0.9}},
                                      {"scale", {1, 2, 0.5}},
                                      {"children", {2}}});
    document.json["nodes"].push_back({{"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9.5, 1}}});
    document.json["nodes"].push_back({{"translation", {100.25, 0, 0}}, {"children", {4}}});
    document.json["nodes"].push_back({{"mesh", 0}, {"rotation", {0, 0, 0.6, 0.8}}, {"scale", {2, 3, -4}}});
    document.json["scenes"].push_back({{"nodes", {0, 1, 3}}});
}

void addAnimation(Document& document)
{
    const size_t times = document.add<float>({0.5F, 1, 1.75F}, "SCALAR");
    const size_t moves = document.add<float>({0, 0, 0, 1, 2, 3, 4, 5, 6}, "VEC3");
    const size_t turns =
        document.add<int16_t>({0, 0, 0, 32767, 10000, 0, 0, 31000, 0, -20000, 0, 26000}, "VEC4", true);
    const size_t spline = document.add<float>(
        {0, 0, 0, 1, 1, 1, 9, 9, 9, 1, 2, 3, 2, 2, 2, 4, 5, 6, 7, 8, 9, 3, 3, 3, 0, 1, 0}, "VEC3");
    const size_t weights = document.add<float>({0, 0.5F, 1}, "SCALAR");
    Json animation{{"samplers", Json::array()}, {"channels", Json::array()}};
    const auto addChannel = [&](size_t node, const char* path, size_t output, const char* interpolation)
    {
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
        animation["samplers"].push_back(
            {{"input", times}, {"output", output}, {"interpolation", interpolation}});
    };
    addChannel(1, "translation", moves, "LINEAR");
    addChannel(1, "rotation", turns, "STEP");
    addChannel(1, "scale", spline, "CUBICSPLINE");
    addChannel(0, "weights", weights, "LINEAR");
    document.json["animations"].push_back(animation);
}

void addMaterial(Document& document)
{
    document.json["images"].push_back({{"uri", "missing.png"}});
    document.json["samplers"].push_back({{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
    document.json["textures"].push_back({{"source", 0}, {"sampler", 0}});
    const Json turned{
        {"index", 0},
        {"texCoord", 0},
        {"extensions",
         {{"KHR_texture_transform",
           {{"offset", {0.125, 0.75}}, {"rotation", 0.7}, {"scale", {2, 0.3}}, {"texCoord", 1}}}}}};
    // each pair is at one place
    const auto layers = [](const Json& texture) -> Json
    {
        const Json plain{{"index", 0}};
        return {{"KHR_materials_ior", {{"ior", 1.33}}},
                {"KHR_materials_specular",
                 {{"specularFactor", 0.81},
                  {"specularColorFactor", {0.82, 1.83, 0.84}},
                  {"specularColorTexture", texture},
                  {"specularTexture", texture}}},
                {"KHR_materials_clearcoat",
                 {{"clearcoatFactor", 0.85},
                  {"clearcoatRoughnessFactor", 0.86},
                  {"clearcoatTexture", plain},
                  {"clearcoatRoughnessTexture", plain},
                  {"clearcoatNormalTexture", {{"index", 0}, {"scale", 0.87}}}}},
                {"KHR_materials_sheen",
                 {{"sheenColorFactor", {0.91, 0.92, 0.93}},
                  {"sheenRoughnessFactor", 0.94},
                  {"sheenColorTexture", plain},
                  {"sheenRoughnessTexture", plain}}}};
    };
    document.json["materials"].push_back({{"pbrMetallicRoughness",
                                           {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                                            {"metallicFactor", 0.15},
                                            {"roughnessFactor", 0.35},
                                            {"baseColorTexture", turned}}},
                                          {"normalTexture", {{"index", 0}, {"scale", 0.45}}},
                                          {"occlusionTexture", {{"index", 0}, {"strength", 0.55}}},
                                          {"emissiveFactor", {0.6, 0.7, 0.8}},
                                          {"alphaMode", "MASK"},
                                          {"alphaCutoff", 0.65},
                                          {"doubleSided", true},
                                          {"extensions", layers(turned)}});
}

Document wholeDocument()
{
    Document document = richDocument();
    addSkinAndNodes(document);
    addAnimation(document);
    addMaterial(document);
    return document;
}

class ImportValues : public ::testing::Test
{
protected:
    Comparison compare(const std::string& path = "source.gltf")
    {
        return importAndCompare(folder, path, path);
    }

    Sandbox folder;
};

} // namespace

TEST_F(ImportValues, areThoseOfEveryLayout)
{
    wholeDocument().write(folder);
    const Comparison comparison = compare();
    EXPECT_EQ(comparison.differences(), 0u) << comparison.report();
    for (const Value kind :
         {Value::position, Value::normal, Value::tangent, Value::uv, Value::color, Value::joint,
          Value::weight, Value::morph_delta, Value::key_time, Value::key_value, Value::node,
          Value::inverse_bind, Value::factor, Value::texture_transform})
        EXPECT_GT(comparison.compared(kind), 0u) << valueName(kind);
}

/// A value is changed behind the import's back: the comparison sees it, in every accessor.
TEST_F(ImportValues, areAllLookedAt)
{
    Document document = wholeDocument();
    document.write(folder);
    ASSERT_EQ(compare().differences(), 0u);
    const std::string bytes = folder.read("source.bin");
    for (size_t accessor = 0; accessor < document.json["accessors"].size(); ++accessor)
    {
        std::string changed = bytes;
        char& byte = changed[document.firstByte(accessor)];
        byte = static_cast<char>(byte ^ 0x41);
        folder.write("source.bin", changed);
        const Comparison comparison = comparePart(folder / "source.gltf", folder / "source.part", "changed");
        EXPECT_GT(comparison.differences(), 0u) << "accessor " << accessor;
    }
}

/// The same for numbers of the JSON text.
TEST_F(ImportValues, ofTheTextAreAllLookedAt)
{
    wholeDocument().write(folder);
    ASSERT_EQ(compare().differences(), 0u);
    const std::string text = folder.read("source.gltf");
    for (const char* number : {"0.1,0.2,0.3,0.4",
                               "0.15",
                               "0.35",
                               "0.45",
                               "0.55",
                               "0.6,0.7",
                               "0.65",
                               "0.125,0.75",
                               "0.7,\"scale\"",
                               "2,0.3",
                               "1.1",
                               "9.5",
                               "100.25",
                               "33071",
                               "33648",
                               "9728",
                               "0.25",
                               "1.33",
                               "0.81",
                               "0.82,1.83",
                               "0.85",
                               "0.86",
                               "0.87",
                               "0.91,0.92",
                               "0.94"})
    {
        std::string changed = text;
        const size_t at = changed.find(number);
        ASSERT_NE(at, std::string::npos) << number;
        const size_t digit = at + std::strcspn(changed.c_str() + at, "123456789");
        changed[digit] = changed[digit] == '9' ? '8' : static_cast<char>(changed[digit] + 1);
        if (std::string_view(number).starts_with("3")) // another sampler mode
            changed.replace(at, 5, "10497");
        if (std::string_view(number) == "9728")
            changed.replace(at, 4, "9729");
        folder.write("source.gltf", changed);
        EXPECT_GT(comparePart(folder / "source.gltf", folder / "source.part", "changed").differences(), 0u)
            << number;
    }
}

TEST_F(ImportValues, ofStripsFansAndSharedAttributes)
{
    Document document;
    const size_t positions = document.add(kQuad, "VEC3");
    const size_t uvs = document.add<float>({0, 1, 2, 3, 4, 5, 6, 7}, "VEC2");
    const size_t indices = document.add<uint8_t>({3, 0, 2, 1}, "SCALAR");
    document.json["meshes"].push_back({{"primitives", Json::array()}});
    Json& primitives = document.json["meshes"][0]["primitives"];
    for (const int mode : {5, 6, 4})
        primitives.push_back(
            {{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"mode", mode}});
    primitives.push_back({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"mode", 5}});
    primitives.push_back({{"attributes", {{"POSITION", positions}}}, {"mode", 6}});
    document.json["nodes"].push_back({{"mesh", 0}});
    document.write(folder);
    const Comparison comparison = compare();
    EXPECT_EQ(comparison.differences(), 0u) << comparison.report();
    EXPECT_EQ(comparison.compared(Value::position), (2u + 2 + 1 + 2 + 2) * 9);
    EXPECT_GT(comparison.compared(Value::flat_normal), 0u);
}

/// Vectors without a direction and joints without a skin have no equal in the part; they are counted.
TEST_F(ImportValues, withoutAnEqualAreCounted)
{
    Document document;
    addMaterial(document);
    const size_t positions = document.add(kQuad, "VEC3");
    const size_t normals = document.add<float>({0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 0}, "VEC3");
    const size_t tangents = document.add<float>({1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, -1, 0, 1, 0, 1}, "VEC4");
    const size_t joints = document.add<uint8_t>(std::vector<uint8_t>(16), "VEC4");
    const size_t weights = document.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    document.json["meshes"].push_back({{"primitives", Json::array()}});
    document.json["meshes"][0]["primitives"].push_back({{"attributes",
                                                         {{"POSITION", positions},
                                                          {"NORMAL", normals},
                                                          {"TANGENT", tangents},
                                                          {"JOINTS_0", joints},
                                                          {"WEIGHTS_0", weights}}},
                                                        {"mode", 6},
                                                        {"material", 0}});
    document.json["nodes"].push_back({{"mesh", 0}});
    document.write(folder);
    const Comparison comparison = compare();
    EXPECT_EQ(comparison.differences(), 0u) << comparison.report();
    EXPECT_EQ(comparison.excluded(Exclusion::normal_without_direction), 2u) << "corners of two triangles";
    EXPECT_EQ(comparison.excluded(Exclusion::tangent_without_direction), 1u);
    EXPECT_EQ(comparison.excluded(Exclusion::idle_skin), 6u);
}

TEST_F(ImportValues, ofQuantisedAndMeshoptGeometry)
{
    Document document;
    std::vector<int16_t> positions;
    for (int i = 0; i < 64; ++i)
        for (const int value : {i % 8 * 900, i / 8 * 800 - 3000, i * 37, 0})
            positions.push_back(static_cast<int16_t>(value));
    std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(64, 8));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), positions.data(), 64, 8));
    const size_t view = document.addView(packed);
    Json& json_view = document.json["bufferViews"][view];
    json_view["extensions"] = {{"EXT_meshopt_compression",
                                {{"buffer", 0},
                                 {"byteOffset", json_view["byteOffset"]},
                                 {"byteLength", packed.size()},
                                 {"byteStride", 8},
                                 {"count", 64},
                                 {"mode", "ATTRIBUTES"}}}};
    json_view["byteLength"] = 512;
    json_view["byteStride"] = 8;
    const size_t accessor = document.addAccessor(view, 5122, "VEC3", 64);
    document.json["accessors"][accessor]["normalized"] = true;
    std::vector<uint8_t> indices;
    for (int i = 0; i + 9 < 64; ++i)
        for (const int corner : {i, i + 1, i + 9})
            indices.push_back(static_cast<uint8_t>(corner));
    document.addView(std::vector<uint8_t>(1024)); // the fallback of the view above lies in the file
    document.json["meshes"].push_back({{"primitives", Json::array()}});
    const size_t index_accessor = document.add(indices, "SCALAR");
    document.json["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", accessor}}}, {"indices", index_accessor}});
    document.json["nodes"].push_back({{"mesh", 0}});
    document.json["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
    document.json["extensionsUsed"] = document.json["extensionsRequired"];
    document.write(folder);
    const Comparison comparison = compare();
    EXPECT_EQ(comparison.differences(), 0u) << comparison.report();
    EXPECT_EQ(comparison.compared(Value::position), indices.size() * 3);
}

TEST_F(ImportValues, ofGeneratedSources)
{
    const ProgramEnd made = folder.run({HEARTH_BIN "/hearth-samples", "character", "--triangles", "3000",
                                        "--texture-size", "64", "-o", folder / "character.glb"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    Comparison comparison = compare("character.glb");
    writeGltf(folder, "tree", 0.3F);
    comparison.add(compare("tree.gltf"));
    EXPECT_EQ(comparison.differences(), 0u) << comparison.report();
    for (const Value kind :
         {Value::position, Value::joint, Value::weight, Value::key_value, Value::inverse_bind})
        EXPECT_GT(comparison.compared(kind), 100u) << valueName(kind);
}

TEST(SourceValues, ofNormalisedIntegersFollowTheSpecification)
{
    EXPECT_EQ(normalised(-128, TINYGLTF_COMPONENT_TYPE_BYTE), -1);
    EXPECT_EQ(normalised(127, TINYGLTF_COMPONENT_TYPE_BYTE), 1);
    EXPECT_EQ(normalised(51, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE), 0.2);
    EXPECT_EQ(normalised(-32768, TINYGLTF_COMPONENT_TYPE_SHORT), -1);
    EXPECT_EQ(normalised(13107, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT), 0.2);
    EXPECT_EQ(normalised(2.5, TINYGLTF_COMPONENT_TYPE_FLOAT), 2.5);
}

} // namespace hearth::test
