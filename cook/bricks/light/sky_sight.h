// Measures how much of the sky a scene sees. A place that sees next to none is lit by what its surfaces give
// back, which bricks are for.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/light/ray_scene.h"

namespace hearth::bricks
{

struct SkySight
{
    uint32_t surface_points = 0;
    uint32_t dark_surface_points = 0; ///< that see less than a tenth of the sky
    uint32_t cameras = 0;
    uint32_t dark_cameras = 0; ///< the same of cameras

    /// True if more than a quarter of the points, or more than half of the cameras, see less than a tenth of
    /// the sky. Of a room with walls of some thickness half of the surfaces are outside, and of an open box
    /// more than half.
    bool isEnclosed() const { return 4 * dark_surface_points > surface_points || 2 * dark_cameras > cameras; }
};

/// Measure by rays that end in no opaque triangle: from 4,096 points on the fronts of surfaces, even in area,
/// over the hemisphere about their normal, and from cameras over the whole sphere. Unlit surfaces are skies.
/// cameras  in voxels, as the positions of the ray scene
SkySight measureSkySight(const RayScene& rays, std::span<const Float3> cameras);

} // namespace hearth::bricks
