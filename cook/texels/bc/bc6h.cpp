// Encodes BC6H: lines of colours by least squares, for one subset and for two with the best partitions, in
// the mode with the finest endpoints that can store them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/bc/bc6h.h"

#include "cook/texels/bc/bc7_partitions.h"
#include "cook/texels/bc/principal_axis.h"
#include "formats/texels/bc6h_modes.h"
#include "formats/texels/block_bits.h"
#include "formats/texels/bptc_tables.h"

#include <algorithm>
#include <bit>

namespace hearth::texels
{

namespace
{

using formats::Bc6hMode;

using Color = std::array<int32_t, 3>;

struct Bc6hProblem
{
    std::array<Color, 16> halves;   ///< bits of the source, 0 to 0x7BFF
    std::array<Color, 16> unscaled; ///< the same in the endpoints' scale, 0 to 0xFFFF
};

/// Endpoints by subset and end: 2 * subset + end.
using Ends = std::array<Color, 4>;

/// A partition; with one subset it is 0.
struct Subsets
{
    uint32_t count;
    uint32_t partition;

    uint32_t subsetAt(uint32_t texel) const { return formats::bptcSubset(count, partition, texel); }
    uint32_t indexBits() const { return count == 1 ? 4 : 3; }
    bool isAnchor(uint32_t texel) const
    {
        return texel == formats::bptcAnchor(count, partition, subsetAt(texel));
    }
};

struct Bc6hCandidate
{
    const Bc6hMode* mode = nullptr;
    Subsets subsets{};
    Ends codes{};
    uint64_t error = UINT64_MAX;
};

using IndexList = std::array<uint8_t, 16>;

/// Effort in numbers.
struct Bc6hSearch
{
    uint32_t rounds;     ///< of least squares
    uint32_t partitions; ///< that are tried
    uint32_t passes;     ///< of the refinement
};

constexpr Bc6hSearch chooseBc6hSearch(Effort effort)
{
    switch (effort)
    {
    case Effort::draft:
        return {1, 0, 0};
    case Effort::normal:
        return {2, 4, 2};
    default:
        return {4, 16, 8};
    }
}

/// Finds indices along a line without a division for each texel.
class Projection
{
public:
    Projection(const Color& first, const Color& second, uint32_t index_bits)
        : first_(first), last_((1 << index_bits) - 1)
    {
        int64_t length = 0;
        for (size_t c = 0; c < 3; ++c)
        {
            along_[c] = second[c] - first[c];
            length += along_[c] * along_[c];
        }
        shift_ = std::max(0, static_cast<int>(std::bit_width(static_cast<uint64_t>(length))) - 24);
        scale_ = length == 0 ? 0 : (int64_t{last_} << 24) / (length >> shift_);
    }

    int32_t findIndex(const Color& color) const
    {
        int64_t place = 0;
        for (size_t c = 0; c < 3; ++c)
            place += (color[c] - first_[c]) * along_[c];
        const int64_t index = ((place >> shift_) * scale_ + (1 << 23)) >> 24;
        return static_cast<int32_t>(std::clamp<int64_t>(index, 0, last_));
    }

private:
    Color first_;
    std::array<int64_t, 3> along_;
    int32_t last_;
    int shift_;
    int64_t scale_;
};

/// Choose the index of each texel that decodes best, and of the anchors one without the highest bit.
/// ends     unquantised
/// returns  error of the block
uint64_t chooseIndices(const Bc6hProblem& problem, const Subsets& subsets, const Ends& ends,
                       IndexList& indices)
{
    const uint32_t bits = subsets.indexBits();
    const std::array<Projection, 2> lines = {Projection(ends[0], ends[1], bits),
                                             Projection(ends[2], ends[3], bits)};
    uint64_t sum = 0;
    for (uint32_t t = 0; t < 16; ++t)
    {
        const uint32_t subset = subsets.subsetAt(t);
        const Color &a = ends[2 * subset], &b = ends[2 * subset + 1];
        const int32_t last = (1 << (bits - (subsets.isAnchor(t) ? 1 : 0))) - 1;
        const int32_t middle = std::min(lines[subset].findIndex(problem.unscaled[t]), last);
        uint64_t best = UINT64_MAX;
        for (int32_t i = std::max(middle - 1, 0); i <= std::min(middle + 1, last); ++i)
        {
            uint64_t error = 0;
            for (size_t c = 0; c < 3; ++c)
            {
                const int32_t value =
                    formats::bptcInterpolate(a[c], b[c], formats::bptcWeight(static_cast<uint32_t>(i), bits));
                const int64_t d = formats::bc6hHalf(value, false) - problem.halves[t][c];
                error += static_cast<uint64_t>(d * d);
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

/// Return the ends of each subset's texels along their principal axis.
Ends findEnds(const Bc6hProblem& problem, const Subsets& subsets)
{
    Ends ends{};
    for (uint32_t subset = 0; subset < subsets.count; ++subset)
    {
        std::array<int64_t, 3> sums{};
        int64_t count = 0;
        for (uint32_t t = 0; t < 16; ++t)
            if (subsets.subsetAt(t) == subset)
            {
                ++count;
                for (size_t c = 0; c < 3; ++c)
                    sums[c] += problem.unscaled[t][c];
            }
        SymmetricMatrix<3> matrix{};
        for (uint32_t t = 0; t < 16; ++t)
            for (size_t i = 0; subsets.subsetAt(t) == subset && i < 3; ++i)
                for (size_t j = 0; j < 3; ++j)
                    matrix[i][j] += (problem.unscaled[t][i] - sums[i] / count) *
                                    (problem.unscaled[t][j] - sums[j] / count);
        const std::array<int64_t, 3> axis = largestEigenvector(matrix, 3);
        int64_t low = INT64_MAX, high = INT64_MIN;
        for (uint32_t t = 0; t < 16; ++t)
            if (subsets.subsetAt(t) == subset)
            {
                int64_t place = 0;
                for (size_t c = 0; c < 3; ++c)
                    place += (problem.unscaled[t][c] - sums[c] / count) * axis[c];
                low = std::min(low, place);
                high = std::max(high, place);
            }
        const int64_t length =
            std::max<int64_t>(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2], 1);
        for (size_t c = 0; c < 3; ++c)
        {
            const auto end = [&](int64_t place) {
                return static_cast<int32_t>(
                    std::clamp<int64_t>(sums[c] / count + place * axis[c] / length, 0, 0xFFFF));
            };
            ends[2 * subset][c] = end(low);
            ends[2 * subset + 1][c] = end(high);
        }
    }
    return ends;
}

/// Move ends to the best ones for the indices, if the indices of a subset differ.
void solve(const Bc6hProblem& problem, const Subsets& subsets, const IndexList& indices, Ends& ends)
{
    for (uint32_t subset = 0; subset < subsets.count; ++subset)
    {
        int64_t aa = 0, ab = 0, bb = 0;
        std::array<int64_t, 3> a{}, b{};
        for (uint32_t t = 0; t < 16; ++t)
        {
            if (subsets.subsetAt(t) != subset)
                continue;
            const auto share = static_cast<int64_t>(formats::bptcWeight(indices[t], subsets.indexBits()));
            aa += (64 - share) * (64 - share);
            ab += (64 - share) * share;
            bb += share * share;
            for (size_t c = 0; c < 3; ++c)
            {
                a[c] += (64 - share) * problem.unscaled[t][c];
                b[c] += share * problem.unscaled[t][c];
            }
        }
        const int64_t determinant = aa * bb - ab * ab;
        for (size_t c = 0; determinant != 0 && c < 3; ++c)
        {
            const auto end = [&](int64_t value)
            { return static_cast<int32_t>(std::clamp<int64_t>(64 * value / determinant, 0, 0xFFFF)); };
            ends[2 * subset][c] = end(bb * a[c] - ab * b[c]);
            ends[2 * subset + 1][c] = end(aa * b[c] - ab * a[c]);
        }
    }
}

/// Exchange the ends of a subset if its anchor is nearer to the second.
void orient(const Bc6hProblem& problem, const Subsets& subsets, Ends& ends)
{
    for (uint32_t subset = 0; subset < subsets.count; ++subset)
    {
        const uint32_t anchor = formats::bptcAnchor(subsets.count, subsets.partition, subset);
        Color &a = ends[2 * subset], &b = ends[2 * subset + 1];
        if (Projection(a, b, 4).findIndex(problem.unscaled[anchor]) >= 8)
            std::swap(a, b);
    }
}

/// Return true if a mode can store the codes: differences must fit.
bool fits(const Bc6hMode& mode, const Ends& codes)
{
    for (size_t e = 0; e < 2u * mode.subsets; ++e)
        for (size_t c = 0; c < 3; ++c)
        {
            if (codes[e][c] < 0 || codes[e][c] >= 1 << mode.endpoint_bits)
                return false;
            const int32_t difference = codes[e][c] - codes[0][c];
            const int32_t limit = 1 << (mode.delta_bits[c] - 1);
            if (mode.transformed && e > 0 && (difference < -limit || difference >= limit))
                return false;
        }
    return true;
}

/// Keep a candidate with these codes if the mode can store them and it is better.
bool keepBetter(const Bc6hProblem& problem, const Bc6hMode& mode, const Subsets& subsets, const Ends& codes,
                Bc6hCandidate& best)
{
    if (!fits(mode, codes))
        return false;
    Ends ends{};
    for (size_t e = 0; e < 2u * mode.subsets; ++e)
        for (size_t c = 0; c < 3; ++c)
            ends[e][c] = formats::unquantizeBc6h(codes[e][c], mode.endpoint_bits, false);
    IndexList indices{};
    const uint64_t error = chooseIndices(problem, subsets, ends, indices);
    if (error >= best.error)
        return false;
    best = {&mode, subsets, codes, error};
    return true;
}

/// Try the mode with the finest codes that can store the ends. Modes with equally fine codes store the same
/// ones.
void tryFinestMode(const Bc6hProblem& problem, const Subsets& subsets, const Ends& ends, Bc6hCandidate& best)
{
    const Bc6hMode* finest = nullptr;
    Ends finest_codes{};
    for (const Bc6hMode& mode : formats::kBc6hModes)
    {
        if (mode.subsets != subsets.count ||
            (finest != nullptr && finest->endpoint_bits >= mode.endpoint_bits))
            continue;
        // a code stands for the middle of the values that begin with its bits
        Ends codes{};
        for (size_t e = 0; e < 2 * subsets.count; ++e)
            for (size_t c = 0; c < 3; ++c)
                codes[e][c] = ends[e][c] >> (16 - mode.endpoint_bits);
        if (fits(mode, codes))
        {
            finest = &mode;
            finest_codes = codes;
        }
    }
    keepBetter(problem, *finest, subsets, finest_codes, best); // some mode stores whole codes
}

void trySubsets(const Bc6hProblem& problem, const Subsets& subsets, uint32_t rounds, Bc6hCandidate& best)
{
    Ends ends = findEnds(problem, subsets);
    orient(problem, subsets, ends);
    IndexList indices{};
    for (uint32_t i = 0; i < rounds; ++i)
    {
        chooseIndices(problem, subsets, ends, indices);
        solve(problem, subsets, indices, ends);
    }
    orient(problem, subsets, ends);
    tryFinestMode(problem, subsets, ends, best);
}

/// Scale the texels to 8 bits about their minimum, for the rank of partitions.
std::array<std::array<int16_t, 16>, 4> reducedValues(const Bc6hProblem& problem)
{
    int32_t range = 0;
    Color low = problem.unscaled[0];
    for (const Color& color : problem.unscaled)
        for (size_t c = 0; c < 3; ++c)
            low[c] = std::min(low[c], color[c]);
    for (const Color& color : problem.unscaled)
        for (size_t c = 0; c < 3; ++c)
            range = std::max(range, color[c] - low[c]);
    std::array<std::array<int16_t, 16>, 4> values{};
    for (size_t t = 0; t < 16; ++t)
        for (size_t c = 0; c < 3; ++c)
            values[c][t] = static_cast<int16_t>((problem.unscaled[t][c] - low[c]) * 255 / std::max(range, 1));
    return values;
}

/// Move codes by one as long as the error decreases.
void refine(const Bc6hProblem& problem, uint32_t passes, Bc6hCandidate& best)
{
    for (uint32_t pass = 0; pass < passes && best.error > 0; ++pass)
    {
        bool found = false;
        for (size_t e = 0; e < 2 * best.subsets.count; ++e)
            for (size_t c = 0; c < 3; ++c)
                for (const int32_t step : {1, -1})
                {
                    Ends codes = best.codes;
                    codes[e][c] += step;
                    found |= keepBetter(problem, *best.mode, best.subsets, codes, best);
                }
        if (!found)
            return;
    }
}

void pack(const Bc6hProblem& problem, const Bc6hCandidate& candidate, std::span<std::byte, 16> block)
{
    const Bc6hMode& mode = *candidate.mode;
    Ends ends{};
    std::array<uint32_t, 12> variables{};
    for (size_t e = 0; e < 2u * mode.subsets; ++e)
        for (size_t c = 0; c < 3; ++c)
        {
            const int32_t code = candidate.codes[e][c];
            ends[e][c] = formats::unquantizeBc6h(code, mode.endpoint_bits, false);
            variables[3 * e + c] =
                static_cast<uint32_t>(mode.transformed && e > 0 ? code - candidate.codes[0][c] : code);
        }
    IndexList indices{};
    chooseIndices(problem, candidate.subsets, ends, indices);

    formats::BlockBitWriter bits;
    bits.write(mode.number, mode.number < 2 ? 2 : 5);
    for (uint32_t i = 0; i < mode.field_count; ++i)
    {
        const formats::Bc6hField field = mode.fields[i];
        const int step = field.first <= field.last ? 1 : -1;
        for (int bit = field.first; bit != field.last + step; bit += step)
            bits.write(variables[static_cast<size_t>(field.variable)] >> bit & 1u, 1);
    }
    if (mode.subsets == 2)
        bits.write(candidate.subsets.partition, 5);
    for (uint32_t t = 0; t < 16; ++t)
        bits.write(indices[t], candidate.subsets.indexBits() - (candidate.subsets.isAnchor(t) ? 1 : 0));
    bits.store(block);
}

/// Make the bits of a half a finite value of at least 0.
int32_t storable(uint16_t half)
{
    constexpr int32_t kMaxHalf = 0x7BFF, kInfinity = 0x7C00;
    if (half > kInfinity) // NaN, or negative
        return 0;
    return std::min<int32_t>(half, kMaxHalf);
}

} // namespace

uint64_t encodeBc6h(const Block16& texels, Effort effort, std::span<std::byte, 16> block)
{
    Bc6hProblem problem;
    for (size_t t = 0; t < 16; ++t)
        for (size_t c = 0; c < 3; ++c)
        {
            problem.halves[t][c] = storable(texels[t][c]);
            // the middle of the values that decode to the half
            problem.unscaled[t][c] = std::min((problem.halves[t][c] * 64 + 47) / 31, 0xFFFF);
        }
    const Bc6hSearch search = chooseBc6hSearch(effort);
    Bc6hCandidate best;
    trySubsets(problem, {1, 0}, search.rounds, best);
    if (best.error > 0 && search.partitions > 0)
    {
        std::array<uint8_t, 32> buffer;
        const auto partitions = std::span(buffer).first(search.partitions);
        rankPartitions(reducedValues(problem), 3, 2, 32, partitions);
        for (const uint8_t partition : partitions)
            trySubsets(problem, {2, partition}, search.rounds, best);
    }
    refine(problem, search.passes, best);
    pack(problem, best, block);
    return best.error;
}

} // namespace hearth::texels
