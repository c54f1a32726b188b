// Quantizes the positions of a mesh to a grid. See cook/mesh/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

namespace hearth::mesh
{

/// Grid of a mesh. Positions are whole multiples of `step`, a power of two, in every axis. The multiples fit
/// in 24 bits, so positions, and sums and differences of them within a mesh, are exact as floats on every
/// machine. Two meshes with the same step share the positions where they meet.
struct Grid
{
    double step = 0;
    float error = 0; ///< upper bound of the distance that a position moved to the grid
};

/// Move all positions of the mesh to the nearest grid points. The step divides the longest side of the mesh's
/// box 65536 to 131072 times. It is up to 16 times finer where triangles would lose an edge, limited by the
/// float resolution of the mesh's farthest coordinate.
Grid snapToGrid(SourceMesh& mesh);

/// Return the nearest grid coordinate.
float snap(double coordinate, double step);

} // namespace hearth::mesh
