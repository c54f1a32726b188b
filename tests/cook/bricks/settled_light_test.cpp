// Tests the light that faces settle at, in scenes from the real importer and cookers: a furnace, a dark room,
// and beside the runtime's sweeps.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/grid/face_locations.h"
#include "cook/bricks/light/emission.h"
#include "cook/bricks/light/scene_light.h"
#include "cook/bricks/light/settled_light.h"
#include "formats/gpu_shared/brick_lighting.h"
#include "tests/cook/bricks/lit_bricks.h"
#include "tests/cook/bricks/source_parts.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace hearth::bricks
{
namespace
{

/// Box whose front faces point inwards, from -1 to 1; y from 0 to 2.
constexpr const char* kBox = "mtllib box.mtl\nusemtl wall\n"
                             "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"
                             "v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
                             "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n";

class SettledLightTest : public ::testing::Test
{
protected:
    /// Cook the box with a material at voxels of a quarter of a metre.
    void cook(const std::string& material)
    {
        folder_.write("box.obj", kBox);
        folder_.write("box.mtl", "newmtl wall\n" + material);
        sources_.clear();
        sources_.push_back(makeSourceParts(folder_, "box.obj"));
        scene_.emplace(collectStaticScene(sources_).value());
        GridSettings settings;
        settings.voxel_size = 0.25;
        settings.seeds = {{0, 1, 0}};
        grid_.emplace(cookGrid(*scene_, settings).value());
        EXPECT_TRUE(traceEmission(*scene_, *grid_).ok());
    }

    std::vector<uint32_t> settled() const
    {
        return settleLight(makeBrickView(grid_->tables), makeSceneLighting(*scene_)).codes;
    }

    /// Faces whose centres lie in the room.
    template <typename Visit>
    void forEachInner(const Visit& visit) const
    {
        const std::vector<FaceLocation> places = faceLocations(grid_->tables.masks());
        size_t count = 0;
        for (size_t face = 0; face < places.size(); ++face)
        {
            const auto [x, y, z, side] = places[face];
            const Float3 middle = shared::brickFaceMiddle(x, y, z, side) * grid_->tables.grid.voxel_size +
                                  grid_->tables.grid.origin;
            if (std::abs(middle.x) > 1 || std::abs(middle.y - 1) > 1 || std::abs(middle.z) > 1)
                continue;
            visit(face);
            ++count;
        }
        EXPECT_GT(count, 100u);
    }

    test::Sandbox folder_;
    std::vector<SourceParts> sources_;
    std::optional<StaticScene> scene_;
    std::optional<CookedGrid> grid_;
};

/// An enclosure that shines evenly has the radiance emission / (1 - albedo) everywhere.
TEST_F(SettledLightTest, isThatOfAFurnace)
{
    cook("Kd 0.5 0.5 0.5\nKe 0.3 0.3 0.3\n");
    const std::vector<uint32_t> codes = settled();
    forEachInner(
        [&](size_t face)
        {
            const float albedo = shared::decodeAlbedo(grid_->tables.albedo[face]).x;
            const float emission = shared::decodeRadiance(grid_->tables.emission[face]).x;
            ASSERT_NEAR(emission, 0.3f, 0.02f);
            EXPECT_NEAR(shared::decodeRadiance(codes[face]).x, emission / (1 - albedo),
                        0.02f * emission / (1 - albedo));
        });
}

/// The runtime's sweeps start from the settled light and leave it as it is; from darkness they come to it.
TEST_F(SettledLightTest, isWhatSweepsOfTheRuntimeComeTo)
{
    cook("Kd 0.8 0.6 0.4\nKe 0.1 0.2 0.3\n");
    const shared::SceneLighting lighting = makeSceneLighting(*scene_);
    const std::vector<uint32_t> codes = settled();
    FaceLighting from_darkness(makeBrickView(grid_->tables));
    from_darkness.sweep(lighting, 16, 60);
    grid_->tables.lighting = codes;
    FaceLighting from_settled(makeBrickView(grid_->tables));
    from_settled.sweep(lighting, 16, 1);
    for (size_t face = 0; face < codes.size(); ++face)
    {
        const Float3 settled = shared::decodeRadiance(codes[face]);
        // codes are a 64th apart, of blue a 32nd
        expectRelative(shared::decodeBrickLight(from_darkness.faces()[face]), settled, 0.017f);
        expectRelative(shared::decodeBrickLight(from_settled.faces()[face]), settled, 0.017f);
    }
}

/// Since the scene has no lights, there is a default sun outside, and a sky.
TEST_F(SettledLightTest, leavesASealedRoomExactlyDark)
{
    cook("Kd 0.8 0.8 0.8\n");
    const std::vector<uint32_t> codes = settled();
    forEachInner([&](size_t face) { EXPECT_EQ(codes[face], 0u); });
    EXPECT_GT(*std::ranges::max_element(codes), 0u) << "the sun is out";
}

/// Lamps apart: light is linear, so each has what the grid has under it alone, and all sum to all.
TEST_F(SettledLightTest, ofLampsApartIsThatOfEachAlone)
{
    cook("Kd 0.8 0.6 0.4\nKe 0.1 0.2 0.3\n");
    shared::SceneLighting lighting = makeSceneLighting(*scene_);
    lighting.lights.clear();
    for (int i = 0; i < 9; ++i) // more than are swept at once
        addLamp(lighting, {-0.6f + 0.15f * static_cast<float>(i), 0.9f, 0.2f},
                {1.0f + static_cast<float>(i), 2, 0.5f});
    const BrickView view = makeBrickView(grid_->tables);
    LampSources sources{.count = 4, .lamps_of_lights = {1, 2, 2, 1, 1, 2, 1, 1, 2}, .emissions = {}};
    for (uint32_t face = 0; face < view.emission.size(); ++face)
        sources.emissions.push_back({face, 3, {0.25f, 0.5f, 1}});
    const std::vector<Float3> lamps = settleLamps(view, lighting, sources);

    const auto settleAlone = [&](uint32_t lamp)
    {
        shared::SceneLighting alone = lighting;
        alone.sky = lamp == 0 ? lighting.sky : shared::Sky{};
        std::vector<uint32_t> emission(view.emission.size());
        const Float3 share = lamp == 0   ? Float3{0.75f, 0.5f, 0}
                             : lamp == 3 ? Float3{0.25f, 0.5f, 1}
                                         : Float3{};
        for (size_t face = 0; face < emission.size(); ++face)
            emission[face] = shared::encodeRadiance(shared::decodeRadiance(view.emission[face]) * share);
        for (size_t i = 0; i < alone.lights.size(); ++i)
            if (sources.lamps_of_lights[i] != lamp)
                alone.lights[i].intensity = {};
        BrickView own = view;
        own.emission = emission;
        return settleLight(own, alone).codes;
    };
    const std::vector<uint32_t> all = settleLight(view, lighting).codes;
    std::vector<Float3> sums(all.size());
    for (uint32_t lamp = 0; lamp < sources.count; ++lamp)
    {
        const std::vector<uint32_t> alone = settleAlone(lamp);
        float brightest = 0;
        for (size_t face = 0; face < all.size(); ++face)
        {
            const Float3 light = lamps[face * sources.count + lamp];
            brightest = std::max(brightest, largest(light));
            sums[face] += light;
            // codes of the light and of the emission are a 64th apart, of blue a 32nd
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(light[c], shared::decodeRadiance(alone[face])[c], 0.035f * light[c] + 1e-4f)
                    << "lamp " << lamp << ", face " << face;
        }
        EXPECT_GT(brightest, 0.05f) << lamp;
    }
    for (size_t face = 0; face < all.size(); ++face)
        expectRelative(sums[face], shared::decodeRadiance(all[face]), 0.02f);
}

TEST_F(SettledLightTest, isTheSameForAnyNumberOfThreads)
{
    cook("Kd 0.8 0.6 0.4\nKe 0.1 0.2 0.3\n");
    const std::vector<uint32_t> many = settled();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(settled(), many);
}

} // namespace
} // namespace hearth::bricks
