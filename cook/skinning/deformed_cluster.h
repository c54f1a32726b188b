// Geometry of a cluster in the bind pose, with its joints and morph targets.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/pose_regions.h"
#include "cook/animation_bounds/skin_motion.h"
#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::skinning
{

/// Deltas of one morph target in a cluster.
struct MorphDeltas
{
    uint32_t target = 0;           ///< index in the mesh
    std::vector<Float3> positions; ///< one for each vertex
};

struct DeformedCluster
{
    std::vector<Float3> positions;
    std::vector<uint32_t> indices;   ///< three for each triangle
    uint32_t influences = 0;         ///< number of influences of each vertex; 0 without a skin
    std::vector<uint16_t> joints;    ///< indices into the skin's joints; `influences` for each vertex
    std::vector<double> weights;     ///< same layout; the weights of a vertex sum to 1
    std::vector<MorphDeltas> morphs; ///< targets that move a vertex of the cluster
};

/// Return the weight of a joint at a vertex.
double jointWeight(const DeformedCluster& cluster, size_t vertex, uint32_t joint);

/// Deformation of the clusters of one mesh. All members must outlive it.
struct Deformation
{
    const animation_bounds::SkinMotion* skin = nullptr;             ///< null without a skin
    std::span<const animation_bounds::Interval> morph_weights = {}; ///< by target
    const animation_bounds::PoseRegions* regions = nullptr; ///< for tightening boxes; null without animation
};

/// Box of the positions of a vertex in the bind pose, over all morph weights.
struct MorphedVertex
{
    Double3 middle;
    Double3 half;
};
std::vector<MorphedVertex> morphedVertices(const DeformedCluster& cluster,
                                           std::span<const animation_bounds::Interval> morph_weights);

} // namespace hearth::skinning
