// Reduces the deformation data of a mesh to what geometry pages can hold: a few influences of each vertex as
// codes, and quantized morph deltas (formats/codecs/vertex_codec.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

#include <span>
#include <vector>

namespace hearth::mesh
{

/// Joint of the skin and its weight.
struct Influence
{
    uint16_t joint;
    double weight;
};

/// Weight that vertices lost with dropped influences, before the others were scaled to a sum of 1.
struct InfluenceLoss
{
    float max_weight = 0;      ///< largest of one vertex
    float mean_weight = 0;     ///< mean over all vertices
    uint32_t vertex_count = 0; ///< vertices that lost any
};

/// Keep the `most` (4 or 8) largest influences of each vertex: largest first, each joint once, weights that
/// are multiples of 1 / 65535 and whose codes sum to 65535, joint 0 in unused slots. One set if no vertex
/// needs more than four.
InfluenceLoss reduceInfluences(SourceMesh& mesh, uint32_t most);

/// Set the influences of one vertex in the same way. `influences` in any order, weights >= 0 of any sum > 0;
/// a joint may occur twice. Changes the order of `influences`. returns the share of the weights that is
/// dropped.
float setInfluences(SourceMesh& mesh, size_t vertex, std::span<Influence> influences);

/// Give all targets deltas of positions, and of normals if the mesh has normals; quantize them to the steps
/// of their codes.
/// returns the step of each target's positions, a power of two
std::vector<float> snapMorphTargets(SourceMesh& mesh);

/// Return the nearest delta that has a code.
Float3 snapMorphPosition(Float3 delta, float step);
Float3 snapMorphNormal(Float3 delta);

} // namespace hearth::mesh
