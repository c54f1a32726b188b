// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/eac_encoder.h"

#include "formats/texels/eac_decoder.h"
#include "formats/texels/etc2_tables.h"

#include <algorithm>
#include <cstdlib>

namespace hearth::texels
{

namespace
{

/// Units of a channel's values, by which alpha and 11 bits share one search.
struct EacUnits
{
    int32_t base_step;   ///< of the base's codes
    int32_t base_offset; ///< value of base 0
    int32_t finest_step; ///< of modifiers, with multiplier 0
    int32_t multiplier_step;
    int32_t min_multiplier;
    int32_t maximum;
};

constexpr EacUnits kAlphaUnits{1, 0, 0, 1, 1, 255};
/// Quarters of codes of 11 bits: sources of 16 bits lie between those.
constexpr EacUnits kFineUnits{32, 16, 4, 32, 0, 4 * 2047};

using EacTargets = std::array<int16_t, 16>;

/// Fields of a block besides the indices.
struct EacParameters
{
    int32_t base = 0;
    int32_t multiplier = 0;
    size_t table = 0;
};

/// Return what a modifier of 1 adds.
int32_t findStep(int32_t multiplier, const EacUnits& units)
{
    return multiplier == 0 ? units.finest_step : multiplier * units.multiplier_step;
}

/// Return the values of the indices of 3 bits.
std::array<int16_t, 8> listValues(const EacParameters& parameters, const EacUnits& units)
{
    const int32_t base = parameters.base * units.base_step + units.base_offset;
    const int32_t step = findStep(parameters.multiplier, units);
    std::array<int16_t, 8> values;
    for (size_t i = 0; i < 8; ++i)
        values[i] = static_cast<int16_t>(
            std::clamp(base + formats::kEacModifiers[parameters.table][i] * step, 0, units.maximum));
    return values;
}

/// Return the sum of squares of the distances to the nearest values.
int32_t targetError(const EacTargets& targets, const std::array<int16_t, 8>& values)
{
    std::array<int16_t, 16> best;
    best.fill(INT16_MAX);
    for (const int16_t value : values)
        for (size_t t = 0; t < 16; ++t)
        {
            const auto above = static_cast<int16_t>(targets[t] - value);
            const auto below = static_cast<int16_t>(value - targets[t]);
            best[t] = std::min(best[t], std::max(above, below));
        }
    int32_t sum = 0;
    for (const int16_t distance : best)
        sum += int32_t{distance} * int32_t{distance};
    return sum;
}

/// Resolution of distances in units of a table's modifiers.
constexpr int32_t kParts = 8;
/// Distances from a base, in modifiers, beyond which all count as one.
constexpr int32_t kMaxDistance = 32;
/// Greatest range of targets, in modifiers, for which a multiplier is tried. Tables span 15 to 29 of them.
constexpr int32_t kMaxRange = 40;

using TableSquares = std::array<int32_t, 16>;

/// Tables of a target's squares.
using SquaresRows = std::array<TableSquares, 2 * kMaxDistance * kParts + 1>;

/// Tabulate [distance from the base, in parts]: square of the distance to the nearest modifier of each table,
/// in parts.
/// is_lowest   values below the target are clamped to it
/// is_highest  values above the target are clamped to it
constexpr SquaresRows makeSquares(bool is_lowest, bool is_highest)
{
    SquaresRows rows{};
    for (size_t d = 0; d < rows.size(); ++d)
        for (size_t table = 0; table < 16; ++table)
        {
            int32_t least = INT32_MAX;
            for (const int32_t modifier : formats::kEacModifiers[table])
            {
                const int32_t distance = static_cast<int32_t>(d) - (kMaxDistance + modifier) * kParts;
                const bool is_clamped = (is_lowest && distance > 0) || (is_highest && distance < 0);
                least = std::min(least, is_clamped ? 0 : distance * distance);
            }
            rows[d][table] = least;
        }
    return rows;
}

constexpr SquaresRows kSquares = makeSquares(false, false);
constexpr SquaresRows kLowestSquares = makeSquares(true, false);
constexpr SquaresRows kHighestSquares = makeSquares(false, true);

/// Add up the squares of all tables for a base and a step.
TableSquares sumSquares(const EacTargets& targets, const EacUnits& units, int32_t base, int32_t step)
{
    // parts of a unit, as a fixed-point number with 16 bits after the point
    const int32_t scale = (kParts << 16) / step;
    TableSquares sums{};
    for (const int16_t target : targets)
    {
        const int32_t limit = kMaxDistance * step;
        const int32_t distance = std::clamp(target - base, -limit, limit);
        const int32_t parts = (distance * scale + (1 << 15)) >> 16;
        const SquaresRows& rows = target == 0               ? kLowestSquares
                                  : target == units.maximum ? kHighestSquares
                                                            : kSquares;
        const TableSquares& row = rows[static_cast<size_t>(parts + kMaxDistance * kParts)];
        for (size_t table = 0; table < 16; ++table)
            sums[table] += row[table];
    }
    return sums;
}

/// Parameters and their error without clamping, in squares of parts times squares of units.
struct RatedParameters
{
    int64_t error = INT64_MAX;
    EacParameters parameters;
};

/// Best parameters by rough errors, sorted.
struct ParameterList
{
    std::array<RatedParameters, 16> items;
    size_t capacity;

    void insert(const RatedParameters& rated)
    {
        if (rated.error >= items[capacity - 1].error)
            return;
        size_t place = capacity - 1;
        for (; place > 0 && items[place - 1].error > rated.error; --place)
            items[place] = items[place - 1];
        items[place] = rated;
    }
};

/// Extent of the search.
struct EacTrials
{
    size_t candidates;    ///< whose exact error is computed
    int32_t bases;        ///< tried to either side of a candidate's
    int32_t half_spacing; ///< of rough bases, in halves of modifiers
    int32_t side;         ///< of rough bases to either side of the middle, in modifiers
    int32_t min_range;    ///< of targets for which a multiplier is tried, in modifiers
};

EacTrials findTrials(Effort effort)
{
    return effort == Effort::high     ? EacTrials{16, 4, 1, 12, 7}
           : effort == Effort::normal ? EacTrials{8, 1, 1, 9, 8}
                                      : EacTrials{2, 1, 2, 9, 14};
}

/// Rate the tables with a multiplier, and the bases that put them near the middle of the targets.
void rateMultiplier(const EacTargets& targets, const EacUnits& units, int32_t middle, int32_t multiplier,
                    const EacTrials& trials, ParameterList& list)
{
    const int32_t step = findStep(multiplier, units);
    const auto code = [&](int32_t value)
    { return std::clamp((value - units.base_offset) / units.base_step, 0, 255); };
    TableSquares least;
    least.fill(INT32_MAX);
    std::array<int32_t, 16> bases{};
    const int32_t spacing = std::max(step * trials.half_spacing / (2 * units.base_step), 1);
    const int32_t last = code(middle + trials.side * step + units.base_step);
    for (int32_t base = code(middle - trials.side * step); base <= last; base += spacing)
    {
        const TableSquares sums =
            sumSquares(targets, units, base * units.base_step + units.base_offset, step);
        for (size_t table = 0; table < 16; ++table)
        {
            const bool is_less = sums[table] < least[table];
            least[table] = is_less ? sums[table] : least[table];
            bases[table] = is_less ? base : bases[table];
        }
    }
    for (size_t table = 0; table < 16; ++table)
        list.insert({int64_t{least[table]} * step * step, {bases[table], multiplier, table}});
}

/// Find parameters of little error: of all tables, of multipliers by which the modifiers span the targets or
/// somewhat less, of bases around the middle, those that a rough error ranks first are tried exactly.
EacParameters searchParameters(const EacTargets& targets, const EacUnits& units, Effort effort)
{
    const auto [lowest, highest] = std::minmax_element(targets.begin(), targets.end());
    const int32_t range = *highest - *lowest;
    const EacTrials trials = findTrials(effort);
    ParameterList list{{}, trials.candidates};
    for (int32_t multiplier = units.min_multiplier; multiplier < 16; ++multiplier)
    {
        const int32_t step = findStep(multiplier, units);
        if (range <= kMaxRange * step || multiplier == 15)
            rateMultiplier(targets, units, (*lowest + *highest) / 2, multiplier, trials, list);
        if (range < trials.min_range * step)
            break;
    }

    EacParameters best;
    int32_t least = INT32_MAX;
    for (size_t i = 0; i < list.capacity && list.items[i].error != INT64_MAX; ++i)
    {
        EacParameters parameters = list.items[i].parameters;
        const int32_t base = parameters.base;
        for (parameters.base = std::max(base - trials.bases, 0);
             parameters.base <= std::min(base + trials.bases, 255); ++parameters.base)
        {
            const int32_t error = targetError(targets, listValues(parameters, units));
            if (error >= least)
                continue;
            least = error;
            best = parameters;
        }
    }
    return best;
}

/// Write a block, each texel with the index of the nearest value.
std::array<std::byte, 8> writeEac(const EacTargets& targets, const EacParameters& parameters,
                                  const EacUnits& units)
{
    const std::array<int16_t, 8> values = listValues(parameters, units);
    uint64_t word = static_cast<uint64_t>(parameters.base) << 56 |
                    static_cast<uint64_t>(parameters.multiplier) << 52 |
                    static_cast<uint64_t>(parameters.table) << 48;
    for (size_t t = 0; t < 16; ++t)
    {
        const auto nearest = std::min_element(
            values.begin(), values.end(),
            [&](int16_t a, int16_t b) { return std::abs(a - targets[t]) < std::abs(b - targets[t]); });
        const size_t place = t % 4 * 4 + t / 4; // texels are counted by columns
        word |= static_cast<uint64_t>(nearest - values.begin()) << (45 - 3 * place);
    }
    std::array<std::byte, 8> bytes;
    for (size_t b = 0; b < 8; ++b)
        bytes[b] = static_cast<std::byte>(word >> (56 - 8 * b));
    return bytes;
}

} // namespace

EncodedAlpha encodeEacAlpha(const std::array<uint8_t, 16>& alphas, Effort effort)
{
    EacTargets targets;
    std::copy(alphas.begin(), alphas.end(), targets.begin());
    const EacParameters parameters = searchParameters(targets, kAlphaUnits, effort);
    const int32_t error = targetError(targets, listValues(parameters, kAlphaUnits));
    return {writeEac(targets, parameters, kAlphaUnits), static_cast<uint32_t>(error)};
}

EncodedR11 encodeEacR11(const std::array<uint16_t, 16>& codes, Effort effort)
{
    EacTargets targets;
    for (size_t t = 0; t < 16; ++t)
        targets[t] = static_cast<int16_t>((int32_t{codes[t]} * kFineUnits.maximum + 0x7FFF) / 0xFFFF);
    EncodedR11 encoded{};
    encoded.bytes = writeEac(targets, searchParameters(targets, kFineUnits, effort), kFineUnits);
    const formats::EacValues values = formats::decodeEacUnsigned(encoded.bytes);
    for (size_t t = 0; t < 16; ++t)
    {
        const int64_t difference = int64_t{formats::eacUnorm(values[t])} - codes[t];
        encoded.error += static_cast<uint64_t>(difference * difference);
    }
    return encoded;
}

EncodedRg11 encodeEacRg11(const Block16& block, Effort effort)
{
    EncodedRg11 encoded{};
    for (size_t c = 0; c < 2; ++c)
    {
        std::array<uint16_t, 16> codes;
        for (size_t t = 0; t < 16; ++t)
            codes[t] = block[t][c];
        const EncodedR11 channel = encodeEacR11(codes, effort);
        std::copy(channel.bytes.begin(), channel.bytes.end(), encoded.bytes.begin() + 8 * c);
        encoded.error += channel.error;
    }
    return encoded;
}

} // namespace hearth::texels
