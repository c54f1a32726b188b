// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/brick_scene.h"

#include "cook/bricks/grid/face_locations.h"
#include "formats/gpu_shared/brick_codes.h"

namespace hearth::test
{

std::vector<FaceLocation> faceLocations(const BrickModel& model)
{
    std::vector<FaceLocation> places;
    for (const bricks::FaceLocation& at : bricks::faceLocations(model.masks()))
        places.push_back({{at.x, at.y, at.z}, at.side});
    return places;
}

BrickModel brickModel(std::array<uint32_t, 3> voxels,
                      const std::function<bool(uint32_t, uint32_t, uint32_t)>& solid, const LookOf& look)
{
    BrickModel model = brickModel(voxels, solid);
    const std::vector<FaceLocation> places = faceLocations(model);
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

bricks::BrickView makeBrickView(const BrickModel& model)
{
    return {model.masks(), model.opacity, model.albedo, model.normals, model.emission, model.lighting};
}

} // namespace hearth::test
