// A cluster's geometry in the bind pose, with what moves it.
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

/// One morph target of a cluster.
struct MorphDeltas
{
    uint32_t target = 0;           ///< of the mesh
    std::vector<Float3> positions; ///< one for each vertex
};

struct DeformedCluster
{
    std::vector<Float3> positions;
    std::vector<uint32_t> indices;   ///< three for each triangle
    uint32_t influences = 0;         ///< of each vertex; 0 without a skin
    std::vector<uint16_t> joints;    ///< of the skin; `influences` for each vertex
    std::vector<double> weights;     ///< as many; those of a vertex sum to 1
    std::vector<MorphDeltas> morphs; ///< targets that move a vertex
};

/// The weight of a joint at a vertex.
double weightOf(const DeformedCluster& cluster, size_t vertex, uint32_t joint);

/// What moves the clusters of one mesh. All outlive it.
struct Deformation
{
    const motion::SkinMotion* skin = nullptr;             ///< null without a skin
    std::span<const motion::Interval> morph_weights = {}; ///< by target
    const motion::PoseRegions* regions = nullptr;         ///< to tighten boxes with; null where nothing moves
};

/// Where morph targets take a vertex in the bind pose.
struct MorphedVertex
{
    Double3 middle;
    Double3 half;
};
std::vector<MorphedVertex> morphedVertices(const DeformedCluster& cluster,
                                           std::span<const motion::Interval> morph_weights);

} // namespace hearth::skinning
