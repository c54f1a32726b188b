// Decomposes a solid into convex parts, for collision.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/convex/solid_distance.h"
#include "cook/proxy/surface/surface.h"

#include <cstdint>
#include <vector>

namespace hearth::proxy
{

/// Maximum vertices of a convex part. Its triangles are then at most 252: physics engines take 255 of both
/// (PhysX).
inline constexpr size_t kMaxPartVertices = 128;

struct ConvexSettings
{
    uint32_t max_parts = 16; ///< at least 1
    /// Parts are cut further while they reach farther than this from the solid, over the diagonal of its box.
    double error = 0.02;
};

/// Convex polyhedra that hold a surface together.
struct ConvexParts
{
    Surface surface; ///< the parts, one after the other; each has its own positions, and one material
    std::vector<uint32_t> ends; ///< of each part: the triangle after its last one
    double distance = 0;        ///< metres: no point of a part is farther from the solid
    double surface_distance =
        0; ///< metres: no point of the surface is farther from the parts; it is rounding
};

/// Decompose a solid: the inside of the closed shells of a surface, and its open shells. Pieces that reach
/// too far from it are cut by the plane that leaves the least volume and area of their hulls, along the axes
/// or along the faces at folds, and joined again where a common hull costs least (after K. Mamou, F. Ghorbel,
/// "A simple and efficient approach for 3D mesh approximate convex decomposition", 2009, and X. Wei et al.,
/// "Approximate Convex Decomposition for 3D Meshes with Collision-Aware Concavity and Tree Search", 2022, but
/// on the surface itself). Each part is exactly convex in the floats of its positions, has volume, and holds
/// its piece of the surface. Parts have the material of the greatest area. Deterministic on processors of one
/// class. Runs on all cores.
/// solid  of a manifold, as cleanSurface makes it, with at least one triangle
ConvexParts decompose(const Solid& solid, const ConvexSettings& settings);

} // namespace hearth::proxy
