// How far vertices stray from where all their influences would carry them, once some of these are left out.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/mesh_motion.h"
#include "cook/mesh/source_mesh.h"

#include <optional>

namespace hearth::clusters
{

/// Bounds the distance between where `all` and where `kept` put a vertex, for those that lost a joint: over all poses of the
/// scene's clips, their blends and the rest pose, with the motion's morph weights. In metres of the mesh's own space: times
/// the largest singular value of an instance's palette it holds in the world.
///
/// Kept joints gain what others lose: a weight w that goes from joint i to joint j moves the vertex x by w |M_i x - M_j x|, which
/// cook/animation_bounds bounds: M_j |D x - x| with what i does as j sees it.
///
/// all     joints of the skin and weights of any sum > 0; other arrays are not read
/// kept    the same vertices with weights that sum to 1, their places and morph deltas
/// motion  of a skin, made for all vertices of `all` and `kept`
/// returns metres; nothing where joints do not see each other: where they can be scaled to 0
std::optional<double> influenceDisplacement(const mesh::SourceMesh& all, const mesh::SourceMesh& kept,
                                            const MeshMotion& motion);

} // namespace hearth::clusters
