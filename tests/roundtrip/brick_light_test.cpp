// Tests the global illumination from bricks of a cooked scene against path tracing of its geometry.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/light_error.h"
#include "tests/roundtrip/cooked_sample.h"

#include <gtest/gtest.h>

namespace hearth::roundtrip
{
namespace
{

using namespace reference;

struct LitRoom
{
    const char* sample;
    const char* voxel_size; ///< metres
    double most;            ///< limit of the error of all light over its mean
};

std::ostream& operator<<(std::ostream& out, const LitRoom& room)
{
    return out << room.sample << " at " << room.voxel_size << " m";
}

class BrickLightError : public ::testing::TestWithParam<LitRoom>
{
};

TEST_P(BrickLightError, isNoMoreThanWasMeasured)
{
    constexpr uint32_t kPoints = 1000, kPaths = 1024, kFaceRays = 16, kGatherRays = 1024;
    const ScratchFolder folder;
    const std::string source = folder.path("sample.glb"), file = folder.path("sample.hearth");
    ASSERT_EQ(
        runProgram(Program::samples, {GetParam().sample, "--texture-size", "64", "-o", source}).exit_code, 0);
    const ProgramEnd end = runProgram(Program::hearth, {"cook", source, "-q", "--no-cache", "--bricks",
                                                        "--voxel-size", GetParam().voxel_size, "-o", file});
    ASSERT_EQ(end.exit_code, 0) << end.errors;
    auto opened = pack::Pack::open(file);
    ASSERT_TRUE(opened.ok());
    const formats::PackView& view = opened->view();
    const auto geometry = PackGeometry::decode(view);
    const auto textures = TextureSet::load(view);
    ASSERT_TRUE(geometry.ok() && textures.ok());
    const ShadedScene scene(*geometry, *textures, nullptr);

    const std::vector<LitPoint> points = litPoints(scene, seenPoints(scene, view, kPoints), kPaths);
    ASSERT_EQ(points.size(), kPoints);
    const BrickGather gather(bricks::makeBrickView(view), sharedLighting(scene.lighting()), kFaceRays);
    std::vector<reference::Double3> gathered;
    for (uint32_t i = 0; i < kPoints; ++i)
        gathered.push_back(gather.at(points[i].seen, kGatherRays, i));
    const LightError error = lightError(points, gathered, true);
    EXPECT_LT(error.whole, GetParam().most) << error.bias << " bias";
    // a smaller error would mean a dark scene, or that the bricks were the scene itself
    EXPECT_GT(error.whole, 0.0005);
}

// Limits are half a percentage point above the result of `./dev bench light`, which uses more points.
INSTANTIATE_TEST_SUITE_P(Samples, BrickLightError,
                         ::testing::Values(LitRoom{"room", "0.2", 0.262}, LitRoom{"room", "0.1", 0.166},
                                           LitRoom{"terrain", "0.5", 0.016}));

} // namespace
} // namespace hearth::roundtrip
