// Packs the attributes that steer simplification into weighted rows: differences between rows are lengths.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/lanes.h"
#include "cook/mesh/source_mesh.h"

#include <cstdint>
#include <vector>

namespace hearth::clusters
{

/// Joint or morph target, and the length that a weight of 1 stands for.
struct DeformationWeight
{
    uint32_t index;
    float length;
};

/// Attributes that count, with the length that one unit of each stands for; 0: the mesh lacks the attribute.
struct AttributeWeights
{
    float normal = 0;
    float uv = 0; ///< first UV set
    float color = 0;
    std::vector<DeformationWeight> joints; ///< all but the main joint, or the most important ones
    uint32_t main_joint = 0;               ///< its weight is the remainder to 1
    std::vector<DeformationWeight> morphs; ///< targets with the largest displacements

    uint32_t count() const
    {
        return (normal > 0 ? 3u : 0u) + (uv > 0 ? 2u : 0u) + (color > 0 ? 4u : 0u) +
               static_cast<uint32_t>(joints.size() + 3 * morphs.size());
    }
    uint32_t rows() const { return (count() + uint32_t{kLanes} - 1) / uint32_t{kLanes}; }
};

/// Write a vertex's weighted attributes to rows() rows; unused lanes are 0.
void packAttributes(const mesh::SourceMesh& vertices, uint32_t vertex, const AttributeWeights& weights,
                    Lanes* rows);

/// Set a vertex's attributes from the rows, clamped to legal values: normals of length 1, colours in [0, 1],
/// tangents orthogonal to their normals, weights that sum to 1. Morph targets stay unchanged.
void unpackAttributes(const Lanes* rows, const AttributeWeights& weights, mesh::SourceMesh& vertices,
                      uint32_t vertex);

} // namespace hearth::clusters
