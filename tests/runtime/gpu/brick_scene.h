// Builds small scenes with bricks for tests.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_view.h"
#include "tests/support/brick_model.h"
#include "tests/support/test_scene.h"

namespace hearth::test
{

/// Surface appearance of the face on `side` of a voxel.
struct FaceLook
{
    Float3 albedo{0.5f, 0.5f, 0.5f};
    Float3 emission{};
};
using LookOf = std::function<FaceLook(std::array<uint32_t, 3> voxel, uint32_t side)>;

/// Make a grid with face appearances; faces start dark.
BrickModel brickModel(std::array<uint32_t, 3> voxels,
                      const std::function<bool(uint32_t, uint32_t, uint32_t)>& solid, const LookOf& look);

/// Add bricks to the scene, before it is built.
void setBricks(TestScene& scene, const BrickModel& bricks);

/// View of a model for the cookers' library; the model must outlive it.
bricks::BrickView makeBrickView(const BrickModel& model);

/// Voxel and side of each face.
struct FaceLocation
{
    std::array<uint32_t, 3> voxel;
    uint32_t side;
};
std::vector<FaceLocation> faceLocations(const BrickModel& model);

/// Shell of a box: solid within `thick` voxels of its surface.
inline auto makeShell(std::array<uint32_t, 3> voxels, uint32_t thick = 1)
{
    return [=](uint32_t x, uint32_t y, uint32_t z)
    {
        return x < thick || y < thick || z < thick || x >= voxels[0] - thick || y >= voxels[1] - thick ||
               z >= voxels[2] - thick;
    };
}

} // namespace hearth::test
