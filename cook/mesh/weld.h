// Welds vertices: finds those that share a position and those that are equal in all attributes. Connectivity
// is by position; attribute seams stay, as several vertices at one position. See cook/mesh/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::mesh
{

/// Result of welding vertices by position.
struct Weld
{
    std::vector<uint32_t> position_id_of_vertex; ///< position ids, dense, in order of first use
    uint32_t position_count = 0;
};

/// Give vertices with the same three coordinates (bit for bit, but -0 equals +0) the same position id.
/// positions  finite
Weld weldPositions(std::span<const Float3> positions);

/// Return, for each vertex, the first vertex that equals it in every array: attributes, joints, weights and
/// morph targets.
std::vector<uint32_t> firstEqualVertices(const SourceMesh& mesh);

} // namespace hearth::mesh
