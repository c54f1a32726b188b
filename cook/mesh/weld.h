// Which vertices share a position, and which are the same vertex twice.
// Connectivity is by position; attribute seams stay, as several vertices at one position. See README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::mesh
{

struct Weld
{
    std::vector<uint32_t> position_of_vertex; ///< dense, in order of first use
    uint32_t position_count = 0;
};

/// Vertices with the same three coordinates (bit for bit, but -0 equals +0) get the same position.
/// positions  finite
Weld weldPositions(std::span<const Float3> positions);

/// For each vertex the first vertex that equals it in every array: attributes, joints, weights and morph targets.
std::vector<uint32_t> firstEqualVertices(const SourceMesh& mesh);

} // namespace hearth::mesh
