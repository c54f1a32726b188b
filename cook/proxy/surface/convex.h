// Checks if a surface is a convex solid, as physics engines take it for collision.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/surface/surface.h"

namespace hearth::proxy
{

/// Maximum of positions of a convex solid: engines take a few hundred, and the check takes time with the
/// square.
inline constexpr size_t kMaxConvexPositions = 8192;

/// Dent that is taken for the rounding of the program that wrote a convex solid, over the solid's diagonal.
inline constexpr double kConvexTolerance = 1e-3;

/// Reason why a surface is no convex solid.
enum class ConvexFault : uint8_t
{
    none,       ///< it is one
    too_large,  ///< more than kMaxConvexPositions: not checked
    open,       ///< an edge has not two triangles that pass it in opposite directions
    inside_out, ///< its triangles face inwards, or it has no volume
    dented,     ///< a position lies in front of a triangle by more than the tolerance
};

/// Check that the surface is closed, faces outwards, and lies behind the plane of each of its triangles, by
/// kConvexTolerance of its diagonal.
/// surface  at least one triangle, welded by position
ConvexFault findConvexFault(const Surface& surface);

} // namespace hearth::proxy
