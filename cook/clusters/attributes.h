// The attributes that steer the simplification, side by side: differences are lengths.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/lanes.h"
#include "cook/mesh/source_mesh.h"

#include <cstdint>

namespace hearth::clusters
{

/// Which attributes there are, and the length that one unit of each stands for; 0: it is not there.
struct AttributeWeights
{
    float normal = 0;
    float uv = 0; ///< of the first set
    float color = 0;

    uint32_t count() const { return (normal > 0 ? 3u : 0u) + (uv > 0 ? 2u : 0u) + (color > 0 ? 4u : 0u); }
    uint32_t rows() const { return (count() + uint32_t{kLanes} - 1) / uint32_t{kLanes}; }
};

/// Write a vertex's attributes, weighted, to rows() rows; what is left over is 0.
void packAttributes(const mesh::SourceMesh& vertices, uint32_t vertex, const AttributeWeights& weights,
                    Lanes* rows);

/// Set a vertex's attributes to what the rows say, as far as they are legal values: normals of length 1, colours in
/// [0, 1], tangents upright on their normals.
void unpackAttributes(const Lanes* rows, const AttributeWeights& weights, mesh::SourceMesh& vertices,
                      uint32_t vertex);

} // namespace hearth::clusters
