// Surface-area cost as for ray-tracing hierarchies: J. D. MacDonald, K. S. Booth, "Heuristics for ray tracing using
// space subdivision", 1990; bins: I. Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/split.h"

#include "cook/clusters/islands.h"
#include "cook/clusters/lanes.h"
#include "formats/assert.h"

#include <algorithm>
#include <array>

#include <tbb/parallel_for.h>

namespace hearth::clusters
{

namespace
{

using formats::kClusterMaxTriangles;
using formats::kClusterMaxVertices;

constexpr size_t kBinCount = 32;

// Nodes above this are cut at the median of their longest side: where the top cuts go does not change the clusters
// measurably, and a histogram of one axis costs a third of the full search.
constexpr size_t kMedianOnly = 32768;

// Nodes up to this size are taken to be alike all over in how many vertices their triangles share.
constexpr size_t kEvenNode = 2048;

struct Cut
{
    int axis = 0;
    size_t left_count = 0;
};

/// Gives the vertices of a cluster their numbers 0, 1, ... in order of first use.
class VertexNumbers
{
public:
    explicit VertexNumbers(uint32_t limit) : limit_(limit) {}

    /// Number of `vertex`, or kClusterMaxVertices if it would be one too many.
    uint32_t numberOf(uint32_t vertex)
    {
        uint32_t slot = (vertex * 0x9E3779B1u) >> 22;
        while (numbers_[slot] != kFree)
        {
            if (vertices_[numbers_[slot]] == vertex)
                return numbers_[slot];
            slot = (slot + 1) % kSlotCount;
        }
        if (count_ == limit_)
            return kClusterMaxVertices;
        numbers_[slot] = static_cast<uint16_t>(count_);
        vertices_[count_] = vertex;
        return count_++;
    }

    std::span<const uint32_t> vertices() const { return std::span(vertices_).first(count_); }

private:
    static constexpr uint32_t kSlotCount = 1024; ///< four times what can be in it
    static constexpr uint16_t kFree = 0xFFFF;

    static constexpr std::array<uint16_t, kSlotCount> allFree()
    {
        std::array<uint16_t, kSlotCount> slots{};
        slots.fill(kFree);
        return slots;
    }

    std::array<uint16_t, kSlotCount> numbers_ = allFree();
    std::array<uint32_t, kClusterMaxVertices> vertices_;
    uint32_t limit_;
    uint32_t count_ = 0;
};

/// Append the items as one cluster; false if they have too many vertices.
bool appendLeaf(std::span<const SplitItem> items, const SplitTriangles& triangles, ClusterStore& out)
{
    VertexNumbers numbers(triangles.vertex_limit);
    std::array<uint8_t, kClusterMaxTriangles * 3> indices;
    size_t index_count = 0;
    for (const SplitItem& item : items)
        for (size_t k = 0; k < 3; ++k)
        {
            const uint32_t number = numbers.numberOf(triangles.corners[size_t{item.triangle} * 3 + k]);
            if (number == kClusterMaxVertices)
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

/// A box in the first three lanes.
struct LaneBox
{
    Lanes min = allLanes(std::numeric_limits<float>::infinity());
    Lanes max = allLanes(-std::numeric_limits<float>::infinity());

    void add(Lanes point)
    {
        min = minimum(min, point);
        max = maximum(max, point);
    }
    Box3 box() const { return {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}}; }
};

/// An item's center in the first three lanes.
Lanes centerLanes(const SplitItem& item)
{
    return Lanes{item.center.x, item.center.y, item.center.z, 0};
}

Box3 boxOf(std::span<const SplitItem> items)
{
    LaneBox box;
    for (const SplitItem& item : items)
        box.add(centerLanes(item));
    return box.box();
}

/// Half the surface of a box, in double: coordinates may be as large as floats go.
double halfArea(const Box3& box)
{
    if (box.empty())
        return 0;
    const double x = double{box.max.x} - box.min.x;
    const double y = double{box.max.y} - box.min.y;
    const double z = double{box.max.z} - box.min.z;
    return x * y + y * z + z * x;
}

/// Maps coordinates to bins of each axis, safely for any finite range: halves do not overflow.
class Binning
{
public:
    explicit Binning(const Box3& box)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            const double extent = (double{box.max[axis]} - box.min[axis]) * 0.5;
            const auto lane = static_cast<size_t>(axis);
            half_low_[lane] = box.min[axis] * 0.5f;
            // an axis too short for floats has one bin
            if (extent > 1e-35)
                scale_[lane] = static_cast<float>(kBinCount / extent);
        }
    }

    LaneMask operator()(Lanes center) const
    {
        const Lanes bin = (center * allLanes(0.5f) - half_low_) * scale_;
        return __builtin_convertvector(minimum(bin, allLanes(kBinCount - 1)), LaneMask);
    }

private:
    Lanes half_low_{};
    Lanes scale_{};
};

/// The multiple of `capacity` nearest to `count` that leaves something on both sides.
size_t roundToFull(size_t count, size_t total, size_t capacity)
{
    const size_t last = (total - 1) / capacity * capacity;
    return std::clamp((count + capacity / 2) / capacity * capacity, capacity, last);
}

int longestAxis(const Box3& box)
{
    const double x = double{box.max.x} - box.min.x;
    const double y = double{box.max.y} - box.min.y;
    const double z = double{box.max.z} - box.min.z;
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

Cut medianCut(const Box3& box, size_t count, size_t capacity)
{
    return {longestAxis(box), roundToFull(count / 2, count, capacity)};
}

struct AxisCost
{
    double cost;
    Cut cut;
};

struct Bins
{
    std::array<LaneBox, kBinCount> boxes;
    std::array<size_t, kBinCount> counts{};
};

/// The cheapest bin border along one axis. Counts are rounded to full clusters before they are weighed.
AxisCost bestCutOfAxis(const Bins& bins, int axis, size_t item_count, size_t capacity)
{
    std::array<Box3, kBinCount> boxes;
    for (size_t b = 0; b < kBinCount; ++b)
        boxes[b] = bins.boxes[b].box();
    std::array<double, kBinCount> right_area{};
    Box3 right;
    for (size_t b = kBinCount; b-- > 1;)
    {
        right.add(boxes[b]);
        right_area[b] = halfArea(right);
    }
    AxisCost best{std::numeric_limits<double>::infinity(), {axis, 0}};
    Box3 left;
    size_t left_count = 0;
    for (size_t b = 0; b + 1 < kBinCount; ++b)
    {
        left.add(boxes[b]);
        left_count += bins.counts[b];
        const size_t cut = roundToFull(left_count, item_count, capacity);
        const double cost = halfArea(left) * static_cast<double>(cut) +
                            right_area[b + 1] * static_cast<double>(item_count - cut);
        if (left_count > 0 && left_count < item_count && cost < best.cost)
            best = {cost, {axis, cut}};
    }
    return best;
}

Cut bestCut(std::span<const SplitItem> items, size_t capacity)
{
    const Box3 box = boxOf(items);
    if (items.size() > kMedianOnly)
        return medianCut(box, items.size(), capacity);
    const Binning binning(box);
    std::array<Bins, 3> bins;
    for (const SplitItem& item : items)
    {
        const Lanes center = centerLanes(item);
        const LaneMask bin = binning(center);
        for (size_t axis = 0; axis < 3; ++axis)
        {
            const auto b = static_cast<size_t>(bin[axis]);
            bins[axis].boxes[b].add(center);
            ++bins[axis].counts[b];
        }
    }
    AxisCost best{std::numeric_limits<double>::infinity(), medianCut(box, items.size(), capacity)};
    for (int axis = 0; axis < 3; ++axis)
        if (box.max[axis] > box.min[axis])
            if (const AxisCost found =
                    bestCutOfAxis(bins[static_cast<size_t>(axis)], axis, items.size(), capacity);
                found.cost < best.cost)
                best = found;
    return best.cut;
}

/// Move the `count` items that are first along an axis to the front. Ties go by triangle: one result on every machine.
template <float Float3::*axis>
void moveToFront(std::span<SplitItem> items, size_t count)
{
    const auto order = [](const SplitItem& a, const SplitItem& b)
    {
        const float x = a.center.*axis;
        const float y = b.center.*axis;
        return x < y || (x == y && a.triangle < b.triangle);
    };
    std::nth_element(items.begin(), items.begin() + static_cast<ptrdiff_t>(count), items.end(), order);
}

void applyCut(std::span<SplitItem> items, Cut cut)
{
    if (cut.axis == 0)
        moveToFront<&Float3::x>(items, cut.left_count);
    else if (cut.axis == 1)
        moveToFront<&Float3::y>(items, cut.left_count);
    else
        moveToFront<&Float3::z>(items, cut.left_count);
}

/// Triangles that a cluster of these items can have on average before its vertices run out.
size_t clusterCapacity(std::span<const SplitItem> items, const SplitTriangles& triangles)
{
    std::vector<uint32_t> vertices;
    vertices.reserve(items.size() * 3);
    for (const SplitItem& item : items)
        for (size_t k = 0; k < 3; ++k)
            vertices.push_back(triangles.corners[size_t{item.triangle} * 3 + k]);
    std::sort(vertices.begin(), vertices.end());
    const auto unique = static_cast<size_t>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
    return std::clamp<size_t>(triangles.vertex_limit * items.size() / unique, 1, kClusterMaxTriangles);
}

/// Cut `root` into clusters of up to `capacity` triangles, depth first without recursion. A cluster with too many
/// vertices is halved, or ends the work with false.
bool splitNode(std::span<SplitItem> root, size_t capacity, bool halve, const SplitTriangles& triangles,
               ClusterStore& out)
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
        const Cut cut = bestCut(items, part);
        applyCut(items, cut);
        stack.push_back(items.subspan(cut.left_count));
        stack.push_back(items.first(cut.left_count));
    }
    return true;
}

/// Cut a node whose clusters share vertices about evenly: into full clusters if their vertices suffice, else again
/// into smaller ones of the size for which they do.
void splitEvenNode(std::span<SplitItem> items, const SplitTriangles& triangles, ClusterStore& out)
{
    const size_t shape_count = out.shapes.size();
    const size_t vertex_count = out.vertices.size();
    const size_t index_count = out.indices.size();
    if (splitNode(items, kClusterMaxTriangles, false, triangles, out))
        return;
    out.shapes.resize(shape_count);
    out.vertices.resize(vertex_count);
    out.indices.resize(index_count);
    out.errors.resize(index_count / 3);
    splitNode(items, clusterCapacity(items, triangles), true, triangles, out);
}

/// The top of the tree, a wave of nodes at a time, until they are small enough to be split one per task.
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
                              if (nodes[i].size() <= kMedianOnly)
                                  return;
                              const Cut cut = bestCut(nodes[i], kClusterMaxTriangles);
                              applyCut(nodes[i], cut);
                              halves[i] = {nodes[i].first(cut.left_count), nodes[i].subspan(cut.left_count)};
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

/// The triangles ordered by material, with their centers.
std::vector<SplitItem> itemsOf(const PreparedMesh& mesh)
{
    std::vector<Float3> centers(mesh.triangleCount());
    for (size_t t = 0; t < centers.size(); ++t)
    {
        const uint32_t* corner = &mesh.corners[t * 3];
        const auto place = [&](size_t k) { return mesh.vertices.positions[corner[k]]; };
        centers[t] = triangleCenter(place(0), place(1), place(2));
    }
    gatherSmallIslands(centers, mesh.corners, mesh.vertices.vertexCount());
    std::vector<SplitItem> items(centers.size());
    for (uint32_t t = 0; t < items.size(); ++t)
        items[t] = {centers[t], t};
    const auto materials = std::span(mesh.materials);
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
    std::vector<std::span<SplitItem>> stack{items};
    while (!stack.empty())
    {
        const std::span<SplitItem> node = stack.back();
        stack.pop_back();
        if (node.size() <= kEvenNode)
        {
            splitEvenNode(node, triangles, out);
            continue;
        }
        const Cut cut = bestCut(node, kClusterMaxTriangles);
        applyCut(node, cut);
        stack.push_back(node.subspan(cut.left_count));
        stack.push_back(node.first(cut.left_count));
    }
}

ClusterStore splitMesh(const PreparedMesh& mesh)
{
    std::vector<SplitItem> items = itemsOf(mesh);
    const std::vector<float> errors(mesh.triangleCount(), mesh.grid.error);
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
    return out;
}

} // namespace hearth::clusters
