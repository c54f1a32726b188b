// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/pages/page_planes.h"

#include "cook/pages/entropy_blocks.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace hearth::pages
{

using namespace formats;

namespace
{

constexpr size_t kNumberBits = 16;

/// Cost of an escape in bits: its number, and the time to insert it.
constexpr double kBitsOfEscape = 16 + 24;

using LowBitCosts = std::array<double, kMaxLowBitsAboveFour + 1>;

/// Estimate the bits of a lane's numbers for each number of low bits: low bits are stored raw, the others are
/// coded. Depends only on the lengths of the numbers: those of one length are about equally frequent.
LowBitCosts estimateLowBitCosts(std::span<const uint16_t> numbers, uint32_t main_bits, uint32_t most)
{
    std::array<uint32_t, kNumberBits + 1> count_of_length{};
    for (const uint16_t number : numbers)
        ++count_of_length[static_cast<size_t>(std::bit_width(number))];
    LowBitCosts costs;
    costs.fill(1e30);
    for (uint32_t low_bits = 0; low_bits <= most; ++low_bits)
    {
        double bits = timesLog2(static_cast<uint32_t>(numbers.size()));
        uint32_t zeros = 0;
        for (uint32_t length = 0; length <= kNumberBits; ++length)
        {
            const uint32_t count = count_of_length[length];
            if (length <= low_bits)
            {
                zeros += count;
                bits += low_bits * static_cast<double>(count);
                continue;
            }
            bits += (length - 1) * static_cast<double>(count) - timesLog2(count);
            // the longest main bytes are escapes: one of 8, or of 128, of those with as many bits as fit
            const double escapes = length > low_bits + main_bits ? 1
                                   : length == low_bits + main_bits
                                       ? 2.0 / static_cast<double>(1u << main_bits)
                                       : 0;
            bits += escapes * kBitsOfEscape * static_cast<double>(count);
        }
        costs[low_bits] = bits - timesLog2(zeros);
    }
    return costs;
}

} // namespace

void PagePlanes::clear(const VertexLanes& lanes)
{
    lanes_ = lanes;
    rows_.clear();
    plane_count_ = 0;
    escapes_.clear();
}

LaneForms PagePlanes::make(PageHeader& header)
{
    LaneForms forms;
    header.new_vertices = static_cast<uint16_t>(rows_.size());
    spreadLanes();
    const size_t blocks = (lanes_.count + kLanesPerBlock - 1) / kLanesPerBlock;
    for (size_t block = 0; block < blocks; ++block)
        chooseLowBits(block, forms);
    collectEscapes(forms);
    header.escapes = static_cast<uint32_t>(escapes_.size() / 2);
    addNumberPlanes(forms);
    addBytePlanes(forms);
    for (size_t block = 0; block < blocks; ++block)
        addLowBits(block, forms);
    return forms;
}

/// Transpose the rows of vertices to lanes.
void PagePlanes::spreadLanes()
{
    const size_t vertices = rows_.size();
    const size_t whole = (vertices + kHalves - 1) / kHalves * kHalves;
    rows_.resize(whole);
    for (size_t block = 0; block * kHalves < lanes_.count; ++block)
    {
        for (size_t i = 0; i < kHalves; ++i)
            values_[block * kHalves + i].resize(whole);
        for (size_t first = 0; first < whole; first += kHalves)
        {
            std::array<Halves, kHalves> square;
            for (size_t i = 0; i < kHalves; ++i)
                square[i] = rows_[first + i][block];
            transpose(square);
            for (size_t i = 0; i < kHalves; ++i)
                std::memcpy(values_[block * kHalves + i].data() + first, &square[i], sizeof(Halves));
        }
        for (size_t i = 0; i < kHalves; ++i)
            values_[block * kHalves + i].resize(vertices);
    }
    rows_.resize(vertices);
}

uint32_t PagePlanes::escapeCode(size_t lane) const
{
    return sharesMainByte(lanes_, lane) ? kEscapeOfFourBits : kEscape;
}

/// Choose the cheapest number of low bits of each lane, then add bits until they fill the bytes of the block.
void PagePlanes::chooseLowBits(size_t block, LaneForms& forms) const
{
    std::array<LowBitCosts, kLanesPerBlock> costs;
    auto* const low_bits = forms.low_bits.data() + block * kLanesPerBlock;
    std::array<uint32_t, kLanesPerBlock> most{};
    uint32_t sum = 0;
    const size_t count = std::min<size_t>(kLanesPerBlock, lanes_.count - block * kLanesPerBlock);
    for (size_t i = 0; i < count; ++i)
    {
        const size_t lane = block * kLanesPerBlock + i;
        if (lanes_.kinds[lane] == LaneKind::bytes)
            continue;
        const bool shared = sharesMainByte(lanes_, lane);
        most[i] = shared ? kMaxLowBitsAboveFour : kMaxLowBits;
        costs[i] = estimateLowBitCosts(values_[lane], shared ? 4 : 8, most[i]);
        const auto best = std::min_element(costs[i].begin(), costs[i].end());
        low_bits[i] = static_cast<uint8_t>(best - costs[i].begin());
        sum += low_bits[i];
    }
    while (sum % 8 != 0)
    {
        size_t best = kLanesPerBlock;
        double best_cost = 0;
        for (size_t i = 0; i < count; ++i)
        {
            if (low_bits[i] >= most[i])
                continue;
            const double cost = costs[i][low_bits[i] + 1u] - costs[i][low_bits[i]];
            if (best == kLanesPerBlock || cost < best_cost)
            {
                best = i;
                best_cost = cost;
            }
        }
        if (best == kLanesPerBlock)
            return;
        ++low_bits[best];
        ++sum;
    }
}

std::vector<uint8_t>& PagePlanes::nextPlane()
{
    if (plane_count_ == planes_.size())
        planes_.emplace_back();
    std::vector<uint8_t>& plane = planes_[plane_count_++];
    plane.assign(rows_.size(), 0);
    return plane;
}

/// Remove the last plane if it is zero. Returns true if it stays.
bool PagePlanes::dropZeros()
{
    const std::vector<uint8_t>& plane = planes_[plane_count_ - 1];
    const bool zero = std::all_of(plane.begin(), plane.end(), [](uint8_t byte) { return byte == 0; });
    plane_count_ -= zero ? 1 : 0;
    return !zero;
}

void PagePlanes::addNumberPlanes(LaneForms& forms)
{
    for (size_t lane = 0; lane < lanes_.count; ++lane)
    {
        const bool shared = sharesMainByte(lanes_, lane);
        if (lanes_.kinds[lane] == LaneKind::bytes || (shared && lane % 2 == 1))
            continue;
        uint8_t* const plane = nextPlane().data();
        const auto mainBits = [&](size_t of, size_t v)
        { return std::min<uint32_t>(uint32_t{values_[of][v]} >> forms.low_bits[of], escapeCode(of)); };
        for (size_t v = 0; v < rows_.size(); ++v)
            plane[v] = static_cast<uint8_t>(mainBits(lane, v) | (shared ? mainBits(lane + 1, v) << 4 : 0));
        if (dropZeros())
            forms.planes[lane] |= kPlaneMain;
    }
}

/// Add planes of bytes, or of nibbles where the lower ones are hardly worth a code.
void PagePlanes::addBytePlanes(LaneForms& forms)
{
    const size_t vertices = rows_.size();
    std::vector<std::vector<uint8_t>> seconds;
    std::vector<size_t> lane_of_second;
    for (size_t lane = 0; lane < lanes_.count; ++lane)
    {
        if (lanes_.kinds[lane] != LaneKind::bytes)
            continue;
        std::vector<uint8_t>& main = nextPlane();
        std::vector<uint8_t> second(vertices), upper(vertices), lower(vertices);
        for (size_t v = 0; v < vertices; ++v)
        {
            const uint32_t value = values_[lane][v];
            main[v] = static_cast<uint8_t>(value);
            second[v] = static_cast<uint8_t>(value >> 8);
            upper[v] = static_cast<uint8_t>((value >> 4 & 0x0F) | (value >> 8 & 0xF0));
            lower[v] = static_cast<uint8_t>((value & 0x0F) | (value >> 4 & 0xF0));
        }
        const double whole = storedBits(computeHistogram(main)) + storedBits(computeHistogram(second));
        if (storedBits(computeHistogram(upper)) + 8.0 * static_cast<double>(vertices) < whole)
        {
            forms.planes[lane] |= kPlaneNibbles;
            main = upper;
            second = lower;
        }
        if (dropZeros())
            forms.planes[lane] |= kPlaneMain;
        seconds.push_back(std::move(second));
        lane_of_second.push_back(lane);
    }
    for (size_t i = 0; i < seconds.size(); ++i)
    {
        nextPlane() = seconds[i];
        if (dropZeros())
            forms.planes[lane_of_second[i]] |= kPlaneSecond;
    }
}

void PagePlanes::addLowBits(size_t block, const LaneForms& forms)
{
    const LowBitFields fields = lowBitFields(forms, block);
    for (uint32_t part = 0; part < fields.planes(); ++part)
    {
        uint8_t* const plane = nextPlane().data();
        for (size_t i = 0; i < kLanesPerBlock && block * kLanesPerBlock + i < lanes_.count; ++i)
        {
            const uint32_t bits = forms.low_bits[block * kLanesPerBlock + i];
            const int shift = static_cast<int>(8 * part) - static_cast<int>(fields.first[i]);
            if (shift <= -8 || shift >= static_cast<int>(bits))
                continue;
            const uint32_t mask = (1u << bits) - 1;
            const uint16_t* const values = values_[block * kLanesPerBlock + i].data();
            const int up = std::max(-shift, 0), down = std::max(shift, 0);
            for (size_t v = 0; v < rows_.size(); ++v)
                plane[v] |= static_cast<uint8_t>((values[v] & mask) << up >> down);
        }
    }
}

/// Collect the escapes in groups of sixteen vertices, within a group by lane, within a lane by vertex.
void PagePlanes::collectEscapes(const LaneForms& forms)
{
    constexpr size_t kGroup = 16;
    const auto leastEscape = [&](size_t lane) { return escapeCode(lane) << forms.low_bits[lane]; };
    std::vector<size_t> lanes;
    for (size_t lane = 0; lane < lanes_.count; ++lane)
    {
        uint16_t most = 0;
        for (const uint16_t value : values_[lane])
            most = std::max(most, value);
        if (lanes_.kinds[lane] != LaneKind::bytes && most >= leastEscape(lane))
            lanes.push_back(lane);
    }
    for (size_t first = 0; first < rows_.size(); first += kGroup)
        for (const size_t lane : lanes)
        {
            const uint32_t least = leastEscape(lane);
            for (size_t v = first; v < std::min(first + kGroup, rows_.size()); ++v)
                if (const uint32_t value = values_[lane][v]; value >= least)
                {
                    escapes_.push_back(static_cast<uint8_t>(value));
                    escapes_.push_back(static_cast<uint8_t>(value >> 8));
                }
        }
}

} // namespace hearth::pages
