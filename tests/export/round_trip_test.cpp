// Tests that a pack that was written as glTF and cooked again is the same scene: triangles, texels,
// materials, lights, cameras, skins, clips. Runs the real hearth with all its cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/export/round_trip.h"

#include "tests/export/compare_packs.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace hearth::test
{

namespace
{

void expectNone(const char* what, const Differences& differences)
{
    constexpr size_t kMaxPrinted = 10;
    for (size_t i = 0; i < std::min(differences.size(), kMaxPrinted); ++i)
        ADD_FAILURE() << what << ": " << differences[i];
}

void expectSameScene(const RoundTrip& trip, uint32_t max_texel_step)
{
    ASSERT_EQ(trip.fault(), "");
    expectNone("triangles", compareTriangles(trip.first(), trip.second()));
    expectNone("instances", compareInstances(trip.first(), trip.second()));
    expectNone("materials", compareMaterials(trip.first(), trip.second()));
    expectNone("texels", compareTexels(trip.first(), trip.second(), max_texel_step));
    expectNone("scene", compareScenes(trip.first(), trip.second()));
    expectNone("clips", compareClips(trip.first(), trip.second()));
}

class SampleRoundTrip : public ::testing::TestWithParam<const char*>
{
};

TEST_P(SampleRoundTrip, keepsTheScene)
{
    Sandbox folder;
    ASSERT_EQ(folder
                  .run({HEARTH_BIN "/hearth-samples", GetParam(), "--triangles", "3000", "--texture-size",
                        "32", "-o", "sample.glb"})
                  .exit_code,
              0);
    expectSameScene(RoundTrip(folder / "sample.glb", plainTexels()), 0);
}

INSTANTIATE_TEST_SUITE_P(All, SampleRoundTrip,
                         ::testing::Values("room", "character", "transforms", "grass", "spheres"));

class LossyRoundTrip : public ::testing::TestWithParam<const char*>
{
};

TEST_P(LossyRoundTrip, keepsTexelsWithinTwiceTheStoredError)
{
    Sandbox folder;
    ASSERT_EQ(folder
                  .run({HEARTH_BIN "/hearth-samples", "rock", "--triangles", "3000", "--texture-size", "128",
                        "-o", "sample.glb"})
                  .exit_code,
              0);
    const RoundTrip plain(folder / "sample.glb", plainTexels());
    const RoundTrip lossy(folder / "sample.glb", makeOptions(std::string("\"") + GetParam() + "\""),
                          plainTexels());
    ASSERT_EQ(plain.fault() + lossy.fault(), "");
    expectNone("texels", compareLoss(plain.first(), lossy.first(), lossy.second()));
    expectNone("triangles", compareTriangles(plain.first(), lossy.second()));
}

INSTANTIATE_TEST_SUITE_P(Families, LossyRoundTrip, ::testing::Values("astc", "etc2", "bc"));

class ModelRoundTrip : public ::testing::TestWithParam<const char*>
{
};

TEST_P(ModelRoundTrip, keepsTheScene)
{
    const char* const assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS is not set";
    expectSameScene(RoundTrip(std::string(assets) + "/good/" + GetParam(), plainTexels()), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Good, ModelRoundTrip,
    ::testing::Values("animation/milktruck/CesiumMilkTruck.gltf",
                      "animation/assetgen_cubic/Animation_Node_05.gltf",
                      "animation/interpolation_test/InterpolationTest.gltf", "skinned/fox/Fox.glb",
                      "skinned/pbr_test_joints8/pbrTest.gltf", "skinned/hand_left/left.glb",
                      "morph/animated_morph_sphere/AnimatedMorphSphere.glb",
                      "morph/morphed_cube_cubic/01_cs_morph.gltf",
                      "lights/light_camera_anim/lightCameraAnimations.gltf", "lights/lights_pc/Lights.glb",
                      "extensions/pbr_next_all/sphere.gltf",
                      "texture-transform/texture_transform_blender/09_texture_transform.gltf",
                      "pbr-embedded/texture_settings/TextureSettingsTest.glb",
                      "emissive-strength/emission_strength/14_emission_strength.gltf",
                      "instancing/simple_instancing/simple-instancing.glb",
                      "negative-scale/negative_scale_mix/negative_scale_mix.glb",
                      "vertex-color/vertex_color_test/VertexColorTest.gltf",
                      "multi-uv/orm_two_uvmaps/12_orm_two_uvmaps.gltf"));

} // namespace

} // namespace hearth::test
