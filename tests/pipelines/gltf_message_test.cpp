// Tests messages about glTF files: warnings of what a file contradicts, limits with their numbers, and hints
// that lead somewhere.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/pipelines/gltf_fixture.h"

#include <gmock/gmock.h>

namespace hearth::import::test
{

namespace
{

using testing::HasSubstr;

const std::string kSquareMesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";

GltfData makeSquare(const std::vector<float>& positions = kSquare)
{
    GltfData data;
    data.add("VEC3", positions);
    data.add("SCALAR", kSquareIndices);
    return data;
}

/// Import the square with another length of its buffer, which has 60 bytes.
Imported importWithLength(const std::string& length, const std::string& binary, const std::string& rest = "")
{
    const GltfData data = makeSquare();
    return importBytes(glb(replaced(data.json(kSquareMesh + rest), R"([{"byteLength":60}])",
                                    R"([{"byteLength":)" + length + "}]"),
                           binary));
}

TEST(GltfBuffers, mayBePadded)
{
    // the chunk of a GLB may be longer than its buffer by up to three bytes
    const std::string binary = makeSquare().binary();
    EXPECT_TRUE(importWithLength("60", binary).warnings.empty());
    EXPECT_TRUE(importWithLength("60", binary + "abc").warnings.empty());
}

TEST(GltfBuffers, warnOfAShortBufferThatNothingUses)
{
    const Imported result =
        importBytes(glb(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":100}]})", "abcd"));
    ASSERT_TRUE(result.ok()) << result.message();
    EXPECT_TRUE(result.hasWarning(Issue::inconsistent,
                                  "byteLength is 100, but there are 4 bytes; nothing uses the buffer"));
}

TEST(GltfBuffers, areRefusedIfTheyAreShort)
{
    const Imported result = importWithLength("60", makeSquare().binary().substr(0, 56));
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.error().issue, Issue::buffer_short);
    EXPECT_EQ(result.status.error().where, "/buffers/0");
    EXPECT_EQ(result.status.error().detail, "byteLength is 60, but there are 56 bytes");
}

TEST(GltfReader, warnsOfAFileWithoutATriangle)
{
    const std::string points = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":0}]}])";
    for (const std::string& rest : {points, std::string(R"("nodes":[{"name":"empty"}])")})
    {
        const Imported result = makeSquare().import(rest);
        ASSERT_TRUE(result.ok()) << result.message();
        EXPECT_TRUE(result.hasWarning(Issue::nothing_drawn, "no mesh has a triangle")) << rest;
    }
    EXPECT_FALSE(makeSquare().import(kSquareMesh).hasWarning(Issue::nothing_drawn, ""));
}

/// Return the message of a document that is refused.
std::string refusal(const GltfData& data, const std::string& rest, const ImportOptions& options = {})
{
    const Imported result = data.import(rest, nullptr, options);
    EXPECT_FALSE(result.ok()) << rest;
    return result.message();
}

TEST(GltfLimits, ofPositionsAreNamedWithAValueAndARemedy)
{
    std::vector<float> positions = kSquare;
    positions[3] = 2e9f;
    EXPECT_THAT(
        refusal(makeSquare(positions), kSquareMesh),
        HasSubstr("|/accessors/0: error: position 1 is (2e+09, 0, 0), coordinates go up to 1e+09 "
                  "[E1116] hint: use smaller numbers: a larger unit, or a model nearer to its origin"));
    positions[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal(makeSquare(positions), kSquareMesh),
                HasSubstr("|/accessors/0: error: position 1 is (nan, 0, 0), which is not finite [E1108]"));
}

TEST(GltfLimits, ofMorphTargetsAreNamedWithAValue)
{
    GltfData data = makeSquare();
    data.add("VEC3", std::vector<float>{0, 0, 0, 0, -3e9f, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_THAT(refusal(data, R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,)"
                              R"("targets":[{"POSITION":2}]}]}])"),
                HasSubstr("POSITION of vertex 1 is (0, -3e+09, 0), coordinates go up to 1e+09 [E1116]"));
}

TEST(GltfLimits, ofTransformsAreNamedWithAValue)
{
    EXPECT_THAT(refusal(makeSquare(), kSquareMesh + R"(,"nodes":[{"mesh":0,"scale":[1e300,1,1]}])"),
                HasSubstr("1e+300 is too large: 32-bit numbers go up to 3.40282e+38 [E1116]"));
    EXPECT_THAT(refusal(makeSquare(), kSquareMesh + R"(,"nodes":[{"scale":[1e30,1,1],"children":[1]},)"
                                                    R"({"mesh":0,"scale":[1e30,1,1]}])"),
                HasSubstr("/nodes/1: error: its transform has the number 1e+60, at most 3.40282e+38 fits"));
}

TEST(GltfLimits, ofCountsAreNamed)
{
    ImportOptions few_vertices, few_triangles, few_instances;
    few_vertices.limits.max_vertices = 3;
    few_triangles.limits.max_triangles = 1;
    few_instances.limits.max_instances = 3;
    EXPECT_THAT(refusal(makeSquare(), kSquareMesh, few_vertices),
                HasSubstr("4 vertices, at most 3 are read"));
    EXPECT_THAT(refusal(makeSquare(), kSquareMesh, few_triangles),
                HasSubstr("2 triangles, at most 1 are read"));
    EXPECT_THAT(refusal(makeSquare(),
                        kSquareMesh + R"(,"nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":)"
                                      R"({"attributes":{"TRANSLATION":0}}}}])",
                        few_instances),
                HasSubstr("4 instances, at most 3 are read"));
    GltfData zeros;
    zeros.addAccessor(std::nullopt, 5126, "VEC3", 200'000'000);
    EXPECT_THAT(refusal(zeros, R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"),
                HasSubstr("200000000 elements of 12 bytes without data, at most 134217728 bytes"));
}

TEST(GltfHints, leadToTheValidatorOnlyWhereItWouldFindSomething)
{
    const std::string node = kSquareMesh + R"(,"nodes":[{"mesh":0,)";
    // none of these is in the specification of glTF or of an extension that the validator checks
    const std::string unchecked[] = {
        node + R"("extras":{"hearth_shadow_radius":-1}}])",
        node + R"("extras":{"hearth_shadow_radius":"large"}}])",
        node + R"("extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":9}}}}])",
        node + R"("extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1}}}}])",
        kSquareMesh + R"(,"images":[{"uri":"a.ktx2"}],)"
                      R"("textures":[{"extensions":{"KHR_texture_basisu":{"source":3}}}])",
    };
    for (const std::string& rest : unchecked)
    {
        const std::string message = refusal(makeSquare(), rest);
        EXPECT_THAT(message, HasSubstr("[E1117] hint: correct the property")) << rest;
    }
    EXPECT_THAT(refusal(makeSquare(), node + R"("camera":3}])"), HasSubstr("Khronos glTF validator"));
    EXPECT_THAT(refusal(makeSquare(), node + R"("extensions":{"KHR_lights_punctual":{"light":3}}}])"),
                HasSubstr("Khronos glTF validator"));
}

} // namespace

} // namespace hearth::import::test
