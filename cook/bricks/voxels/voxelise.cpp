// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/voxelise.h"

#include "cook/bricks/grid/brick_tables.h"
#include "cook/bricks/voxels/focus.h"
#include "cook/bricks/voxels/tile.h"

#include <algorithm>
#include <tbb/parallel_for.h>

namespace hearth::bricks
{

using namespace formats;

namespace
{

// Tiles between two checks of the memory budget: enough for many threads.
constexpr size_t kTilesPerBatch = 256;

/// Cluster in one of the tiles that its bounds overlap.
struct TileItem
{
    uint32_t tile;
    uint32_t placed;
    friend auto operator<=>(const TileItem&, const TileItem&) = default;
};

std::vector<Affine3d> instanceTransforms(const StaticScene& scene, const GridFrame& frame)
{
    std::vector<Affine3d> transforms;
    for (const StaticInstance& instance : scene.instances)
        transforms.push_back(voxelsFromObject(frame, instance.world_from_object));
    return transforms;
}

/// Return the clusters of each tile, sorted by tile.
std::vector<TileItem> listTileItems(const StaticScene& scene, std::span<const InstancedCluster> placed,
                                    const GridFrame& frame, const std::vector<Affine3d>& transforms)
{
    const Cell tiles = tileCounts(frame);
    std::vector<TileItem> items;
    for (uint32_t i = 0; i < placed.size(); ++i)
    {
        const VoxelBox box = computeVoxelBox(scene, placed[i], transforms[placed[i].instance]);
        Cell first, last;
        bool reaches = true;
        for (int axis = 0; axis < 3; ++axis)
        {
            const auto a = static_cast<size_t>(axis);
            const double size = frame.voxels[a];
            // skip boxes that are not finite
            reaches = reaches && coordinate(box.max, axis) >= 0 && coordinate(box.min, axis) <= size;
            const auto tileIndex = [&](double voxel)
            { return static_cast<uint32_t>(std::clamp(voxel, 0.0, size - 1)) / kTileVoxels; };
            // include both tiles for surfaces in the plane between them
            first[a] = reaches ? tileIndex(coordinate(box.min, axis) - 1) : 0;
            last[a] = reaches ? tileIndex(coordinate(box.max, axis)) : 0;
        }
        if (!reaches)
            continue;
        for (uint32_t z = first[2]; z <= last[2]; ++z)
            for (uint32_t y = first[1]; y <= last[1]; ++y)
                for (uint32_t x = first[0]; x <= last[0]; ++x)
                    items.push_back({x + tiles[0] * (y + tiles[1] * z), i});
    }
    std::ranges::sort(items);
    return items;
}

/// Items of one tile.
struct TileRange
{
    uint32_t tile;
    std::span<const TileItem> items;
    double distance = 0; ///< metres from the nearest focus point
};

std::vector<TileRange> tileRanges(std::span<const TileItem> items)
{
    std::vector<TileRange> ranges;
    for (size_t begin = 0; begin < items.size();)
    {
        size_t end = begin;
        while (end < items.size() && items[end].tile == items[begin].tile)
            ++end;
        ranges.push_back({items[begin].tile, items.subspan(begin, end - begin), 0});
        begin = end;
    }
    return ranges;
}

std::vector<TileRange> nearestFirst(std::vector<TileRange> ranges, const GridFrame& frame,
                                    std::span<const Float3> foci)
{
    for (TileRange& range : ranges)
    {
        const Cell at = tileAt(frame, range.tile);
        const Double3 low{at[0] * double{kTileVoxels}, at[1] * double{kTileVoxels},
                          at[2] * double{kTileVoxels}};
        range.distance =
            focusDistance(frame, foci, low, low + Double3{kTileVoxels, kTileVoxels, kTileVoxels});
    }
    std::ranges::stable_sort(ranges, {}, &TileRange::distance);
    return ranges;
}

/// Sums the memory, without faces, of the bricks within a distance of the focus points.
class NearBrickMemory
{
public:
    NearBrickMemory(const GridFrame& frame, std::span<const Float3> foci)
        : frame_(frame), foci_(foci), within_(computeBrickBytes(frame.groupCount(), 0, 0, 0).total())
    {
    }

    void add(const TileVoxels& tile)
    {
        for (const TileVoxels::Group& group : tile.groups)
        {
            uint32_t brick = group.bricks.first;
            for (uint64_t rest = group.bricks.mask; rest != 0; rest &= rest - 1, ++brick)
            {
                const auto bit = static_cast<uint32_t>(std::countr_zero(rest));
                const Cell cell{group.cell[0] + (bit & 3) * 4, group.cell[1] + (bit >> 2 & 3) * 4,
                                group.cell[2] + (bit >> 4) * 4};
                const auto voxels = static_cast<uint64_t>(std::popcount(tile.bricks[brick].mask));
                beyond_.push_back(
                    {brickDistance(frame_, foci_, cell), computeBrickBytes(0, 1, voxels, 0).total()});
            }
        }
    }

    /// Return the bytes of the bricks nearer than a distance, and of the groups.
    /// distance  must not decrease between calls
    uint64_t bytesWithin(double distance)
    {
        std::erase_if(beyond_,
                      [&](const Brick& brick)
                      {
                          const bool is_within = brick.distance < distance;
                          within_ += is_within ? brick.bytes : 0;
                          return is_within;
                      });
        return within_;
    }

private:
    struct Brick
    {
        double distance;
        uint64_t bytes;
    };
    const GridFrame& frame_;
    std::span<const Float3> foci_;
    uint64_t within_;
    std::vector<Brick> beyond_;
};

/// Voxelise one tile.
Result<TileVoxels> voxeliseTile(const StaticScene& scene, std::span<const InstancedCluster> placed,
                                const TileRange& range, const GridFrame& frame,
                                const std::vector<Affine3d>& transforms)
{
    Tile tile(frame, tileAt(frame, range.tile));
    std::vector<std::byte> page;
    uint32_t page_source = kInvalidIndex, page_number = kInvalidIndex;
    for (const TileItem& item : range.items)
    {
        const InstancedCluster& at = placed[item.placed];
        const PackView& part = scene.sources[at.source].clusters;
        if (at.source != page_source || at.page != page_number)
        {
            HEARTH_ASSIGN_OR_RETURN(page, part.decodePage(at.page));
            page_source = at.source;
            page_number = at.page;
        }
        const StaticInstance& instance = scene.instances[at.instance];
        const ClusterRecord& record = part.clusters()[at.cluster];
        const auto geometry = ClusterGeometry::at(page, record, part.meshes()[instance.mesh]);
        if (!geometry)
            return Error{Issue::meaning_geometry, part.name(), "cluster " + std::to_string(at.cluster),
                         "lies outside its page"};
        tile.add(*geometry, scene.material(at.source, record.material), transforms[at.instance],
                 instance.mirrored);
    }
    return tile.finish();
}

Status textureStatus(const StaticScene& scene)
{
    for (const std::vector<SurfaceMaterial>& materials : scene.materials)
        for (const SurfaceMaterial& material : materials)
            for (const auto& texture : {material.base_color, material.metallic_roughness, material.emissive})
                if (texture)
                    HEARTH_TRY(texture->status());
    return success();
}

} // namespace

Result<VoxeliseResult> voxelise(const StaticScene& scene, std::span<const InstancedCluster> placed,
                                const GridFrame& frame, std::span<const Float3> foci, uint64_t memory)
{
    const std::vector<Affine3d> transforms = instanceTransforms(scene, frame);
    const std::vector<TileItem> items = listTileItems(scene, placed, frame, transforms);
    const std::vector<TileRange> ranges = nearestFirst(tileRanges(items), frame, foci);
    std::vector<TileVoxels> tiles(ranges.size());
    std::vector<Status> statuses(ranges.size(), success());
    NearBrickMemory near(frame, foci);
    size_t done = 0;
    while (done < ranges.size() && (done == 0 || near.bytesWithin(ranges[done].distance) <= memory))
    {
        const size_t end = std::min(done + kTilesPerBatch, ranges.size());
        tbb::parallel_for(done, end,
                          [&](size_t i)
                          {
                              auto tile = voxeliseTile(scene, placed, ranges[i], frame, transforms);
                              if (tile.ok())
                                  tiles[i] = std::move(*tile);
                              else
                                  statuses[i] = tile.error();
                          });
        for (; done < end; ++done)
        {
            HEARTH_TRY(std::move(statuses[done]));
            near.add(tiles[done]);
        }
    }
    HEARTH_TRY(textureStatus(scene));
    VoxeliseResult result{mergeTiles(frame, tiles), {}, ranges.size() - done};
    result.counts.clusters = placed.size();
    for (const InstancedCluster& at : placed)
        result.counts.triangles += scene.sources[at.source].clusters.clusters()[at.cluster].triangle_count;
    for (const TileVoxels& tile : tiles)
        result.counts.pieces += tile.pieces;
    return result;
}

} // namespace hearth::bricks
