// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/texels/slow_etc2.h"

#include "formats/texels/eac_decoder.h"
#include "formats/texels/etc2_tables.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace hearth::bench
{

namespace
{

using texels::Block8;
using Color = std::array<int, 3>;

int extend(int code, int bits)
{
    return code << (8 - bits) | code >> (2 * bits - 8);
}

int square(int value)
{
    return value * value;
}

/// Return the sum over texels of the least distance to any of four colours.
template <size_t count>
uint32_t errorOfPaints(const std::array<Color, count>& texels, const std::array<Color, 4>& paints)
{
    std::array<int, count> least;
    least.fill(INT32_MAX);
    for (const Color& paint : paints)
        for (size_t t = 0; t < count; ++t)
            least[t] = std::min(least[t], square(texels[t][0] - paint[0]) + square(texels[t][1] - paint[1]) +
                                              square(texels[t][2] - paint[2]));
    uint32_t sum = 0;
    for (const int error : least)
        sum += static_cast<uint32_t>(error);
    return sum;
}

Color add(const Color& color, int distance)
{
    return {std::clamp(color[0] + distance, 0, 255), std::clamp(color[1] + distance, 0, 255),
            std::clamp(color[2] + distance, 0, 255)};
}

using HalfTexels = std::array<Color, 8>;

/// Return the least error of a half for every base colour, over all tables.
/// returns  [red << 2 bits | green << bits | blue]
std::vector<uint32_t> errorsOfBases(const HalfTexels& half, int bits)
{
    const int codes = 1 << bits;
    std::vector<uint32_t> errors;
    for (int r = 0; r < codes; ++r)
        for (int g = 0; g < codes; ++g)
            for (int b = 0; b < codes; ++b)
            {
                const Color base{extend(r, bits), extend(g, bits), extend(b, bits)};
                uint32_t least = UINT32_MAX;
                for (const auto& [lesser, greater] : formats::kEtcDistances)
                    least = std::min(least, errorOfPaints(half, {add(base, lesser), add(base, greater),
                                                                 add(base, -lesser), add(base, -greater)}));
                errors.push_back(least);
            }
    return errors;
}

/// Replace each value by the least of those that a difference of -4 to 3 reaches along an axis of 32 codes.
void spreadMinimum(std::vector<uint32_t>& errors, size_t stride)
{
    std::vector<uint32_t> spread(errors.size());
    for (size_t i = 0; i < errors.size(); ++i)
    {
        const int code = static_cast<int>(i / stride % 32);
        uint32_t least = UINT32_MAX;
        for (int other = std::max(code - 4, 0); other <= std::min(code + 3, 31); ++other)
            least = std::min(
                least, errors[i + static_cast<size_t>(other) * stride - static_cast<size_t>(code) * stride]);
        spread[i] = least;
    }
    errors = std::move(spread);
}

uint32_t leastHalvesError(const Block8& block)
{
    uint32_t least = UINT32_MAX;
    for (const bool is_flipped : {false, true})
    {
        std::array<HalfTexels, 2> halves;
        std::array<size_t, 2> counts{};
        for (size_t t = 0; t < 16; ++t)
        {
            const size_t h = (is_flipped ? t / 4 : t % 4) / 2;
            halves[h][counts[h]++] = {block[t][0], block[t][1], block[t][2]};
        }
        uint32_t individual = 0;
        for (const HalfTexels& half : halves)
        {
            const std::vector<uint32_t> errors = errorsOfBases(half, 4);
            individual += *std::min_element(errors.begin(), errors.end());
        }
        const std::vector<uint32_t> first = errorsOfBases(halves[0], 5);
        std::vector<uint32_t> second = errorsOfBases(halves[1], 5);
        for (const size_t stride : {1u, 32u, 1024u})
            spreadMinimum(second, stride);
        least = std::min(least, individual);
        for (size_t i = 0; i < first.size(); ++i)
            least = std::min(least, first[i] + second[i]);
    }
    return least;
}

uint32_t leastPlanarError(const Block8& block)
{
    uint32_t sum = 0;
    for (size_t c = 0; c < 3; ++c)
    {
        const int bits = c == 1 ? 7 : 6;
        uint32_t least = UINT32_MAX;
        for (int o = 0; o < 1 << bits; ++o)
            for (int h = 0; h < 1 << bits; ++h)
                for (int v = 0; v < 1 << bits; ++v)
                {
                    const int origin = extend(o, bits), right = extend(h, bits), below = extend(v, bits);
                    uint32_t error = 0;
                    for (int y = 0; y < 4; ++y)
                    {
                        for (int x = 0; x < 4; ++x)
                        {
                            const int value =
                                (x * (right - origin) + y * (below - origin) + 4 * origin + 2) >> 2;
                            error += static_cast<uint32_t>(
                                square(std::clamp(value, 0, 255) - block[static_cast<size_t>(4 * y + x)][c]));
                        }
                        if (error >= least)
                            break;
                    }
                    least = std::min(least, error);
                }
        sum += least;
    }
    return sum;
}

/// Start of T or H.
struct Paints
{
    bool is_h;
    std::array<Color, 2> codes;
    int distance;
};

uint32_t errorOfPaints(const std::array<Color, 16>& texels, const Paints& paints)
{
    std::array<Color, 2> colors;
    for (size_t i = 0; i < 2; ++i)
        for (size_t c = 0; c < 3; ++c)
        {
            const int code = paints.codes[i][c];
            if (code < 0 || code > 15)
                return UINT32_MAX;
            colors[i][c] = extend(code, 4);
        }
    if (paints.distance < 0 || paints.distance > 7 ||
        (paints.is_h && paints.distance % 2 == 0 && paints.codes[0] == paints.codes[1]))
        return UINT32_MAX;
    const int d = formats::kEtcPaintDistances[static_cast<size_t>(paints.distance)];
    if (paints.is_h)
        return errorOfPaints<16>(
            texels, {add(colors[0], d), add(colors[0], -d), add(colors[1], d), add(colors[1], -d)});
    return errorOfPaints<16>(texels, {colors[0], add(colors[1], d), colors[1], add(colors[1], -d)});
}

/// Move one or two codes by one, or the distance, while that lowers the error.
uint32_t descend(const std::array<Color, 16>& texels, Paints paints)
{
    uint32_t error = errorOfPaints(texels, paints);
    const auto at = [](Paints& p, size_t i) -> int& { return i < 6 ? p.codes[i / 3][i % 3] : p.distance; };
    for (bool is_better = true; is_better;)
    {
        is_better = false;
        for (size_t i = 0; i < 7; ++i)
            for (size_t j = i; j < 7; ++j)
                for (const int di : {-1, 1})
                    for (const int dj : {-1, 1})
                    {
                        Paints trial = paints;
                        at(trial, i) += di;
                        if (j != i)
                            at(trial, j) += dj;
                        const uint32_t trial_error = errorOfPaints(texels, trial);
                        if (trial_error >= error)
                            continue;
                        paints = trial;
                        error = trial_error;
                        is_better = true;
                    }
    }
    return error;
}

uint32_t leastPaintsError(const Block8& block)
{
    constexpr size_t kDescents = 24;
    std::array<Color, 16> texels;
    for (size_t t = 0; t < 16; ++t)
        texels[t] = {block[t][0], block[t][1], block[t][2]};
    uint32_t least = UINT32_MAX;
    for (const bool is_h : {false, true})
    {
        std::vector<std::pair<uint32_t, Paints>> starts;
        for (size_t a = 0; a < 16; ++a)
            for (size_t b = 0; b < 16; ++b)
                for (int distance = 0; distance < 8; ++distance)
                {
                    Paints paints{is_h, {}, distance};
                    for (size_t c = 0; c < 3; ++c)
                    {
                        paints.codes[0][c] = (texels[a][c] + 8) / 17;
                        paints.codes[1][c] = (texels[b][c] + 8) / 17;
                    }
                    starts.emplace_back(errorOfPaints(texels, paints), paints);
                }
        const size_t count = std::min(kDescents, starts.size());
        std::partial_sort(starts.begin(), starts.begin() + kDescents, starts.end(),
                          [](const auto& x, const auto& y) { return x.first < y.first; });
        for (size_t i = 0; i < count; ++i)
            least = std::min(least, descend(texels, starts[i].second));
    }
    return least;
}

/// Return the least error over all base, multipliers and tables.
/// errorOf  sum of squares of the targets' distances to eight values
template <typename Value, typename Code>
uint64_t leastEacError(const std::array<Code, 16>& targets, int min_multiplier, Value value)
{
    uint64_t least = UINT64_MAX;
    for (const auto& modifiers : formats::kEacModifiers)
        for (int multiplier = min_multiplier; multiplier < 16; ++multiplier)
            for (int base = 0; base < 256; ++base)
            {
                std::array<int, 16> nearest;
                nearest.fill(INT32_MAX);
                for (const int modifier : modifiers)
                {
                    const int v = value(base, multiplier, modifier);
                    for (size_t t = 0; t < 16; ++t)
                        nearest[t] = std::min(nearest[t], std::abs(v - targets[t]));
                }
                uint64_t error = 0;
                for (const int distance : nearest)
                    error += static_cast<uint64_t>(int64_t{distance} * distance);
                least = std::min(least, error);
            }
    return least;
}

} // namespace

uint32_t leastColorError(const Block8& block)
{
    return std::min({leastHalvesError(block), leastPlanarError(block), leastPaintsError(block)});
}

uint32_t leastAlphaError(const std::array<uint8_t, 16>& alphas)
{
    const auto value = [](int base, int multiplier, int modifier)
    { return std::clamp(base + multiplier * modifier, 0, 255); };
    return static_cast<uint32_t>(leastEacError(alphas, 1, value));
}

uint64_t leastR11Error(const std::array<uint16_t, 16>& codes)
{
    const auto value = [](int base, int multiplier, int modifier)
    {
        const int step = multiplier == 0 ? 1 : 8 * multiplier;
        return int{formats::eacUnorm(std::clamp(8 * base + 4 + step * modifier, 0, 2047))};
    };
    return leastEacError(codes, 0, value);
}

} // namespace hearth::bench
