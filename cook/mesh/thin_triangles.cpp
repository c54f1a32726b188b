// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/thin_triangles.h"

#include "cook/mesh/interior_edges.h"
#include "formats/base/double3.h"
#include "formats/base/index.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace hearth::mesh
{

namespace
{

using CornerIndices = std::array<uint32_t, 3>;

// A flip or a collapse can make neighbours thin; the worst of the tested meshes needed four rounds.
constexpr int kRounds = 16;

// Maximum length of an edge of a thin triangle that is collapsed, by the longest edge, in units of thinness:
// a corner this close to an end of the longest edge would leave a thin triangle behind if that edge were
// flipped.
constexpr double kMaxCollapsedEdge = 4;

struct Shape
{
    double ratio;      ///< height / longest edge
    double shortest;   ///< shortest edge / longest edge
    int opposite;      ///< corner opposite to the longest edge
    int shortest_edge; ///< corner opposite to the shortest edge
};

Shape measureShape(std::span<const Float3> positions, const CornerIndices& corners)
{
    std::array<double, 3> length2;
    const std::array<Double3, 3> p{widen(positions[corners[0]]), widen(positions[corners[1]]),
                                   widen(positions[corners[2]])};
    for (size_t k = 0; k < 3; ++k)
    {
        const Double3 edge = p[(k + 2) % 3] - p[(k + 1) % 3];
        length2[k] = dot(edge, edge);
    }
    const auto longest = std::max_element(length2.begin(), length2.end());
    const auto shortest = std::min_element(length2.begin(), length2.end());
    if (!(*longest > 0))
        return {0, 0, 0, 0};
    return {length(cross(p[1] - p[0], p[2] - p[0])) / *longest, std::sqrt(*shortest / *longest),
            static_cast<int>(longest - length2.begin()), static_cast<int>(shortest - length2.begin())};
}

bool isDegenerate(const CornerIndices& c)
{
    return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
}

/// Triangles during cleaning. A triangle with two equal corners counts as removed.
class TriangleCleaner
{
public:
    TriangleCleaner(std::span<const Float3> positions, std::span<const uint32_t> indices, double thinness)
        : positions_(positions),
          thinness_(thinness),
          corners_(indices.size() / 3),
          flipped_(corners_.size(), false),
          reserved_round_(positions.size(), 0)
    {
        for (size_t t = 0; t < corners_.size(); ++t)
            corners_[t] = {indices[t * 3], indices[t * 3 + 1], indices[t * 3 + 2]};
        result_.collapse_target.resize(positions.size());
        std::iota(result_.collapse_target.begin(), result_.collapse_target.end(), 0u);
        result_.remaining_of_source.assign(corners_.size(), kInvalidIndex);
    }

    CleanTriangles clean()
    {
        collectLive();
        result_.statistics.degenerate = static_cast<uint32_t>(corners_.size() - live_.size() - duplicates_);
        result_.statistics.duplicate = duplicates_;
        for (int round = 0; round < kRounds && thinness_ > 0 && runRound(); ++round)
            collectLive();
        dropThin();
        finish();
        return std::move(result_);
    }

private:
    /// Collect live_: the triangles with three different corners, one for each set of three.
    void collectLive()
    {
        // vertices collapse into lower ones, which this loop has already resolved
        for (uint32_t& vertex : result_.collapse_target)
            vertex = result_.collapse_target[vertex];
        for (CornerIndices& corners : corners_)
            for (uint32_t& vertex : corners)
                vertex = result_.collapse_target[vertex];
        struct Key
        {
            CornerIndices sorted;
            uint32_t triangle;
        };
        std::vector<Key> keys;
        keys.reserve(corners_.size());
        for (uint32_t t = 0; t < corners_.size(); ++t)
        {
            if (isDegenerate(corners_[t]))
                continue;
            CornerIndices sorted = corners_[t];
            std::sort(sorted.begin(), sorted.end());
            keys.push_back({sorted, t});
        }
        std::sort(keys.begin(), keys.end(),
                  [](const Key& a, const Key& b)
                  { return a.sorted != b.sorted ? a.sorted < b.sorted : a.triangle < b.triangle; });
        live_.clear();
        duplicate_of_.assign(corners_.size(), kInvalidIndex);
        duplicates_ = 0;
        uint32_t first = kInvalidIndex;
        for (size_t i = 0; i < keys.size(); ++i)
        {
            if (i == 0 || keys[i].sorted != keys[i - 1].sorted)
            {
                first = keys[i].triangle;
                live_.push_back(first);
            }
            else
                ++duplicates_;
            duplicate_of_[keys[i].triangle] = first;
        }
        std::sort(live_.begin(), live_.end());
    }

    /// Run one round of collapses and flips that share no vertex. Return false if nothing changed.
    bool runRound()
    {
        ++round_;
        bool changed = false, edges_known = false;
        for (const uint32_t triangle : live_)
        {
            const Shape shape = measureShape(positions_, corners_[triangle]);
            if (shape.ratio >= thinness_)
                continue;
            if (shape.shortest <= kMaxCollapsedEdge * thinness_)
            {
                changed |= collapse(triangle, shape);
                continue;
            }
            if (!edges_known)
                findEdges();
            edges_known = true;
            changed |= flip(triangle, shape);
        }
        return changed;
    }

    /// Reserve vertices for this round. False if one of them is already reserved.
    bool reserveVertices(std::initializer_list<uint32_t> vertices)
    {
        for (const uint32_t vertex : vertices)
            if (reserved_round_[vertex] == round_)
                return false;
        for (const uint32_t vertex : vertices)
            reserved_round_[vertex] = round_;
        return true;
    }

    bool collapse(uint32_t triangle, const Shape& shape)
    {
        const CornerIndices& corners = corners_[triangle];
        const auto [low, high] = std::minmax(corners[static_cast<size_t>(shape.shortest_edge + 1) % 3],
                                             corners[static_cast<size_t>(shape.shortest_edge + 2) % 3]);
        if (!reserveVertices({low, high}))
            return false;
        result_.collapse_target[high] = low;
        ++result_.statistics.collapsed;
        return true;
    }

    /// Collect the edges of the live triangles at the start of the round.
    void findEdges()
    {
        std::vector<uint32_t> indices;
        indices.reserve(live_.size() * 3);
        for (const uint32_t triangle : live_)
            indices.insert(indices.end(), corners_[triangle].begin(), corners_[triangle].end());
        edges_ = findInteriorEdges(indices, positions_.size());
    }

    /// Return the triangle across the edge (a, b), and its third corner.
    std::pair<uint32_t, uint32_t> across(uint32_t triangle, uint32_t a, uint32_t b) const
    {
        const auto [low, high] = std::minmax(a, b);
        const auto edge = std::lower_bound(edges_.begin(), edges_.end(), std::pair(low, high),
                                           [](const InteriorEdge& e, const std::pair<uint32_t, uint32_t>& key)
                                           { return std::pair(e.a, e.b) < key; });
        if (edge == edges_.end() || edge->a != low || edge->b != high)
            return {kInvalidIndex, kInvalidIndex};
        const bool first = live_[edge->triangles[0]] == triangle;
        return {live_[edge->triangles[first ? 1 : 0]], first ? edge->l : edge->k};
    }

    bool flip(uint32_t triangle, const Shape& shape)
    {
        const CornerIndices corners = corners_[triangle];
        const auto k = static_cast<size_t>(shape.opposite);
        const uint32_t p = corners[k], a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        const auto [other, c] = across(triangle, a, b);
        if (other == kInvalidIndex || c == p)
            return false;
        const CornerIndices one{a, c, p}, two{c, b, p};
        const double before = std::min(shape.ratio, measureShape(positions_, corners_[other]).ratio);
        const double after =
            std::min(measureShape(positions_, one).ratio, measureShape(positions_, two).ratio);
        if (!(after > before) || !reserveVertices({a, b, c, p}))
            return false;
        corners_[triangle] = one;
        corners_[other] = two;
        flipped_[triangle] = flipped_[other] = true;
        ++result_.statistics.flipped;
        return true;
    }

    void dropThin()
    {
        const auto thin = [&](uint32_t triangle)
        { return thinness_ > 0 && measureShape(positions_, corners_[triangle]).ratio < thinness_; };
        const auto end = std::remove_if(live_.begin(), live_.end(), thin);
        result_.statistics.dropped = static_cast<uint32_t>(live_.end() - end);
        live_.erase(end, live_.end());
    }

    void finish()
    {
        std::vector<uint32_t> remaining_of_triangle(corners_.size(), kInvalidIndex);
        for (const uint32_t triangle : live_)
        {
            remaining_of_triangle[triangle] = static_cast<uint32_t>(result_.source.size());
            result_.source.push_back(flipped_[triangle] ? kInvalidIndex : triangle);
            result_.indices.insert(result_.indices.end(), corners_[triangle].begin(),
                                   corners_[triangle].end());
        }
        for (size_t t = 0; t < corners_.size(); ++t)
            if (duplicate_of_[t] != kInvalidIndex && !flipped_[t])
                result_.remaining_of_source[t] = remaining_of_triangle[duplicate_of_[t]];
    }

    std::span<const Float3> positions_;
    double thinness_;
    std::vector<CornerIndices> corners_;
    std::vector<bool> flipped_;
    std::vector<uint32_t> live_;
    std::vector<uint32_t> duplicate_of_; ///< live triangle with the same corners; kInvalidIndex if degenerate
    uint32_t duplicates_ = 0;
    std::vector<InteriorEdge> edges_;      ///< their triangles index live_
    std::vector<uint32_t> reserved_round_; ///< last round that changed each vertex
    uint32_t round_ = 0;
    CleanTriangles result_;
};

} // namespace

CleanTriangles removeThinTriangles(std::span<const Float3> positions, std::span<const uint32_t> indices,
                                   double thinness)
{
    return TriangleCleaner(positions, indices, thinness).clean();
}

} // namespace hearth::mesh
