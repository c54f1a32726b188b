// Fits a simplified surface to the original by a step of least squares. See cook/clusters/README.md,
// "Fitting".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/surface.h"
#include "cook/clusters/surface/surface_points.h"

namespace hearth::clusters
{

/// Move the modified positions, on the mesh's grid, and change their attributes, so that the triangles of the
/// group lie nearer to the new surface in the sense of least squares. No triangle flips.
/// after, points  of `simplified`; updated with it
void fitToGroup(const GroupMesh& group, SimplifiedGroup& simplified, Surface& after, SurfacePoints& points);

} // namespace hearth::clusters
