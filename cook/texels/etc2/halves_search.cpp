// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/halves_search.h"

#include "cook/texels/etc2/base_sweep.h"
#include "formats/texels/etc2_tables.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace hearth::texels
{

namespace
{

struct Half
{
    TexelSet set;
    ChannelTexels<8> texels;
};

struct BaseCandidate
{
    Rgb codes;
    int32_t error; ///< without clamping: not below the exact one
    uint8_t table;
};

/// Candidates of a half. Each step of a sweep lowers one of three codes of 5 bits; a second sweep may have
/// two that move; and each of 8 tables has 4 modifiers by which a base colour reaches either of two means.
struct CandidateList
{
    std::array<BaseCandidate, 3 * 31 + 1 + 2 * 31 + 1 + 64> items;
    size_t count = 0;
};

/// Rate a base colour by the best table.
BaseCandidate rateBase(const TexelSet& set, const Rgb& codes, int bits, const SearchTables& tables)
{
    const Rgb color = widenCodes(codes, bits);
    int32_t gray = 0;
    for (size_t c = 0; c < 3; ++c)
        gray += tables.weights[c] * color[c];
    TableErrors errors{};
    for (size_t t = 0; t < 8; ++t)
    {
        const TableErrors& row = tables.halves[static_cast<size_t>(std::abs(set.grays[t] - gray))];
        for (size_t table = 0; table < 8; ++table)
            errors[table] += row[table];
    }
    const auto best = std::min_element(errors.begin(), errors.end());
    return {codes, set.spread(color, tables.weights) + *best, static_cast<uint8_t>(best - errors.begin())};
}

/// Return how far from the mean a base colour may be: indices of one sign are of use if their modifiers,
/// which are about 0.85 times their difference away, span the grays.
int32_t findReach(const TexelSet& set, const SearchTables& tables, Effort effort)
{
    const int32_t span = (set.max_gray - set.min_gray) / tables.weight_sum;
    if (set.min_gray == set.max_gray && effort != Effort::draft)
        return effort == Effort::high ? 183 : 60; // one modifier for all: any may come nearest
    return effort == Effort::high ? span + 8 : effort == Effort::normal ? span / 2 + 6 : span / 4 + 4;
}

int32_t exactError(const Half& half, const Rgb& codes, int bits, size_t table, const SearchTables& tables)
{
    return paintError(half.texels, halfPaints(widenCodes(codes, bits), table), tables.weights);
}

/// Rate a base colour by its best table, exactly. Tables much finer or coarser than the grays are left out.
BaseCandidate rateExactly(const Half& half, const Rgb& codes, int bits, const SearchTables& tables)
{
    const int32_t span = (half.set.max_gray - half.set.min_gray) / tables.weight_sum;
    BaseCandidate best{codes, INT32_MAX, 0};
    for (uint8_t table = 0; table < 8; ++table)
    {
        const auto& [lesser, greater] = formats::kEtcDistances[table];
        if (4 * greater < span || lesser > span + 8)
            continue;
        const int32_t error = exactError(half, codes, bits, table, tables);
        if (error < best.error)
            best = {codes, error, table};
    }
    return best;
}

bool hasLessError(const BaseCandidate& a, const BaseCandidate& b)
{
    return a.error < b.error;
}

const BaseCandidate& findBest(const CandidateList& list)
{
    return *std::min_element(list.items.begin(), list.items.begin() + list.count, hasLessError);
}

/// True if modifiers of a table bring a channel below 0 or above 255.
bool isClamped(const Rgb& color, size_t table)
{
    const int32_t greater = formats::kEtcDistances[table][1];
    return *std::min_element(color.begin(), color.end()) < greater ||
           *std::max_element(color.begin(), color.end()) > 255 - greater;
}

/// Texels nearer than this to 0 or 255 make clamped colours likely.
constexpr int16_t kEdge = 16;
/// Channels all nearer than this to 0 or 255 may have all colours clamped.
constexpr int16_t kPinnedEdge = 8;
/// Error of a half that is not worth more trials.
constexpr int32_t kFlatError = 16;

/// True if a channel of the half comes near 0 or 255.
bool isNearEdge(const Half& half)
{
    for (const std::array<int16_t, 8>& channel : half.texels.channels)
    {
        const auto [least, greatest] = std::minmax_element(channel.begin(), channel.end());
        if (*least < kEdge || *greatest > 255 - kEdge)
            return true;
    }
    return false;
}

/// Add base colours one of whose channels is clamped for all texels: it stays at its end, and the others
/// move.
void addPinned(const Half& half, int bits, int32_t reach, const SearchTables& tables, CandidateList& list)
{
    Rgb pinned = kAllMove;
    for (size_t c = 0; c < 3; ++c)
    {
        const auto& channel = half.texels.channels[c];
        const auto [least, greatest] = std::minmax_element(channel.begin(), channel.end());
        if (*least > 255 - kPinnedEdge)
            pinned[c] = (1 << bits) - 1;
        else if (*greatest < kPinnedEdge)
            pinned[c] = 0;
    }
    if (pinned != kAllMove)
        sweepBases(half.set, bits, reach, pinned,
                   [&](const Rgb& codes)
                   { list.items[list.count++] = rateExactly(half, codes, bits, tables); });
}

/// Means of the darker and the brighter texels of a half, rounded.
struct HalfMeans
{
    std::array<Rgb, 2> colors{};
    std::array<int32_t, 2> counts{};
};

HalfMeans findHalfMeans(const Half& half)
{
    const int32_t middle = (half.set.min_gray + half.set.max_gray) / 2;
    HalfMeans means;
    for (size_t t = 0; t < 8; ++t)
    {
        const size_t part = half.set.grays[t] > middle ? 1 : 0;
        ++means.counts[part];
        for (size_t c = 0; c < 3; ++c)
            means.colors[part][c] += half.texels.channels[c][t];
    }
    for (size_t part = 0; part < 2; ++part)
        for (int32_t& channel : means.colors[part])
            channel = (channel + means.counts[part] / 2) / std::max(means.counts[part], 1);
    return means;
}

/// Return the weighted square of a colour's distance to the nearest paint.
int32_t colorError(const Rgb& color, const Paints& paints, const ColorWeights& weights)
{
    int32_t least = INT32_MAX;
    for (const std::array<int16_t, 3>& paint : paints)
    {
        int32_t error = 0;
        for (size_t c = 0; c < 3; ++c)
        {
            const int32_t difference = color[c] - paint[c];
            error += weights[c] * difference * difference;
        }
        least = std::min(least, error);
    }
    return least;
}

/// Add base colours of which a modifier reaches the mean of the darker or of the brighter texels: the others
/// may be clamped to black or white. Colours are left out that are far from the other mean.
void addReaching(const Half& half, int bits, const SearchTables& tables, CandidateList& list)
{
    const HalfMeans means = findHalfMeans(half);
    if (means.counts[1] == 0)
        return;
    const int32_t limit = findBest(list).error;
    for (size_t part = 0; part < 2; ++part)
        for (uint8_t table = 0; table < 8; ++table)
            for (const int32_t distance : formats::kEtcDistances[table])
                for (const int32_t modifier : {-distance, distance})
                {
                    Rgb codes;
                    for (size_t c = 0; c < 3; ++c)
                        codes[c] = nearestCode(std::max(means.colors[part][c] - modifier, 0), 1, bits);
                    const Rgb color = widenCodes(codes, bits);
                    if (!isClamped(color, table))
                        continue;
                    const int32_t other_error =
                        colorError(means.colors[1 - part], halfPaints(color, table), tables.weights);
                    if (means.counts[1 - part] * other_error < limit)
                        list.items[list.count++] = {codes, exactError(half, codes, bits, table, tables),
                                                    table};
                }
}

/// Compute exact errors of the best candidates, and add others that the sweep without clamping does not see.
void considerClamping(const Half& half, int bits, int32_t reach, const SearchTables& tables, Effort effort,
                      CandidateList& list)
{
    const size_t rated = effort == Effort::high ? list.count : std::min<size_t>(list.count, 3);
    std::partial_sort(list.items.begin(), list.items.begin() + rated, list.items.begin() + list.count,
                      hasLessError);
    for (size_t i = 0; i < rated; ++i)
    {
        BaseCandidate& candidate = list.items[i];
        candidate.error = exactError(half, candidate.codes, bits, candidate.table, tables);
        const BaseCandidate other = rateExactly(half, candidate.codes, bits, tables);
        if (other.error < candidate.error)
            candidate = other;
    }
    addPinned(half, bits, reach, tables, list);
    addReaching(half, bits, tables, list);
}

CandidateList listCandidates(const Half& half, int bits, const SearchTables& tables, Effort effort)
{
    CandidateList list;
    const int32_t reach = findReach(half.set, tables, effort);
    sweepBases(half.set, bits, reach, kAllMove,
               [&](const Rgb& codes) { list.items[list.count++] = rateBase(half.set, codes, bits, tables); });
    if (effort != Effort::draft && isNearEdge(half) && findBest(list).error > kFlatError)
        considerClamping(half, bits, reach, tables, effort, list);
    return list;
}

/// True if the second base colour is one that differences of 3 bits reach.
bool isReached(const Rgb& first, const Rgb& second)
{
    for (size_t c = 0; c < 3; ++c)
        if (second[c] - first[c] < -4 || second[c] - first[c] > 3)
            return false;
    return true;
}

struct CandidatePair
{
    BaseCandidate first, second;
    int32_t error() const { return first.error + second.error; }
};

/// Find the best pair of two lists that can be stored.
std::optional<CandidatePair> findPair(CandidateList& first, CandidateList& second)
{
    const auto sort = [](CandidateList& list)
    { std::sort(list.items.begin(), list.items.begin() + list.count, hasLessError); };
    sort(first);
    sort(second);
    std::optional<CandidatePair> best;
    for (size_t a = 0; a < first.count; ++a)
    {
        const int32_t limit = best ? best->error() - first.items[a].error : INT32_MAX;
        if (limit <= second.items[0].error)
            break;
        for (size_t b = 0; b < second.count && second.items[b].error < limit; ++b)
            if (isReached(first.items[a].codes, second.items[b].codes))
            {
                best = CandidatePair{first.items[a], second.items[b]};
                break;
            }
    }
    return best;
}

/// Improve on a pair by moving one of two good candidates to where the other reaches it.
/// lists  sorted
void clipPairs(const std::array<Half, 2>& halves, const std::array<CandidateList, 2>& lists,
               const SearchTables& tables, size_t tries, std::optional<CandidatePair>& best)
{
    const std::array<size_t, 2> counts{std::min(tries, lists[0].count), std::min(tries, lists[1].count)};
    for (size_t a = 0; a < counts[0]; ++a)
        for (size_t b = 0; b < counts[1]; ++b)
        {
            const BaseCandidate &first = lists[0].items[a], &second = lists[1].items[b];
            if (best && first.error + second.error >= best->error())
                break;
            // all of the move by one, by the other, or shared
            for (int32_t share = 0; share <= 2; ++share)
            {
                Rgb near = first.codes, far = second.codes;
                for (size_t c = 0; c < 3; ++c)
                {
                    const int32_t move = far[c] - near[c] - std::clamp(far[c] - near[c], -4, 3);
                    near[c] += move * share / 2;
                    far[c] -= move - move * share / 2;
                }
                const CandidatePair pair{rateBase(halves[0].set, near, 5, tables),
                                         rateBase(halves[1].set, far, 5, tables)};
                if (!best || pair.error() < best->error())
                    best = pair;
            }
        }
}

bool isStorable(const HalvesSolution& solution)
{
    const int32_t maximum = (1 << solution.bits()) - 1;
    for (const Rgb& codes : solution.codes)
        for (const int32_t code : codes)
            if (code < 0 || code > maximum)
                return false;
    return !solution.is_differential || isReached(solution.codes[0], solution.codes[1]);
}

/// Step of a base colour and of its table.
struct BaseStep
{
    Rgb codes;
    int32_t table;
};

constexpr std::array<BaseStep, 10> kBaseSteps{{{{1, 0, 0}, 0},
                                               {{-1, 0, 0}, 0},
                                               {{0, 1, 0}, 0},
                                               {{0, -1, 0}, 0},
                                               {{0, 0, 1}, 0},
                                               {{0, 0, -1}, 0},
                                               {{1, 1, 1}, 0},
                                               {{-1, -1, -1}, 0},
                                               {{0, 0, 0}, 1},
                                               {{0, 0, 0}, -1}}};

/// Change a code, all codes of a half, or its table by one while that lowers the error: where colours are
/// clamped, the sweep has not seen the exact one.
void descend(const std::array<Half, 2>& halves, const SearchTables& tables, HalvesSolution& solution)
{
    for (size_t h = 0; h < 2; ++h)
    {
        int32_t error = exactError(halves[h], solution.codes[h], solution.bits(), solution.tables[h], tables);
        for (bool is_better = isClamped(widenCodes(solution.codes[h], solution.bits()), solution.tables[h]);
             is_better;)
        {
            is_better = false;
            for (const BaseStep& step : kBaseSteps)
            {
                HalvesSolution trial = solution;
                for (size_t c = 0; c < 3; ++c)
                    trial.codes[h][c] += step.codes[c];
                const int32_t table = trial.tables[h] + step.table;
                if (table < 0 || table > 7 || !isStorable(trial))
                    continue;
                trial.tables[h] = static_cast<uint8_t>(table);
                const int32_t trial_error =
                    exactError(halves[h], trial.codes[h], trial.bits(), trial.tables[h], tables);
                if (trial_error >= error)
                    continue;
                trial.error -= error - trial_error;
                error = trial_error;
                solution = trial;
                is_better = true;
            }
        }
    }
}

} // namespace

Paints halfPaints(const Rgb& color, size_t table)
{
    const int32_t lesser = formats::kEtcDistances[table][0], greater = formats::kEtcDistances[table][1];
    return makePaints({color, color, color, color}, {lesser, greater, -lesser, -greater});
}

HalvesSolution searchHalves(const Block8& block, const SearchTables& tables, Effort effort)
{
    HalvesSolution best;
    for (size_t flip = 0; flip < 2; ++flip)
    {
        const auto& masks = kHalfMasks[flip];
        const std::array<Half, 2> halves{
            Half{TexelSet(block, masks[0], tables), gatherTexels<8>(block, masks[0])},
            Half{TexelSet(block, masks[1], tables), gatherTexels<8>(block, masks[1])}};
        const auto consider = [&](bool is_differential, const CandidatePair& pair)
        {
            HalvesSolution solution;
            solution.is_differential = is_differential;
            solution.is_flipped = flip != 0;
            solution.codes = {pair.first.codes, pair.second.codes};
            solution.tables = {pair.first.table, pair.second.table};
            solution.error = 0;
            for (size_t h = 0; h < 2; ++h)
                solution.error +=
                    exactError(halves[h], solution.codes[h], solution.bits(), solution.tables[h], tables);
            if (effort != Effort::draft && solution.error / 2 < best.error)
                descend(halves, tables, solution);
            if (solution.error < best.error)
                best = solution;
        };
        const CandidatePair individual{findBest(listCandidates(halves[0], 4, tables, effort)),
                                       findBest(listCandidates(halves[1], 4, tables, effort))};
        consider(false, individual);

        std::array<CandidateList, 2> lists{listCandidates(halves[0], 5, tables, effort),
                                           listCandidates(halves[1], 5, tables, effort)};
        std::optional<CandidatePair> differential = CandidatePair{findBest(lists[0]), findBest(lists[1])};
        if (!isReached(differential->first.codes, differential->second.codes))
        {
            differential = findPair(lists[0], lists[1]);
            if (effort != Effort::draft)
                clipPairs(halves, lists, tables, effort == Effort::high ? 16 : 4, differential);
        }
        if (differential)
            consider(true, *differential);
    }
    return best;
}

} // namespace hearth::texels
