// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/surface/side_twins.h"

#include "cook/clusters/core/lanes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace hearth::clusters
{

namespace
{

constexpr uint32_t kMany = kNoSide - 1;

using Numbers = uint32_t __attribute__((vector_size(kLanes * sizeof(uint32_t))));

uint32_t sumOf(Numbers x)
{
    return (x[0] + x[1]) + (x[2] + x[3]);
}

/// Half-edges that arrive at one position from larger ids: most positions have about three. Compares all at
/// once, because a branch on each comparison would be unpredictable.
struct Arriving
{
    static constexpr size_t kPlaces = 2 * kLanes;
    std::array<uint32_t, kPlaces> start; ///< kNoSide in unused slots
    std::array<uint32_t, kPlaces> side;

    struct Found
    {
        uint32_t count;
        uint32_t side; ///< valid if the count is one
    };
    Found find(uint32_t position) const
    {
        Numbers count{}, found{};
        for (size_t first = 0; first < kPlaces; first += kLanes)
        {
            Numbers starts, sides;
            std::memcpy(&starts, &start[first], sizeof(starts));
            std::memcpy(&sides, &side[first], sizeof(sides));
            const auto hit = reinterpret_cast<Numbers>(starts == position);
            count -= hit;
            found += hit & sides;
        }
        return {sumOf(count), sumOf(found)};
    }
};

constexpr Arriving kNothing{{kNoSide, kNoSide, kNoSide, kNoSide, kNoSide, kNoSide, kNoSide, kNoSide}, {}};

class TwinFinder
{
public:
    TwinFinder(std::span<const uint32_t> positions, size_t position_count)
        : positions_(positions),
          count_at_(position_count, 0),
          arriving_(position_count, kNothing),
          twins_(positions.size(), kNoSide)
    {
    }

    std::vector<uint32_t> run()
    {
        sort();
        for (const uint32_t side : rising_)
            findTwin(side);
        if (several_)
            std::replace(twins_.begin(), twins_.end(), kMany, kNoSide);
        return std::move(twins_);
    }

private:
    void sort()
    {
        rising_.resize(positions_.size());
        size_t rising_count = 0;
        for (uint32_t first = 0; first < positions_.size(); first += 3)
            for (uint32_t k = 0; k < 3; ++k)
            {
                const uint32_t side = first + k;
                const uint32_t start = positions_[side], end = positions_[k == 2 ? first : side + 1];
                rising_[rising_count] = side;
                rising_count += start < end ? 1 : 0;
                uint32_t& count = count_at_[end];
                if (count < Arriving::kPlaces)
                {
                    // a half-edge to a larger id does not count: the next one overwrites it
                    arriving_[end].start[count] = start;
                    arriving_[end].side[count] = side;
                }
                else if (start > end)
                    others_.push_back(side);
                count += start > end ? 1 : 0;
            }
        rising_.resize(rising_count);
        // terminate each list
        for (size_t position = 0; position < count_at_.size(); ++position)
            if (const uint32_t count = count_at_[position]; count < Arriving::kPlaces)
                arriving_[position].start[count] = kNoSide;
    }

    void findTwin(uint32_t side)
    {
        const uint32_t start = positions_[side], end = positions_[nextSide(side)];
        const Arriving& arriving = arriving_[start];
        if (const Arriving::Found found = arriving.find(end); found.count == 1)
            pair(side, found.side);
        else if (found.count > 1)
            for (size_t i = 0; i < Arriving::kPlaces; ++i)
                if (arriving.start[i] == end)
                    pair(side, arriving.side[i]);
        if (count_at_[start] > Arriving::kPlaces)
            for (const uint32_t other : others_)
                if (positions_[other] == end && positions_[nextSide(other)] == start)
                    pair(side, other);
    }

    void pair(uint32_t side, uint32_t back)
    {
        if (twins_[side] == kNoSide && twins_[back] == kNoSide)
        {
            twins_[side] = back;
            twins_[back] = side;
            return;
        }
        several_ = true;
        for (const uint32_t one : {side, back})
            if (const uint32_t other = std::exchange(twins_[one], kMany); other < kMany)
                twins_[other] = kMany;
    }

    std::span<const uint32_t> positions_;
    std::vector<uint32_t> count_at_; ///< half-edges that arrive from larger ids, for each position
    std::vector<Arriving> arriving_;
    std::vector<uint32_t> rising_; ///< half-edges to a larger id
    std::vector<uint32_t> others_; ///< half-edges to a smaller id that did not fit
    std::vector<uint32_t> twins_;
    bool several_ = false; ///< several half-edges run in the same direction between the same positions
};

} // namespace

std::vector<uint32_t> sideTwins(std::span<const uint32_t> positions, size_t position_count)
{
    return TwinFinder(positions, position_count).run();
}

} // namespace hearth::clusters
