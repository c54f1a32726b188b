// Tests one defect at a time in an otherwise valid document: the import rejects it with the right issue and
// location.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines/gltf_fixture.h"

namespace hearth::import::test
{

namespace
{

/// Skinned, animated, textured square with a morph target, in 448 bytes of data.
const char* const kDocument = R"({
  "asset": {"version": "2.0"},
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
  "scene": 0,
  "scenes": [{"nodes": [0, 1]}],
  "nodes": [
    {"mesh": 0, "skin": 0, "children": [2]},
    {"camera": 0, "translation": [0, 0, 5]},
    {"rotation": [0, 0, 0, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}}
  ],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "JOINTS_0": 2, "WEIGHTS_0": 3},
    "indices": 4, "material": 0, "mode": 4, "targets": [{"POSITION": 5}]}], "weights": [0]}],
  "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 0}}, "alphaMode": "MASK"}],
  "textures": [{"source": 0, "sampler": 0}],
  "images": [{"bufferView": 9}],
  "samplers": [{"wrapS": 33071}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
  "skins": [{"joints": [2], "inverseBindMatrices": 6}],
  "animations": [{"samplers": [{"input": 7, "output": 8}], "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}]}],
  "buffers": [{"byteLength": 448}],
  "bufferViews": [
    {"buffer": 0, "byteOffset": 0, "byteLength": 48},
    {"buffer": 0, "byteOffset": 48, "byteLength": 32},
    {"buffer": 0, "byteOffset": 80, "byteLength": 16},
    {"buffer": 0, "byteOffset": 96, "byteLength": 64},
    {"buffer": 0, "byteOffset": 160, "byteLength": 12},
    {"buffer": 0, "byteOffset": 176, "byteLength": 48},
    {"buffer": 0, "byteOffset": 224, "byteLength": 64},
    {"buffer": 0, "byteOffset": 288, "byteLength": 8},
    {"buffer": 0, "byteOffset": 296, "byteLength": 32},
    {"buffer": 0, "byteOffset": 328, "byteLength": 8},
    {"buffer": 0, "byteOffset": 336, "byteLength": 112, "byteStride": 12}
  ],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4},
    {"bufferView": 1, "componentType": 5126, "type": "VEC2", "count": 4},
    {"bufferView": 2, "componentType": 5121, "type": "VEC4", "count": 4},
    {"bufferView": 3, "componentType": 5126, "type": "VEC4", "count": 4},
    {"bufferView": 4, "componentType": 5123, "type": "SCALAR", "count": 6},
    {"bufferView": 5, "componentType": 5126, "type": "VEC3", "count": 4},
    {"bufferView": 6, "componentType": 5126, "type": "MAT4", "count": 1},
    {"bufferView": 7, "componentType": 5126, "type": "SCALAR", "count": 2},
    {"bufferView": 8, "componentType": 5126, "type": "VEC4", "count": 2},
    {"bufferView": 10, "componentType": 5126, "type": "VEC3", "count": 9,
     "sparse": {"count": 2, "indices": {"bufferView": 9, "componentType": 5123},
                "values": {"bufferView": 8}}}
  ]
})";

std::string documentData()
{
    std::string data(448, '\0');
    const auto put = [&](size_t offset, const std::string& bytes)
    { data.replace(offset, bytes.size(), bytes); };
    put(0, toBytes(kSquare));
    put(96, toBytes<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
    put(160, toBytes(kSquareIndices));
    put(224, toBytes<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
    put(288, toBytes<float>({0, 1}));
    put(296, toBytes<float>({0, 0, 0, 1, 0, 0, 0, 1}));
    put(328, toBytes<uint16_t>({0, 1, 2, 3}));
    return data;
}

struct Defect
{
    const char* from;
    const char* to;
    Issue issue;
    const char* where;
};

void PrintTo(const Defect& defect, std::ostream* out)
{
    *out << defect.from << " -> " << defect.to;
}

class GltfRejects : public testing::TestWithParam<Defect>
{
};

TEST_P(GltfRejects, aDefectByItsPlace)
{
    const Defect& defect = GetParam();
    const Imported result = importBytes(glb(replaced(kDocument, defect.from, defect.to), documentData()));
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(issueInfo(result.status.error().issue).name, issueInfo(defect.issue).name) << result.message();
    EXPECT_EQ(result.status.error().where, defect.where) << result.message();
}

INSTANTIATE_TEST_SUITE_P(
    Document, GltfRejects,
    testing::Values(
        Defect{R"("asset": {"version": "2.0"},)", "", Issue::gltf_structure, ""},
        Defect{R"({"version": "2.0"})", "[]", Issue::gltf_structure, "/asset"},
        Defect{R"("version": "2.0")", R"("version": 2.0)", Issue::gltf_structure, "/asset/version"},
        Defect{R"("version": "2.0")", R"("version": "1.0")", Issue::gltf_version, "/asset"},
        Defect{R"("version": "2.0")", R"("version": "2.0", "minVersion": "2.1")", Issue::gltf_version,
               "/asset"},
        Defect{R"("extensionsUsed")", R"("extensionsRequired": ["FOO_bar"], "extensionsUsed")",
               Issue::gltf_extension, "/extensionsRequired"},
        Defect{R"(["KHR_lights_punctual"])", R"("KHR_lights_punctual")", Issue::gltf_structure,
               "/extensionsUsed"},
        Defect{R"("scene": 0)", R"("scene": 1)", Issue::gltf_reference, "/scene"},
        Defect{R"("scene": 0)", R"("scene": 4294967296)", Issue::gltf_reference, "/scene"},
        Defect{R"("scene": 0)", R"("scene": -1)", Issue::gltf_reference, "/scene"},
        Defect{R"("scene": 0)", R"("scene": null)", Issue::gltf_structure, "/scene"},
        Defect{R"("scene": 0)", R"("scene": "0")", Issue::gltf_structure, "/scene"},
        Defect{R"("scene": 0)", R"("scene": [0])", Issue::gltf_structure, "/scene"},
        Defect{R"("scene": 0)", R"("scene": 0.5)", Issue::gltf_structure, "/scene"},
        Defect{R"([{"nodes": [0, 1]}])", R"({"nodes": [0, 1]})", Issue::gltf_structure, "/scenes"},
        Defect{R"({"nodes": [0, 1]})", "null", Issue::gltf_structure, "/scenes/0"},
        Defect{R"("nodes": [0, 1])", R"("nodes": [0, 99])", Issue::gltf_reference, "/scenes/0/nodes/1"}));

INSTANTIATE_TEST_SUITE_P(
    Nodes, GltfRejects,
    testing::Values(
        Defect{R"("mesh": 0,)", R"("mesh": 1,)", Issue::gltf_reference, "/nodes/0/mesh"},
        Defect{R"("skin": 0,)", R"("skin": 1,)", Issue::gltf_reference, "/nodes/0/skin"},
        Defect{R"("children": [2])", R"("children": [3])", Issue::gltf_reference, "/nodes/0/children/0"},
        Defect{R"("children": [2])", R"("children": [0])", Issue::gltf_hierarchy, "/nodes/0"},
        Defect{R"("children": [2])", R"("children": [2, 2])", Issue::gltf_hierarchy, "/nodes/0"},
        Defect{R"({"camera": 0,)", R"({"children": [2], "camera": 0,)", Issue::gltf_hierarchy, "/nodes/1"},
        Defect{R"({"rotation")", R"({"children": [0], "rotation")", Issue::gltf_hierarchy, "/nodes/0"},
        Defect{R"("camera": 0)", R"("camera": 1)", Issue::gltf_reference, "/nodes/1/camera"},
        Defect{R"([0, 0, 5])", R"([0, 0])", Issue::gltf_structure, "/nodes/1/translation"},
        Defect{R"([0, 0, 5])", R"([0, null, 0])", Issue::gltf_structure, "/nodes/1/translation/1"},
        Defect{R"([0, 0, 5])", R"([0, 1e300, 0])", Issue::number_too_large, "/nodes/1/translation/1"},
        Defect{R"("translation": [0, 0, 5])", R"("matrix": [1, 0, 0, 0])", Issue::gltf_structure,
               "/nodes/1/matrix"},
        Defect{R"("translation": [0, 0, 5])", R"("matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1])",
               Issue::gltf_value, "/nodes/1"},
        Defect{R"({"light": 0})", R"({"light": 1})", Issue::gltf_reference,
               "/nodes/2/extensions/KHR_lights_punctual/light"},
        Defect{R"({"light": 0})", R"(7)", Issue::gltf_structure, "/nodes/2/extensions/KHR_lights_punctual"},
        Defect{R"("type": "point")", R"("type": "sun")", Issue::gltf_value,
               "/extensions/KHR_lights_punctual/lights/0/type"},
        Defect{R"("type": "perspective", )", "", Issue::gltf_structure, "/cameras/0"}));

INSTANTIATE_TEST_SUITE_P(
    Meshes, GltfRejects,
    testing::Values(
        Defect{R"([{"primitives": [)", R"([{"x": [)", Issue::gltf_structure, "/meshes/0"},
        Defect{R"({"POSITION": 0, "TEXCOORD_0": 1,)", R"({"POSITION": 10, "TEXCOORD_0": 1,)",
               Issue::gltf_reference, "/meshes/0/primitives/0/attributes/POSITION"},
        Defect{R"({"POSITION": 0, "TEXCOORD_0": 1,)", R"({"POSITION": 1, "TEXCOORD_0": 1,)",
               Issue::gltf_value, "/accessors/1"},
        Defect{R"("indices": 4)", R"("indices": "4")", Issue::gltf_structure,
               "/meshes/0/primitives/0/indices"},
        Defect{R"("indices": 4)", R"("indices": 0)", Issue::gltf_value, "/accessors/0"},
        Defect{R"("material": 0)", R"("material": 2147483648)", Issue::gltf_reference,
               "/meshes/0/primitives/0/material"},
        Defect{R"("mode": 4)", R"("mode": 7)", Issue::gltf_value, "/meshes/0/primitives/0/mode"},
        Defect{R"("mode": 4)", R"("mode": 4294967300)", Issue::gltf_value, "/meshes/0/primitives/0/mode"},
        Defect{R"([{"POSITION": 5}])", R"({"POSITION": 5})", Issue::gltf_structure,
               "/meshes/0/primitives/0/targets"},
        Defect{R"([{"POSITION": 5}])", R"([{"POSITION": 1}])", Issue::gltf_value, "/accessors/1"},
        Defect{R"([{"POSITION": 5}])", R"([{"POSITION": 9}])", Issue::gltf_data, "/accessors/9"},
        Defect{R"("JOINTS_0": 2)", R"("JOINTS_0": 3)", Issue::gltf_value, "/accessors/3"},
        Defect{R"("WEIGHTS_0": 3)", R"("WEIGHTS_0": 0)", Issue::gltf_value, "/accessors/0"},
        Defect{R"("joints": [2])", R"("joints": [])", Issue::gltf_structure, "/skins/0"},
        Defect{R"("joints": [2])", R"("joints": [2, 3])", Issue::gltf_reference, "/skins/0/joints/1"},
        Defect{R"("joints": [2])", R"("joints": [2, 1])", Issue::gltf_data, "/accessors/6"},
        Defect{R"("joints": [2])", R"("joints": [2], "skeleton": 99)", Issue::gltf_reference,
               "/skins/0/skeleton"},
        Defect{R"("inverseBindMatrices": 6)", R"("inverseBindMatrices": 3)", Issue::gltf_value,
               "/accessors/3"}));

INSTANTIATE_TEST_SUITE_P(
    Materials, GltfRejects,
    testing::Values(Defect{R"({"baseColorTexture": {"index": 0, "texCoord": 0}})", "[]",
                           Issue::gltf_structure, "/materials/0/pbrMetallicRoughness"},
                    Defect{R"({"index": 0, "texCoord": 0})", R"({"index": 1})", Issue::gltf_reference,
                           "/materials/0/pbrMetallicRoughness/baseColorTexture/index"},
                    Defect{R"({"index": 0, "texCoord": 0})", R"({"texCoord": 0})", Issue::gltf_structure,
                           "/materials/0/pbrMetallicRoughness/baseColorTexture"},
                    Defect{R"("texCoord": 0)", R"("texCoord": -1)", Issue::gltf_value,
                           "/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord"},
                    Defect{R"("MASK")", R"("mask")", Issue::gltf_value, "/materials/0/alphaMode"},
                    Defect{R"("source": 0)", R"("source": 1)", Issue::gltf_reference, "/textures/0/source"},
                    Defect{R"("sampler": 0})", R"("sampler": 1})", Issue::gltf_reference,
                           "/textures/0/sampler"},
                    Defect{R"([{"bufferView": 9}])", R"([{"bufferView": 11}])", Issue::gltf_reference,
                           "/images/0/bufferView"},
                    Defect{R"(33071)", "33072", Issue::gltf_value, "/samplers/0"}));

INSTANTIATE_TEST_SUITE_P(
    Animations, GltfRejects,
    testing::Values(Defect{R"("sampler": 0, "target")", R"("sampler": 5, "target")", Issue::gltf_reference,
                           "/animations/0/channels/0/sampler"},
                    Defect{R"("node": 2, "path")", R"("node": 3, "path")", Issue::gltf_reference,
                           "/animations/0/channels/0/target/node"},
                    Defect{R"(, "path": "rotation")", "", Issue::gltf_structure,
                           "/animations/0/channels/0/target"},
                    Defect{R"("path": "rotation")", R"("path": "scale")", Issue::gltf_value, "/accessors/8"},
                    Defect{R"("output": 8})", R"("output": 8, "interpolation": "SMOOTH"})", Issue::gltf_value,
                           "/animations/0/samplers/0/interpolation"},
                    Defect{R"("output": 8})", R"("output": 8, "interpolation": "CUBICSPLINE"})",
                           Issue::gltf_data, "/accessors/8"},
                    Defect{R"("input": 7)", R"("input": 0)", Issue::gltf_value, "/accessors/0"},
                    Defect{R"("output": 8})", R"("output": 3})", Issue::gltf_data, "/accessors/3"}));

INSTANTIATE_TEST_SUITE_P(
    Data, GltfRejects,
    testing::Values(
        Defect{R"("byteLength": 448)", R"("byteLength": 18446744073709551616)", Issue::gltf_value,
               "/buffers/0/byteLength"},
        Defect{R"("byteLength": 448)", R"("byteLength": 0)", Issue::gltf_value, "/buffers/0/byteLength"},
        Defect{R"({"byteLength": 448})", R"({"byteLength": 448, "uri": "absent.bin"})", Issue::buffer_missing,
               "/buffers/0/uri"},
        Defect{R"({"byteLength": 448})", R"({"byteLength": 448, "uri": "../absent.bin"})", Issue::uri_outside,
               "/buffers/0/uri"},
        Defect{R"({"byteLength": 448})", R"({"byteLength": 448, "uri": "%zz"})", Issue::uri_malformed,
               "/buffers/0/uri"},
        Defect{R"({"byteLength": 448})", R"({"byteLength": 448, "uri": 4})", Issue::gltf_structure,
               "/buffers/0/uri"},
        Defect{R"({"buffer": 0, "byteOffset": 48,)", R"({"buffer": 1, "byteOffset": 48,)",
               Issue::gltf_reference, "/bufferViews/1/buffer"},
        Defect{R"({"buffer": 0, "byteOffset": 48,)", R"({"byteOffset": 48,)", Issue::gltf_structure,
               "/bufferViews/1"},
        Defect{R"("byteOffset": 336)", R"("byteOffset": 337)", Issue::gltf_bounds, "/bufferViews/10"},
        Defect{R"("byteOffset": 336)", R"("byteOffset": 1e19)", Issue::gltf_value,
               "/bufferViews/10/byteOffset"},
        Defect{R"("byteOffset": 336)", R"("byteOffset": -4)", Issue::gltf_value,
               "/bufferViews/10/byteOffset"},
        Defect{R"("byteStride": 12)", R"("byteStride": 0)", Issue::gltf_value, "/bufferViews/10/byteStride"},
        Defect{R"("byteStride": 12)", R"("byteStride": 253)", Issue::gltf_value,
               "/bufferViews/10/byteStride"},
        Defect{R"("byteStride": 12)", R"("byteStride": 8)", Issue::gltf_value, "/accessors/9"},
        Defect{R"("byteStride": 12)", R"("byteStride": 16)", Issue::gltf_bounds, "/accessors/9"}));

INSTANTIATE_TEST_SUITE_P(
    Accessors, GltfRejects,
    testing::Values(
        Defect{R"({"bufferView": 0, "componentType": 5126)", R"({"bufferView": 0, "componentType": 5124)",
               Issue::gltf_value, "/accessors/0"},
        Defect{R"({"bufferView": 0, "componentType": 5126)", R"({"bufferView": 0, "componentType": -5126)",
               Issue::gltf_value, "/accessors/0/componentType"},
        Defect{R"({"bufferView": 0, "componentType": 5126, )", R"({"bufferView": 0, )", Issue::gltf_structure,
               "/accessors/0"},
        Defect{R"({"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4})",
               R"({"bufferView": 0, "componentType": 5126, "type": "vec3", "count": 4})", Issue::gltf_value,
               "/accessors/0/type"},
        Defect{R"({"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4})",
               R"({"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 0})", Issue::gltf_value,
               "/accessors/0/count"},
        Defect{R"({"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4})",
               R"({"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 5})", Issue::gltf_bounds,
               "/accessors/0"},
        Defect{R"({"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4})",
               R"({"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 9007199254740992})",
               Issue::gltf_bounds, "/accessors/0"},
        Defect{
            R"({"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4})",
            R"({"bufferView": 0, "byteOffset": 4294967284, "componentType": 5126, "type": "VEC3", "count": 4})",
            Issue::gltf_bounds, "/accessors/0"},
        Defect{R"({"bufferView": 1, "componentType": 5126, "type": "VEC2", "count": 4})",
               R"({"bufferView": 1, "componentType": 5126, "type": "VEC2", "count": 3})", Issue::gltf_data,
               "/accessors/1"},
        Defect{R"({"count": 2, "indices")", R"({"count": 10, "indices")", Issue::gltf_value,
               "/accessors/9/sparse/count"},
        Defect{R"({"count": 2, "indices")", R"({"count": 5, "indices")", Issue::gltf_bounds,
               "/accessors/9/sparse/indices"},
        Defect{R"({"count": 2, "indices")", R"({"count": 3, "indices")", Issue::gltf_bounds,
               "/accessors/9/sparse/values"},
        Defect{R"("indices": {"bufferView": 9, "componentType": 5123},)", "", Issue::gltf_structure,
               "/accessors/9/sparse"},
        Defect{R"("indices": {"bufferView": 9, "componentType": 5123})",
               R"("indices": {"bufferView": 9, "componentType": 5126})", Issue::gltf_value,
               "/accessors/9/sparse/indices"},
        Defect{R"("values": {"bufferView": 8})", R"("values": {"bufferView": 99})", Issue::gltf_reference,
               "/accessors/9/sparse/values/bufferView"}));

TEST(GltfReader, acceptsTheDocumentThatTheDefectsComeFrom)
{
    const Imported result = importBytes(glb(kDocument, documentData()));
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_EQ(result.counts.triangles, 2u);
    EXPECT_EQ(result.counts.vertices, 4u);
    EXPECT_EQ(result.counts.joints, 1u);
    EXPECT_EQ(result.counts.animations, 1u);
    EXPECT_EQ(result.counts.materials, 1u);
}

TEST(GltfReader, toleratesIndicesWrittenAsRealNumbers)
{
    const Imported result =
        importBytes(glb(replaced(kDocument, R"("scene": 0)", R"("scene": 0.0)"), documentData()));
    EXPECT_TRUE(result.ok()) << result.message();
}

TEST(GltfReader, refusesEveryShorterGlb)
{
    const std::string whole = glb(kDocument, documentData());
    // every length near the borders between the container's sections, and every 37th between
    for (size_t size = 0; size < whole.size();
         size += size_t{size < 40 || size + 40 > whole.size() ? 1u : 37u})
        EXPECT_FALSE(importBytes(whole.substr(0, size)).ok()) << size;
}

TEST(GltfReader, survivesFlippedBytes)
{
    const std::string whole = glb(kDocument, documentData());
    for (size_t at = 0; at < whole.size(); at += 17)
    {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
        const Imported result = importBytes(damaged);
        EXPECT_TRUE(result.ok() || exitCode(result.status.error()) <= 66) << at;
    }
}

TEST(GltfReader, refusesPositionsThatAreNotFinite)
{
    std::string data = documentData();
    data.replace(0, 4, toBytes<float>({std::numeric_limits<float>::infinity()}));
    const Imported result = importBytes(glb(kDocument, data));
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.error().issue, Issue::gltf_data);
    EXPECT_EQ(result.status.error().where, "/accessors/0");
}

TEST(GltfReader, refusesAnIndexBeyondTheVertices)
{
    for (const uint16_t index : {uint16_t{4}, uint16_t{65535}})
    {
        std::string data = documentData();
        data.replace(160, 2, toBytes<uint16_t>({index}));
        const Imported result = importBytes(glb(kDocument, data));
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.status.error().issue, Issue::index_out_of_range);
        EXPECT_EQ(result.status.error().where, "/accessors/4");
    }
}

TEST(GltfReader, refusesAJointBeyondTheSkinUnlessItsWeightIsZero)
{
    std::string data = documentData();
    data[81] = 9; // second joint of vertex 0, whose weight is 0
    EXPECT_TRUE(importBytes(glb(kDocument, data)).ok());
    data[80] = 9;
    const Imported result = importBytes(glb(kDocument, data));
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.error().issue, Issue::gltf_data);
    EXPECT_EQ(result.status.error().where, "/nodes/0");
}

TEST(GltfReader, asksForNoMemoryThatNoDataStandFor)
{
    GltfData data;
    data.addAccessor(std::nullopt, 5126, "VEC3", 200'000'000);
    const Imported result = data.import(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])");
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.error().issue, Issue::input_too_large);
}

} // namespace

} // namespace hearth::import::test
