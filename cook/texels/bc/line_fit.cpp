// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/bc/line_fit.h"

#include "cook/texels/bc/principal_axis.h"
#include "formats/texels/bptc_tables.h"

#include <algorithm>

namespace hearth::texels
{

namespace
{

/// Endpoints with 8 bits a channel.
using WideEnds = std::array<std::array<int16_t, 4>, 2>;

WideEnds widen(const Line& line, const LineFormat& format)
{
    WideEnds ends;
    for (size_t e = 0; e < 2; ++e)
        for (size_t c = 0; c < 4; ++c)
            ends[e][c] = widenCode(line.codes[e][c], format.bits[c]);
    return ends;
}

/// [bits - 5][parity][value]: code whose widened value is nearest. Parity 2 is either.
using NearestCodes = std::array<std::array<std::array<uint8_t, 256>, 3>, 4>;

constexpr NearestCodes makeNearestCodes()
{
    NearestCodes nearest{};
    for (uint8_t bits = 5; bits <= 8; ++bits)
        for (int parity = 0; parity < 3; ++parity)
        {
            // codes ascend, so their widened values do: the nearest code never decreases
            const int step = parity == 2 ? 1 : 2;
            int code = parity == 2 ? 0 : parity;
            for (int value = 0; value < 256; ++value)
            {
                const auto distance = [&](int other)
                {
                    const int d = widenCode(static_cast<uint8_t>(other), bits) - value;
                    return d < 0 ? -d : d;
                };
                while (code + step < 1 << bits && distance(code + step) < distance(code))
                    code += step;
                nearest[bits - 5u][static_cast<size_t>(parity)][static_cast<size_t>(value)] =
                    static_cast<uint8_t>(code);
            }
        }
    return nearest;
}
constexpr NearestCodes kNearestCodes = makeNearestCodes();

/// LineShares of the second endpoint, of 64, by texel.
using LineShares = std::array<int16_t, 16>;

/// Give each texel the share that is nearest along the line, and compute the error. Lanes beyond the count
/// get 0.
template <size_t kLanes>
uint32_t measureLanes(const LineTexels& texels, const LineWeights& weights, const WideEnds& ends,
                      uint32_t index_bits, LineShares& shares)
{
    std::array<int32_t, kLanes> place{};
    int32_t length = 0;
    for (size_t c = 0; c < 4; ++c)
    {
        const int16_t a = ends[0][c];
        const auto along = static_cast<int16_t>(ends[1][c] - a);
        const auto weighted = static_cast<int16_t>(along * weights[c]);
        if (weighted == 0)
            continue;
        length += weighted * along;
        for (size_t t = 0; t < kLanes; ++t)
            place[t] += int32_t{static_cast<int16_t>(texels.values[c][t] - a)} * int32_t{weighted};
    }
    std::array<int32_t, kLanes> share{};
    const uint32_t last = (1u << index_bits) - 1;
    for (uint32_t i = 0; i < last; ++i)
    {
        const auto low = static_cast<int32_t>(formats::bptcWeight(i, index_bits));
        const auto high = static_cast<int32_t>(formats::bptcWeight(i + 1, index_bits));
        const int32_t middle = (low + high) * length >> 7;
        for (size_t t = 0; t < kLanes; ++t)
            share[t] += place[t] > middle ? high - low : 0;
    }
    for (size_t t = 0; t < kLanes; ++t)
        shares[t] = static_cast<int16_t>(t < texels.count ? share[t] : 0);
    std::array<int32_t, kLanes> errors{};
    for (size_t c = 0; c < 4; ++c)
    {
        if (weights[c] == 0)
            continue;
        const int16_t a = ends[0][c];
        const auto along = static_cast<int16_t>(ends[1][c] - a);
        const auto base = static_cast<int16_t>(a * 64 + 32);
        for (size_t t = 0; t < kLanes; ++t)
        {
            const auto value = static_cast<int16_t>(
                static_cast<int16_t>(base + static_cast<int16_t>(along * shares[t])) >> 6);
            const auto d = static_cast<int16_t>(texels.values[c][t] - value);
            errors[t] += int32_t{static_cast<int16_t>(d * weights[c])} * int32_t{d};
        }
    }
    int32_t sum = 0;
    for (size_t t = 0; t < kLanes; ++t)
        sum += t < texels.count ? errors[t] : 0;
    return static_cast<uint32_t>(sum);
}

uint32_t measure(const LineTexels& texels, const LineWeights& weights, const WideEnds& ends,
                 uint32_t index_bits, LineShares& shares)
{
    return texels.count <= 8 ? measureLanes<8>(texels, weights, ends, index_bits, shares)
                             : measureLanes<16>(texels, weights, ends, index_bits, shares);
}

/// Compute the best endpoints for the texels' shares.
/// returns  false if all shares are equal
bool solve(const LineTexels& texels, const LineWeights& weights, const LineShares& shares, LineEnds& ends)
{
    int32_t sum = 0, squares = 0;
    for (size_t t = 0; t < 16; ++t)
    {
        sum += shares[t];
        squares += shares[t] * shares[t];
    }
    const auto count = static_cast<int64_t>(texels.count);
    const int64_t bb = squares;
    const int64_t ab = int64_t{64} * sum - bb;
    const int64_t aa = count * 64 * 64 - 2 * ab - bb;
    const int64_t determinant = aa * bb - ab * ab;
    if (determinant == 0)
        return false;
    for (size_t c = 0; c < 4; ++c)
    {
        if (weights[c] == 0)
            continue;
        int32_t total = 0, b = 0;
        for (size_t t = 0; t < 16; ++t)
        {
            total += texels.values[c][t];
            b += int32_t{texels.values[c][t]} * int32_t{shares[t]};
        }
        const int64_t a = int64_t{64} * total - b;
        ends[0][c] =
            static_cast<int32_t>(std::clamp<int64_t>(1024 * (bb * a - ab * b) / determinant, 0, 4080));
        ends[1][c] =
            static_cast<int32_t>(std::clamp<int64_t>(1024 * (aa * b - ab * a) / determinant, 0, 4080));
    }
    return true;
}

/// Return the codes nearest to an end.
/// parity  of all codes; 2: either
/// error   gets the weighted square of the distance
std::array<uint8_t, 4> nearestCodes(const std::array<int32_t, 4>& end, const LineWeights& weights,
                                    const LineFormat& format, size_t parity, int64_t& error)
{
    std::array<uint8_t, 4> codes{};
    for (size_t c = 0; c < 4; ++c)
    {
        const uint8_t bits = format.bits[c];
        if (bits == 0)
            continue;
        const int32_t value = weights[c] == 0 ? 4080 : end[c];
        codes[c] = kNearestCodes[bits - 5u][parity][static_cast<size_t>((value + 8) >> 4)];
        const int64_t distance = widenCode(codes[c], bits) * 16 - value;
        error += distance * distance * weights[c];
    }
    return codes;
}

/// Round ends to codes.
Line quantize(const LineEnds& ends, const LineWeights& weights, const LineFormat& format)
{
    Line line;
    int64_t error = 0;
    if (format.lowest == LowestBit::free || format.lowest == LowestBit::set)
    {
        const size_t parity = format.lowest == LowestBit::free ? 2 : 1;
        for (size_t e = 0; e < 2; ++e)
            line.codes[e] = nearestCodes(ends[e], weights, format, parity, error);
        return line;
    }
    std::array<std::array<std::array<uint8_t, 4>, 2>, 2> codes; // [parity][end]
    std::array<std::array<int64_t, 2>, 2> errors{};
    for (size_t parity = 0; parity < 2; ++parity)
        for (size_t e = 0; e < 2; ++e)
            codes[parity][e] = nearestCodes(ends[e], weights, format, parity, errors[parity][e]);
    if (format.lowest == LowestBit::shared)
    {
        const size_t parity = errors[1][0] + errors[1][1] < errors[0][0] + errors[0][1] ? 1 : 0;
        line.codes = codes[parity];
        return line;
    }
    for (size_t e = 0; e < 2; ++e)
        line.codes[e] = codes[errors[1][e] < errors[0][e] ? 1 : 0][e];
    return line;
}

bool keepBetter(const LineTexels& texels, const LineWeights& weights, const LineFormat& format,
                Line candidate, Line& best)
{
    LineShares shares{};
    candidate.error = measure(texels, weights, widen(candidate, format), format.index_bits, shares);
    if (candidate.error >= best.error)
        return false;
    best = candidate;
    return true;
}

/// Try the other lowest bits, with the codes next to the best ones.
bool tryLowestBits(const LineTexels& texels, const LineWeights& weights, const LineFormat& format, Line& best)
{
    const WideEnds wide = widen(best, format);
    LineEnds ends;
    for (size_t e = 0; e < 2; ++e)
        for (size_t c = 0; c < 4; ++c)
            ends[e][c] = wide[e][c] * 16;
    bool found = false;
    for (size_t pair = 0; pair < 4; ++pair)
    {
        if (format.lowest == LowestBit::shared && (pair == 1 || pair == 2))
            continue;
        Line candidate;
        int64_t unused = 0;
        for (size_t e = 0; e < 2; ++e)
            candidate.codes[e] = nearestCodes(ends[e], weights, format, pair >> e & 1u, unused);
        found |= keepBetter(texels, weights, format, candidate, best);
    }
    return found;
}

} // namespace

LineEnds findEnds(const LineTexels& texels, const LineWeights& weights)
{
    std::array<int64_t, 4> sums{};
    SymmetricMatrix<4> products{};
    const auto count = static_cast<int64_t>(texels.count);
    for (size_t i = 0; i < 4; ++i)
    {
        if (weights[i] == 0)
            continue;
        int32_t sum = 0;
        for (size_t t = 0; t < 16; ++t) // 0 beyond the count
            sum += texels.values[i][t];
        sums[i] = sum;
        for (size_t j = 0; j <= i; ++j)
        {
            if (weights[j] == 0)
                continue;
            int32_t product = 0;
            for (size_t t = 0; t < 16; ++t)
                product += int32_t{texels.values[i][t]} * int32_t{texels.values[j][t]};
            products[i][j] = products[j][i] = product * count - sums[i] * sums[j];
        }
    }
    const std::array<int64_t, 4> axis = largestEigenvector(products, 3);
    std::array<int64_t, 16> place{};
    int64_t length = 0, center = 0;
    for (size_t c = 0; c < 4; ++c)
    {
        length += axis[c] * axis[c];
        center += axis[c] * sums[c];
        for (size_t t = 0; t < texels.count; ++t)
            place[t] += axis[c] * texels.values[c][t];
    }
    const auto range = std::minmax_element(place.begin(), place.begin() + count);
    LineEnds ends{};
    for (size_t c = 0; c < 4; ++c)
    {
        const int64_t mean = sums[c] * 16 / count;
        const auto end = [&](int64_t extreme)
        {
            const int64_t offset =
                length == 0 ? 0 : (extreme * count - center) / count * axis[c] * 16 / length;
            return static_cast<int32_t>(std::clamp<int64_t>(mean + offset, 0, 4080));
        };
        ends[0][c] = end(*range.first);
        ends[1][c] = end(*range.second);
    }
    return ends;
}

Line fitLine(const LineTexels& texels, const LineWeights& weights, const LineFormat& format,
             const LineEnds& start, uint32_t rounds)
{
    Line best = quantize(start, weights, format);
    LineShares shares{};
    best.error = measure(texels, weights, widen(best, format), format.index_bits, shares);
    LineEnds ends = start;
    for (uint32_t i = 0; i < rounds && best.error > 0 && solve(texels, weights, shares, ends); ++i)
    {
        Line next = quantize(ends, weights, format);
        next.error = measure(texels, weights, widen(next, format), format.index_bits, shares);
        if (next.error >= best.error)
            break;
        best = next;
    }
    return best;
}

void refineLine(const LineTexels& texels, const LineWeights& weights, const LineFormat& format,
                uint32_t passes, Line& line)
{
    const int step = format.lowest == LowestBit::free ? 1 : 2;
    for (uint32_t pass = 0; pass < passes && line.error > 0; ++pass)
    {
        bool found = false;
        if (format.lowest == LowestBit::each || format.lowest == LowestBit::shared)
            found |= tryLowestBits(texels, weights, format, line);
        for (size_t c = 0; c < 4; ++c)
        {
            if (weights[c] == 0 || format.bits[c] == 0)
                continue;
            const int max = (1 << format.bits[c]) - 1;
            for (size_t move = 0; move < 8; ++move)
            {
                // one end, the other, both together, both apart; up and down
                const int sign = (move & 1) != 0 ? step : -step;
                const int first = move < 2 || move >= 4 ? sign : 0;
                const int second = move < 2 ? 0 : move < 6 ? sign : -sign;
                const int a = line.codes[0][c] + first, b = line.codes[1][c] + second;
                if (a < 0 || b < 0 || a > max || b > max)
                    continue;
                Line candidate = line;
                candidate.codes[0][c] = static_cast<uint8_t>(a);
                candidate.codes[1][c] = static_cast<uint8_t>(b);
                found |= keepBetter(texels, weights, format, candidate, line);
            }
        }
        if (!found)
            break;
    }
}

uint32_t chooseLineIndices(const LineTexels& texels, const LineWeights& weights, const LineFormat& format,
                           const Line& line, std::array<uint8_t, 16>& indices)
{
    const WideEnds ends = widen(line, format);
    uint32_t sum = 0;
    for (size_t t = 0; t < texels.count; ++t)
    {
        uint32_t best = UINT32_MAX;
        for (uint32_t i = 0; i < 1u << format.index_bits; ++i)
        {
            uint32_t error = 0;
            for (size_t c = 0; c < 4; ++c)
            {
                const int d =
                    texels.values[c][t] - formats::bptcInterpolate(ends[0][c], ends[1][c],
                                                                   formats::bptcWeight(i, format.index_bits));
                error += static_cast<uint32_t>(d * d * weights[c]);
            }
            if (error < best)
            {
                best = error;
                indices[t] = static_cast<uint8_t>(i);
            }
        }
        sum += best;
    }
    return sum;
}

} // namespace hearth::texels
