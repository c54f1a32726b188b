// Tests the baked start value of light in scenes from the real importer and cookers: a furnace, and a dark
// room.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/grid/face_locations.h"
#include "cook/bricks/light/bake.h"
#include "cook/bricks/light/emission.h"
#include "cook/tools/open_part.h"
#include "formats/gpu_shared/brick_lighting.h"
#include "tests/support/sandbox.h"

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

class BricksBake : public ::testing::Test
{
protected:
    /// Cook the box with a material at voxels of a quarter of a metre.
    void cook(const std::string& material)
    {
        folder_.write("box.obj", kBox);
        folder_.write("box.mtl", "newmtl wall\n" + material);
        const auto step = [&](const char* program, std::vector<std::string> arguments)
        {
            arguments.insert(arguments.begin(), std::string(HEARTH_BIN "/") + program);
            const test::ProgramEnd end = folder_.run(arguments);
            ASSERT_EQ(end.exit_code, 0) << program << ": " << end.err;
        };
        step("hearth-import", {"box.obj", "-o", "import.part"});
        step("hearth-clusters", {"import.part", "-o", "clusters.part"});
        step("hearth-textures", {"import.part", "-o", "textures.part"});
        const auto open = [&](const char* part) { return tools::openPart(folder_ / part).value(); };
        sources_.clear();
        sources_.push_back({open("import.part"), open("clusters.part"), open("textures.part")});
        scene_.emplace(collectStaticScene(sources_).value());
        GridSettings settings;
        settings.voxel_size = 0.25;
        settings.seeds = {{0, 1, 0}};
        grid_.emplace(cookGrid(*scene_, settings).value());
        EXPECT_TRUE(traceEmission(*scene_, *grid_).ok());
    }

    std::vector<uint32_t> baked(uint32_t bounces)
    {
        EXPECT_TRUE(bakeLight(*scene_, {.bounces = bounces, .rays = 16}, *grid_).ok());
        return grid_->tables.lighting;
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

TEST_F(BricksBake, addsUpInAFurnaceBounceByBounce)
{
    cook("Kd 0.5 0.5 0.5\nKe 0.3 0.3 0.3\n");
    for (const uint32_t bounces : {0u, 1u, 3u, 24u})
    {
        const std::vector<uint32_t> codes = baked(bounces);
        forEachInner(
            [&](size_t face)
            {
                const float albedo = shared::decodeAlbedo(grid_->tables.albedo[face]).x;
                const float emission = shared::decodeRadiance(grid_->tables.emission[face]).x;
                ASSERT_NEAR(emission, 0.3f, 0.02f);
                float expected = emission, power = 1;
                for (uint32_t i = 0; i <= bounces; ++i)
                    expected += emission * (power *= albedo);
                EXPECT_NEAR(shared::decodeRadiance(codes[face]).x, expected, 0.02f * expected) << bounces;
            });
    }
}

/// Since the scene has no lights, there is a default sun outside, and a sky.
TEST_F(BricksBake, leavesASealedRoomExactlyDark)
{
    cook("Kd 0.8 0.8 0.8\n");
    const std::vector<uint32_t> codes = baked(3);
    forEachInner([&](size_t face) { EXPECT_EQ(codes[face], 0u); });
    EXPECT_GT(*std::ranges::max_element(codes), 0u) << "the sun is out";
}

TEST_F(BricksBake, isTheSameForAnyNumberOfThreads)
{
    cook("Kd 0.8 0.6 0.4\nKe 0.1 0.2 0.3\n");
    const std::vector<uint32_t> many = baked(2);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(baked(2), many);
}

} // namespace
} // namespace hearth::bricks
