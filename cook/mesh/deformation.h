// What deforms a mesh, brought to what geometry pages can hold: a few influences of each vertex in codes, and morph deltas
// in steps (formats/codecs/vertex_codec.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

#include <span>
#include <vector>

namespace hearth::mesh
{

/// A joint of the skin and its weight.
struct Influence
{
    uint16_t joint;
    double weight;
};

/// What vertices lost with the influences that were left out, before the others were scaled to a sum of 1.
struct InfluenceLoss
{
    float most_weight = 0;     ///< of one vertex
    float mean_weight = 0;     ///< over all vertices
    uint32_t vertex_count = 0; ///< that lost any
};

/// Keep the `most` (4 or 8) largest influences of each vertex: largest first, joints once, weights that are multiples of
/// 1 / 65535 and whose codes sum to 65535, joint 0 where there is none. One set where no vertex needs more than four.
InfluenceLoss reduceInfluences(SourceMesh& mesh, uint32_t most);

/// The same for one vertex: `influences` in any order, weights >= 0 of any sum > 0; a joint may stand there twice.
/// Changes the order of `influences`. returns the share of the weights that is left out.
float setInfluences(SourceMesh& mesh, size_t vertex, std::span<Influence> influences);

/// Give all targets deltas of positions, and of normals if the mesh has those; bring them to the steps of their codes.
/// returns the step of each target's positions, a power of two
std::vector<float> snapMorphTargets(SourceMesh& mesh);

/// The nearest deltas that have codes.
Float3 snapMorphPosition(Float3 delta, float step);
Float3 snapMorphNormal(Float3 delta);

} // namespace hearth::mesh
