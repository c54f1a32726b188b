// Closes the gaps of surfaces through which light would leak into what a closed surface around them contains.
//
// A closed proxy says what is inside of a mesh whose own triangles do not: walls that miss a face or do not
// meet, overlapping parts. Its surface is not that of the mesh, so it does not become voxels: walls would
// become thicker, and lose their colours. Only where an empty voxel inside and one outside touch, the mesh
// has a gap, and gets opaque voxels there. Afterwards the inside is a space of its own (empty_spaces.h).
//
// A proxy lies a little off its mesh. The empty voxels between both belong to the outside: gaps are closed
// as many voxels behind the proxy as its vertices are away from solid voxels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/interior.h"
#include "cook/bricks/voxels/solid_grid.h"

#include <functional>

namespace hearth::bricks
{

struct LeakStatistics
{
    uint64_t surfaces = 0; ///< closed surfaces, counted once for each instance
    /// Surfaces that are too far from their mesh to close its gaps: a tenth of their vertices is more than
    /// kMaxSurfaceDistance away from all solid voxels.
    uint64_t loose_surfaces = 0;
    uint64_t voxels = 0; ///< that became solid
};

/// Maximum distance of a closed surface from its mesh, in voxels. Wraps of default settings are at most one
/// and a half away in grids of 512 voxels.
inline constexpr double kMaxSurfaceDistance = 4;

/// Make voxels opaque so that no path through empty voxels leads into the inside of a surface. A new voxel
/// has the material of the nearest solid one.
///
/// grid         with opacities
/// makeSurface  returns surface i < surface_count; called in parallel
LeakStatistics closeLeaks(SolidGrid& grid, size_t surface_count,
                          const std::function<ClosedSurface(size_t)>& makeSurface);

} // namespace hearth::bricks
