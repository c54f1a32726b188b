// Tests that a bake reads the triangles, UVs, materials and lights of a source.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/scene/receiver_scene.h"

#include "cook/bricks/light/scene_light.h"
#include "cook/receivers/bake/bake.h"
#include "sample_assets/shapes/glb_writer.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "tests/cook/bricks/source_parts.h"

#include <gtest/gtest.h>

namespace hearth::receivers
{
namespace
{

using namespace samples;

/// Floor of 4 x 4 m at y = 0 that faces up, once over UV.
TriangleMesh makeFloorMesh()
{
    TriangleMesh floor = makeGrid(8, 8,
                                  [](Float2 uv, Float3& position, Float2& texture_uv)
                                  {
                                      position = {4 * uv.x - 2, 0, 2 - 4 * uv.y};
                                      texture_uv = uv;
                                  });
    setFlatNormals(floor);
    return floor;
}

class ReceiverSceneTest : public ::testing::Test
{
protected:
    void SetUp() override
    {
        Document document;
        const int red = addPlainMaterial(document, "red", {0.8f, 0.1f, 0.1f});
        const int lamp = addEmissiveMaterial(document, "lamp", {1, 0.5f, 0.25f}, 4);
        addObject(document, "floor", {{makeFloorMesh(), red}});
        document.nodes.back().placement.scale = {-1, 1, 1};
        addObject(document, "panel", {{makeBox({0, 2, 0}, {0.5f, 0.1f, 0.5f}, 1), lamp}});
        samples::Light bulb;
        bulb.name = "bulb";
        bulb.intensity = 30;
        addLight(document, bulb, {0.5f, 1.5f, 0.25f}, {0, 0, 0, 1});
        ASSERT_TRUE(writeFile(folder_ / "room.glb", encodeGlb(document)).ok());
        sources_.push_back(bricks::makeSourceParts(folder_, "room.glb"));
        static_scene_ = bricks::collectStaticScene(sources_).value();
        scene_ = makeReceiverScene(static_scene_).value();
    }

    test::Sandbox folder_;
    std::vector<bricks::SourceParts> sources_;
    bricks::StaticScene static_scene_;
    ReceiverScene scene_;
};

} // namespace

TEST_F(ReceiverSceneTest, hasTheTrianglesLightsAndUvs)
{
    ASSERT_EQ(scene_.bake.instance_count, 2u);
    ASSERT_EQ(scene_.bake.triangles.size(), 128u + 12);
    float floor_area = 0, panel_flux = 0;
    for (const Triangle& triangle : scene_.bake.triangles)
    {
        ASSERT_GT(dot(triangle.normals[0], crossEdges(triangle)), 0);
        const bool is_floor = triangle.instance == 0;
        floor_area += is_floor ? length(crossEdges(triangle)) / 2 : 0;
        if (is_floor)
        {
            ASSERT_GT(triangle.normals[0].y, 0.99f);
            ASSERT_GT(triangle.albedo.x, 3 * triangle.albedo.y);
        }
    }
    EXPECT_NEAR(floor_area, 16, 1e-3f);
    ASSERT_EQ(scene_.bake.mesh_lights.size(), 1u);
    EXPECT_EQ(scene_.mesh_light_instances, (std::vector<uint32_t>{1}));
    const MeshLight& panel = scene_.bake.mesh_lights[0];
    const shared::SceneLighting lighting = bricks::makeSceneLighting(static_scene_);
    for (size_t i = 0; i < panel.triangles.size(); ++i)
        panel_flux += panel.radiance[i].x * length(crossEdges(scene_.bake.triangles[panel.triangles[i]])) / 2;
    EXPECT_NEAR(panel_flux, 4 * lighting.exposure * (2 * 1 + 4 * 0.2f), 1e-3f);
    EXPECT_EQ(scene_.uv_sets[0], 0u);
}

TEST_F(ReceiverSceneTest, isBakedWithTheLightThatIsDrawn)
{
    const BakedReceivers baked = bakeReceivers(scene_.bake, {.texels_per_metre = 16, .bounces = 0}).value();
    EXPECT_EQ(baked.rectangles[0].size, (RectangleSize{64, 64}));
    const shared::Light& bulb = scene_.bake.lamps.at(0).light;
    size_t lit = 0;
    for (size_t i = 0; i < baked.texels.size(); ++i)
    {
        const BakedTexel& texel = baked.texels[i];
        if (texel.is_copy || texel.instance != 0)
            continue;
        const Float3 offset = Float3{0.5f, 1.5f, 0.25f} - texel.position;
        const float expected = bulb.intensity.x * offset.y / std::pow(length(offset), 3.0f);
        ASSERT_NEAR(baked.light(i)[0].x, expected, 0.005f * expected);
        ++lit;
    }
    EXPECT_EQ(lit, 64u * 64);
}

} // namespace hearth::receivers
