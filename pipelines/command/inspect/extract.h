// hearth extract: a cut of a mesh's hierarchy as plain triangles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/command/inspect/posed_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

/// The clusters that are drawn at object-space error `error` (the rule stands beside GroupRecord), by index in the
/// table. They cover the mesh once.
std::vector<uint32_t> clustersOfCut(const formats::PackView& pack, const formats::MeshRecord& mesh,
                                    float error);

/// Write the cut of mesh `mesh` as binary little-endian PLY: x y z, then where the mesh has them nx ny nz, the cone that
/// has the moments of the vertex's visibility (axis_x axis_y axis_z, aperture: half-angle in radians, scale), the ambient
/// occlusion ao = dot(n, m1) / pi and the moments themselves (m0 m1_x m1_y m1_z), and s t; vertices are shared inside a
/// cluster, not between clusters. One page is in memory at a time.
/// What joints or morph targets move is written in the scene's space, in the rest pose or that of the clip; other meshes in
/// their own space, or with a clip in the scene's.
/// errors: usage where the mesh or the clip does not exist; those of openPack; cannot_write.
Status extractCut(const std::string& path, uint32_t mesh, float error, const std::optional<ClipTime>& clip,
                  const std::string& output);

} // namespace hearth::command
