// Encodes BC7: a line fit for each subset of each promising layout, then a refinement of the best.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/bc/bc7.h"

#include "cook/texels/bc/bc7_partitions.h"
#include "cook/texels/bc/line_fit.h"
#include "formats/texels/bc7_modes.h"
#include "formats/texels/block_bits.h"
#include "formats/texels/bptc_tables.h"

#include <algorithm>

namespace hearth::texels
{

namespace
{

using Bc7Values = std::array<std::array<int16_t, 16>, 4>; ///< [channel][texel]

struct Bc7Problem
{
    Bc7Values values;
    LineWeights weights; ///< 0 of alpha that is 255 everywhere
    bool is_opaque;      ///< decoded alpha must be 255
    bool has_alpha;      ///< alpha counts and is not 255 everywhere
};

/// Choices of a block beside endpoints and indices.
struct Layout
{
    uint8_t mode = 6;
    uint8_t partition = 0;
    uint8_t rotation = 0;
    uint8_t selection = 0;
};

struct Candidate
{
    Layout layout;
    std::array<Line, 3> lines{}; ///< by subset; of modes 4 and 5: colours, alpha
    uint32_t error = UINT32_MAX;
};

/// Best candidates, the best first.
class BestCandidates
{
public:
    explicit BestCandidates(size_t capacity) : capacity_(capacity) {}

    void add(const Candidate& candidate)
    {
        if (size_ == capacity_ && candidate.error >= list_[size_ - 1].error)
            return;
        size_t i = size_ < capacity_ ? size_++ : size_ - 1;
        for (; i > 0 && list_[i - 1].error > candidate.error; --i)
            list_[i] = list_[i - 1];
        list_[i] = candidate;
    }

    uint32_t worstError() const { return size_ < capacity_ ? UINT32_MAX : list_[size_ - 1].error; }
    uint32_t bestError() const { return size_ == 0 ? UINT32_MAX : list_[0].error; }
    std::span<Candidate> list() { return std::span(list_).first(size_); }

private:
    size_t capacity_;
    size_t size_ = 0;
    std::array<Candidate, 8> list_;
};

/// Effort in numbers.
struct Bc7Search
{
    uint32_t rounds;  ///< of least squares
    uint32_t ranked;  ///< partitions of each number of subsets that are measured
    uint32_t fitted;  ///< partitions that are fitted, of those
    uint32_t refined; ///< candidates that are refined
    uint32_t passes;  ///< of a refinement
    uint32_t gain;    ///< a refinement is hoped to take this many fourths of the error
    bool three_subsets;
    bool two_index_sets; ///< also of opaque blocks
    bool many_starts;    ///< of a refinement
};

constexpr Bc7Search chooseSearch(Effort effort)
{
    switch (effort)
    {
    case Effort::draft:
        return {1, 1, 1, 1, 0, 1, false, false, false};
    case Effort::normal:
        return {2, 5, 2, 2, 1, 1, false, true, false};
    default:
        return {4, 64, 12, 4, 8, 1, true, true, false};
    }
}

// Blocks of few colours, as of painted palettes, are searched again if their error is large enough to count.
// Their best line is the one that passes through most of the colours, and it is seldom the principal axis.
constexpr Bc7Search kFewColorsSearch{1, 16, 4, 4, 2, 2, true, true, true};
constexpr size_t kFewColors = 12;
constexpr uint32_t kFewColorsError = 24; // of a block

/// Exchange alpha with the channel that a rotation names.
template <typename T>
std::array<T, 4> rotate(std::array<T, 4> channels, uint32_t rotation)
{
    if (rotation != 0)
        std::swap(channels[3], channels[rotation - 1]);
    return channels;
}

/// Return the format of the lines of a mode. Of modes 4 and 5: of the colours, or of alpha.
LineFormat lineFormat(const Layout& layout, bool is_alpha, bool is_opaque)
{
    const formats::Bc7Mode& mode = formats::kBc7Modes[layout.mode];
    const auto more = static_cast<uint8_t>(mode.endpoint_p_bits + mode.shared_p_bits);
    const auto color = static_cast<uint8_t>(mode.color_bits + more);
    const auto alpha = static_cast<uint8_t>(mode.alpha_bits == 0 ? 0 : mode.alpha_bits + more);
    LineFormat format{{color, color, color, alpha}, LowestBit::free, mode.index_bits};
    if (mode.endpoint_p_bits != 0)
        format.lowest = is_opaque && alpha != 0 ? LowestBit::set : LowestBit::each;
    if (mode.shared_p_bits != 0)
        format.lowest = LowestBit::shared;
    if (mode.second_index_bits != 0)
    {
        if (is_alpha != (layout.selection != 0))
            format.index_bits = mode.second_index_bits;
    }
    return format;
}

uint32_t lineCount(const Layout& layout)
{
    const formats::Bc7Mode& mode = formats::kBc7Modes[layout.mode];
    return mode.second_index_bits != 0 ? 2 : mode.subsets;
}

/// Texels and weights of one line of a layout.
struct LineTask
{
    LineTexels texels;
    LineWeights weights;
    LineFormat format;
};

LineTexels gather(const Bc7Values& values, uint32_t subsets, uint32_t partition, uint32_t subset)
{
    LineTexels texels{{}, 0};
    for (uint32_t t = 0; t < 16; ++t)
        if (formats::bptcSubset(subsets, partition, t) == subset)
        {
            for (size_t c = 0; c < 4; ++c)
                texels.values[c][texels.count] = values[c][t];
            ++texels.count;
        }
    return texels;
}

LineTask makeTask(const Bc7Problem& problem, const Layout& layout, uint32_t line)
{
    const formats::Bc7Mode& mode = formats::kBc7Modes[layout.mode];
    if (mode.second_index_bits == 0)
        return {gather(problem.values, mode.subsets, layout.partition, line), problem.weights,
                lineFormat(layout, false, problem.is_opaque)};
    LineTask task{{rotate(problem.values, layout.rotation), 16},
                  rotate(problem.weights, layout.rotation),
                  lineFormat(layout, line == 1, problem.is_opaque)};
    for (size_t c = 0; c < 4; ++c)
        if ((c == 3) != (line == 1))
            task.weights[c] = 0;
    return task;
}

void tryLayout(const Bc7Problem& problem, const Layout& layout, const Bc7Search& search, BestCandidates& best)
{
    Candidate candidate{layout, {}, 0};
    for (uint32_t i = 0; i < lineCount(layout) && candidate.error < best.worstError(); ++i)
    {
        const LineTask task = makeTask(problem, layout, i);
        candidate.lines[i] = fitLine(task.texels, task.weights, task.format,
                                     findEnds(task.texels, task.weights), search.rounds);
        candidate.error += candidate.lines[i].error;
    }
    best.add(candidate);
}

/// Texels and ends of the subsets of a partition.
struct PartitionedTexels
{
    uint8_t partition;
    std::array<LineTexels, 3> texels;
    std::array<LineEnds, 3> ends;
    uint32_t error; ///< of the ends as they are
};

/// Fit the subsets in a mode.
Candidate fitPartition(const Bc7Problem& problem, const PartitionedTexels& parts, uint8_t mode,
                       uint32_t rounds)
{
    Candidate candidate{{mode, parts.partition, 0, 0}, {}, 0};
    const LineFormat format = lineFormat(candidate.layout, false, problem.is_opaque);
    for (uint32_t i = 0; i < formats::kBc7Modes[mode].subsets; ++i)
    {
        candidate.lines[i] = fitLine(parts.texels[i], problem.weights, format, parts.ends[i], rounds);
        candidate.error += candidate.lines[i].error;
    }
    return candidate;
}

/// Try modes with the same number of subsets and of partitions.
/// modes  the first of them measures the partitions
void tryPartitions(const Bc7Problem& problem, std::span<const uint8_t> modes, const Bc7Search& search,
                   BestCandidates& best)
{
    const uint32_t subsets = formats::kBc7Modes[modes[0]].subsets;
    const uint32_t partitions = 1u << formats::kBc7Modes[modes[0]].partition_bits;
    std::array<uint8_t, 64> buffer;
    const auto ranked = std::span(buffer).first(std::min(search.ranked, partitions));
    rankPartitions(problem.values, problem.has_alpha ? 4 : 3, subsets, partitions, ranked);
    std::array<PartitionedTexels, 16> kept;
    size_t count = 0;
    for (const uint8_t partition : ranked)
    {
        PartitionedTexels parts;
        parts.partition = partition;
        for (uint32_t i = 0; i < subsets; ++i)
        {
            parts.texels[i] = gather(problem.values, subsets, partition, i);
            parts.ends[i] = findEnds(parts.texels[i], problem.weights);
        }
        parts.error = fitPartition(problem, parts, modes[0], 0).error;
        if (count == search.fitted && parts.error >= kept[count - 1].error)
            continue;
        size_t at = count < search.fitted ? count++ : count - 1;
        for (; at > 0 && kept[at - 1].error > parts.error; --at)
            kept[at] = kept[at - 1];
        kept[at] = parts;
    }
    for (const PartitionedTexels& parts : std::span(kept).first(count))
        for (const uint8_t mode : modes)
            best.add(fitPartition(problem, parts, mode, search.rounds));
}

void tryTwoIndexSets(const Bc7Problem& problem, const Bc7Search& search, BestCandidates& best)
{
    for (uint8_t rotation = 0; rotation < 4; ++rotation)
    {
        tryLayout(problem, {5, 0, rotation, 0}, search, best);
        // without alpha to store, the coarser endpoints of mode 4 are of no use
        for (uint8_t selection = 0; selection < 2 && (rotation != 0 || problem.has_alpha); ++selection)
            tryLayout(problem, {4, 0, rotation, selection}, search, best);
    }
}

/// Move both ends away from their middle, to `quarters` fourths of the distance.
LineEnds stretch(const LineEnds& ends, int32_t quarters)
{
    LineEnds result;
    for (size_t c = 0; c < 4; ++c)
    {
        const int32_t middle = (ends[0][c] + ends[1][c]) / 2;
        for (size_t e = 0; e < 2; ++e)
            result[e][c] = std::clamp(middle + (ends[e][c] - middle) * quarters / 4, 0, 4080);
    }
    return result;
}

/// Return ends between which the texels' extremes get the given shares, of 64.
LineEnds spread(const LineEnds& extremes, int32_t first, int32_t last)
{
    LineEnds result;
    for (size_t c = 0; c < 4; ++c)
    {
        const int32_t length = extremes[1][c] - extremes[0][c];
        result[0][c] = std::clamp(extremes[0][c] - length * first / (last - first), 0, 4080);
        result[1][c] = std::clamp(extremes[1][c] + length * (64 - last) / (last - first), 0, 4080);
    }
    return result;
}

/// Try ends that lie further apart than the texels, so that these get other indices: each pair of indices of
/// the extremes, but those that would use less than a third of the line.
void tryManyStarts(const LineTask& task, const Bc7Search& search, const LineEnds& extremes, Line& line)
{
    const uint32_t last = (1u << task.format.index_bits) - 1;
    Line best;
    for (uint32_t i = 0; i < last; ++i)
        for (uint32_t j = i + (last + 2) / 3; j <= last && best.error > 0; ++j)
        {
            const LineEnds ends =
                spread(extremes, static_cast<int32_t>(formats::bptcWeight(i, task.format.index_bits)),
                       static_cast<int32_t>(formats::bptcWeight(j, task.format.index_bits)));
            const Line other = fitLine(task.texels, task.weights, task.format, ends, search.rounds);
            if (other.error < best.error)
                best = other;
        }
    refineLine(task.texels, task.weights, task.format, search.passes, best);
    if (best.error < line.error)
        line = best;
}

/// Refine a line. If its error is small, what counts is which colours happen to lie between the ends: then
/// ends that lie further apart are tried as well.
void refine(const LineTask& task, const Bc7Search& search, Line& line)
{
    constexpr uint32_t kSmallError = 3; // of a texel
    refineLine(task.texels, task.weights, task.format, search.passes, line);
    if (line.error == 0 || search.passes == 0)
        return;
    const LineEnds ends = findEnds(task.texels, task.weights);
    if (search.many_starts)
        return tryManyStarts(task, search, ends, line);
    if (line.error > kSmallError * task.texels.count)
        return;
    for (const int32_t quarters : {5, 6, 8})
    {
        Line other = fitLine(task.texels, task.weights, task.format, stretch(ends, quarters), search.rounds);
        refineLine(task.texels, task.weights, task.format, search.passes, other);
        if (other.error < line.error)
            line = other;
    }
}

void refine(const Bc7Problem& problem, const Bc7Search& search, Candidate& candidate)
{
    candidate.error = 0;
    for (uint32_t i = 0; i < lineCount(candidate.layout); ++i)
    {
        refine(makeTask(problem, candidate.layout, i), search, candidate.lines[i]);
        candidate.error += candidate.lines[i].error;
    }
}

/// [value]: codes of 7 bits between which the value lies exactly at index 1 of 2 bits, in mode 5.
constexpr std::array<std::array<uint8_t, 2>, 256> kSingleColors = []
{
    std::array<std::array<uint8_t, 2>, 256> table{};
    for (int value = 0; value < 256; ++value)
    {
        // the codes around the value, then those that are one further apart
        const int near = value >> 1;
        for (int i = 0; i < 9; ++i)
        {
            const int a = near + i / 3 - 1, b = near + i % 3 - 1;
            if (a < 0 || b < 0 || a > 127 || b > 127)
                continue;
            const auto first = static_cast<uint8_t>(a), second = static_cast<uint8_t>(b);
            if (formats::bptcInterpolate(widenCode(first, 7), widenCode(second, 7),
                                         formats::bptcWeight(1, 2)) == value)
                table[static_cast<size_t>(value)] = {first, second};
        }
    }
    return table;
}();

/// Encode a block of one color exactly.
Candidate makeSingleColor(const Bc7Problem& problem)
{
    Candidate candidate{{5, 0, 0, 0}, {}, 0};
    for (size_t c = 0; c < 3; ++c)
        for (size_t e = 0; e < 2; ++e)
            candidate.lines[0].codes[e][c] = kSingleColors[static_cast<size_t>(problem.values[c][0])][e];
    candidate.lines[1].codes[0][3] = candidate.lines[1].codes[1][3] =
        static_cast<uint8_t>(problem.values[3][0]);
    return candidate;
}

bool isSingleColor(const Bc7Problem& problem)
{
    return std::all_of(problem.values.begin(), problem.values.end(),
                       [](const std::array<int16_t, 16>& channel)
                       { return std::count(channel.begin(), channel.end(), channel[0]) == 16; });
}

/// Indices of a layout's lines by texel.
struct Indices
{
    std::array<std::array<uint8_t, 16>, 2> sets{}; ///< first and second indices
};

/// Choose the indices, exchanging ends so that the anchors' highest bits are 0.
/// error  gets that of the block
Indices chooseIndices(const Bc7Problem& problem, Candidate& candidate)
{
    const Layout& layout = candidate.layout;
    const formats::Bc7Mode& mode = formats::kBc7Modes[layout.mode];
    Indices indices;
    candidate.error = 0;
    for (uint32_t i = 0; i < lineCount(layout); ++i)
    {
        const LineTask task = makeTask(problem, layout, i);
        Line& line = candidate.lines[i];
        std::array<uint8_t, 16> chosen{};
        candidate.error += chooseLineIndices(task.texels, task.weights, task.format, line, chosen);
        const bool has_two_sets = mode.second_index_bits != 0;
        const uint32_t set = has_two_sets && (i == 1) != (layout.selection != 0) ? 1 : 0;
        std::array<uint8_t, 16>& by_texel = indices.sets[set];
        size_t next = 0;
        uint8_t flip = 0;
        const uint32_t anchor = has_two_sets ? 0 : formats::bptcAnchor(mode.subsets, layout.partition, i);
        const auto max = static_cast<uint8_t>((1u << task.format.index_bits) - 1);
        for (uint32_t t = 0; t < 16; ++t)
            if (has_two_sets || formats::bptcSubset(mode.subsets, layout.partition, t) == i)
            {
                by_texel[t] = chosen[next++];
                if (t == anchor && by_texel[t] > max / 2)
                    flip = max;
            }
        if (flip == 0)
            continue;
        std::swap(line.codes[0], line.codes[1]);
        for (uint32_t t = 0; t < 16; ++t)
            if (has_two_sets || formats::bptcSubset(mode.subsets, layout.partition, t) == i)
                by_texel[t] = static_cast<uint8_t>(max - by_texel[t]);
    }
    return indices;
}

void pack(const Candidate& candidate, const Indices& indices, std::span<std::byte, 16> block)
{
    const Layout& layout = candidate.layout;
    const formats::Bc7Mode& mode = formats::kBc7Modes[layout.mode];
    formats::BlockBitWriter bits;
    bits.write(1u << layout.mode, layout.mode + 1u);
    bits.write(layout.partition, mode.partition_bits);
    bits.write(layout.rotation, mode.rotation_bits);
    bits.write(layout.selection, mode.selection_bits);
    const uint32_t more = mode.endpoint_p_bits + mode.shared_p_bits;
    const bool has_two_sets = mode.second_index_bits != 0;
    for (size_t c = 0; c < 4; ++c)
        for (uint32_t i = 0; i < 2u * mode.subsets; ++i)
        {
            const uint32_t line = has_two_sets ? (c == 3 ? 1 : 0) : i / 2;
            bits.write(candidate.lines[line].codes[i % 2][c] >> more,
                       c < 3 ? mode.color_bits : mode.alpha_bits);
        }
    for (uint32_t i = 0; i < 2u * mode.subsets; ++i)
        if (mode.endpoint_p_bits != 0 || (mode.shared_p_bits != 0 && i % 2 == 0))
            bits.write(candidate.lines[i / 2].codes[i % 2][0] & 1u, 1);
    for (size_t set = 0; set < 2; ++set)
    {
        const uint32_t width = set == 0 ? mode.index_bits : mode.second_index_bits;
        for (uint32_t t = 0; width != 0 && t < 16; ++t)
        {
            const uint32_t subset = formats::bptcSubset(mode.subsets, layout.partition, t);
            const bool is_anchor = t == formats::bptcAnchor(mode.subsets, layout.partition, subset);
            bits.write(indices.sets[set][t], width - (is_anchor ? 1 : 0));
        }
    }
    bits.store(block);
}

/// Search the layouts, and refine the best ones.
Candidate findBest(const Bc7Problem& problem, const Bc7Search& search)
{
    BestCandidates best(search.refined);
    tryLayout(problem, {6, 0, 0, 0}, search, best);
    if (best.bestError() > 0)
    {
        constexpr std::array<uint8_t, 2> kTwoSubsets = {1, 3};
        constexpr std::array<uint8_t, 1> kTwoSubsetsWithAlpha = {7}, kFine = {2}, kCoarse = {0};
        if (problem.has_alpha)
            tryPartitions(problem, kTwoSubsetsWithAlpha, search, best);
        else
            tryPartitions(problem, kTwoSubsets, search, best);
        if (search.three_subsets && !problem.has_alpha)
        {
            tryPartitions(problem, kFine, search, best);
            tryPartitions(problem, kCoarse, search, best);
        }
        if (search.two_index_sets || problem.has_alpha)
            tryTwoIndexSets(problem, search, best);
    }
    uint32_t least = UINT32_MAX;
    size_t chosen = 0;
    for (size_t i = 0; i < best.list().size(); ++i)
    {
        Candidate& candidate = best.list()[i];
        if (candidate.error - candidate.error / 4 * search.gain >= least)
            continue;
        refine(problem, search, candidate);
        if (candidate.error < least)
        {
            least = candidate.error;
            chosen = i;
        }
    }
    return best.list()[chosen];
}

bool hasFewColors(const Block8& texels)
{
    Block8 sorted = texels;
    std::ranges::sort(sorted);
    return std::ranges::unique(sorted).begin() - sorted.begin() <= static_cast<ptrdiff_t>(kFewColors);
}

} // namespace

uint32_t encodeBc7(const Block8& texels, const ChannelWeights& weights, Effort effort,
                   std::span<std::byte, 16> block)
{
    Bc7Problem problem;
    problem.is_opaque = true;
    for (size_t t = 0; t < 16; ++t)
    {
        for (size_t c = 0; c < 4; ++c)
            problem.values[c][t] = texels[t][c];
        problem.is_opaque &= texels[t][3] == 255;
    }
    for (size_t c = 0; c < 4; ++c)
        problem.weights[c] = weights[c];
    problem.is_opaque &= weights[3] != 0;
    problem.has_alpha = weights[3] != 0 && !problem.is_opaque;
    if (problem.is_opaque)
        problem.weights[3] = 0;

    if (isSingleColor(problem))
    {
        Candidate single = makeSingleColor(problem);
        const Indices indices = chooseIndices(problem, single);
        pack(single, indices, block);
        return single.error;
    }
    Candidate result = findBest(problem, chooseSearch(effort));
    if (effort != Effort::draft && result.error > kFewColorsError && hasFewColors(texels))
        if (const Candidate other = findBest(problem, kFewColorsSearch); other.error < result.error)
            result = other;
    const Indices indices = chooseIndices(problem, result);
    pack(result, indices, block);
    return result.error;
}

} // namespace hearth::texels
