// Starts and rays of faces, as the GPU's pass has them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_view.h"
#include "cook/bricks/grid/face_locations.h"
#include "formats/gpu_shared/brick_lighting.h"

#include <vector>

namespace hearth::bricks
{

/// Return the start of a face's rays.
/// place  of the face, by its index
inline shared::BrickStart startFace(const BrickView& bricks, const shared::BrickScene& scene,
                                    const FaceLocation& place, size_t face)
{
    const auto [x, y, z, side] = place;
    return shared::brickFaceStart(
        scene, x, y, z, side, shared::decodeFaceNormal(bricks.normals[face]),
        shared::brickFaceSurface(x, y, z, side, shared::decodeFaceDepth(bricks.albedo[face])));
}

/// Append `count` rays of a face, which are the same in every frame.
inline void addFaceRays(const shared::BrickScene& scene, const FaceLocation& place,
                        const shared::BrickStart& start, uint32_t count, std::vector<shared::BrickRay>& rays)
{
    const auto [x, y, z, side] = place;
    const uint32_t seed = shared::brickFaceSeed(x, y, z, side);
    for (uint32_t i = 0; i < count; ++i)
    {
        const Float3 direction = shared::brickRayDirection(start.normal, i, count, seed);
        rays.push_back(shared::brickRayInVoxels(scene.masks.grid,
                                                shared::brickRayOrigin(scene, start, direction), direction,
                                                shared::kBrickInfinity));
    }
}

} // namespace hearth::bricks
