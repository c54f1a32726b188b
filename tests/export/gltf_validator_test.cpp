// Checks that Khronos' validator finds no error in GLB files of samples and of models by many exporters.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/export/round_trip.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

namespace hearth::test
{

namespace
{

// of each kind of content; sources that are themselves correct
constexpr const char* kModels[] = {"alpha/sunflower/sunflower.gltf",
                                   "alpha/low_poly_tree/low-poly-tree.glb",
                                   "animation/animation_pointer/24_animation_pointer.gltf",
                                   "animation/assetgen_cubic/Animation_Node_05.gltf",
                                   "animation/interpolation_test/InterpolationTest.gltf",
                                   "animation/milktruck/CesiumMilkTruck.gltf",
                                   "draco/box_draco/Box_Draco.glb",
                                   "draco-skinned/horse_draco_skin/model.gltf",
                                   "emissive-strength/emission_strength/14_emission_strength.gltf",
                                   "extensions/pbr_next_all/sphere.gltf",
                                   "extensions/spec_gloss_box/BoxTextured.gltf",
                                   "game-props/kaykit_axe_2handed/axe_2handed.gltf",
                                   "huge-coords/ecef_node/ecef_node.glb",
                                   "instancing/simple_instancing/simple-instancing.glb",
                                   "lights/light_camera_anim/lightCameraAnimations.gltf",
                                   "lights/lights_pc/Lights.glb",
                                   "meshopt/pirate_meshopt/pirate.glb",
                                   "morph/animated_morph_sphere/AnimatedMorphSphere.glb",
                                   "morph/morphed_cube_cubic/01_cs_morph.gltf",
                                   "morph/multi_prim_morph_sparse/23_multi_prim_vertex_attribute.gltf",
                                   "msft-lod/lod_node_wingnut/lod_node_wingnut.glb",
                                   "multi-scene/camera_test/camera-test.gltf",
                                   "multi-uv/orm_two_uvmaps/12_orm_two_uvmaps.gltf",
                                   "negative-scale/negative_scale_mix/negative_scale_mix.glb",
                                   "pbr-embedded/texture_settings/TextureSettingsTest.glb",
                                   "quantized/fox_quantized/fox_quantized.glb",
                                   "skinned/fox/Fox.glb",
                                   "skinned/pbr_test_joints8/pbrTest.gltf",
                                   "skinned/rigged_figure/RiggedFigure.glb",
                                   "texture-transform/texture_transform_blender/09_texture_transform.gltf",
                                   "tex-webp/box_webp_fallback/box-textured-with-fallback.gltf",
                                   "vertex-color/vertex_color_test/VertexColorTest.gltf"};

/// Write a source as GLB, with coarser levels as well. Returns false and fails if a program does.
/// options  of the cook, beside those of all
bool writeGlb(Sandbox& folder, const std::string& source, const std::string& name,
              const std::vector<std::string>& options)
{
    std::vector<std::string> cook{HEARTH_BIN "/hearth", "cook",       source, "-o",
                                  name + ".hearth",     "--progress", "none", "--no-cache"};
    for (const std::string& option : plainTexels())
        cook.push_back(option);
    cook.insert(cook.end(), options.begin(), options.end());
    for (const auto& command :
         {cook, {HEARTH_BIN "/hearth", "extract", name + ".hearth", "--lods", "-o", name + ".glb"}})
    {
        const ProgramEnd end = folder.run(command);
        EXPECT_EQ(end.exit_code, 0) << source << ": " << end.err;
        if (end.exit_code != 0)
            return false;
    }
    return true;
}

void expectNoErrors(Sandbox& folder, const std::vector<std::string>& sources,
                    const std::vector<std::string>& options = {})
{
    const char* const module = std::getenv("HEARTH_GLTF_VALIDATOR");
    if (module == nullptr)
        GTEST_SKIP()
            << "there is no gltf-validator: ./dev test installs it by npm and sets HEARTH_GLTF_VALIDATOR";
    std::vector<std::string> command{"/usr/bin/env", "node", HEARTH_VALIDATE_GLTF, module};
    for (const std::string& source : sources)
    {
        const std::string name = std::to_string(command.size());
        if (writeGlb(folder, source, name, options))
            command.push_back(name + ".glb");
    }
    const ProgramEnd end = folder.run(command);
    ASSERT_EQ(end.exit_code, 0) << end.err;
    std::istringstream lines(end.out);
    std::string line;
    size_t count = 0;
    for (; std::getline(lines, line); ++count)
        EXPECT_EQ(Json::parse(line).value()["errors"], 0) << sources[count] << ": " << line;
    EXPECT_EQ(count, sources.size());
}

} // namespace

TEST(GltfValidator, findsNoErrorInSamples)
{
    Sandbox folder;
    std::vector<std::string> sources;
    for (const char* kind : {"room", "character", "transforms", "grass", "spheres"})
    {
        sources.push_back(folder / (std::string(kind) + ".source.glb"));
        ASSERT_EQ(folder
                      .run({HEARTH_BIN "/hearth-samples", kind, "--triangles", "3000", "--texture-size", "32",
                            "-o", sources.back()})
                      .exit_code,
                  0);
    }
    expectNoErrors(folder, sources, {"--proxy-from", "clean"}); // of textured and skinned meshes, too
}

TEST(GltfValidator, findsNoErrorInModelsOfManyExporters)
{
    const char* const assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS is not set";
    Sandbox folder;
    std::vector<std::string> sources;
    for (const char* model : kModels)
        sources.push_back(std::string(assets) + "/good/" + model);
    expectNoErrors(folder, sources);
}

} // namespace hearth::test
