// Clips triangles to the voxels that they cross. Closed surfaces stay closed in voxels: no path across common
// faces of voxels passes through a closed surface without meeting a voxel that has a piece.
//
// This holds because corners are snapped to a grid (kStepsPerVoxel), and because the point where a plane cuts
// an edge is a function of the edge and the plane alone: neighbouring triangles are cut at the same points,
// whatever their order, direction or tile.
//
// A piece in a plane between voxels belongs to the voxel behind it, against its normal: walls on planes of
// the grid do not shrink the room in front of them. At the boundary of the grid it belongs to the voxel in
// front.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/grid_frame.h"
#include "formats/gpu_shared/bricks.h"

#include <algorithm>
#include <cmath>

namespace hearth::bricks
{

/// Steps per voxel to which corners of triangles are rounded.
inline constexpr double kStepsPerVoxel = 65536;

/// Distance from a plane between voxels, in voxels, within which corners are snapped into the plane. Walls
/// are built on planes, but meshes keep them only to a hundred-thousandth of their size: a ceiling that is
/// lower by that much would fill the voxels of the room under it. The allowed LOD error of clusters is a
/// quarter of a voxel in any case.
inline constexpr double kPlaneSnapDistance = double{shared::kBrickPlaneTolerance};

inline Double3 snapped(Double3 p)
{
    const auto snap = [](double value)
    {
        const double plane = std::floor(value + 0.5);
        return std::abs(value - plane) <= kPlaneSnapDistance
                   ? plane
                   : std::floor(value * kStepsPerVoxel + 0.5) / kStepsPerVoxel;
    };
    return {snap(p.x), snap(p.y), snap(p.z)};
}

inline double coordinate(const Double3& p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// Convex polygon: the part of a triangle between two planes of each axis.
struct Polygon
{
    /// Maximum number of corners. A triangle has at most five corners after the first axis. For later axes
    /// the bound is that a cut through n edges gives at most 2 n corners, because a rounded polygon need not
    /// be exactly convex.
    static constexpr uint32_t kMaxPoints = 20;
    std::array<Double3, kMaxPoints> points;
    uint32_t count = 0;

    void add(const Double3& p) { points[count++] = p; }
    std::array<double, 2> span(int axis) const
    {
        std::array<double, 2> ends{coordinate(points[0], axis), coordinate(points[0], axis)};
        for (uint32_t i = 1; i < count; ++i)
        {
            ends[0] = std::min(ends[0], coordinate(points[i], axis));
            ends[1] = std::max(ends[1], coordinate(points[i], axis));
        }
        return ends;
    }
};

/// Return the normal vector with twice the area as its length.
Double3 doubleArea(const Polygon& polygon);

/// Set `part` to the part between the planes low and low + 1 of an axis. It must be a different object.
void clipToSlab(const Polygon& polygon, int axis, double low, Polygon& part);

/// Box of voxels, `end` excluded.
struct CellBox
{
    Cell begin;
    Cell end;
};

/// Return the range of voxels along an axis that the polygon has a part in, last included.
///
/// along_normal  the normal's component along the axis
/// size          voxels of the grid along the axis: a polygon in a boundary plane of the grid stays inside
inline std::array<int64_t, 2> findSlabs(const Polygon& polygon, int axis, double along_normal, uint32_t size)
{
    // clamp before the conversion: triangles may reach beyond the range of integers
    const auto near = [&](double place) { return std::clamp(place, -1.0, size + 1.0); };
    const std::array<double, 2> ends = polygon.span(axis);
    const auto first = static_cast<int64_t>(std::floor(near(ends[0])));
    const int64_t last = static_cast<int64_t>(std::ceil(near(ends[1]))) - 1;
    if (first <= last)
        return {first, last};
    const int64_t behind = along_normal > 0 ? first - 1 : first;
    const int64_t kept = first == 0 ? 0 : first == size ? first - 1 : behind;
    return {kept, kept};
}

/// Call visit(cell, piece) for each voxel of `box` that contains a piece of the triangle with an area.
///
/// triangle  snapped, in voxels, three points
/// normal    of any length > 0, towards the front side
/// grid      voxels of the whole grid; the box lies inside
template <typename Visit>
void forEachPiece(const Polygon& triangle, const Double3& normal, const Cell& grid, const CellBox& box,
                  const Visit& visit)
{
    const auto within = [&](const Polygon& polygon, int axis)
    {
        std::array<int64_t, 2> slabs =
            findSlabs(polygon, axis, coordinate(normal, axis), grid[static_cast<size_t>(axis)]);
        slabs[0] = std::max(slabs[0], int64_t{box.begin[static_cast<size_t>(axis)]});
        slabs[1] = std::min(slabs[1], int64_t{box.end[static_cast<size_t>(axis)]} - 1);
        return slabs;
    };
    /// Return the part in a slab: the polygon itself for most triangles, else the clipped polygon in `room`.
    const auto part = [](const Polygon& polygon, int axis, const std::array<int64_t, 2>& slabs, int64_t slab,
                         Polygon& room) -> const Polygon&
    {
        const std::array<double, 2> ends = polygon.span(axis);
        const auto low = static_cast<double>(slab);
        if (slabs[0] == slabs[1] && ends[0] >= low && ends[1] <= low + 1)
            return polygon;
        clipToSlab(polygon, axis, low, room);
        return room;
    };
    Polygon x_room, y_room, z_room;
    const std::array<int64_t, 2> xs = within(triangle, 0);
    for (int64_t x = xs[0]; x <= xs[1]; ++x)
    {
        const Polygon& in_x = part(triangle, 0, xs, x, x_room);
        if (in_x.count < 3)
            continue;
        const std::array<int64_t, 2> ys = within(in_x, 1);
        for (int64_t y = ys[0]; y <= ys[1]; ++y)
        {
            const Polygon& in_y = part(in_x, 1, ys, y, y_room);
            if (in_y.count < 3)
                continue;
            const std::array<int64_t, 2> zs = within(in_y, 2);
            for (int64_t z = zs[0]; z <= zs[1]; ++z)
            {
                const Polygon& piece = part(in_y, 2, zs, z, z_room);
                if (piece.count < 3)
                    continue;
                const Double3 area = doubleArea(piece);
                if (area.x != 0 || area.y != 0 || area.z != 0)
                    visit(Cell{static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<uint32_t>(z)},
                          piece);
            }
        }
    }
}

} // namespace hearth::bricks
