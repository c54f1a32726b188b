// The attributes that steer the simplification, side by side: differences are lengths.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/lanes.h"
#include "cook/mesh/source_mesh.h"

#include <cstdint>
#include <vector>

namespace hearth::clusters
{

/// A joint, or a morph target, and the length that a weight of 1 stands for.
struct DeformationWeight
{
    uint32_t index;
    float length;
};

/// Which attributes there are, and the length that one unit of each stands for; 0: it is not there.
struct AttributeWeights
{
    float normal = 0;
    float uv = 0; ///< of the first set
    float color = 0;
    std::vector<DeformationWeight> joints; ///< all but the main joint, or those that count most
    uint32_t main_joint = 0;               ///< its weight is what the others leave
    std::vector<DeformationWeight> morphs; ///< those that move most

    uint32_t count() const
    {
        return (normal > 0 ? 3u : 0u) + (uv > 0 ? 2u : 0u) + (color > 0 ? 4u : 0u) +
               static_cast<uint32_t>(joints.size() + 3 * morphs.size());
    }
    uint32_t rows() const { return (count() + uint32_t{kLanes} - 1) / uint32_t{kLanes}; }
};

/// Write a vertex's attributes, weighted, to rows() rows; what is left over is 0.
void packAttributes(const mesh::SourceMesh& vertices, uint32_t vertex, const AttributeWeights& weights,
                    Lanes* rows);

/// Set a vertex's attributes to what the rows say, as far as they are legal values: normals of length 1, colours in
/// [0, 1], tangents upright on their normals, weights that sum to 1. Morph targets stay as they are.
void unpackAttributes(const Lanes* rows, const AttributeWeights& weights, mesh::SourceMesh& vertices,
                      uint32_t vertex);

} // namespace hearth::clusters
