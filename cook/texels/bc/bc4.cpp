// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/bc/bc4.h"

#include <algorithm>
#include <array>

namespace hearth::texels
{

namespace
{

/// Bc4Values of a channel that a block is to have.
struct Bc4Values
{
    std::array<int32_t, 16> texels;
    int32_t scale; ///< value of 1: 255 or 65535
};

/// Endpoints of 8 bits. A palette with eight values between them has first > second; the other has six, and 0
/// and 1.
struct Bc4Ends
{
    int32_t first, second;
};

struct Bc4Solution
{
    Bc4Ends ends{};
    uint64_t error = UINT64_MAX;
};

using Bc4Palette = std::array<int32_t, 8>;

/// Make the decoder's palette, by index: the fraction rounded to nearest.
Bc4Palette makePalette(const Bc4Ends& ends, int32_t scale)
{
    Bc4Palette palette{};
    const int32_t unit = scale / 255;
    palette[0] = ends.first * unit;
    palette[1] = ends.second * unit;
    const int32_t steps = ends.first > ends.second ? 7 : 5;
    for (int32_t i = 1; i < steps; ++i)
        palette[static_cast<size_t>(i) + 1] =
            (((steps - i) * ends.first + i * ends.second) * unit + steps / 2) / steps;
    if (steps == 5)
        palette[7] = scale;
    return palette;
}

/// Choose the nearest value of each texel.
/// indices  [texel]
/// returns  sum of the squares of the differences
uint64_t chooseIndices(const Bc4Values& values, const Bc4Palette& palette, std::array<int32_t, 16>& indices)
{
    std::array<int32_t, 16> best;
    best.fill(INT32_MAX);
    for (int32_t k = 0; k < 8; ++k)
        for (size_t t = 0; t < 16; ++t)
        {
            const int32_t difference = values.texels[t] - palette[static_cast<size_t>(k)];
            const int32_t distance = difference < 0 ? -difference : difference;
            indices[t] = distance < best[t] ? k : indices[t];
            best[t] = distance < best[t] ? distance : best[t];
        }
    uint64_t error = 0;
    for (const int32_t distance : best)
        error += static_cast<uint64_t>(distance) * static_cast<uint64_t>(distance);
    return error;
}

bool keepBetter(const Bc4Values& values, const Bc4Ends& ends, Bc4Solution& best)
{
    std::array<int32_t, 16> indices{};
    const uint64_t error = chooseIndices(values, makePalette(ends, values.scale), indices);
    if (error >= best.error)
        return false;
    best = {ends, error};
    return true;
}

/// Return the best endpoints for the indices that these endpoints have; the same if the indices say nothing.
Bc4Ends solve(const Bc4Values& values, const Bc4Ends& ends)
{
    std::array<int32_t, 16> indices{};
    chooseIndices(values, makePalette(ends, values.scale), indices);
    const int64_t steps = ends.first > ends.second ? 7 : 5;
    int64_t aa = 0, ab = 0, bb = 0, a = 0, b = 0;
    for (size_t t = 0; t < 16; ++t)
    {
        if (steps == 5 && indices[t] >= 6)
            continue;
        const int64_t share = indices[t] == 0 ? 0 : indices[t] == 1 ? steps : indices[t] - 1;
        aa += (steps - share) * (steps - share);
        ab += (steps - share) * share;
        bb += share * share;
        a += (steps - share) * values.texels[t];
        b += share * values.texels[t];
    }
    const int64_t determinant = aa * bb - ab * ab;
    if (determinant == 0)
        return ends;
    const auto round = [&](int64_t dividend)
    {
        const int64_t divisor = determinant * (values.scale / 255);
        const int64_t code = (2 * dividend + divisor) / (2 * divisor);
        return static_cast<int32_t>(std::clamp<int64_t>(dividend < 0 ? 0 : code, 0, 255));
    };
    return {round(steps * (bb * a - ab * b)), round(steps * (aa * b - ab * a))};
}

/// Return true if the endpoints have a palette with eight values between them, or the other kind.
bool isKind(const Bc4Ends& ends, bool has_eight)
{
    return ends.first >= 0 && ends.first <= 255 && ends.second >= 0 && ends.second <= 255 &&
           (ends.first > ends.second) == has_eight;
}

/// Improve endpoints by least squares, then by steps of the codes, as long as the error decreases.
void refine(const Bc4Values& values, bool has_eight, int32_t reach, Bc4Solution& best)
{
    for (Bc4Ends next = solve(values, best.ends); isKind(next, has_eight) && keepBetter(values, next, best);)
        next = solve(values, best.ends);
    for (bool found = true; found && best.error > 0;)
    {
        found = false;
        const Bc4Ends center = best.ends;
        for (int32_t i = -reach; i <= reach; ++i)
            for (int32_t j = -reach; j <= reach; ++j)
            {
                const Bc4Ends ends{center.first + i, center.second + j};
                if (isKind(ends, has_eight))
                    found |= keepBetter(values, ends, best);
            }
    }
}

/// Find endpoints of one kind of palette from the range of the values.
Bc4Solution search(const Bc4Values& values, bool has_eight, Effort effort)
{
    // the kind with six values has 0 and 1 besides: values close to them do not widen the range
    const int32_t margin = has_eight ? -1 : values.scale / 32;
    int32_t low = values.scale, high = 0;
    for (const int32_t value : values.texels)
        if (value > margin && value < values.scale - margin)
        {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    const int32_t unit = values.scale / 255;
    if (low > high)
        low = high = 0;
    Bc4Ends ends{std::min((high + unit - 1) / unit, 255), low / unit};
    if (has_eight && ends.first == ends.second)
        ends.first < 255 ? ++ends.first : --ends.second;
    if (!has_eight)
        std::swap(ends.first, ends.second);
    Bc4Solution best;
    keepBetter(values, ends, best);
    if (effort != Effort::draft)
        refine(values, has_eight, effort == Effort::normal ? 1 : 3, best);
    return best;
}

uint64_t encode(const Bc4Values& values, Effort effort, std::span<std::byte, 8> block)
{
    Bc4Solution best = search(values, true, effort);
    if (best.error > 0)
    {
        const Bc4Solution six = search(values, false, effort);
        if (six.error < best.error)
            best = six;
    }
    std::array<int32_t, 16> indices{};
    chooseIndices(values, makePalette(best.ends, values.scale), indices);
    uint64_t bits = static_cast<uint64_t>(best.ends.first) | static_cast<uint64_t>(best.ends.second) << 8;
    for (size_t t = 0; t < 16; ++t)
        bits |= static_cast<uint64_t>(indices[t]) << (16 + 3 * t);
    for (size_t i = 0; i < 8; ++i)
        block[i] = static_cast<std::byte>(bits >> 8 * i & 0xFFu);
    return best.error;
}

} // namespace

uint64_t encodeBc4(const Block16& texels, size_t channel, Effort effort, std::span<std::byte, 8> block)
{
    Bc4Values values{{}, 65535};
    for (size_t t = 0; t < 16; ++t)
        values.texels[t] = texels[t][channel];
    return encode(values, effort, block);
}

uint64_t encodeBc5(const Block16& texels, Effort effort, std::span<std::byte, 16> block)
{
    return encodeBc4(texels, 0, effort, block.first<8>()) + encodeBc4(texels, 1, effort, block.last<8>());
}

uint32_t encodeBc3Alpha(const Block8& texels, Effort effort, std::span<std::byte, 8> block)
{
    Bc4Values values{{}, 255};
    for (size_t t = 0; t < 16; ++t)
        values.texels[t] = texels[t][3];
    return static_cast<uint32_t>(encode(values, effort, block));
}

} // namespace hearth::texels
