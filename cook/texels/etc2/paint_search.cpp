// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/paint_search.h"

#include "cook/texels/etc2/base_sweep.h"
#include "cook/texels/etc2/partitions.h"
#include "formats/texels/etc2_tables.h"

#include <algorithm>
#include <cstdlib>

namespace hearth::texels
{

namespace
{

int32_t weightedGray(const Rgb& color, const ColorWeights& weights)
{
    return weights[0] * color[0] + weights[1] * color[1] + weights[2] * color[2];
}

/// Base colours of a set of texels for each distance.
struct DistanceBases
{
    TableErrors errors;
    std::array<Rgb, 8> codes;
};

int32_t findLineReach(const TexelSet& set, const SearchTables& tables)
{
    return (set.max_gray - set.min_gray) / tables.weight_sum / 2 + 8;
}

void keepBetter(const TableErrors& errors, const Rgb& codes, DistanceBases& bases)
{
    for (size_t d = 0; d < 8; ++d)
        if (errors[d] < bases.errors[d])
        {
            bases.errors[d] = errors[d];
            bases.codes[d] = codes;
        }
}

/// Find the colours that are best with the modifiers -d, 0, d.
DistanceBases findLines(const TexelSet& set, const SearchTables& tables)
{
    DistanceBases bases;
    bases.errors.fill(INT32_MAX);
    sweepBases(set, 4, findLineReach(set, tables), kAllMove,
               [&](const Rgb& codes)
               {
                   const Rgb color = widenCodes(codes, 4);
                   const int32_t gray = weightedGray(color, tables.weights);
                   TableErrors errors;
                   errors.fill(set.spread(color, tables.weights));
                   for (size_t t = 0; t < static_cast<size_t>(set.count); ++t)
                   {
                       const TableErrors& row =
                           tables.lines[static_cast<size_t>(std::abs(set.grays[t] - gray))];
                       for (size_t d = 0; d < 8; ++d)
                           errors[d] += row[d];
                   }
                   keepBetter(errors, codes, bases);
               });
    return bases;
}

/// Find the colours that are best with the modifiers -d and d.
DistanceBases findDoubles(const TexelSet& set, const SearchTables& tables)
{
    DistanceBases bases;
    bases.errors.fill(INT32_MAX);
    sweepBases(set, 4, findLineReach(set, tables), kAllMove,
               [&](const Rgb& codes)
               {
                   const Rgb color = widenCodes(codes, 4);
                   const int32_t gray = weightedGray(color, tables.weights);
                   int32_t distance_sum = 0;
                   for (size_t t = 0; t < static_cast<size_t>(set.count); ++t)
                       distance_sum += std::abs(set.grays[t] - gray);
                   const int32_t spread = set.spread(color, tables.weights);
                   TableErrors errors;
                   for (size_t d = 0; d < 8; ++d)
                   {
                       const int32_t modifier = formats::kEtcPaintDistances[d];
                       errors[d] = spread + set.count * tables.weight_sum * modifier * modifier -
                                   2 * modifier * distance_sum;
                   }
                   keepBetter(errors, codes, bases);
               });
    return bases;
}

/// Block with what all trials need.
struct Trials
{
    const Block8& block;
    const SearchTables& tables;
    ChannelTexels<16> texels;

    /// Find the solution of mode T for texels that have the colour alone.
    PaintSolution tryT(TexelMask alone) const
    {
        PaintSolution solution;
        const TexelSet single(block, alone, tables);
        const DistanceBases lines = findLines(TexelSet(block, kAllTexels & ~alone, tables), tables);
        const auto best = static_cast<size_t>(std::min_element(lines.errors.begin(), lines.errors.end()) -
                                              lines.errors.begin());
        for (size_t c = 0; c < 3; ++c)
            solution.codes[0][c] = nearestCode(single.sums[c], single.count, 4);
        solution.codes[1] = lines.codes[best];
        solution.distance = static_cast<uint8_t>(best);
        solution.error = paintError(texels, solution.paints(), tables.weights);
        return solution;
    }

    /// Find the solution of mode H for texels that have the first colour.
    PaintSolution tryH(TexelMask first) const
    {
        PaintSolution solution;
        solution.is_h = true;
        const DistanceBases bases[2]{findDoubles(TexelSet(block, first, tables), tables),
                                     findDoubles(TexelSet(block, kAllTexels & ~first, tables), tables)};
        int32_t best = INT32_MAX;
        for (uint8_t d = 0; d < 8; ++d)
        {
            const int32_t error = bases[0].errors[d] + bases[1].errors[d];
            // the order of the colours is the low bit of the distance: equal ones have the odd one
            if (error >= best || (d % 2 == 0 && bases[0].codes[d] == bases[1].codes[d]))
                continue;
            best = error;
            solution.distance = d;
            solution.codes = {bases[0].codes[d], bases[1].codes[d]};
        }
        solution.error = paintError(texels, solution.paints(), tables.weights);
        return solution;
    }

    /// Return the texels that choose the first colour.
    TexelMask chooseFirst(const PaintSolution& solution) const
    {
        const std::array<uint8_t, 16> indices = choosePaints(texels, solution.paints(), tables.weights);
        TexelMask mask = 0;
        for (size_t t = 0; t < 16; ++t)
            if (indices[t] < (solution.is_h ? 2 : 1))
                mask |= 1u << t;
        return mask;
    }

    /// Search and partition in turns while that lowers the error, and keep a better solution.
    void iterate(bool is_h, TexelMask mask, int rounds, PaintSolution& best) const
    {
        int32_t last = INT32_MAX;
        for (int round = 0; round < rounds && mask != 0 && mask != kAllTexels; ++round)
        {
            const PaintSolution solution = is_h ? tryH(mask) : tryT(mask);
            if (solution.error >= last)
                return;
            last = solution.error;
            if (solution.error < best.error)
                best = solution;
            mask = chooseFirst(solution);
        }
    }
};

bool isStorable(const PaintSolution& solution)
{
    for (const Rgb& codes : solution.codes)
        for (const int32_t code : codes)
            if (code < 0 || code > 15)
                return false;
    return !solution.is_h || solution.distance % 2 != 0 || solution.codes[0] != solution.codes[1];
}

} // namespace

Paints PaintSolution::paints() const
{
    const Rgb first = widenCodes(codes[0], 4), second = widenCodes(codes[1], 4);
    const int32_t d = formats::kEtcPaintDistances[distance];
    if (is_h)
        return makePaints({first, first, second, second}, {d, -d, d, -d});
    return makePaints({first, second, second, second}, {0, d, 0, -d});
}

void descendPaints(const Trials& trials, PaintSolution& solution)
{
    const auto consider = [&](const PaintSolution& trial)
    {
        if (!isStorable(trial))
            return false;
        const int32_t error = paintError(trials.texels, trial.paints(), trials.tables.weights);
        if (error >= solution.error)
            return false;
        solution = trial;
        solution.error = error;
        return true;
    };
    for (bool is_better = true; is_better;)
    {
        is_better = false;
        for (const int sign : {-1, 1})
        {
            for (size_t code = 0; code < 6; ++code)
            {
                PaintSolution trial = solution;
                trial.codes[code / 3][code % 3] += sign;
                is_better |= consider(trial);
            }
            PaintSolution trial = solution;
            if (trial.distance + sign < 0 || trial.distance + sign > 7)
                continue;
            trial.distance = static_cast<uint8_t>(trial.distance + sign);
            is_better |= consider(trial);
        }
    }
}

PaintSolution searchPaints(const Block8& block, const SearchTables& tables, Effort effort, int32_t limit)
{
    const Trials trials{block, tables, gatherTexels<16>(block, kAllTexels)};
    const int rounds = effort == Effort::high ? 8 : effort == Effort::normal ? 3 : 1;
    PaintSolution best;
    for (const TexelMask mask : listPartitions(block, tables.weights, effort))
    {
        std::array<PaintSolution, 3> solutions;
        trials.iterate(false, mask, rounds, solutions[0]);
        trials.iterate(false, kAllTexels & ~mask, rounds, solutions[1]);
        trials.iterate(true, mask, rounds, solutions[2]);
        for (PaintSolution& solution : solutions)
        {
            if (solution.error != INT32_MAX && effort != Effort::draft &&
                (effort == Effort::high || solution.error / 2 < std::min(limit, best.error)))
                descendPaints(trials, solution);
            if (solution.error < best.error)
                best = solution;
        }
    }
    return best;
}

} // namespace hearth::texels
