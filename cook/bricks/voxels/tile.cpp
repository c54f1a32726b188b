// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/tile.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hearth::bricks
{

using namespace formats;

namespace
{

/// Return the dither threshold of a coverage sample. Each of the 64 steps occurs once, so blended surfaces
/// cover as many samples as their alpha says, evenly spread (B. E. Bayer, "An optimum method for two-level
/// rendition of continuous-tone pictures", 1973).
float ditherThreshold(uint32_t u, uint32_t v)
{
    uint32_t order = 0;
    for (uint32_t bit = 0; bit < 3; ++bit)
    {
        const uint32_t x = u >> bit & 1, y = v >> bit & 1;
        order |= (x ^ y) << (5 - 2 * bit) | y << (4 - 2 * bit);
    }
    return (static_cast<float>(order) + 0.5f) / 64.0f;
}

/// Return the point of a triangle's plane at a coverage sample along an axis. The plane is not parallel to
/// the axis.
Double3 pointAt(const Polygon& piece, const Double3& normal, const Cell& cell, int axis, uint32_t bit)
{
    const int u_axis = uAxis(axis), v_axis = vAxis(axis);
    const double u = cell[static_cast<size_t>(u_axis)] + (bit % kSamplesPerEdge + 0.5) / kSamplesPerEdge;
    const double v = cell[static_cast<size_t>(v_axis)] + (bit / kSamplesPerEdge + 0.5) / kSamplesPerEdge;
    const Double3& p = piece.points[0];
    const double along = coordinate(p, axis) - ((u - coordinate(p, u_axis)) * coordinate(normal, u_axis) +
                                                (v - coordinate(p, v_axis)) * coordinate(normal, v_axis)) /
                                                   coordinate(normal, axis);
    Double3 at;
    const auto set = [&](int which, double value) { (which == 0 ? at.x : which == 1 ? at.y : at.z) = value; };
    set(axis, along);
    set(u_axis, u);
    set(v_axis, v);
    return at;
}

Double3 meanPoint(const Polygon& piece)
{
    Double3 sum;
    for (uint32_t i = 0; i < piece.count; ++i)
        sum = sum + piece.points[i];
    return sum * (1.0 / piece.count);
}

/// Return the mean over the piece: fan triangles around the first corner, sampled at their centroids,
/// weighted by area.
SurfaceSample meanSample(const Polygon& piece, const TriangleSurface& surface)
{
    if (surface.plain())
        return surface.at(piece.points[0]);
    double area = 0, coverage = 0;
    Double3 albedo;
    for (uint32_t i = 2; i < piece.count; ++i)
    {
        const Double3& a = piece.points[0];
        const Double3& b = piece.points[i - 1];
        const Double3& c = piece.points[i];
        const double weight = length(cross(b - a, c - a));
        const SurfaceSample look = surface.at((a + b + c) * (1.0 / 3));
        area += weight;
        coverage += weight * look.coverage;
        albedo = albedo + widen(look.albedo) * (weight * look.coverage);
    }
    SurfaceSample mean;
    mean.coverage = static_cast<float>(coverage / area);
    if (coverage > 0)
        mean.albedo = narrow(albedo * (1 / coverage));
    return mean;
}

} // namespace

Cell tileCounts(const GridFrame& frame)
{
    Cell count;
    for (size_t axis = 0; axis < 3; ++axis)
        count[axis] = (frame.voxels[axis] + kTileVoxels - 1) / kTileVoxels;
    return count;
}

Cell tileAt(const GridFrame& frame, uint32_t tile)
{
    const Cell count = tileCounts(frame);
    return {tile % count[0], tile / count[0] % count[1], tile / count[0] / count[1]};
}

SolidGrid mergeTiles(const GridFrame& frame, std::span<const TileVoxels> tiles)
{
    struct Place
    {
        uint32_t tile;
        uint32_t group;
    };
    SolidGrid grid{frame, {}, {}, {}};
    grid.groups.resize(frame.groupCount());
    std::vector<Place> place_of_group(grid.groups.size(), {kInvalidIndex, 0});
    size_t bricks = 0, voxels = 0;
    for (uint32_t t = 0; t < tiles.size(); ++t)
    {
        for (uint32_t g = 0; g < tiles[t].groups.size(); ++g)
            place_of_group[grid.groupIndex(tiles[t].groups[g].cell)] = {t, g};
        bricks += tiles[t].bricks.size();
        voxels += tiles[t].voxels.size();
    }
    grid.bricks.reserve(bricks);
    grid.voxels.reserve(voxels);
    for (size_t g = 0; g < grid.groups.size(); ++g)
    {
        grid.groups[g].first = static_cast<uint32_t>(grid.bricks.size());
        if (place_of_group[g].tile == kInvalidIndex)
            continue;
        const TileVoxels& tile = tiles[place_of_group[g].tile];
        const MaskedCells& group = tile.groups[place_of_group[g].group].bricks;
        grid.groups[g].mask = group.mask;
        for (int b = 0; b < std::popcount(group.mask); ++b)
        {
            const MaskedCells& brick = tile.bricks[group.first + static_cast<uint32_t>(b)];
            grid.bricks.push_back({brick.mask, static_cast<uint32_t>(grid.voxels.size())});
            const auto first = tile.voxels.begin() + brick.first;
            grid.voxels.insert(grid.voxels.end(), first, first + std::popcount(brick.mask));
        }
    }
    return grid;
}

Tile::Tile(const GridFrame& frame, const Cell& at)
    : frame_(frame), index_(size_t{kTileVoxels} * kTileVoxels * kTileVoxels, kInvalidIndex)
{
    for (size_t axis = 0; axis < 3; ++axis)
    {
        box_.begin[axis] = at[axis] * kTileVoxels;
        box_.end[axis] = std::min(box_.begin[axis] + kTileVoxels, frame.voxels[axis]);
    }
}

void Tile::add(const ClusterGeometry& geometry, const SurfaceMaterial& material,
               const Affine3d& voxels_from_object, bool mirrored)
{
    positions_.clear();
    for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
        positions_.push_back(snapped(transformPoint(voxels_from_object, widen(geometry.position(v)))));
    Polygon triangle;
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
    {
        const std::array<uint32_t, 3> corners = geometry.triangle(t);
        triangle.count = 0;
        for (const uint32_t corner : corners)
            triangle.add(positions_[corner]);
        if (reaches(triangle))
            add(triangle, readTriangleAttributes(geometry, corners, material), material, mirrored ? -1 : 1);
    }
}

/// True if the bounding boxes overlap. False for triangles with infinite or NaN corners, too.
bool Tile::reaches(const Polygon& triangle) const
{
    for (int axis = 0; axis < 3; ++axis)
    {
        const std::array<double, 2> ends = triangle.span(axis);
        const auto a = static_cast<size_t>(axis);
        if (!(ends[1] >= box_.begin[a] && ends[0] <= box_.end[a]))
            return false;
    }
    return true;
}

void Tile::add(const Polygon& triangle, const TriangleAttributes& look, const SurfaceMaterial& material,
               double front)
{
    const Double3 normal = doubleArea(triangle) * front;
    if (normal.x == 0 && normal.y == 0 && normal.z == 0)
        return;
    const TriangleSurface surface(material, triangle, look);
    forEachPiece(triangle, normal, frame_.voxels, box_,
                 [&](const Cell& cell, const Polygon& piece)
                 {
                     ++pieces_;
                     uint32_t& index = indexAt(cell);
                     if (index != kInvalidIndex)
                     {
                         addPiece(sums_[index], cell, piece, surface, material, front);
                         return;
                     }
                     VoxelSum sum;
                     if (!addPiece(sum, cell, piece, surface, material, front))
                         return;
                     index = static_cast<uint32_t>(sums_.size());
                     sums_.push_back(sum);
                 });
}

/// Add a piece to a sum. True if its opacity is above 0.
bool Tile::addPiece(VoxelSum& sum, const Cell& cell, const Polygon& piece, const TriangleSurface& surface,
                    const SurfaceMaterial& material, double front)
{
    const Double3 double_area = doubleArea(piece) * front;
    const SurfaceSample look = meanSample(piece, surface);
    if (look.coverage == 0)
        return false;
    sum.add(meanPoint(piece) - Double3{double(cell[0]), double(cell[1]), double(cell[2])}, double_area, look,
            material.doubleSided());
    for (int axis = 0; axis < 3; ++axis)
    {
        uint64_t coverage = coveredSamples(piece, cell, axis);
        if (material.hasHoles() && coordinate(double_area, axis) != 0)
            for (uint64_t rest = coverage; rest != 0; rest &= rest - 1)
            {
                const auto bit = static_cast<uint32_t>(std::countr_zero(rest));
                const Double3 at = pointAt(piece, double_area, cell, axis, bit);
                if (surface.coverageAt(at) < ditherThreshold(bit % kSamplesPerEdge, bit / kSamplesPerEdge))
                    coverage &= ~(uint64_t{1} << bit);
            }
        sum.coverage[static_cast<size_t>(axis)] |= coverage;
    }
    return true;
}

uint32_t& Tile::indexAt(const Cell& cell)
{
    return index_[(cell[0] - box_.begin[0]) +
                  kTileVoxels *
                      ((cell[1] - box_.begin[1]) + size_t{kTileVoxels} * (cell[2] - box_.begin[2]))];
}

TileVoxels Tile::finish() const
{
    TileVoxels tile;
    tile.pieces = pieces_;
    const auto index = [&](const Cell& cell) // relative to the tile
    { return index_[cell[0] + kTileVoxels * (cell[1] + size_t{kTileVoxels} * cell[2])]; };
    const auto corner = [](uint32_t bits, uint32_t per_row, uint32_t edge) {
        return Cell{bits % per_row * edge, bits / per_row % per_row * edge,
                    bits / (per_row * per_row) * edge};
    };
    constexpr uint32_t kGroupsAcross = kTileVoxels / 16;
    for (uint32_t g = 0; g < kGroupsAcross * kGroupsAcross * kGroupsAcross; ++g)
    {
        const Cell group = corner(g, kGroupsAcross, 16);
        MaskedCells group_bricks{0, static_cast<uint32_t>(tile.bricks.size())};
        for (uint32_t b = 0; b < 64; ++b)
        {
            const Cell in_group = corner(b, 4, 4);
            MaskedCells brick{0, static_cast<uint32_t>(tile.voxels.size())};
            for (uint32_t v = 0; v < 64; ++v)
            {
                const Cell in_brick = corner(v, 4, 1);
                const uint32_t sum =
                    index({group[0] + in_group[0] + in_brick[0], group[1] + in_group[1] + in_brick[1],
                           group[2] + in_group[2] + in_brick[2]});
                if (sum == kInvalidIndex)
                    continue;
                brick.mask |= uint64_t{1} << v;
                tile.voxels.push_back(encodeVoxel(sums_[sum]));
            }
            if (brick.mask == 0)
                continue;
            group_bricks.mask |= uint64_t{1} << b;
            tile.bricks.push_back(brick);
        }
        if (group_bricks.mask != 0)
            tile.groups.push_back(
                {{box_.begin[0] + group[0], box_.begin[1] + group[1], box_.begin[2] + group[2]},
                 group_bricks});
    }
    return tile;
}

} // namespace hearth::bricks
