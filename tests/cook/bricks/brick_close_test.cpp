// Tests geometry in the voxel right in front of a surface, behind which the surface's rays start: its light
// is not lost.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/face_lighting.h"
#include "tests/support/voxel_model.h"

#include <gtest/gtest.h>

namespace hearth::bricks
{
namespace
{

using namespace shared;

/// Wall that ends with the voxels of z = 1, with a strip of one voxel on it from y = 8 to 9.
BrickTables wallWithStrip(const Voxel& strip)
{
    VoxelModel model({16, 16, 12});
    model.fill({0, 0, 0}, {16, 16, 2}, makeVoxel({0.5f, 0.5f, 0.5f}));
    model.fill({0, 8, 2}, {16, 9, 3}, strip);
    return model.build();
}

constexpr Sky kDusk{{0.25f, 0.25f, 0.25f}, {0.25f, 0.25f, 0.25f}, {0.25f, 0.25f, 0.25f}};

/// Return the light on a point of the wall that is seen from the front, without other light.
float lightAt(const BrickTables& tables, Float3 position, Sky sky = {})
{
    const BrickView view = makeBrickView(tables);
    FaceLighting lighting(view);
    SceneLighting dark{};
    dark.exposure = 1;
    lighting.sweep(dark, 1, 1);
    const BrickStart start = brickVisibleStart(lighting.scene(), position, {0, 0, 1}, {0, -2, 10});
    EXPECT_EQ(start.is_interior, 0u);
    return brickGather(lighting.scene(), sky, start, 1024, 1).x;
}

} // namespace

TEST(BrickClose, lightsTheSurfaceBehindIt)
{
    const BrickTables tables = wallWithStrip(makeVoxel({0, 0, 0}, {2, 2, 2}));
    // three sides in the air have their light and half of that of the fourth; the same whichever of the two
    // voxels the wall's plane belongs to
    for (const float z : {1.99f, 2.0f, 2.01f})
        EXPECT_NEAR(lightAt(tables, {8.5f, 8.3f, z}), 2 * 3 / 3.5f, 0.02f) << z;
    EXPECT_LT(lightAt(tables, {8.5f, 6.5f, 2}), 0.3f) << "beside it rays find it as before";
}

TEST(BrickClose, lightsItAsFarAsItIsOpaque)
{
    const BrickTables half = wallWithStrip(makeVoxel({0, 0, 0}, {2, 2, 2}, 128));
    // two more sides look at the next voxels of the strip, since light passes them
    const float strip = 2 * 5 / 5.5f, beyond = 0.25f;
    EXPECT_NEAR(lightAt(half, {8.5f, 8.3f, 2}, kDusk), beyond + (strip - beyond) * 128 / 255, 0.02f);
}

/// A darker voxel beside or in front of the point takes no light away.
TEST(BrickClose, darkensNothing)
{
    const BrickTables dark = wallWithStrip(makeVoxel({0, 0, 0}));
    EXPECT_NEAR(lightAt(dark, {8.5f, 8.3f, 2}, kDusk), 0.25f, 0.01f);
}

/// A surface within its own voxel is not lit by that voxel, however bright the voxel is.
TEST(BrickClose, isNotTheSurfacesOwnVoxel)
{
    VoxelModel model({16, 16, 12});
    model.fill({0, 0, 0}, {16, 16, 2}, makeVoxel({0, 0, 0}, {2, 2, 2}));
    const BrickTables tables = model.build();
    for (const float z : {1.2f, 1.6f, 2.0f})
        EXPECT_EQ(lightAt(tables, {8.5f, 8.3f, z}), 0) << z;
}

} // namespace hearth::bricks
