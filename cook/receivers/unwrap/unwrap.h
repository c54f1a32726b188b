// Makes UVs for receivers: each piece of a surface has texels to itself, of one size all over.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hearth::receivers
{

/// Mesh with UVs in [0, 1]. Vertices at the borders of charts are there once for each chart.
struct Unwrapped
{
    std::vector<uint32_t> old_from_new; ///< vertex of the given mesh for each vertex
    std::vector<Float2> uvs;            ///< of each vertex
    std::vector<uint32_t> indices;      ///< in the order of the given ones
    uint32_t chart_count = 0;
    uint32_t width = 0, height = 0; ///< texels of the square of UV
};

/// Divide a mesh into charts and pack them. Charts are at least two texels apart, so that bilinear taps read
/// their own. No more than .5 % of a chart's area overlaps. Triangles without an area get UV (0, 0). The same
/// mesh gets the same UVs.
///
/// positions   finite
/// indices     three for each triangle
/// texel_size  metres of the mesh's space, above 0. Texels are larger if the square would have more than
///             kMaxRectangleSide each way.
/// returns     nullopt: there are too many pieces
std::optional<Unwrapped> unwrap(std::span<const Float3> positions, std::span<const uint32_t> indices,
                                double texel_size);

} // namespace hearth::receivers
