// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/edge_split.h"

#include "formats/base/assert.h"
#include "formats/base/index.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace hearth::mesh
{

namespace
{

using Corners = std::array<uint32_t, 3>;

/// One round: splits each edge that is too long once.
class SplitRound
{
public:
    SplitRound(const SplitSurface& surface, float max_length)
        : surface_(surface), max_length2_(double{max_length} * double{max_length})
    {
        split_.positions = surface.positions;
    }

    SplitSurface run()
    {
        for (size_t t = 0; t < surface_.source_triangle.size(); ++t)
        {
            const uint32_t* corners = &surface_.indices[t * 3];
            source_triangle_ = surface_.source_triangle[t];
            split({corners[0], corners[1], corners[2]});
        }
        return std::move(split_);
    }

    bool hasSplit() const { return !middles_.empty(); }

private:
    double length2(uint32_t a, uint32_t b) const
    {
        const Double3 edge = widen(split_.positions[b]) - widen(split_.positions[a]);
        return dot(edge, edge);
    }

    /// Return the middle of an edge, kInvalidIndex if it is not split.
    uint32_t findMiddle(uint32_t a, uint32_t b)
    {
        if (length2(a, b) <= max_length2_)
            return kInvalidIndex;
        const uint64_t edge = uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        const auto [found, is_new] = middles_.emplace(edge, static_cast<uint32_t>(split_.positions.size()));
        if (is_new)
        {
            const Float3 middle = (split_.positions[a] + split_.positions[b]) * 0.5f;
            split_.positions.push_back(middle);
        }
        return found->second;
    }

    void add(uint32_t a, uint32_t b, uint32_t c)
    {
        split_.indices.insert(split_.indices.end(), {a, b, c});
        split_.source_triangle.push_back(source_triangle_);
    }

    void split(const Corners& corners)
    {
        Corners middles; // of the edges from each corner to the next
        for (size_t k = 0; k < 3; ++k)
            middles[k] = findMiddle(corners[k], corners[(k + 1) % 3]);
        const auto count = std::ranges::count_if(middles, [](uint32_t m) { return m != kInvalidIndex; });
        if (count == 0)
            return add(corners[0], corners[1], corners[2]);
        if (count == 3)
        {
            for (size_t k = 0; k < 3; ++k)
                add(corners[k], middles[k], middles[(k + 2) % 3]);
            return add(middles[0], middles[1], middles[2]);
        }
        // first edge of the corner a is split; with two, the last one is not
        size_t k = 0;
        while (middles[k] == kInvalidIndex || (count == 2 && middles[(k + 1) % 3] == kInvalidIndex))
            ++k;
        const uint32_t a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
        const uint32_t ab = middles[k], bc = middles[(k + 1) % 3];
        if (count == 1)
        {
            add(a, ab, c);
            return add(ab, b, c);
        }
        add(ab, b, bc);
        if (length2(a, bc) < length2(ab, c))
        {
            add(a, ab, bc);
            return add(a, bc, c);
        }
        add(a, ab, c);
        add(ab, bc, c);
    }

    const SplitSurface& surface_;
    const double max_length2_;
    SplitSurface split_;
    std::unordered_map<uint64_t, uint32_t> middles_;
    uint32_t source_triangle_ = 0;
};

} // namespace

std::optional<SplitSurface> splitLongEdges(std::span<const Float3> positions,
                                           std::span<const uint32_t> indices, float max_length,
                                           size_t max_triangles)
{
    HEARTH_ASSERT(max_length > 0);
    SplitSurface surface{{positions.begin(), positions.end()}, {indices.begin(), indices.end()}, {}};
    for (uint32_t t = 0; t < indices.size() / 3; ++t)
        surface.source_triangle.push_back(t);
    while (surface.source_triangle.size() <= max_triangles)
    {
        SplitRound round(surface, max_length);
        SplitSurface split = round.run();
        if (!round.hasSplit())
            return surface;
        surface = std::move(split);
    }
    return std::nullopt;
}

} // namespace hearth::mesh
