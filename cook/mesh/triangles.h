// Triangles that cover nothing, and edges that are open: exact answers by position.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::mesh
{

/// Whether the three points lie on one line, exactly: such a triangle covers no sample from any view.
/// Needle triangles with the smallest area stay. Points finite.
bool isDegenerate(Float3 a, Float3 b, Float3 c);

/// An edge that the triangles use more often in one direction than in the other.
struct OpenEdge
{
    uint32_t from;
    uint32_t to;
    int32_t surplus; ///< uses from -> to minus uses to -> from; positive

    friend bool operator==(const OpenEdge&, const OpenEdge&) = default;
    friend auto operator<=>(const OpenEdge&, const OpenEdge&) = default;
};

/// The boundary of the triangles as a chain: their open edges, sorted. Empty for a closed surface, whatever its genus
/// and however many faces meet at an edge, as long as its faces are oriented alike.
/// positions  three position indices for each triangle
std::vector<OpenEdge> openEdges(std::span<const uint32_t> positions);

} // namespace hearth::mesh
