// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/texels/bc_oracle.h"

#include "formats/texels/bc7_modes.h"
#include "formats/texels/bptc_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace hearth::bench
{

namespace
{

using Point = std::array<double, 4>;

constexpr uint64_t kNoError = std::numeric_limits<uint64_t>::max();

/// Texels that share endpoints, in the channels that count.
struct Texels
{
    size_t channels;
    std::vector<std::array<int, 4>> list;
};

/// A way to store a line of colours.
struct LineKind
{
    std::array<int, 4> bits; ///< of a channel's code
    /// Share of the second endpoint, by index; negative: black.
    std::vector<double> shares;
    /// Makes the color of an index from 8 bits of both endpoints.
    std::function<int(int first, int second, size_t index)> mix;
    int lowest = -1; ///< parity of the codes of the first end | 2 * that of the second; -1: any
};

int widen(int code, int bits)
{
    int value = code << (8 - bits);
    for (int shift = bits; shift < 8; shift += bits)
        value |= value >> shift;
    return value;
}

using EndCodes = std::array<std::array<int, 4>, 2>;

bool isAllowed(const LineKind& kind, const EndCodes& ends, size_t channels)
{
    for (size_t e = 0; e < 2; ++e)
        for (size_t c = 0; c < channels; ++c)
        {
            const int code = ends[e][c];
            if (code < 0 || code >= 1 << kind.bits[c] ||
                (kind.lowest >= 0 && (code & 1) != (kind.lowest >> e & 1)))
                return false;
        }
    return true;
}

/// Compute the error with the nearest indices.
/// indices  gets them
uint64_t measure(const Texels& texels, const LineKind& kind, const EndCodes& ends,
                 std::vector<size_t>& indices)
{
    std::array<std::array<int, 4>, 16> palette{};
    for (size_t k = 0; k < kind.shares.size(); ++k)
        for (size_t c = 0; c < texels.channels; ++c)
            palette[k][c] = kind.mix(widen(ends[0][c], kind.bits[c]), widen(ends[1][c], kind.bits[c]), k);
    uint64_t sum = 0;
    indices.resize(texels.list.size());
    for (size_t t = 0; t < texels.list.size(); ++t)
    {
        uint64_t best = kNoError;
        for (size_t k = 0; k < kind.shares.size(); ++k)
        {
            uint64_t error = 0;
            for (size_t c = 0; c < texels.channels; ++c)
            {
                const int d = palette[k][c] - texels.list[t][c];
                error += static_cast<uint64_t>(d * d);
            }
            if (error < best)
            {
                best = error;
                indices[t] = k;
            }
        }
        sum += best;
    }
    return sum;
}

EndCodes roundEnds(const LineKind& kind, const std::array<Point, 2>& ends, size_t channels)
{
    EndCodes codes{};
    for (size_t e = 0; e < 2; ++e)
        for (size_t c = 0; c < channels; ++c)
        {
            const int max = (1 << kind.bits[c]) - 1;
            const int step = kind.lowest < 0 ? 1 : 2;
            const int offset = kind.lowest < 0 ? 0 : kind.lowest >> e & 1;
            const double code = std::clamp(ends[e][c], 0.0, 255.0) * max / 255;
            codes[e][c] = std::clamp(static_cast<int>(std::lround((code - offset) / step)) * step + offset,
                                     offset, max);
            if (codes[e][c] > max - (step == 2 && ((max ^ offset) & 1) != 0 ? 1 : 0))
                codes[e][c] -= step;
        }
    return codes;
}

/// Solve for the endpoints of given indices.
bool solve(const Texels& texels, const LineKind& kind, const std::vector<size_t>& indices,
           std::array<Point, 2>& ends)
{
    double aa = 0, ab = 0, bb = 0;
    Point a{}, b{};
    for (size_t t = 0; t < texels.list.size(); ++t)
    {
        const double share = kind.shares[indices[t]];
        if (share < 0)
            continue;
        aa += (1 - share) * (1 - share);
        ab += (1 - share) * share;
        bb += share * share;
        for (size_t c = 0; c < texels.channels; ++c)
        {
            a[c] += (1 - share) * texels.list[t][c];
            b[c] += share * texels.list[t][c];
        }
    }
    const double determinant = aa * bb - ab * ab;
    if (determinant < 1e-9)
        return false;
    for (size_t c = 0; c < texels.channels; ++c)
    {
        ends[0][c] = (bb * a[c] - ab * b[c]) / determinant;
        ends[1][c] = (aa * b[c] - ab * a[c]) / determinant;
    }
    return true;
}

/// Descend from codes: steps of one or two of any code, and of both ends of a channel.
uint64_t descend(const Texels& texels, const LineKind& kind, EndCodes ends)
{
    std::vector<size_t> indices;
    uint64_t best = measure(texels, kind, ends, indices);
    const int step = kind.lowest < 0 ? 1 : 2;
    for (bool found = true; found && best > 0;)
    {
        found = false;
        for (size_t c = 0; c < texels.channels; ++c)
            for (int first = -2; first <= 2; ++first)
                for (int second = -2; second <= 2; ++second)
                {
                    EndCodes next = ends;
                    next[0][c] += first * step;
                    next[1][c] += second * step;
                    if ((first == 0 && second == 0) || !isAllowed(kind, next, texels.channels))
                        continue;
                    const uint64_t error = measure(texels, kind, next, indices);
                    if (error < best)
                    {
                        best = error;
                        ends = next;
                        found = true;
                    }
                }
    }
    return best;
}

/// Return the direction of the largest variance.
Point principalDirection(const Texels& texels, Point& mean)
{
    mean = {};
    for (const auto& texel : texels.list)
        for (size_t c = 0; c < texels.channels; ++c)
            mean[c] += texel[c] / static_cast<double>(texels.list.size());
    Point direction{1, 1.1, 0.9, 1.2};
    for (int i = 0; i < 30; ++i)
    {
        Point next{};
        for (const auto& texel : texels.list)
        {
            double along = 0;
            for (size_t c = 0; c < texels.channels; ++c)
                along += (texel[c] - mean[c]) * direction[c];
            for (size_t c = 0; c < texels.channels; ++c)
                next[c] += along * (texel[c] - mean[c]);
        }
        double length = 0;
        for (size_t c = 0; c < texels.channels; ++c)
            length += next[c] * next[c];
        if (length < 1e-12)
            break;
        for (size_t c = 0; c < texels.channels; ++c)
            direction[c] = next[c] / std::sqrt(length);
    }
    return direction;
}

/// Ends to start from: along the principal direction with several margins, and pairs of texels.
std::vector<std::array<Point, 2>> makeStarts(const Texels& texels)
{
    std::vector<std::array<Point, 2>> starts;
    Point mean;
    const Point direction = principalDirection(texels, mean);
    double low = 0, high = 0;
    for (const auto& texel : texels.list)
    {
        double along = 0;
        for (size_t c = 0; c < texels.channels; ++c)
            along += (texel[c] - mean[c]) * direction[c];
        low = std::min(low, along);
        high = std::max(high, along);
    }
    for (const double margin : {1.0, 0.85, 1.15, 0.6, 1.5})
    {
        std::array<Point, 2> ends{};
        for (size_t c = 0; c < texels.channels; ++c)
        {
            ends[0][c] = mean[c] + direction[c] * low * margin;
            ends[1][c] = mean[c] + direction[c] * high * margin;
        }
        starts.push_back(ends);
    }
    for (size_t i = 0; i < texels.list.size(); ++i)
        for (size_t j = i + 1 + i % 3; j < texels.list.size(); j += 5)
        {
            std::array<Point, 2> ends{};
            for (size_t c = 0; c < texels.channels; ++c)
            {
                ends[0][c] = texels.list[i][c];
                ends[1][c] = texels.list[j][c];
            }
            starts.push_back(ends);
        }
    return starts;
}

/// Return the least error of a line: least squares from each start, then a descent from the best few results.
uint64_t fitLine(const Texels& texels, const LineKind& kind, size_t descents)
{
    if (texels.list.empty())
        return 0;
    std::vector<std::pair<uint64_t, EndCodes>> results;
    std::vector<size_t> indices;
    for (std::array<Point, 2> ends : makeStarts(texels))
    {
        std::pair<uint64_t, EndCodes> best{kNoError, {}};
        for (int round = 0; round < 5; ++round)
        {
            const EndCodes codes = roundEnds(kind, ends, texels.channels);
            const uint64_t error = measure(texels, kind, codes, indices);
            if (error >= best.first)
                break;
            best = {error, codes};
            if (!solve(texels, kind, indices, ends))
                break;
        }
        results.push_back(best);
    }
    std::sort(results.begin(), results.end());
    results.erase(std::unique(results.begin(), results.end()), results.end());
    uint64_t least = kNoError;
    for (size_t i = 0; i < std::min(descents, results.size()); ++i)
        least = std::min(least, descend(texels, kind, results[i].second));
    return least;
}

/// Return the least error over the parities that the lowest bits of the ends may have.
uint64_t fitWithLowestBits(const Texels& texels, LineKind kind, const formats::Bc7Mode& mode,
                           bool needs_opaque)
{
    constexpr size_t kDescents = 2;
    if (mode.endpoint_p_bits + mode.shared_p_bits == 0)
        return fitLine(texels, kind, kDescents);
    uint64_t least = kNoError;
    for (int lowest = needs_opaque ? 3 : 0; lowest < 4; ++lowest)
    {
        if (mode.shared_p_bits != 0 && (lowest == 1 || lowest == 2))
            continue;
        kind.lowest = lowest;
        least = std::min(least, fitLine(texels, kind, kDescents));
    }
    return least;
}

LineKind bc7Kind(int color_bits, int alpha_bits, uint32_t index_bits)
{
    LineKind kind{{color_bits, color_bits, color_bits, alpha_bits}, {}, {}};
    for (uint32_t i = 0; i < 1u << index_bits; ++i)
        kind.shares.push_back(formats::bptcWeight(i, index_bits) / 64.0);
    kind.mix = [index_bits](int first, int second, size_t index)
    {
        return formats::bptcInterpolate(first, second,
                                        formats::bptcWeight(static_cast<uint32_t>(index), index_bits));
    };
    return kind;
}

/// Return the error of a layout with partitions.
uint64_t fitSubsets(const OracleBlock& block, const formats::Bc7Mode& mode, uint32_t partition,
                    bool has_alpha, uint64_t limit)
{
    const int more = mode.endpoint_p_bits + mode.shared_p_bits;
    const LineKind kind = bc7Kind(mode.color_bits + more, mode.alpha_bits + more, mode.index_bits);
    uint64_t sum = 0;
    for (uint32_t subset = 0; subset < mode.subsets && sum < limit; ++subset)
    {
        Texels texels{has_alpha ? size_t{4} : size_t{3}, {}};
        for (uint32_t t = 0; t < 16; ++t)
            if (formats::bptcSubset(mode.subsets, partition, t) == subset)
                texels.list.push_back({block[t][0], block[t][1], block[t][2], block[t][3]});
        sum += fitWithLowestBits(texels, kind, mode, !has_alpha && mode.alpha_bits != 0);
    }
    return sum;
}

/// Return the error of a layout with two sets of indices.
uint64_t fitTwoSets(const OracleBlock& block, const formats::Bc7Mode& mode, uint32_t rotation, bool exchanged,
                    bool has_alpha)
{
    const uint32_t color_indices = exchanged ? mode.second_index_bits : mode.index_bits;
    const uint32_t alpha_indices = exchanged ? mode.index_bits : mode.second_index_bits;
    Texels colors{3, {}}, alone{1, {}};
    for (const auto& texel : block)
    {
        std::array<int, 4> rotated = {texel[0], texel[1], texel[2], has_alpha ? texel[3] : 255};
        if (rotation != 0)
            std::swap(rotated[3], rotated[rotation - 1]);
        colors.list.push_back(rotated);
        alone.list.push_back({rotated[3], 0, 0, 0});
    }
    LineKind alone_kind = bc7Kind(mode.alpha_bits, 0, alpha_indices);
    return fitLine(colors, bc7Kind(mode.color_bits, 0, color_indices), 2) + fitLine(alone, alone_kind, 2);
}

LineKind bc1Kind(bool has_four)
{
    LineKind kind{{5, 6, 5, 0}, {0, 1}, {}};
    if (has_four)
    {
        kind.shares = {0, 1, 1 / 3.0, 2 / 3.0};
        kind.mix = [](int first, int second, size_t index)
        {
            const int sums[] = {3 * first, 3 * second, 2 * first + second, first + 2 * second};
            return (sums[index] + 1) / 3;
        };
    }
    else
    {
        kind.shares = {0, 1, 0.5, -1};
        kind.mix = [](int first, int second, size_t index)
        {
            const int sums[] = {2 * first, 2 * second, first + second, 0};
            return (sums[index] + 1) / 2;
        };
    }
    return kind;
}

} // namespace

uint64_t oracleBc1(const OracleBlock& block)
{
    constexpr size_t kDescents = 12;
    Texels texels{3, {}};
    for (const auto& texel : block)
        texels.list.push_back({texel[0], texel[1], texel[2], 0});
    return std::min(fitLine(texels, bc1Kind(true), kDescents), fitLine(texels, bc1Kind(false), kDescents));
}

uint64_t oracleBc7(const OracleBlock& block, bool has_alpha)
{
    uint64_t least = kNoError;
    for (const formats::Bc7Mode& mode : formats::kBc7Modes)
    {
        if (mode.second_index_bits != 0)
            for (uint32_t rotation = 0; rotation < 4; ++rotation)
                for (uint32_t exchanged = 0; exchanged <= mode.selection_bits; ++exchanged)
                    least = std::min(least, fitTwoSets(block, mode, rotation, exchanged != 0, has_alpha));
        else if (mode.alpha_bits != 0 || !has_alpha)
            for (uint32_t partition = 0; partition < 1u << mode.partition_bits; ++partition)
                least = std::min(least, fitSubsets(block, mode, partition, has_alpha, least));
    }
    return least;
}

} // namespace hearth::bench
