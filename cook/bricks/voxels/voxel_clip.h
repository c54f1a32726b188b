// Cuts triangles to the voxels that they cross. What closes a surface closes it in voxels: no way leads from voxel to
// voxel across common faces through a closed surface without meeting one that a piece was given to.
//
// That holds because corners lie on a grid (kSnap), and because the point where an edge is cut is a function of the edge and
// the plane alone: neighbours are cut in the same points, whatever their own order, direction or tile.
//
// A piece that lies in a plane between voxels belongs to the voxel behind it, against its normal: walls on the planes of the
// grid leave the room in front of them as large as it is. Where the grid ends there, it belongs to the voxel in front.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/grid_frame.h"
#include "formats/gpu_shared/bricks.h"

#include <algorithm>
#include <cmath>

namespace hearth::bricks
{

/// Corners of triangles are rounded to so many steps a voxel.
inline constexpr double kSnap = 65536;

/// Corners so near to a plane between voxels, in voxels, are put into it. Walls are built on planes, but meshes keep them to a
/// hundred-thousandth of their size: a ceiling that is lower by that would fill the voxels of the room under it. A quarter
/// of a voxel is what clusters may be off in any case.
inline constexpr double kPlaneReach = double{shared::kBrickPlaneReach};

inline Double3 snapped(Double3 p)
{
    const auto snap = [](double value)
    {
        const double plane = std::floor(value + 0.5);
        return std::abs(value - plane) <= kPlaneReach ? plane : std::floor(value * kSnap + 0.5) / kSnap;
    };
    return {snap(p.x), snap(p.y), snap(p.z)};
}

inline double coordinate(const Double3& p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// A convex polygon: what is left of a triangle between two planes of each axis.
struct Polygon
{
    /// A triangle has five corners after the first axis. Later ones count on no more than that a cut through n edges leaves
    /// 2 n corners: what is rounded need not be convex to the last bit.
    static constexpr uint32_t kMost = 20;
    std::array<Double3, kMost> points;
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

/// Twice the area, along the normal.
Double3 doubleArea(const Polygon& polygon);

/// Set `part` to what lies between the planes low and low + 1 of an axis. It is another polygon.
void clipToSlab(const Polygon& polygon, int axis, double low, Polygon& part);

/// A box of voxels, `end` excluded.
struct CellBox
{
    Cell begin;
    Cell end;
};

/// Numbers of the voxels along an axis that the polygon has a part in, last included.
///
/// along_normal  the normal's part along the axis
/// size          voxels of the grid along the axis: one that lies in the grid's own side stays inside
inline std::array<int64_t, 2> slabsOf(const Polygon& polygon, int axis, double along_normal, uint32_t size)
{
    // triangles may reach farther than whole numbers do
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

/// Call visit(cell, piece) for each voxel of `box` that a piece of the triangle with an area lies in.
///
/// triangle  snapped, in voxels, three points
/// normal    of any length > 0, to the side that is the front
/// grid      voxels of the whole grid; the box lies inside
template <typename Visit>
void forEachPiece(const Polygon& triangle, const Double3& normal, const Cell& grid, const CellBox& box,
                  const Visit& visit)
{
    const auto within = [&](const Polygon& polygon, int axis)
    {
        std::array<int64_t, 2> slabs =
            slabsOf(polygon, axis, coordinate(normal, axis), grid[static_cast<size_t>(axis)]);
        slabs[0] = std::max(slabs[0], int64_t{box.begin[static_cast<size_t>(axis)]});
        slabs[1] = std::min(slabs[1], int64_t{box.end[static_cast<size_t>(axis)]} - 1);
        return slabs;
    };
    /// The part in a slab: the polygon itself, as for most triangles, or what is cut from it.
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
