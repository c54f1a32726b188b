// Accumulates the material of the surface pieces in one voxel, and encodes its sides.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/material.h"
#include "cook/bricks/voxels/solid_grid.h"

namespace hearth::bricks
{

/// Sums over the surfaces visible through one side of a voxel, weighted by their projected area.
struct SideSum
{
    double weight = 0; ///< voxels squared
    Double3 albedo;
    Double3 normal;
    double depth = 0; ///< behind the side, voxels
};

struct VoxelSum
{
    std::array<SideSum, kFaces> sides;
    double area = 0; ///< total area of all pieces, voxels squared
    Double3 albedo;  ///< weighted by area
    Double3 normal;
    CoverageMasks coverage{};

    /// Add a piece.
    /// middle       a point of the piece, voxels from the voxel's lower corner
    /// double_area  vector along the front's normal, twice the area long
    /// look         mean over the piece; look.coverage is its opacity
    void add(const Double3& middle, const Double3& double_area, const SurfaceSample& look, bool double_sided);
};

/// Encode a voxel. A side without a visible front face gets the mean albedo of all surfaces, and
/// the normal of the surfaces whose back faces it shows, or else its own normal. Back faces of single-sided
/// surfaces are not drawn, but they block light. `opacity` stays 0.
SolidVoxel encodeVoxel(const VoxelSum& sum);

} // namespace hearth::bricks
