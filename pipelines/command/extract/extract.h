// hearth extract: writes a cut of a mesh's LOD hierarchy as plain triangles (PLY).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/command/extract/posed_mesh.h"

#include <optional>
#include <string>

namespace hearth::command
{

/// Write the cut of mesh `mesh` as binary little-endian PLY. Properties of a vertex: x y z, then, if the mesh
/// has them, nx ny nz; the cone that has the moments of the vertex's visibility (axis_x axis_y axis_z,
/// aperture: half-angle in radians, scale); the ambient occlusion ao = dot(n, m1) / pi; the moments
/// themselves (m0 m1_x m1_y m1_z); s t. Vertices are shared inside a cluster, not between clusters. One page
/// is in memory at a time.
/// Meshes that joints or morph targets deform are written in scene space, in the rest pose or the pose of the
/// clip. Other meshes are written in object space, or with a clip in scene space.
/// errors: usage if the mesh or the clip does not exist; those of openPack; cannot_write.
Status extractCut(const std::string& path, uint32_t mesh, float error, const std::optional<ClipTime>& clip,
                  const std::string& output);

} // namespace hearth::command
