// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/opposite_half_edges.h"

#include "cook/clusters/core/lanes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace hearth::clusters
{

namespace
{

constexpr uint32_t kNonManifold = kInvalidIndex - 1;

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
    std::array<uint32_t, kSlots> start; ///< kInvalidIndex in unused slots
    std::array<uint32_t, kSlots> half_edge;

    struct Found
    {
        uint32_t count;
        uint32_t half_edge; ///< valid if the count is one
    };
    Found find(uint32_t position) const
    {
        Numbers count{}, found{};
        for (size_t first = 0; first < kSlots; first += kLanes)
        {
            Numbers starts, half_edges;
            std::memcpy(&starts, &start[first], sizeof(starts));
            std::memcpy(&half_edges, &half_edge[first], sizeof(half_edges));
            const auto hit = reinterpret_cast<Numbers>(starts == position);
            count -= hit;
            found += hit & half_edges;
        }
        return {sumNumbers(count), sumNumbers(found)};
    }
};

constexpr IncomingHalfEdges kNoIncoming{{kInvalidIndex, kInvalidIndex, kInvalidIndex, kInvalidIndex,
                                         kInvalidIndex, kInvalidIndex, kInvalidIndex, kInvalidIndex},
                                        {}};

class OppositeFinder
{
public:
    OppositeFinder(std::span<const uint32_t> positions, size_t position_count)
        : positions_(positions),
          count_at_(position_count, 0),
          incoming_(position_count, kNoIncoming),
          opposites_(positions.size(), kInvalidIndex)
    {
    }

    std::vector<uint32_t> run()
    {
        sort();
        for (const uint32_t half_edge : rising_)
            findOpposite(half_edge);
        if (non_manifold_)
            std::replace(opposites_.begin(), opposites_.end(), kNonManifold, kInvalidIndex);
        return std::move(opposites_);
    }

private:
    void sort()
    {
        rising_.resize(positions_.size());
        size_t rising_count = 0;
        for (uint32_t first = 0; first < positions_.size(); first += 3)
            for (uint32_t k = 0; k < 3; ++k)
            {
                const uint32_t half_edge = first + k;
                const uint32_t start = positions_[half_edge],
                               end = positions_[k == 2 ? first : half_edge + 1];
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
        for (size_t position = 0; position < count_at_.size(); ++position)
            if (const uint32_t count = count_at_[position]; count < IncomingHalfEdges::kSlots)
                incoming_[position].start[count] = kInvalidIndex;
    }

    void findOpposite(uint32_t half_edge)
    {
        const uint32_t start = positions_[half_edge], end = positions_[nextHalfEdge(half_edge)];
        const IncomingHalfEdges& incoming = incoming_[start];
        if (const IncomingHalfEdges::Found found = incoming.find(end); found.count == 1)
            pair(half_edge, found.half_edge);
        else if (found.count > 1)
            for (size_t i = 0; i < IncomingHalfEdges::kSlots; ++i)
                if (incoming.start[i] == end)
                    pair(half_edge, incoming.half_edge[i]);
        if (count_at_[start] > IncomingHalfEdges::kSlots)
            for (const uint32_t other : overflow_)
                if (positions_[other] == end && positions_[nextHalfEdge(other)] == start)
                    pair(half_edge, other);
    }

    void pair(uint32_t half_edge, uint32_t back)
    {
        if (opposites_[half_edge] == kInvalidIndex && opposites_[back] == kInvalidIndex)
        {
            opposites_[half_edge] = back;
            opposites_[back] = half_edge;
            return;
        }
        non_manifold_ = true;
        for (const uint32_t one : {half_edge, back})
            if (const uint32_t other = std::exchange(opposites_[one], kNonManifold); other < kNonManifold)
                opposites_[other] = kNonManifold;
    }

    std::span<const uint32_t> positions_;
    std::vector<uint32_t> count_at_; ///< half-edges that arrive from larger ids, for each position
    std::vector<IncomingHalfEdges> incoming_;
    std::vector<uint32_t> rising_;   ///< half-edges to a larger id
    std::vector<uint32_t> overflow_; ///< half-edges to a smaller id that did not fit
    std::vector<uint32_t> opposites_;
    bool non_manifold_ = false; ///< several half-edges run in the same direction between the same positions
};

} // namespace

std::vector<uint32_t> findOppositeHalfEdges(std::span<const uint32_t> positions, size_t position_count)
{
    return OppositeFinder(positions, position_count).run();
}

} // namespace hearth::clusters
