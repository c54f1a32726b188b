// Bounds the displacement of vertices that dropped influences cause.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/mesh_motion.h"
#include "cook/mesh/source_mesh.h"

#include <optional>

namespace hearth::clusters
{

/// Bound the distance between the positions that `all` and `kept` give a vertex, over the vertices that lost
/// a joint: over all poses of the scene's clips, their blends and the rest pose, with the motion's morph
/// weights. In metres of the mesh's own space; in the world, multiply by the largest singular value of an
/// instance's palette.
///
/// Kept joints gain the weight of dropped ones: a weight w that goes from joint i to joint j moves the vertex
/// x by w |M_i x - M_j x|. cook/animation_bounds bounds it as M_j |D x - x| with D the motion of i relative
/// to j.
///
/// all     joints of the skin and weights of any sum > 0; other arrays are not read
/// kept    the same vertices with weights that sum to 1, their positions and morph deltas
/// motion  of a skin, made for all vertices of `all` and `kept`
/// returns metres; nothing if joints have no bounded relative motion: if they can be scaled to 0
std::optional<double> influenceDisplacement(const mesh::SourceMesh& all, const mesh::SourceMesh& kept,
                                            const MeshMotion& motion);

} // namespace hearth::clusters
