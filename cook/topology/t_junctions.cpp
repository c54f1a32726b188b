// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/topology/t_junctions.h"

#include "cook/topology/box_tree.h"
#include "formats/base/double3.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>
#include <utility>

namespace hearth::topology
{

namespace
{

bool overlaps(const Box3& a, const Box3& b)
{
    return a.min.x <= b.max.x && a.max.x >= b.min.x && a.min.y <= b.max.y && a.max.y >= b.min.y &&
           a.min.z <= b.max.z && a.max.z >= b.min.z;
}

/// True if the sides of box a are no shorter than those of b.
bool isLarger(const Box3& a, const Box3& b)
{
    const Float3 size_a = a.max - a.min, size_b = b.max - b.min;
    return size_a.x >= size_b.x && size_a.y >= size_b.y && size_a.z >= size_b.z;
}

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
        // Comparing floats with a box decides most cases; it is a little larger, so that rounding costs none.
        const Float3 margin = narrow(Double3{tolerance, tolerance, tolerance} * 1.01);
        constexpr float kRounded = 0x1p-22f;
        const auto rounding = [](Float3 p) {
            return Float3{std::abs(p.x), std::abs(p.y), std::abs(p.z)} * kRounded;
        };
        box_ = {min(from - rounding(from), to - rounding(to)) - margin,
                max(from + rounding(from), to + rounding(to)) + margin};
    }

    /// True if the box, grown by the tolerance, may meet the segment: no axis of a box separates them, nor
    /// a cross product with one.
    bool meets(const Box3& box) const
    {
        if (!overlaps(box_, box))
            return false;
        if (isLarger(box, box_))
            return true; // cross products separate a segment from few boxes that are larger
        const Double3 min = widen(box.min), max = widen(box.max);
        const Double3 offset = (min + max) * 0.5 - middle_;
        const Double3 size = (max - min) * 0.5 + Double3{tolerance_, tolerance_, tolerance_};
        const Double3 reach{std::abs(half_.x), std::abs(half_.y), std::abs(half_.z)};
        return std::abs(half_.y * offset.z - half_.z * offset.y) <= size.y * reach.z + size.z * reach.y &&
               std::abs(half_.z * offset.x - half_.x * offset.z) <= size.z * reach.x + size.x * reach.z &&
               std::abs(half_.x * offset.y - half_.y * offset.x) <= size.x * reach.y + size.y * reach.x;
    }

    /// True if the point lies within the segment.
    bool contains(Float3 point) const
    {
        if (!overlaps(box_, {point, point}))
            return false;
        const Double3 offset = widen(point) - from_;
        const double along = dot(offset, direction_) / dot(direction_, direction_);
        if (along <= 0 || along >= 1)
            return false;
        return length(offset - direction_ * along) <= tolerance_ && length(offset) > tolerance_ &&
               length(offset - direction_) > tolerance_;
    }

    /// Return the box of the segment, grown by the tolerance.
    const Box3& box() const { return box_; }

private:
    Double3 from_;
    Double3 direction_;
    Double3 middle_;
    Double3 half_;
    double tolerance_;
    Box3 box_;
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

/// Searches vertices within edges.
class Search
{
public:
    Search(const Surface& surface, const Edges& edges, double tolerance)
        : surface_(surface),
          edges_(edges),
          tolerance_(tolerance),
          used_(findUsedPositions(surface)),
          tree_(makeBoxes(surface, used_))
    {
    }

    /// Find the vertices within edges of [first, end). Edges that start at one position search together,
    /// which takes half of the time.
    std::vector<TJunction> run(uint32_t first, uint32_t end) const
    {
        std::vector<TJunction> found;
        std::vector<Segment> segments;
        while (first < end)
        {
            segments.clear();
            Box3 box;
            const uint32_t from = edges_.edges[first].from;
            for (uint32_t e = first; e < std::min(first + kMaxTogether, end); ++e)
            {
                const Edge& edge = edges_.edges[e];
                if (edge.from != from)
                    break;
                segments.emplace_back(surface_.positions[from], surface_.positions[edge.to], tolerance_);
                box.add(segments.back().box());
            }
            search(first, segments, box, found);
            first += static_cast<uint32_t>(segments.size());
        }
        std::sort(found.begin(), found.end(),
                  [](const TJunction& a, const TJunction& b)
                  { return std::pair(a.edge, a.position) < std::pair(b.edge, b.position); });
        return found;
    }

private:
    /// Most positions start three edges. A hub of thousands must not test all its edges with each vertex.
    static constexpr uint32_t kMaxTogether = 8;

    static std::vector<Box3> makeBoxes(const Surface& surface, const std::vector<uint32_t>& used)
    {
        std::vector<Box3> boxes;
        for (const uint32_t position : used)
            boxes.push_back({surface.positions[position], surface.positions[position]});
        return boxes;
    }

    /// box  of all segments, the first of which is edge `first`
    void search(uint32_t first, std::span<const Segment> segments, const Box3& box,
                std::vector<TJunction>& found) const
    {
        const auto isNeeded = [&](const Box3& node)
        {
            return overlaps(node, box) &&
                   (isLarger(node, box) || std::any_of(segments.begin(), segments.end(),
                                                       [&](const Segment& s) { return s.meets(node); }));
        };
        tree_.visit(isNeeded,
                    [&](uint32_t i)
                    {
                        const Float3 point = surface_.positions[used_[i]];
                        if (!overlaps(box, {point, point}))
                            return;
                        for (uint32_t s = 0; s < segments.size(); ++s)
                            if (segments[s].contains(point) && !isCorner(edges_.edges[first + s], used_[i]))
                                found.push_back({first + s, used_[i]});
                    });
    }

    /// True if the position is a corner of a triangle at the edge.
    bool isCorner(const Edge& edge, uint32_t position) const
    {
        const std::span<const uint32_t> half_edges = edges_.halfEdges(edge);
        return position == edge.from || position == edge.to ||
               std::any_of(half_edges.begin(), half_edges.end(),
                           [&](uint32_t half_edge)
                           { return surface_.corners[previousHalfEdge(half_edge)] == position; });
    }

    const Surface& surface_;
    const Edges& edges_;
    double tolerance_;
    std::vector<uint32_t> used_;
    BoxTree tree_; ///< of used_
};

} // namespace

std::vector<TJunction> findTJunctions(const Surface& surface, const Edges& edges, double tolerance)
{
    const Search search(surface, edges, tolerance);
    constexpr uint32_t kChunkEdges = 4096;
    const auto count = static_cast<uint32_t>(edges.edges.size());
    std::vector<std::vector<TJunction>> found_of_chunk((count + kChunkEdges - 1) / kChunkEdges);
    tbb::parallel_for(size_t{0}, found_of_chunk.size(),
                      [&](size_t chunk)
                      {
                          const uint32_t first = static_cast<uint32_t>(chunk) * kChunkEdges;
                          found_of_chunk[chunk] = search.run(first, std::min(first + kChunkEdges, count));
                      });
    std::vector<TJunction> all;
    for (const std::vector<TJunction>& found : found_of_chunk)
        all.insert(all.end(), found.begin(), found.end());
    return all;
}

} // namespace hearth::topology
