// Tests the lists of material tiles against slow and simple code, and the image against one drawn without
// lists.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/material_tiles.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <set>

namespace hearth::test
{

namespace
{

using namespace shared;
using gpu::ShadedArea;

/// Content of the pass's buffers.
struct TileTwin
{
    std::vector<uint32_t> tile_materials;
    std::vector<std::array<uint32_t, 4>> draws; ///< TileDraw
    std::vector<uint32_t> lists;                ///< from kFirstTileEntry on
    uint32_t crowded_tiles = 0;                 ///< tiles with more materials than a row holds
    uint32_t whole_image_draws = 0; ///< materials that are shaded full-screen because of such tiles
};

/// Materials of each tile; 0 is the sky.
std::vector<std::set<uint32_t>> materialsOfTiles(const Image& image, const std::vector<ClusterDraw>& draws)
{
    const uint32_t row = materialTiles(image.width);
    std::vector<std::set<uint32_t>> materials(size_t{row} * materialTiles(image.height));
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x)
        {
            const uint32_t id = image.visibility[size_t{y} * image.width + x];
            materials[size_t{y / kMaterialTilePixels} * row + x / kMaterialTilePixels].insert(
                id == kVisibilitySky ? 0 : draws[image.list.slots.at(id >> kTriangleBits).cluster].material);
        }
    return materials;
}

TileTwin makeTileTwin(const Image& image, const gpu::SceneLayout& layout)
{
    TileTwin twin;
    const auto materials_of_tiles = materialsOfTiles(image, layout.draws);
    const uint32_t row = materialTiles(image.width);
    std::vector<std::vector<uint32_t>> tiles_of_material(layout.material_rows + 1);
    std::set<uint32_t> whole_image;
    for (uint32_t tile = 0; tile < materials_of_tiles.size(); ++tile)
    {
        uint32_t listed = 0;
        for (const uint32_t material : materials_of_tiles[tile])
            if (listed++ < kMaterialsPerTile)
            {
                twin.tile_materials.push_back(material);
                tiles_of_material[material].push_back((tile % row) | (tile / row) << 16);
            }
            else
                whole_image.insert(material);
        twin.tile_materials.resize((size_t{tile} + 1) * kMaterialsPerTile, kNoTileMaterial);
        twin.crowded_tiles += listed > kMaterialsPerTile ? 1 : 0;
    }
    for (uint32_t material = 0; material < tiles_of_material.size(); ++material)
    {
        if (whole_image.contains(material))
        {
            twin.draws.push_back({3, 1, 0, 0});
            continue;
        }
        const auto& tiles = tiles_of_material[material];
        const auto first = static_cast<uint32_t>(kFirstTileEntry + twin.lists.size());
        twin.draws.push_back({kTileVertices, static_cast<uint32_t>(tiles.size()), kTileVertices * first, 0});
        twin.lists.insert(twin.lists.end(), tiles.begin(), tiles.end());
    }
    twin.whole_image_draws = static_cast<uint32_t>(whole_image.size());
    return twin;
}

formats::MaterialRecord colored(std::mt19937& random)
{
    formats::MaterialRecord material = plainMaterial();
    material.flags = formats::kMaterialUnlit; // fast to draw: the test checks positions, not shading
    material.base_color = {uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1), 1};
    return material;
}

/// Fill with 12 x 12 small squares in front of rocks, each with a material of its own. `spare` unused
/// materials lie between those of the squares.
void fillColors(TestScene& scene, std::mt19937& random, uint32_t spare = 0)
{
    for (int i = 0; i < 144; ++i)
    {
        for (uint32_t j = 0; i == 72 && j < spare; ++j)
            scene.addMaterial(colored(random));
        const uint32_t square =
            scene.addMesh(withMaterial(makeQuad(0.3f, 0.3f), scene.addMaterial(colored(random))));
        scene.addInstance(square,
                          translated({0.35f * static_cast<float>(i % 12) - 1.9f,
                                      0.35f * static_cast<float>(i / 12) - 1.9f, uniform(random, 0, 1)}));
    }
    for (int i = 0; i < 6; ++i)
    {
        const uint32_t rock =
            scene.addMesh(withMaterial(shapes::rock(8, 0.2f), scene.addMaterial(colored(random))));
        scene.addInstance(rock, translated({uniform(random, -3, 3), uniform(random, -3, 3), -3}));
    }
}

Camera lookingFrom(float distance)
{
    return {.position = {0.1f * distance, 0.2f * distance, distance}, .target = {0, 0, 0}, .z_near = 0.05f};
}

class MaterialTilesTest : public GpuTest
{
protected:
    void expectTwin(const gpu::Scene& scene, const gpu::SceneLayout& layout, const Camera& camera,
                    DrawOptions options)
    {
        options.area = ShadedArea::tiles;
        gpu::FrameTargets targets = makeTargets(options.width, options.height);
        const Image image = draw(scene, targets, camera, options);
        const TileTwin twin = makeTileTwin(image, layout);
        EXPECT_EQ(read<uint32_t>(targets.tileMaterials(), twin.tile_materials.size()), twin.tile_materials);
        EXPECT_EQ((read<std::array<uint32_t, 4>>(scene.frame().tile_draws, twin.draws.size())), twin.draws);
        std::vector<uint32_t> lists =
            read<uint32_t>(targets.tileLists(), kFirstTileEntry + twin.lists.size());
        lists.erase(lists.begin(), lists.begin() + kFirstTileEntry);
        EXPECT_EQ(lists, twin.lists);
        crowded_ += twin.crowded_tiles;
        whole_image_ += twin.whole_image_draws;
        listed_ += twin.lists.size();

        options.area = ShadedArea::wholeFrame;
        const Image whole = draw(scene, camera, options);
        EXPECT_EQ(image.visibility, whole.visibility);
        EXPECT_EQ(image.color, whole.color) << options.width << "x" << options.height;
    }

    size_t crowded_ = 0, whole_image_ = 0, listed_ = 0;
};

} // namespace

TEST_F(MaterialTilesTest, equalTheirTwinAndDrawTheSameImage)
{
    std::mt19937 random(31);
    TestScene test;
    fillColors(test, random);
    const formats::PackView pack = test.build();
    const auto layout = gpu::makeSceneLayout(pack);
    ASSERT_TRUE(layout.ok());
    const auto scene = upload(pack);
    for (const auto& [width, height] : {std::pair{1u, 1u}, {63u, 65u}, {64u, 64u}, {333u, 777u}})
        for (const float distance : {1.5f, 5.0f, 64.0f})
            for (const uint32_t flags : {kCullEverything, kCullEverything & ~kCullOcclusion})
                expectTwin(*scene, *layout, lookingFrom(distance),
                           {.width = width, .height = height, .flags = flags});
    EXPECT_GT(listed_, 1000u);
    EXPECT_GT(crowded_, 0u) << "a tile of more materials than its row holds is not tested";
    EXPECT_GT(whole_image_, 0u);
}

TEST_F(MaterialTilesTest, everyMaterialOfAVeryLargeSceneIsFound)
{
    // counts on both sides of the limit where the pass starts its second round
    std::mt19937 random(41);
    TestScene test;
    fillColors(test, random, kTileRoundMaterials);
    const formats::PackView pack = test.build();
    const auto layout = gpu::makeSceneLayout(pack);
    ASSERT_TRUE(layout.ok());
    ASSERT_GT(layout->material_rows, kTileRoundMaterials);
    const auto scene = upload(pack);
    expectTwin(*scene, *layout, lookingFrom(5), {.width = 320, .height = 240});
    EXPECT_GT(listed_, 144u);
}

TEST_F(MaterialTilesTest, debugViewsAreTheSameToo)
{
    std::mt19937 random(51);
    TestScene test;
    fillColors(test, random);
    const formats::PackView pack = test.build();
    const auto layout = gpu::makeSceneLayout(pack);
    ASSERT_TRUE(layout.ok());
    const auto scene = upload(pack);
    for (const uint32_t debug_view : {kViewClusters, kViewNormals})
        expectTwin(*scene, *layout, lookingFrom(5), {.debug_view = debug_view});
}

TEST_F(MaterialTilesTest, areMadeWhereThereAreManyMaterials)
{
    const auto shadesTiles = [&](uint32_t rows)
    {
        TestScene test;
        for (uint32_t i = 1; i < rows; ++i) // the last row is the default material
            test.addMaterial(plainMaterial());
        test.addInstance(test.addMesh(makeQuad(1, 1)), Affine3{});
        const formats::PackView pack = test.build();
        return gpu::shadesTiles(*upload(pack), ShadedArea::automatic);
    };
    EXPECT_FALSE(shadesTiles(gpu::kWholeFrameMaterials));
    EXPECT_TRUE(shadesTiles(gpu::kWholeFrameMaterials + 1));
}

} // namespace hearth::test
