// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/brick_scene.h"

#include "formats/shared/brick_codes.h"

namespace hearth::test
{

std::vector<FacePlace> facePlaces(const BrickModel& model)
{
    std::vector<FacePlace> places(model.albedo.size());
    const uint32_t groups_x = shared::brickGroups(model.grid.voxels[0]),
                   groups_y = shared::brickGroups(model.grid.voxels[1]);
    for (uint32_t g = 0; g < model.groups.size(); ++g)
    {
        uint32_t number = model.groups[g].first_brick;
        for (uint32_t b = 0; b < 64; ++b)
        {
            if (!shared::maskHas(model.groups[g].brick_mask_low, model.groups[g].brick_mask_high, b))
                continue;
            const shared::Brick& brick = model.bricks[number++];
            const std::array<uint32_t, 3> first{g % groups_x * 16 + (b & 3) * 4,
                                                g / groups_x % groups_y * 16 + (b >> 2 & 3) * 4,
                                                g / groups_x / groups_y * 16 + (b >> 4) * 4};
            for (uint32_t side = 0; side < 6; ++side)
                for (uint32_t bit = 0; bit < 64; ++bit)
                    if (const uint32_t face = shared::brickFace(brick, bit, side); face != shared::kNoFace)
                        places[face] = {
                            {first[0] + (bit & 3), first[1] + (bit >> 2 & 3), first[2] + (bit >> 4)}, side};
        }
    }
    return places;
}

BrickModel brickModel(std::array<uint32_t, 3> voxels,
                      const std::function<bool(uint32_t, uint32_t, uint32_t)>& solid, const LookOf& look)
{
    BrickModel model = brickModel(voxels, solid);
    const std::vector<FacePlace> places = facePlaces(model);
    for (size_t face = 0; face < places.size(); ++face)
    {
        const FaceLook at = look(places[face].voxel, places[face].side);
        model.albedo[face] = shared::encodeAlbedo(at.albedo);
        model.emission[face] = shared::encodeRadiance(at.emission);
    }
    return model;
}

void setBricks(TestScene& scene, const BrickModel& bricks)
{
    scene.model().bricks = bricks;
    scene.model().brick_grids = {bricks.grid};
}

bricks::BrickView brickViewOf(const BrickModel& model)
{
    return {model.masks(), model.opacity, model.albedo, model.normals, model.emission, model.lighting};
}

} // namespace hearth::test
