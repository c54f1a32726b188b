// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/leaks.h"

#include "cook/bricks/voxels/opacity.h"
#include "cook/bricks/voxels/voxel_sum.h"
#include "formats/records/bricks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tbb/parallel_for.h>

namespace hearth::bricks
{

namespace
{

// Vertices of a surface whose distances are measured: enough for a share of nine tenths.
constexpr size_t kMeasuredVertices = 512;

// Share of the vertices that a surface's distance holds for. Vertices in hollows of a mesh may be farther
// away.
constexpr double kMeasuredShare = 0.9;

/// Voxels in the order of a grid's tables: by group, brick and bit.
class CellOrder
{
public:
    explicit CellOrder(const SolidGrid& grid) : grid_(grid) {}

    uint64_t key(const Cell& cell) const
    {
        return uint64_t{grid_.groupIndex(cell)} << 12 | cellBit(cell, 2) << 6 | cellBit(cell);
    }
    bool operator()(const Cell& a, const Cell& b) const { return key(a) < key(b); }

private:
    const SolidGrid& grid_;
};

bool isEmpty(const SolidGrid& grid, const Cell& cell)
{
    return !isInside(grid.frame, cell) || grid.voxelAt(cell) == kInvalidIndex;
}

/// Return the distance of a point from a voxel.
double voxelDistance(const Double3& point, const Cell& cell)
{
    const auto beyond = [](double at, uint32_t low) {
        return std::max({low - at, at - (static_cast<double>(low) + 1), 0.0});
    };
    return length(Double3{beyond(point.x, cell[0]), beyond(point.y, cell[1]), beyond(point.z, cell[2])});
}

/// Return the distance of a point from the nearest solid voxel, infinity if it is above kMaxSurfaceDistance.
double findSolidDistance(const SolidGrid& grid, const Double3& point)
{
    double nearest = std::numeric_limits<double>::infinity();
    const auto visit = [&](const std::array<int64_t, 3>& at)
    {
        Cell cell;
        for (size_t axis = 0; axis < 3; ++axis)
        {
            if (at[axis] < 0 || at[axis] >= grid.frame.voxels[axis])
                return;
            cell[axis] = static_cast<uint32_t>(at[axis]);
        }
        if (grid.voxelAt(cell) != kInvalidIndex)
            nearest = std::min(nearest, voxelDistance(point, cell));
    };
    std::array<int64_t, 3> middle;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double at = axis == 0 ? point.x : axis == 1 ? point.y : point.z;
        if (!(std::abs(at) < double{formats::kMaxGridVoxels} * 2))
            return nearest;
        middle[static_cast<size_t>(axis)] = static_cast<int64_t>(std::floor(at));
    }
    // voxels of shell r are at least r - 1 away
    for (int64_t r = 0; r <= static_cast<int64_t>(kMaxSurfaceDistance) + 1; ++r)
    {
        if (nearest <= static_cast<double>(r - 1))
            break;
        for (int64_t z = -r; z <= r; ++z)
            for (int64_t y = -r; y <= r; ++y)
            {
                const bool is_side = std::abs(z) == r || std::abs(y) == r;
                for (int64_t x = -r; x <= r; x += is_side || r == 0 ? 1 : 2 * r)
                    visit({middle[0] + x, middle[1] + y, middle[2] + z});
            }
    }
    return nearest <= kMaxSurfaceDistance ? nearest : std::numeric_limits<double>::infinity();
}

/// Return how far a surface is from solid voxels, in voxels; nothing if that is too far.
std::optional<double> measureDistance(const SolidGrid& grid, const ClosedSurface& surface)
{
    std::vector<double> distances;
    const size_t step = surface.positions.size() / kMeasuredVertices + 1;
    for (size_t v = 0; v < surface.positions.size(); v += step)
        distances.push_back(findSolidDistance(grid, surface.positions[v]));
    if (distances.empty())
        return std::nullopt;
    const auto rank = static_cast<ptrdiff_t>(kMeasuredShare * static_cast<double>(distances.size() - 1));
    std::ranges::nth_element(distances, distances.begin() + rank);
    const double distance = distances[static_cast<size_t>(rank)];
    return std::isfinite(distance) ? std::optional(distance) : std::nullopt;
}

/// Call visit(z) for each voxel of a run that none of the other runs has.
template <typename Visit>
void forEachUncovered(Interior::Run run, std::span<const Interior::Run> others, const Visit& visit)
{
    uint32_t z = run.begin;
    for (const Interior::Run& other : others)
    {
        for (; z < std::min(run.end, other.begin); ++z)
            visit(z);
        z = std::max(z, std::min(run.end, other.end));
    }
    for (; z < run.end; ++z)
        visit(z);
}

/// Layers of empty voxels inside of a surface, by the length of the path from an empty voxel outside.
class EmptyLayers
{
public:
    EmptyLayers(const SolidGrid& grid, const Interior& inside) : grid_(grid), order_(grid), inside_(inside)
    {
        inside.forEachColumn(
            [&](uint32_t x, uint32_t y, std::span<const Interior::Run> column)
            {
                for (const Interior::Run& run : column)
                {
                    const auto add = [&](uint32_t face)
                    {
                        return [this, x, y, face](uint32_t z)
                        {
                            const Cell cell{x, y, z};
                            if (isEmpty(grid_, cell) && isEmpty(grid_, across(cell, face)))
                                layer_.push_back(cell);
                        };
                    };
                    for (uint32_t face = 0; face < 4; ++face)
                    {
                        const Cell next = across({x, y, 0}, face);
                        forEachUncovered(run, inside_.runs(next[0], next[1]), add(face));
                    }
                    add(4)(run.begin);
                    add(5)(run.end - 1);
                }
            });
        sortLayer();
    }

    /// Go on to the next layer.
    void advance()
    {
        std::vector<Cell> next;
        for (const Cell& cell : layer_)
            for (uint32_t face = 0; face < kFaces; ++face)
            {
                const Cell at = across(cell, face);
                if (isInside(grid_.frame, at) && inside_.has(at) && isEmpty(grid_, at) &&
                    !std::ranges::binary_search(layer_, at, order_) &&
                    !std::ranges::binary_search(last_, at, order_))
                    next.push_back(at);
            }
        last_ = std::move(layer_);
        layer_ = std::move(next);
        sortLayer();
    }

    const std::vector<Cell>& layer() const { return layer_; }

private:
    void sortLayer()
    {
        std::ranges::sort(layer_, order_);
        const auto repeated = std::ranges::unique(layer_);
        layer_.erase(repeated.begin(), repeated.end());
    }

    const SolidGrid& grid_;
    CellOrder order_;
    const Interior& inside_;
    std::vector<Cell> layer_, last_; ///< sorted
};

/// Find the voxels that close the gaps of one surface; nothing if it is too far from its mesh.
std::optional<std::vector<Cell>> findLeaks(const SolidGrid& grid, const ClosedSurface& surface)
{
    const std::optional<double> distance = measureDistance(grid, surface);
    if (!distance)
        return std::nullopt;
    const Interior inside(surface, grid.frame);
    EmptyLayers layers(grid, inside);
    // a path across faces between both surfaces is longer than their distance, by up to the root of three
    const auto between = static_cast<uint32_t>(std::ceil(*distance * std::sqrt(3.0))) + 1;
    for (uint32_t i = 0; i < between && !layers.layer().empty(); ++i)
        layers.advance();
    return layers.layer();
}

/// Opaque grey voxel, for gaps that touch no solid one.
SolidVoxel makeGreyVoxel()
{
    VoxelSum grey;
    grey.area = 1;
    grey.albedo = {0.5, 0.5, 0.5};
    return encodeVoxel(grey);
}

/// Return the voxels for empty cells, each with the material of the nearest solid voxel, by steps to any of
/// the 26 neighbours.
/// cells  sorted
std::vector<SolidVoxel> makeVoxels(const SolidGrid& grid, std::span<const Cell> cells)
{
    const CellOrder order(grid);
    std::vector<uint32_t> nearest(cells.size(), kInvalidIndex);
    const auto forEachNeighbour = [&](const Cell& cell, const auto& visit)
    {
        for (uint32_t i = 0; i < 27; ++i)
        {
            const Cell next{cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1};
            if (isInside(grid.frame, next))
                visit(next);
        }
    };
    std::vector<uint32_t> queue;
    for (uint32_t i = 0; i < cells.size(); ++i)
    {
        forEachNeighbour(cells[i],
                         [&](const Cell& next)
                         {
                             if (nearest[i] == kInvalidIndex)
                                 nearest[i] = grid.voxelAt(next);
                         });
        if (nearest[i] != kInvalidIndex)
            queue.push_back(i);
    }
    for (size_t q = 0; q < queue.size(); ++q)
        forEachNeighbour(cells[queue[q]],
                         [&](const Cell& next)
                         {
                             const auto at = std::ranges::lower_bound(cells, next, order);
                             const auto i = static_cast<uint32_t>(at - cells.begin());
                             if (at == cells.end() || *at != next || nearest[i] != kInvalidIndex)
                                 return;
                             nearest[i] = nearest[queue[q]];
                             queue.push_back(i);
                         });
    std::vector<SolidVoxel> voxels;
    for (const uint32_t voxel : nearest)
    {
        voxels.push_back(voxel == kInvalidIndex ? makeGreyVoxel() : grid.voxels[voxel]);
        voxels.back().opacity = kOpaque;
    }
    return voxels;
}

/// Return the grid with further voxels.
/// cells  empty, sorted
SolidGrid addVoxels(const SolidGrid& grid, std::span<const Cell> cells, std::span<const SolidVoxel> voxels)
{
    const CellOrder order(grid);
    SolidGrid result{grid.frame, {}, {}, {}};
    result.groups.reserve(grid.groups.size());
    result.voxels.reserve(grid.voxels.size() + voxels.size());
    size_t next = 0;
    for (uint64_t g = 0; g < grid.groups.size(); ++g)
    {
        MaskedCells group{0, static_cast<uint32_t>(result.bricks.size())};
        for (uint32_t b = 0; b < 64; ++b)
        {
            const MaskedCells& old = grid.groups[g];
            const MaskedCells solid = old.has(b) ? grid.bricks[old.at(b)] : MaskedCells{};
            MaskedCells brick{0, static_cast<uint32_t>(result.voxels.size())};
            for (uint32_t v = 0; v < 64; ++v)
            {
                const bool is_new = next < cells.size() && order.key(cells[next]) == (g << 12 | b << 6 | v);
                if (!is_new && !solid.has(v))
                    continue;
                brick.mask |= uint64_t{1} << v;
                result.voxels.push_back(is_new ? voxels[next++] : grid.voxels[solid.at(v)]);
            }
            if (brick.mask == 0)
                continue;
            group.mask |= uint64_t{1} << b;
            result.bricks.push_back(brick);
        }
        result.groups.push_back(group);
    }
    return result;
}

} // namespace

LeakStatistics closeLeaks(SolidGrid& grid, size_t surface_count,
                          const std::function<ClosedSurface(size_t)>& makeSurface)
{
    std::vector<std::optional<std::vector<Cell>>> leaks(surface_count);
    tbb::parallel_for(size_t{0}, surface_count,
                      [&](size_t i) { leaks[i] = findLeaks(grid, makeSurface(i)); });
    LeakStatistics statistics{surface_count};
    std::vector<Cell> cells;
    for (const std::optional<std::vector<Cell>>& of_surface : leaks)
        if (of_surface)
            cells.insert(cells.end(), of_surface->begin(), of_surface->end());
        else
            ++statistics.loose_surfaces;
    std::ranges::sort(cells, CellOrder(grid));
    const auto repeated = std::ranges::unique(cells);
    cells.erase(repeated.begin(), repeated.end());
    statistics.voxels = cells.size();
    if (!cells.empty())
        grid = addVoxels(grid, cells, makeVoxels(grid, cells));
    return statistics;
}

} // namespace hearth::bricks
