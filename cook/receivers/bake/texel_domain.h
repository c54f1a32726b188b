// Finds the texels of a rectangle that triangles touch by their UVs, and points of the triangles in each.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/surface.h"

#include <vector>

namespace hearth::receivers
{

/// Points at which the light of a texel is sampled.
inline constexpr uint32_t kTexelPoints = 4;

/// Texel with points on the triangles that touch it.
struct DomainTexel
{
    uint16_t x = 0, y = 0;
    /// One for each of kTexelPoints strata. A point that no triangle covers is moved to the nearest triangle
    /// of those that touch the texel.
    std::array<SurfacePoint, kTexelPoints> points;
    SurfacePoint middle; ///< at the centre of the texel, or the point of the triangles that is nearest to it
};

struct TexelDomain
{
    uint32_t width = 0, height = 0;
    std::vector<DomainTexel> texels; ///< by rows
    /// Share of the strata's points that are in more than one triangle, of those that are in any.
    double overlap = 0;
};

/// Return the points of the strata in a texel's square, the same for all texels.
std::array<Float2, kTexelPoints> texelStrata();

/// Rasterise triangles conservatively: a texel belongs to the domain if any triangle has an area in it.
/// Triangles without an area in UV are left out.
/// first_triangle  index of the first triangle in the points of the result
/// width, height   texels of the square [0, 1] of UV, 1 to 65535; UVs are clamped to the square
/// margin          metres by which points stay off the edges of their triangle, as far as it has room: a ray
///                 from the edge of a floor must not begin behind the wall
TexelDomain rasterise(std::span<const Triangle> triangles, uint32_t first_triangle, uint32_t width,
                      uint32_t height, float margin);

/// Move a point of a triangle off its edges.
/// margin  metres, at most a quarter of the way from an edge to the opposite corner
Float2 insetPoint(const Triangle& triangle, Float2 weights, float margin);

} // namespace hearth::receivers
