// Voxelized triangles for tests, without the parts that the cooker reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/memory_budget.h"
#include "cook/bricks/voxels/opacity.h"
#include "cook/bricks/voxels/tile.h"

#include <limits>
#include <random>

namespace hearth::bricks
{

struct Corners
{
    std::array<Double3, 3> at; ///< in voxels, from the grid's origin
};

inline Polygon makePolygon(const Corners& corners)
{
    Polygon polygon;
    for (const Double3& corner : corners.at)
        polygon.add(snapped(corner));
    return polygon;
}

/// Twelve triangles of a box, facing out, or in if `inwards`. Corner (x, y, z) lies at middle + x a + y b + z
/// c, each of x, y, z being -1 or 1; a, b, c are right-handed.
inline void addBox(std::vector<Corners>& triangles, Double3 middle, Double3 a, Double3 b, Double3 c,
                   bool inwards)
{
    const auto corner = [&](int x, int y, int z) { return middle + a * x + b * y + c * z; };
    const auto quad = [&](Double3 p, Double3 q, Double3 r, Double3 s)
    {
        if (inwards)
            std::swap(q, s);
        triangles.push_back({{p, q, r}});
        triangles.push_back({{p, r, s}});
    };
    quad(corner(-1, -1, -1), corner(-1, -1, 1), corner(-1, 1, 1), corner(-1, 1, -1));
    quad(corner(1, -1, -1), corner(1, 1, -1), corner(1, 1, 1), corner(1, -1, 1));
    quad(corner(-1, -1, -1), corner(1, -1, -1), corner(1, -1, 1), corner(-1, -1, 1));
    quad(corner(-1, 1, -1), corner(-1, 1, 1), corner(1, 1, 1), corner(1, 1, -1));
    quad(corner(-1, -1, -1), corner(-1, 1, -1), corner(1, 1, -1), corner(1, -1, -1));
    quad(corner(-1, -1, 1), corner(1, -1, 1), corner(1, 1, 1), corner(-1, 1, 1));
}

inline GridFrame frameOfSize(uint32_t x, uint32_t y, uint32_t z)
{
    return {{0, 0, 0}, 1, {x, y, z}};
}

/// Voxels of triangles of one material, with opacities set.
inline SolidGrid makeSolidGrid(const std::vector<Corners>& triangles, const GridFrame& frame,
                               const SurfaceMaterial& material = defaultMaterial())
{
    const Cell count = tileCounts(frame);
    std::vector<TileVoxels> tiles;
    for (uint32_t t = 0; t < count[0] * count[1] * count[2]; ++t)
    {
        Tile tile(frame, tileAt(frame, t));
        for (const Corners& triangle : triangles)
            tile.add(makePolygon(triangle), {}, material, 1);
        tiles.push_back(tile.finish());
    }
    SolidGrid grid = mergeTiles(frame, tiles);
    computeOpacities(grid);
    return grid;
}

/// Compute spaces and faces too, without a memory limit.
inline GridWithFaces addFaces(SolidGrid grid, std::span<const Float3> seen_points = {})
{
    const Float3 focus;
    return fitToMemory(std::move(grid), seen_points, {&focus, 1}, std::numeric_limits<uint64_t>::max());
}

using Random = std::mt19937;

inline double uniform(Random& random, double low, double high)
{
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
}

inline Double3 uniformPoint(Random& random, double low, double high)
{
    const double x = uniform(random, low, high), y = uniform(random, low, high);
    return {x, y, uniform(random, low, high)};
}

/// Return three orthonormal, right-handed vectors, uniformly distributed over all rotations.
inline std::array<Double3, 3> randomFrame(Random& random)
{
    for (;;)
    {
        const Double3 a = uniformPoint(random, -1, 1), b = uniformPoint(random, -1, 1);
        const Double3 c = cross(a, b);
        if (length(a) > 1 || length(a) < 0.1 || length(c) < 0.1)
            continue;
        const Double3 x = a * (1 / length(a)), z = c * (1 / length(c));
        return {x, cross(z, x), z};
    }
}

} // namespace hearth::bricks
