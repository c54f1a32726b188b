// Sums over the pieces of surface in one voxel, and what its sides look like by them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/material.h"
#include "cook/bricks/voxels/solid_grid.h"

namespace hearth::bricks
{

/// A look at a voxel's surfaces from one side, each weighed by the area that it shows there.
struct SideSum
{
    double weight = 0; ///< voxels squared
    Double3 albedo;
    Double3 emission;
    Double3 normal;
};

struct VoxelSum
{
    std::array<SideSum, kFaces> sides;
    double area = 0; ///< of everything, whatever it faces
    Double3 albedo;  ///< weighed by it
    Double3 normal;
    CrossSections hidden{};

    /// Add a piece.
    /// double_area  twice its area along its front's normal
    /// look         mean over the piece; look.hidden is the share of it that is there
    void add(const Double3& double_area, const Look& look, bool double_sided);
};

/// The codes of a voxel. A side that no front is seen through looks as the mean of all surfaces, gives off no light, and
/// has the normal of what is seen from behind there, or its own: the backs of single-sided surfaces are not drawn either,
/// but light does not pass them. `opacity` is left 0.
SolidVoxel voxelOf(const VoxelSum& sum);

} // namespace hearth::bricks
