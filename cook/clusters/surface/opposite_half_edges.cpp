// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/opposite_half_edges.h"

#include "cook/clusters/core/lanes.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace hearth::clusters
{

namespace
{

constexpr HalfEdgeId kNonManifold{kInvalidIndex - 1};

using Numbers = uint32_t __attribute__((vector_size(kLanes * sizeof(uint32_t))));

uint32_t sumNumbers(Numbers x)
{
    return (x[0] + x[1]) + (x[2] + x[3]);
}

/// Half-edges that arrive at one position from larger ids: most positions have about three. Compares all at
/// once, because a branch on each comparison would be unpredictable.
struct IncomingHalfEdges
{
    static constexpr size_t kSlots = 2 * kLanes;
    std::array<PositionId, kSlots> start; ///< kInvalid in unused slots
    std::array<HalfEdgeId, kSlots> half_edge;

    struct Found
    {
        uint32_t count;
        HalfEdgeId half_edge; ///< valid if the count is one
    };
    Found find(PositionId position) const
    {
        Numbers count{}, found{};
        for (size_t first = 0; first < kSlots; first += kLanes)
        {
            Numbers starts, half_edges;
            std::memcpy(&starts, &start[first], sizeof(starts));
            std::memcpy(&half_edges, &half_edge[first], sizeof(half_edges));
            const auto hit = reinterpret_cast<Numbers>(starts == toIndex(position));
            count -= hit;
            found += hit & half_edges;
        }
        return {sumNumbers(count), HalfEdgeId{sumNumbers(found)}};
    }
};

constexpr IncomingHalfEdges kNoIncoming{
    {kInvalid, kInvalid, kInvalid, kInvalid, kInvalid, kInvalid, kInvalid, kInvalid}, {}};

class OppositeFinder
{
public:
    OppositeFinder(CornerSpan<const PositionId> positions, size_t position_count)
        : positions_(positions),
          count_at_(position_count, 0),
          incoming_(position_count, kNoIncoming),
          opposites_(positions.size(), kInvalid)
    {
    }

    IdVector<HalfEdgeId, HalfEdgeId> run()
    {
        sort();
        for (const HalfEdgeId half_edge : rising_)
            findOpposite(half_edge);
        if (non_manifold_)
            std::replace(opposites_.begin(), opposites_.end(), kNonManifold, HalfEdgeId{kInvalid});
        return std::move(opposites_);
    }

private:
    void sort()
    {
        rising_.resize(positions_.size());
        size_t rising_count = 0;
        for (const TriangleId triangle : positions_.triangles())
            for (uint32_t k = 0; k < 3; ++k)
            {
                const HalfEdgeId half_edge = makeCorner(triangle, k);
                const PositionId start = positions_[half_edge],
                                 end = positions_[makeCorner(triangle, k == 2 ? 0 : k + 1)];
                rising_[rising_count] = half_edge;
                rising_count += start < end ? 1 : 0;
                uint32_t& count = count_at_[end];
                if (count < IncomingHalfEdges::kSlots)
                {
                    // a half-edge to a larger id does not count: the next one overwrites it
                    incoming_[end].start[count] = start;
                    incoming_[end].half_edge[count] = half_edge;
                }
                else if (start > end)
                    overflow_.push_back(half_edge);
                count += start > end ? 1 : 0;
            }
        rising_.resize(rising_count);
        // terminate each list
        for (const PositionId position : count_at_.ids())
            if (const uint32_t count = count_at_[position]; count < IncomingHalfEdges::kSlots)
                incoming_[position].start[count] = kInvalid;
    }

    void findOpposite(HalfEdgeId half_edge)
    {
        const PositionId start = positions_[half_edge], end = positions_[nextHalfEdge(half_edge)];
        const IncomingHalfEdges& incoming = incoming_[start];
        if (const IncomingHalfEdges::Found found = incoming.find(end); found.count == 1)
            pair(half_edge, found.half_edge);
        else if (found.count > 1)
            for (size_t i = 0; i < IncomingHalfEdges::kSlots; ++i)
                if (incoming.start[i] == end)
                    pair(half_edge, incoming.half_edge[i]);
        if (count_at_[start] > IncomingHalfEdges::kSlots)
            for (const HalfEdgeId other : overflow_)
                if (positions_[other] == end && positions_[nextHalfEdge(other)] == start)
                    pair(half_edge, other);
    }

    void pair(HalfEdgeId half_edge, HalfEdgeId back)
    {
        if (opposites_[half_edge] == kInvalid && opposites_[back] == kInvalid)
        {
            opposites_[half_edge] = back;
            opposites_[back] = half_edge;
            return;
        }
        non_manifold_ = true;
        for (const HalfEdgeId one : {half_edge, back})
            if (const HalfEdgeId other = std::exchange(opposites_[one], kNonManifold); other < kNonManifold)
                opposites_[other] = kNonManifold;
    }

    CornerSpan<const PositionId> positions_;
    IdVector<PositionId, uint32_t> count_at_; ///< half-edges that arrive from larger ids
    IdVector<PositionId, IncomingHalfEdges> incoming_;
    std::vector<HalfEdgeId> rising_;   ///< half-edges to a larger id
    std::vector<HalfEdgeId> overflow_; ///< half-edges to a smaller id that did not fit
    IdVector<HalfEdgeId, HalfEdgeId> opposites_;
    bool non_manifold_ = false; ///< several half-edges run in the same direction between the same positions
};

/// True if each opposite of a half-edge has that half-edge as its own.
[[maybe_unused]] bool arePairs(IdSpan<HalfEdgeId, const HalfEdgeId> opposites)
{
    const auto half_edges = opposites.ids();
    return std::all_of(half_edges.begin(), half_edges.end(),
                       [&](HalfEdgeId half_edge)
                       {
                           const HalfEdgeId opposite = opposites[half_edge];
                           return opposite == kInvalid || opposites[opposite] == half_edge;
                       });
}

} // namespace

IdVector<HalfEdgeId, HalfEdgeId> findOppositeHalfEdges(CornerSpan<const PositionId> positions,
                                                       size_t position_count)
{
    HEARTH_ASSERT(positions.size() % 3 == 0);
    HEARTH_RUNTIME_ASSERT(allBelow(positions, position_count));
    IdVector<HalfEdgeId, HalfEdgeId> opposites = OppositeFinder(positions, position_count).run();
    HEARTH_RUNTIME_ASSERT(arePairs(opposites));
    return opposites;
}

} // namespace hearth::clusters
