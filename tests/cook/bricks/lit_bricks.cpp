// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/bricks/lit_bricks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hearth::bricks
{

using namespace shared;

SceneLighting darkness()
{
    return {.sky = {}, .lights = {}};
}

SceneLighting constantSky(Float3 radiance)
{
    SceneLighting lighting = darkness();
    lighting.sky = {radiance, radiance, radiance};
    return lighting;
}

void addSun(SceneLighting& lighting, Float3 direction, Float3 illuminance)
{
    Light& sun = lighting.lights.emplace_back();
    sun.type = kLightDirectional;
    sun.direction = direction / length(direction);
    sun.intensity = illuminance;
}

void addLamp(SceneLighting& lighting, Float3 position, Float3 candela, float range)
{
    Light& lamp = lighting.lights.emplace_back();
    lamp.type = 1;
    lamp.position = position;
    lamp.intensity = candela;
    lamp.range = range;
}

std::vector<LitFace> facesIn(const BrickTables& tables, Float3 low, Float3 high)
{
    std::vector<LitFace> faces;
    for (uint32_t z = 0; z < tables.grid.voxels[2]; ++z)
        for (uint32_t y = 0; y < tables.grid.voxels[1]; ++y)
            for (uint32_t x = 0; x < tables.grid.voxels[0]; ++x)
                for (uint32_t side = 0; side < kVoxelFaces; ++side)
                {
                    const uint32_t face = faceAt(tables, x, y, z, side);
                    const Float3 middle = brickFaceMiddle(x, y, z, side);
                    if (face != kNoFace && middle == max(low, min(middle, high)))
                        faces.push_back({x, y, z, side, face});
                }
    return faces;
}

Room::Room(std::array<uint32_t, 3> inside, const Voxel& wall, float voxel_size)
{
    const std::array<uint32_t, 3> size{inside[0] + 4, inside[1] + 4, inside[2] + 4};
    VoxelModel model(size, voxel_size, {-3, 5, 0.5f});
    model.shell({1, 1, 1}, {inside[0] + 3, inside[1] + 3, inside[2] + 3}, wall);
    tables = model.build();
    inner = facesIn(tables, {2, 2, 2},
                    {static_cast<float>(inside[0] + 2), static_cast<float>(inside[1] + 2),
                     static_cast<float>(inside[2] + 2)});
}

Float3 computeRadiance(const FaceLighting& lighting, uint32_t face)
{
    return decodeBrickLight(lighting.faces()[face]);
}

void expectRelative(Float3 value, Float3 expected, float tolerance)
{
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c], expected[c], tolerance * expected[c]) << "channel " << c;
}

float largest(Float3 v)
{
    return std::max({v.x, v.y, v.z});
}

} // namespace hearth::bricks
