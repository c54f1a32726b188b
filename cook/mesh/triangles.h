// Detects degenerate triangles and open edges, exactly and by position.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::mesh
{

/// True if the three points lie on one line, exactly: such a triangle covers no sample from any view. Needle
/// triangles with the smallest area stay. Points finite.
bool isDegenerate(Float3 a, Float3 b, Float3 c);

/// Edge with unbalanced half-edges: the triangles use one direction more often than the other.
struct OpenEdge
{
    uint32_t from;
    uint32_t to;
    int32_t surplus; ///< uses from -> to minus uses to -> from; positive

    friend bool operator==(const OpenEdge&, const OpenEdge&) = default;
    friend auto operator<=>(const OpenEdge&, const OpenEdge&) = default;
};

/// Return the boundary of the triangles as a chain: their open edges, sorted. Empty for a closed surface of
/// any genus with any number of triangles at an edge, if its triangles are oriented consistently.
/// positions  three position ids for each triangle
std::vector<OpenEdge> openEdges(std::span<const uint32_t> positions);

} // namespace hearth::mesh
