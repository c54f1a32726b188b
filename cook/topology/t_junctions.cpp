// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/t_junctions.h"

#include "cook/topology/box_tree.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <tbb/parallel_for.h>

namespace hearth::topology
{

namespace
{

/// Edge as a segment, for tests of distances.
class Segment
{
public:
    Segment(Float3 from, Float3 to, double tolerance)
        : from_(widen(from)),
          direction_(widen(to) - widen(from)),
          middle_(from_ + direction_ * 0.5),
          half_(direction_ * 0.5),
          tolerance_(tolerance)
    {
    }

    /// True if the box, grown by the tolerance, meets the segment: no axis of a box or a cross product
    /// with one separates them.
    bool meets(const Box3& box) const
    {
        const Double3 min = widen(box.min), max = widen(box.max);
        const Double3 offset = (min + max) * 0.5 - middle_;
        const Double3 size = (max - min) * 0.5 + Double3{tolerance_, tolerance_, tolerance_};
        const Double3 reach{std::abs(half_.x), std::abs(half_.y), std::abs(half_.z)};
        return std::abs(offset.x) <= size.x + reach.x && std::abs(offset.y) <= size.y + reach.y &&
               std::abs(offset.z) <= size.z + reach.z &&
               std::abs(half_.y * offset.z - half_.z * offset.y) <= size.y * reach.z + size.z * reach.y &&
               std::abs(half_.z * offset.x - half_.x * offset.z) <= size.z * reach.x + size.x * reach.z &&
               std::abs(half_.x * offset.y - half_.y * offset.x) <= size.x * reach.y + size.y * reach.x;
    }

    /// True if the point lies within the segment.
    bool contains(Float3 point) const
    {
        const Double3 offset = widen(point) - from_;
        const double length2 = dot(direction_, direction_);
        const double along = dot(offset, direction_) / length2;
        if (along <= 0 || along >= 1)
            return false;
        const double to_start = length(offset), to_end = length(offset - direction_);
        return length(offset - direction_ * along) <= tolerance_ && to_start > tolerance_ &&
               to_end > tolerance_;
    }

private:
    Double3 from_;
    Double3 direction_;
    Double3 middle_;
    Double3 half_;
    double tolerance_;
};

/// Return the positions that triangles use.
std::vector<uint32_t> findUsedPositions(const Surface& surface)
{
    std::vector<bool> is_used(surface.positions.size(), false);
    for (const uint32_t corner : surface.corners)
        is_used[corner] = true;
    std::vector<uint32_t> used;
    for (uint32_t position = 0; position < is_used.size(); ++position)
        if (is_used[position])
            used.push_back(position);
    return used;
}

} // namespace

std::vector<TJunction> findTJunctions(const Surface& surface, const Edges& edges, double tolerance)
{
    const std::vector<uint32_t> used = findUsedPositions(surface);
    std::vector<Box3> boxes(used.size());
    std::transform(used.begin(), used.end(), boxes.begin(),
                   [&](uint32_t position) {
                       return Box3{surface.positions[position], surface.positions[position]};
                   });
    const BoxTree tree(boxes);

    constexpr size_t kChunkEdges = 4096;
    std::vector<std::vector<TJunction>> found_of_chunk((edges.edges.size() + kChunkEdges - 1) / kChunkEdges);
    tbb::parallel_for(
        size_t{0}, found_of_chunk.size(),
        [&](size_t chunk)
        {
            std::vector<TJunction>& found = found_of_chunk[chunk];
            const size_t end = std::min((chunk + 1) * kChunkEdges, edges.edges.size());
            for (size_t e = chunk * kChunkEdges; e < end; ++e)
            {
                const Edge& edge = edges.edges[e];
                const Segment segment(surface.positions[edge.from], surface.positions[edge.to], tolerance);
                const auto isOwn = [&](uint32_t position)
                {
                    if (position == edge.from || position == edge.to)
                        return true;
                    const std::span<const uint32_t> half_edges = edges.halfEdges(edge);
                    return std::any_of(half_edges.begin(), half_edges.end(),
                                       [&](uint32_t half_edge)
                                       { return surface.corners[previousHalfEdge(half_edge)] == position; });
                };
                const size_t first = found.size();
                tree.visit([&](const Box3& box) { return segment.meets(box); },
                           [&](uint32_t i)
                           {
                               if (segment.contains(surface.positions[used[i]]) && !isOwn(used[i]))
                                   found.push_back({static_cast<uint32_t>(e), used[i]});
                           });
                std::sort(found.begin() + static_cast<ptrdiff_t>(first), found.end(),
                          [](const TJunction& a, const TJunction& b) { return a.position < b.position; });
            }
        });
    std::vector<TJunction> all;
    for (const std::vector<TJunction>& found : found_of_chunk)
        all.insert(all.end(), found.begin(), found.end());
    return all;
}

} // namespace hearth::topology
