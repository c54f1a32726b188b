// The grid that all positions of a mesh lie on. See README.md, "The grid".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

namespace hearth::mesh
{

/// Positions are whole multiples of `step`, a power of two, in every axis: 24 bits hold the multiples, so that they, and
/// sums and differences of them within a mesh, are exact as floats on every machine. Two meshes with one step share
/// the places where they meet.
struct Grid
{
    double step = 0;
    float error = 0; ///< upper bound of the distance that a position moved to come on it
};

/// Move all positions of the mesh to the nearest points of its grid. The step divides the longest side of the mesh's
/// box 65536 to 131072 times; more often where triangles would lose an edge, up to 16 times as often, or as often as
/// a float of the mesh's farthest coordinate can tell.
Grid snapToGrid(SourceMesh& mesh);

/// The nearest point of the grid.
float snap(double coordinate, double step);

} // namespace hearth::mesh
