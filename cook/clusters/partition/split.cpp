// Surface-area heuristic as for ray-tracing hierarchies: J. D. MacDonald, K. S. Booth, "Heuristics for ray
// tracing using space subdivision", 1990; bins: I. Wald, "On fast construction of SAH-based bounding volume
// hierarchies", 2007.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/partition/split.h"

#include "cook/clusters/core/islands.h"
#include "cook/clusters/core/lanes.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include <tbb/parallel_for.h>

namespace hearth::clusters
{

namespace
{

using formats::kMaxClusterTriangles;
using formats::kMaxClusterVertices;

constexpr size_t kBinCount = 32;

// Nodes above this are cut at the median of their longest side: the position of the top cuts does not change
// the clusters measurably, and a histogram of one axis costs a third of the full search.
constexpr size_t kMaxSearchedItems = 4096;

// Nodes up to this size are assumed to share vertices uniformly.
constexpr size_t kMaxUniformNode = 2048;

struct Cut
{
    size_t axis = 0;
    size_t left_count = 0;
};

/// Numbers the vertices of a cluster 0, 1, ... in order of first use.
class VertexNumbering
{
public:
    explicit VertexNumbering(uint32_t limit) : limit_(limit) {}

    /// Return the number of `vertex`, or kMaxClusterVertices if it exceeds the limit.
    uint32_t findOrAdd(VertexId vertex)
    {
        // appended in any case, because a branch on its novelty would be unpredictable
        vertices_[count_] = vertex;
        uint32_t slot = (toIndex(vertex) * 0x9E3779B1u) >> 22;
        while (vertices_[std::min(numbers_[slot], count_)] != vertex)
            slot = (slot + 1) % kSlotCount;
        const uint32_t number = std::min(numbers_[slot], count_);
        numbers_[slot] = number;
        count_ += number == count_ ? 1 : 0;
        return count_ <= limit_ ? number : kMaxClusterVertices;
    }

    std::span<const VertexId> vertices() const { return std::span(vertices_).first(count_); }

private:
    static constexpr uint32_t kSlotCount = 1024; ///< four times the number of entries
    static constexpr uint32_t kFree = 0xFFFFFFFFu;

    static constexpr std::array<uint32_t, kSlotCount> allFree()
    {
        std::array<uint32_t, kSlotCount> slots{};
        slots.fill(kFree);
        return slots;
    }

    std::array<uint32_t, kSlotCount> numbers_ = allFree();
    std::array<VertexId, kMaxClusterVertices + 1> vertices_; ///< one more than the limit
    uint32_t limit_;
    uint32_t count_ = 0;
};

/// Append the items as one cluster; false if they have too many vertices.
bool appendLeaf(std::span<const SplitItem> items, const SplitTriangles& triangles, ClusterStore& out)
{
    VertexNumbering numbers(triangles.vertex_limit);
    std::array<uint8_t, kMaxClusterTriangles * 3> indices;
    size_t index_count = 0;
    for (const SplitItem& item : items)
        for (const VertexId vertex : triangles.corners.triangle(item.triangle))
        {
            const uint32_t number = numbers.findOrAdd(vertex);
            if (number == kMaxClusterVertices)
                return false;
            indices[index_count++] = static_cast<uint8_t>(number);
        }
    const auto vertices = numbers.vertices();
    out.shapes.push_back({.first_vertex = static_cast<uint32_t>(out.vertices.size()),
                          .vertex_count = static_cast<uint32_t>(vertices.size()),
                          .first_index = static_cast<uint32_t>(out.indices.size()),
                          .triangle_count = static_cast<uint32_t>(items.size()),
                          .material = triangles.material});
    out.vertices.insert(out.vertices.end(), vertices.begin(), vertices.end());
    out.indices.insert(out.indices.end(), indices.begin(),
                       indices.begin() + static_cast<ptrdiff_t>(index_count));
    for (const SplitItem& item : items)
        out.errors.push_back(triangles.errors[item.triangle]);
    return true;
}

/// Box in the first three lanes.
struct LaneBox
{
    Lanes min = splat(std::numeric_limits<float>::infinity());
    Lanes max = splat(-std::numeric_limits<float>::infinity());

    void add(Lanes point)
    {
        min = minimum(min, point);
        max = maximum(max, point);
    }
    void add(const LaneBox& other)
    {
        min = minimum(min, other.min);
        max = maximum(max, other.max);
    }
};

/// Return an item's center in the first three lanes.
Lanes centerLanes(const SplitItem& item)
{
    return Lanes{item.center.x, item.center.y, item.center.z, 0};
}

LaneBox boundCenters(std::span<const SplitItem> items)
{
    LaneBox box;
    for (const SplitItem& item : items)
        box.add(centerLanes(item));
    return box;
}

/// Return half the surface of a box that is not empty. If its sides overflow floats, no cut is better than
/// the median.
double halfArea(const LaneBox& box)
{
    const Lanes sides = box.max - box.min;
    const double x = double{sides[0]}, y = double{sides[1]}, z = double{sides[2]};
    return x * y + y * z + z * x;
}

/// Maps coordinates to bins of each axis, safely for any finite range: halving avoids overflow.
class Binning
{
public:
    explicit Binning(const LaneBox& box)
        : half_low_(box.min * splat(0.5f)), half_sides_(box.max * splat(0.5f) - half_low_)
    {
        // an axis too short for floats has one bin
        for (size_t axis = 0; axis < 3; ++axis)
            if (half_sides_[axis] > 1e-35f)
                scale_[axis] = kBinCount / half_sides_[axis];
    }

    LaneMask operator()(const SplitItem& item) const
    {
        const Lanes bin = (centerLanes(item) * splat(0.5f) - half_low_) * scale_;
        return __builtin_convertvector(minimum(bin, splat(kBinCount - 1)), LaneMask);
    }

    size_t longestAxis() const
    {
        const float x = half_sides_[0], y = half_sides_[1], z = half_sides_[2];
        return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    }

private:
    Lanes half_low_, half_sides_;
    Lanes scale_{};
};

/// Return the multiple of `capacity` nearest to `count` that leaves items on both sides.
size_t roundToFull(size_t count, size_t total, size_t capacity)
{
    const size_t last = (total - 1) / capacity * capacity;
    return std::clamp((count + capacity / 2) / capacity * capacity, capacity, last);
}

struct AxisCost
{
    double cost;
    Cut cut;
};

using BinCounts = std::array<uint32_t, kBinCount>;

struct Bins
{
    std::array<LaneBox, kBinCount> boxes;
    BinCounts counts{};
};

/// Find the cheapest bin border along one axis. Counts are rounded to full clusters before they are weighted.
AxisCost bestCutOfAxis(const Bins& bins, size_t axis, size_t item_count, size_t capacity)
{
    std::array<double, kBinCount> right_area{};
    LaneBox right;
    for (size_t b = kBinCount; b-- > 1;)
    {
        right.add(bins.boxes[b]);
        right_area[b] = halfArea(right);
    }
    AxisCost best{std::numeric_limits<double>::infinity(), {axis, 0}};
    LaneBox left;
    size_t left_count = 0;
    for (size_t b = 0; b + 1 < kBinCount; ++b)
    {
        left.add(bins.boxes[b]);
        left_count += bins.counts[b];
        if (bins.counts[b] == 0 || left_count == item_count)
            continue;
        const size_t cut = roundToFull(left_count, item_count, capacity);
        const double cost = halfArea(left) * static_cast<double>(cut) +
                            right_area[b + 1] * static_cast<double>(item_count - cut);
        if (cost < best.cost)
            best = {cost, {axis, cut}};
    }
    return best;
}

/// Cuts nodes in two.
class NodeCutter
{
public:
    /// max_items  of a node
    explicit NodeCutter(size_t max_items) : scratch_(std::make_unique_for_overwrite<SplitItem[]>(max_items))
    {
    }

    /// Cut at a multiple of `capacity`. Returns the number of items on the left; they come first.
    size_t operator()(std::span<SplitItem> items, size_t capacity)
    {
        const Binning binning(boundCenters(items));
        Cut cut{binning.longestAxis(), roundToFull(items.size() / 2, items.size(), capacity)};
        if (items.size() > kMaxSearchedItems)
            apply(items, cut, binning, countItems(items, binning, cut.axis));
        else
        {
            const std::array<Bins, 3> bins = fillBins(items, binning);
            double least = std::numeric_limits<double>::infinity();
            for (size_t axis = 0; axis < 3; ++axis)
                if (const AxisCost found = bestCutOfAxis(bins[axis], axis, items.size(), capacity);
                    found.cost < least)
                {
                    least = found.cost;
                    cut = found.cut;
                }
            apply(items, cut, binning, bins[cut.axis].counts);
        }
        return cut.left_count;
    }

private:
    static BinCounts countItems(std::span<const SplitItem> items, const Binning& binning, size_t axis)
    {
        BinCounts counts{};
        for (const SplitItem& item : items)
            ++counts[static_cast<size_t>(binning(item)[axis])];
        return counts;
    }

    static std::array<Bins, 3> fillBins(std::span<const SplitItem> items, const Binning& binning)
    {
        std::array<Bins, 3> bins;
        for (const SplitItem& item : items)
        {
            const LaneMask bin = binning(item);
            for (size_t axis = 0; axis < 3; ++axis)
            {
                const auto b = static_cast<size_t>(bin[axis]);
                bins[axis].boxes[b].add(centerLanes(item));
                ++bins[axis].counts[b];
            }
        }
        return bins;
    }

    /// Move the items that are first along the axis to the front. Only the bin that contains the cut needs
    /// comparisons.
    void apply(std::span<SplitItem> items, Cut cut, const Binning& binning, const BinCounts& counts)
    {
        size_t bin = 0, before = 0;
        for (; before + counts[bin] < cut.left_count; ++bin)
            before += counts[bin];
        // without branches, which would be unpredictable: each item is written to all three destinations, and
        // one is kept
        size_t left = 0, right = 0, middle = items.size();
        for (const SplitItem item : items)
        {
            const auto b = static_cast<size_t>(binning(item)[cut.axis]);
            items[left] = item;
            scratch_[right] = item;
            scratch_[middle - 1] = item;
            left += b < bin ? 1 : 0;
            right += b > bin ? 1 : 0;
            middle -= b == bin ? 1 : 0;
        }
        const auto of_bin = std::span(scratch_.get() + middle, items.size() - middle);
        moveToFront(of_bin, cut.axis, cut.left_count - before);
        std::copy(of_bin.begin(), of_bin.end(), items.begin() + static_cast<ptrdiff_t>(left));
        std::copy_n(scratch_.get(), right, items.end() - static_cast<ptrdiff_t>(right));
    }

    /// Partition by comparison. Ties are ordered by triangle: one result on every machine.
    static void moveToFront(std::span<SplitItem> items, size_t axis, size_t count)
    {
        const auto order = [&](const SplitItem& a, const SplitItem& b)
        {
            const float x = centerLanes(a)[axis], y = centerLanes(b)[axis];
            return x < y || (x == y && a.triangle < b.triangle);
        };
        std::nth_element(items.begin(), items.begin() + static_cast<ptrdiff_t>(count), items.end(), order);
    }

    std::unique_ptr<SplitItem[]> scratch_; ///< items of the right half and of the bin that contains the cut
};

/// Return the average triangles of a cluster of these items before it reaches the vertex limit.
size_t clusterCapacity(std::span<const SplitItem> items, const SplitTriangles& triangles)
{
    std::vector<VertexId> vertices;
    vertices.reserve(items.size() * 3);
    for (const SplitItem& item : items)
        for (const VertexId vertex : triangles.corners.triangle(item.triangle))
            vertices.push_back(vertex);
    std::sort(vertices.begin(), vertices.end());
    const auto unique = static_cast<size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
    return std::clamp<size_t>(triangles.vertex_limit * items.size() / unique, 1, kMaxClusterTriangles);
}

/// Cut `root` into clusters of up to `capacity` triangles, depth first without recursion. A cluster with too
/// many vertices is halved, or, without `halve`, ends the function with false.
bool splitNode(std::span<SplitItem> root, size_t capacity, bool halve, const SplitTriangles& triangles,
               NodeCutter& cutNode, ClusterStore& out)
{
    std::vector<std::span<SplitItem>> stack{root};
    while (!stack.empty())
    {
        const std::span<SplitItem> items = stack.back();
        stack.pop_back();
        size_t part = capacity;
        if (items.size() <= capacity)
        {
            if (appendLeaf(items, triangles, out))
                continue;
            if (!halve)
                return false;
            part = (items.size() + 1) / 2;
        }
        const size_t left = cutNode(items, part);
        HEARTH_ASSERT(left > 0 && left < items.size());
        stack.push_back(items.subspan(left));
        stack.push_back(items.first(left));
    }
    return true;
}

/// Cut a node whose clusters share vertices uniformly: into full clusters if their vertices fit, else into
/// smaller ones of the size that fits.
void splitUniformNode(std::span<SplitItem> items, const SplitTriangles& triangles, NodeCutter& cutNode,
                      ClusterStore& out)
{
    const size_t shape_count = out.shapes.size();
    const size_t vertex_count = out.vertices.size();
    const size_t index_count = out.indices.size();
    if (splitNode(items, kMaxClusterTriangles, false, triangles, cutNode, out))
        return;
    out.shapes.resize(shape_count);
    out.vertices.resize(vertex_count);
    out.indices.resize(index_count);
    out.errors.resize(index_count / 3);
    splitNode(items, clusterCapacity(items, triangles), true, triangles, cutNode, out);
}

/// Split the top of the tree, one level of nodes at a time, until they are small enough to be split one per
/// task.
std::vector<std::span<SplitItem>> splitTop(std::span<SplitItem> items)
{
    std::vector<std::span<SplitItem>> nodes{items};
    for (bool changed = true; changed;)
    {
        std::vector<std::array<std::span<SplitItem>, 2>> halves(nodes.size());
        tbb::parallel_for(size_t{0}, nodes.size(),
                          [&](size_t i)
                          {
                              halves[i] = {nodes[i], {}};
                              if (nodes[i].size() <= kMaxSearchedItems)
                                  return;
                              const size_t left = NodeCutter(nodes[i].size())(nodes[i], kMaxClusterTriangles);
                              halves[i] = {nodes[i].first(left), nodes[i].subspan(left)};
                          });
        changed = false;
        nodes.clear();
        for (const auto& [left, right] : halves)
        {
            nodes.push_back(left);
            if (!right.empty())
                nodes.push_back(right);
            changed |= !right.empty();
        }
    }
    return nodes;
}

/// Return the triangles ordered by material, with their centers.
std::vector<SplitItem> makeSplitItems(const PreparedMesh& mesh)
{
    const IdSpan<VertexId, const Float3> positions = mesh.positions();
    IdVector<TriangleId, Float3> centers(mesh.triangleCount());
    for (const TriangleId triangle : centers.ids())
    {
        const auto [a, b, c] = mesh.corners.triangle(triangle);
        centers[triangle] = triangleCenter(positions[a], positions[b], positions[c]);
    }
    moveToIslandCenters<VertexId>(centers, mesh.corners, positions.size());
    std::vector<SplitItem> items;
    items.reserve(centers.size());
    for (const TriangleId triangle : centers.ids())
        items.push_back({centers[triangle], triangle});
    const IdSpan<TriangleId, const uint32_t> materials = mesh.materials;
    const bool mixed = std::any_of(materials.begin(), materials.end(),
                                   [&](uint32_t material) { return material != materials.front(); });
    if (mixed)
        std::stable_sort(items.begin(), items.end(),
                         [&](const SplitItem& a, const SplitItem& b)
                         { return materials[a.triangle] < materials[b.triangle]; });
    return items;
}

} // namespace

void splitIntoClusters(std::span<SplitItem> items, const SplitTriangles& triangles, ClusterStore& out)
{
    HEARTH_ASSERT(!items.empty());
    HEARTH_ASSERT(triangles.vertex_limit >= 3 && triangles.vertex_limit <= kMaxClusterVertices);
    HEARTH_ASSERT(triangles.errors.size() == triangles.corners.triangleCount());
    const size_t error_count = out.errors.size();
    NodeCutter cutNode(items.size());
    std::vector<std::span<SplitItem>> stack{items};
    while (!stack.empty())
    {
        const std::span<SplitItem> node = stack.back();
        stack.pop_back();
        if (node.size() <= kMaxUniformNode)
        {
            splitUniformNode(node, triangles, cutNode, out);
            continue;
        }
        const size_t left = cutNode(node, kMaxClusterTriangles);
        stack.push_back(node.subspan(left));
        stack.push_back(node.first(left));
    }
    HEARTH_ASSERT(out.errors.size() == error_count + items.size());
    HEARTH_ASSERT(out.indices.size() == out.errors.size() * 3);
}

ClusterStore splitMesh(const PreparedMesh& mesh)
{
    HEARTH_ASSERT(mesh.materials.size() == mesh.triangleCount());
    std::vector<SplitItem> items = makeSplitItems(mesh);
    const IdVector<TriangleId, float> errors(mesh.triangleCount(), mesh.grid.error);
    ClusterStore out;
    for (size_t first = 0; first < items.size();)
    {
        const uint32_t material = mesh.materials[items[first].triangle];
        size_t last = first;
        while (last < items.size() && mesh.materials[items[last].triangle] == material)
            ++last;
        const auto nodes = splitTop(std::span(items).subspan(first, last - first));
        const SplitTriangles triangles{mesh.corners, errors, material, clusterVertexLimit(mesh)};
        std::vector<ClusterStore> parts(nodes.size());
        tbb::parallel_for(size_t{0}, nodes.size(),
                          [&](size_t i) { splitIntoClusters(nodes[i], triangles, parts[i]); });
        for (ClusterStore& part : parts)
        {
            out.append(part);
            part = {};
        }
        first = last;
    }
    HEARTH_ASSERT(out.errors.size() == mesh.triangleCount());
    return out;
}

} // namespace hearth::clusters
