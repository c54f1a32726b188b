// Finds endpoints as "cluster fit" does: texels are sorted along their principal axis, and each way to cut
// that order into the palette's colours has best endpoints in closed form.
// Source: S. Brown, "libsquish", 2006; here the cuts are ranked by the closed form's error with integers, and
// the endpoints of the best are refined in the codes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/bc/bc1.h"

#include "cook/texels/bc/principal_axis.h"

#include <algorithm>
#include <bit>

namespace hearth::texels
{

namespace
{

/// Channels of texels side by side, for vector instructions.
using Channel = std::array<int16_t, 16>;

/// Codes of an endpoint's channels: 5, 6 and 5 bits.
using Codes = std::array<int16_t, 3>;

constexpr Codes kMaxCodes = {31, 63, 31};

/// Set of texels: a bit each.
constexpr uint32_t kAllTexels = 0xFFFF;

struct Bc1Problem
{
    std::array<Channel, 3> texels;
    std::array<int16_t, 3> weights;
};

/// Kind of a palette, by the order of the endpoints.
enum class Bc1Palette : uint8_t
{
    four,
    three, ///< and black
};

struct Bc1Solution
{
    Codes first{}, second{};
    Bc1Palette palette = Bc1Palette::four;
    uint32_t error = UINT32_MAX;
};

int16_t widen(int16_t code, size_t channel)
{
    return static_cast<int16_t>(channel == 1 ? code << 2 | code >> 4 : code << 3 | code >> 2);
}

/// Return the code whose widened value is nearest to `value` / `scale`, which may be beyond the range.
int16_t nearestCode(int64_t value, int64_t scale, size_t channel)
{
    const int64_t max = kMaxCodes[channel];
    const int64_t code = (2 * value * max + 255 * scale) / (2 * 255 * scale);
    return static_cast<int16_t>(std::clamp<int64_t>(value < 0 ? 0 : code, 0, max));
}

/// [color][channel]
std::array<std::array<int16_t, 3>, 4> makePalette(const Codes& first, const Codes& second, Bc1Palette palette)
{
    std::array<std::array<int16_t, 3>, 4> colors{};
    for (size_t c = 0; c < 3; ++c)
    {
        const int a = widen(first[c], c), b = widen(second[c], c);
        const bool four = palette == Bc1Palette::four;
        colors[0][c] = static_cast<int16_t>(a);
        colors[1][c] = static_cast<int16_t>(b);
        colors[2][c] = static_cast<int16_t>(four ? (2 * a + b + 1) / 3 : (a + b + 1) / 2);
        colors[3][c] = static_cast<int16_t>(four ? (a + 2 * b + 1) / 3 : 0);
    }
    return colors;
}

/// Choose the nearest color of each texel.
/// indices  [texel]: gets the number of the color
/// returns  error of the block
uint32_t chooseIndices(const Bc1Problem& problem, const std::array<std::array<int16_t, 3>, 4>& colors,
                       std::array<int32_t, 16>& indices)
{
    std::array<int32_t, 16> best;
    best.fill(INT32_MAX);
    for (int32_t k = 0; k < 4; ++k)
    {
        std::array<int32_t, 16> error{};
        for (size_t c = 0; c < 3; ++c)
            for (size_t t = 0; t < 16; ++t)
            {
                const auto d = static_cast<int16_t>(problem.texels[c][t] - colors[size_t(k)][c]);
                error[t] += int32_t{static_cast<int16_t>(d * problem.weights[c])} * int32_t{d};
            }
        for (size_t t = 0; t < 16; ++t)
        {
            indices[t] = error[t] < best[t] ? k : indices[t];
            best[t] = error[t] < best[t] ? error[t] : best[t];
        }
    }
    int32_t sum = 0;
    for (const int32_t error : best)
        sum += error;
    return static_cast<uint32_t>(sum);
}

/// Compute the error of endpoints.
uint32_t measure(const Bc1Problem& problem, const Codes& first, const Codes& second, Bc1Palette palette)
{
    std::array<int32_t, 16> indices{};
    return chooseIndices(problem, makePalette(first, second, palette), indices);
}

void keepBetter(const Bc1Problem& problem, const Codes& first, const Codes& second, Bc1Palette palette,
                Bc1Solution& best)
{
    const uint32_t error = measure(problem, first, second, palette);
    if (error < best.error)
        best = {first, second, palette, error};
}

/// A cut of the sorted texels into clusters, and what its closed form says.
struct Cut
{
    std::array<uint8_t, 3> ends; ///< of the clusters but the last
    int64_t gain;                ///< decrease of the error, in units of its own
};

/// Texels in the order along an axis, less their mean, summed up.
struct SortedSums
{
    size_t count;
    std::array<int64_t, 3> total; ///< of the texels
    std::array<std::array<int64_t, 3>, 17>
        sums{}; ///< [n]: of the first n texels, times count, less n * total
};

SortedSums sortAlong(const Bc1Problem& problem, const std::array<int32_t, 3>& axis, uint32_t used)
{
    std::array<uint8_t, 16> order;
    std::array<int64_t, 16> place;
    SortedSums sorted{0, {}, {}};
    for (uint8_t t = 0; t < 16; ++t)
    {
        if ((used >> t & 1u) == 0)
            continue;
        place[t] = 0;
        for (size_t c = 0; c < 3; ++c)
        {
            place[t] += int64_t{axis[c]} * problem.texels[c][t];
            sorted.total[c] += problem.texels[c][t];
        }
        size_t i = sorted.count++;
        for (; i > 0 && place[order[i - 1]] > place[t]; --i)
            order[i] = order[i - 1];
        order[i] = t;
    }
    for (size_t i = 0; i < sorted.count; ++i)
        for (size_t c = 0; c < 3; ++c)
            sorted.sums[i + 1][c] = sorted.sums[i][c] +
                                    problem.texels[c][order[i]] * static_cast<int64_t>(sorted.count) -
                                    sorted.total[c];
    return sorted;
}

/// Sums of products of the shares that clusters have of the endpoints. ShareSums are in thirds or halves.
struct ShareSums
{
    int64_t aa, ab, bb; ///< of the first endpoint with itself, of both, of the second with itself
    int64_t determinant() const { return aa * bb - ab * ab; }
};

/// steps  3 for a palette of four, 2 for one of three
ShareSums sumShares(const std::array<uint8_t, 3>& ends, int64_t steps, size_t count)
{
    ShareSums shares{};
    for (int64_t k = 0; k <= steps; ++k)
    {
        const int64_t first = k == 0 ? 0 : ends[static_cast<size_t>(k) - 1];
        const int64_t n = (k == steps ? static_cast<int64_t>(count) : ends[static_cast<size_t>(k)]) - first;
        shares.aa += n * (steps - k) * (steps - k);
        shares.ab += n * (steps - k) * k;
        shares.bb += n * k * k;
    }
    return shares;
}

/// Best cuts, the best first.
class BestCuts
{
public:
    explicit BestCuts(size_t capacity) : capacity_(capacity) {}

    int64_t worstGain() const { return size_ == capacity_ ? cuts_[size_ - 1].gain : 0; }

    void add(const Cut& cut)
    {
        size_t i = size_ < capacity_ ? size_++ : size_ - 1;
        for (; i > 0 && cuts_[i - 1].gain < cut.gain; --i)
            cuts_[i] = cuts_[i - 1];
        cuts_[i] = cut;
    }

    std::span<const Cut> list() const { return std::span(cuts_).first(size_); }

private:
    size_t capacity_;
    size_t size_ = 0;
    std::array<Cut, 16> cuts_;
};

/// Reciprocals of the determinants of all cuts, times 2^24 by the steps: [count][ends].
/// A cut with all texels in one cluster has determinant 0, and gets 0.
template <int64_t kSteps>
const auto& cutReciprocals()
{
    static const auto table = []
    {
        std::array<std::array<std::array<std::array<uint32_t, 17>, 17>, 17>, 17> values{};
        for (size_t n = 1; n < 17; ++n)
            for (uint8_t i = 0; i <= n; ++i)
                for (uint8_t j = i; j <= n; ++j)
                    for (uint8_t k = kSteps == 3 ? j : static_cast<uint8_t>(n); k <= n; ++k)
                    {
                        const int64_t d = sumShares({i, j, k}, kSteps, n).determinant();
                        values[n][i][j][k] = d == 0 ? 0 : static_cast<uint32_t>((1 << 24) / d);
                    }
        return values;
    }();
    return table;
}

/// Rank all cuts of the order. If texels have mean 0, so do sums of both shares, and the decrease of the
/// error is proportional to the square of the first's over the determinant.
template <int64_t kSteps>
void rankCuts(const Bc1Problem& problem, const SortedSums& sorted, BestCuts& best)
{
    const auto n = static_cast<uint8_t>(sorted.count);
    const auto& reciprocals = cutReciprocals<kSteps>()[n];
    for (uint8_t i = 0; i <= n; ++i)
        for (uint8_t j = i; j <= n; ++j)
            for (uint8_t k = kSteps == 3 ? j : n; k <= n; ++k)
            {
                int64_t square = 0;
                for (size_t c = 0; c < 3; ++c)
                {
                    // sums of all texels are 0, so the third end of a palette of three adds nothing
                    const int64_t sum = (sorted.sums[i][c] + sorted.sums[j][c] + sorted.sums[k][c]) >> 2;
                    square += sum * sum * problem.weights[c];
                }
                const int64_t gain = (square >> 8) * reciprocals[i][j][k];
                if (gain > best.worstGain())
                    best.add({{i, j, k}, gain});
            }
}

/// Return the best endpoints of a cut.
template <int64_t kSteps>
std::array<Codes, 2> solveCut(const SortedSums& sorted, const Cut& cut)
{
    const ShareSums shares = sumShares(cut.ends, kSteps, sorted.count);
    const int64_t determinant = shares.determinant();
    const auto count = static_cast<int64_t>(sorted.count);
    std::array<Codes, 2> ends{};
    for (size_t c = 0; c < 3; ++c)
    {
        // sums of the shares times the texels; each is count times too large
        int64_t a = 0;
        for (size_t k = 0; k < static_cast<size_t>(kSteps); ++k)
            a += sorted.sums[cut.ends[k]][c] + cut.ends[k] * sorted.total[c];
        const int64_t b = kSteps * count * sorted.total[c] - a;
        ends[0][c] = nearestCode(kSteps * (shares.bb * a - shares.ab * b), determinant * count, c);
        ends[1][c] = nearestCode(kSteps * (shares.aa * b - shares.ab * a), determinant * count, c);
    }
    return ends;
}

/// Try the best cuts of the texels `used` along an axis.
template <int64_t kSteps>
void fitClusters(const Bc1Problem& problem, const std::array<int32_t, 3>& axis, uint32_t used,
                 size_t cut_count, Bc1Solution& best)
{
    const SortedSums sorted = sortAlong(problem, axis, used);
    BestCuts cuts(cut_count);
    rankCuts<kSteps>(problem, sorted, cuts);
    for (const Cut& cut : cuts.list())
    {
        const std::array<Codes, 2> ends = solveCut<kSteps>(sorted, cut);
        keepBetter(problem, ends[0], ends[1], kSteps == 3 ? Bc1Palette::four : Bc1Palette::three, best);
    }
}

/// Move single codes, and codes of both endpoints, by one as long as that decreases the error.
void refine(const Bc1Problem& problem, Bc1Solution& best)
{
    constexpr std::array<std::array<int16_t, 2>, 8> kMoves = {
        {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
    for (bool found = true; found;)
    {
        found = false;
        for (size_t c = 0; c < 3; ++c)
            for (const std::array<int16_t, 2>& move : kMoves)
            {
                Codes first = best.first, second = best.second;
                first[c] = std::clamp<int16_t>(static_cast<int16_t>(first[c] + move[0]), 0, kMaxCodes[c]);
                second[c] = std::clamp<int16_t>(static_cast<int16_t>(second[c] + move[1]), 0, kMaxCodes[c]);
                const uint32_t before = best.error;
                keepBetter(problem, first, second, best.palette, best);
                found |= best.error < before;
            }
    }
}

/// [palette][channel][value]: codes whose third colour is nearest to a value of 8 bits; among equals the
/// closest pair.
using SingleColors = std::array<std::array<std::array<std::array<int16_t, 2>, 256>, 3>, 2>;

const SingleColors& singleColors()
{
    static const SingleColors table = []
    {
        SingleColors result{};
        for (size_t palette = 0; palette < 2; ++palette)
            for (size_t c = 0; c < 3; ++c)
            {
                std::array<int, 256> best;
                best.fill(INT32_MAX);
                for (int16_t a = 0; a <= kMaxCodes[c]; ++a)
                    for (int16_t b = 0; b <= kMaxCodes[c]; ++b)
                    {
                        Codes first{}, second{};
                        first[c] = a;
                        second[c] = b;
                        const int color = makePalette(first, second, static_cast<Bc1Palette>(palette))[2][c];
                        for (int value = std::max(color - 8, 0); value <= std::min(color + 8, 255); ++value)
                        {
                            const int rating = std::abs(color - value) * 256 + std::abs(a - b);
                            if (rating < best[static_cast<size_t>(value)])
                            {
                                best[static_cast<size_t>(value)] = rating;
                                result[palette][c][static_cast<size_t>(value)] = {a, b};
                            }
                        }
                    }
            }
        return result;
    }();
    return table;
}

/// Return endpoints between which the mean colour of the texels `used` lies: for texels of nearly one colour.
Bc1Solution fitSingleColor(const Bc1Problem& problem, Bc1Palette palette, uint32_t used)
{
    const auto count = static_cast<int>(std::popcount(used));
    Codes first{}, second{};
    for (size_t c = 0; c < 3; ++c)
    {
        int sum = count / 2;
        for (size_t t = 0; t < 16; ++t)
            sum += (used >> t & 1u) != 0 ? problem.texels[c][t] : 0;
        const auto mean = static_cast<size_t>(sum / count);
        const std::array<int16_t, 2>& ends = singleColors()[static_cast<size_t>(palette)][c][mean];
        first[c] = ends[0];
        second[c] = ends[1];
    }
    Bc1Solution solution;
    keepBetter(problem, first, second, palette, solution);
    return solution;
}

/// Try endpoints at the ends of the texels along an axis.
void tryExtremes(const Bc1Problem& problem, const std::array<int32_t, 3>& axis, Bc1Solution& best)
{
    size_t low = 0, high = 0;
    std::array<int64_t, 16> place{};
    for (size_t t = 0; t < 16; ++t)
    {
        for (size_t c = 0; c < 3; ++c)
            place[t] += int64_t{axis[c]} * problem.texels[c][t];
        low = place[t] < place[low] ? t : low;
        high = place[t] > place[high] ? t : high;
    }
    Codes first{}, second{};
    for (size_t c = 0; c < 3; ++c)
    {
        first[c] = nearestCode(problem.texels[c][high], 1, c);
        second[c] = nearestCode(problem.texels[c][low], 1, c);
    }
    keepBetter(problem, first, second, Bc1Palette::four, best);
}

std::array<int32_t, 3> axisBetween(const Bc1Solution& solution)
{
    std::array<int32_t, 3> axis;
    for (size_t c = 0; c < 3; ++c)
        axis[c] = widen(solution.first[c], c) - widen(solution.second[c], c);
    return axis;
}

/// Return the texels that are not nearly black, a bit each: black is a colour of the palette of three.
uint32_t texelsAboveBlack(const Bc1Problem& problem)
{
    constexpr int16_t kNearlyBlack = 12;
    uint32_t used = 0;
    for (uint32_t t = 0; t < 16; ++t)
        if (std::max({problem.texels[0][t], problem.texels[1][t], problem.texels[2][t]}) > kNearlyBlack)
            used |= 1u << t;
    return used;
}

/// Refine a solution, and one about a single colour if that is not much worse; the better becomes `best`.
void refineBoth(const Bc1Problem& problem, Bc1Solution solution, Bc1Solution single, Bc1Solution& best)
{
    const uint32_t before = solution.error;
    refine(problem, solution);
    if (single.error / 4 < before)
    {
        refine(problem, single);
        if (single.error < solution.error)
            solution = single;
    }
    if (solution.error < best.error)
        best = solution;
}

void fitFour(const Bc1Problem& problem, const std::array<int32_t, 3>& axis, size_t cut_count,
             Bc1Solution& best)
{
    Bc1Solution solution = best;
    fitClusters<3>(problem, axis, kAllTexels, cut_count, solution);
    fitClusters<3>(problem, axisBetween(solution), kAllTexels, cut_count, solution);
    refineBoth(problem, solution, fitSingleColor(problem, Bc1Palette::four, kAllTexels), best);
}

void fitThree(const Bc1Problem& problem, const std::array<int32_t, 3>& axis, size_t cut_count,
              Bc1Solution& best)
{
    Bc1Solution solution, single = fitSingleColor(problem, Bc1Palette::three, kAllTexels);
    fitClusters<2>(problem, axis, kAllTexels, cut_count, solution);
    const uint32_t used = texelsAboveBlack(problem);
    if (used != kAllTexels && used != 0)
    {
        fitClusters<2>(problem, principalAxis(problem.texels, used), used, cut_count, solution);
        single = fitSingleColor(problem, Bc1Palette::three, used);
    }
    refineBoth(problem, solution, single, best);
}

/// Write a solution. The order of the endpoints tells the palette.
void pack(const Bc1Problem& problem, const Bc1Solution& solution, std::span<std::byte, 8> block)
{
    const auto join = [](const Codes& codes)
    {
        return static_cast<uint32_t>(codes[0]) << 11 | static_cast<uint32_t>(codes[1]) << 5 |
               static_cast<uint32_t>(codes[2]);
    };
    std::array<int32_t, 16> indices{};
    chooseIndices(problem, makePalette(solution.first, solution.second, solution.palette), indices);
    uint32_t first = join(solution.first), second = join(solution.second);
    const bool four = solution.palette == Bc1Palette::four;
    const bool exchange = four ? first < second : first > second;
    if (exchange)
        std::swap(first, second);
    uint32_t bits = 0;
    for (uint32_t t = 0; t < 16; ++t)
    {
        auto index = static_cast<uint32_t>(indices[t]);
        if (first == second)
            index = index == 3 && !four ? 3 : 0; // all but black are one colour
        else if (exchange && (four || index < 2))
            index ^= 1u;
        bits |= index << 2 * t;
    }
    const std::array<uint32_t, 2> words = {first | second << 16, bits};
    for (size_t i = 0; i < 8; ++i)
        block[i] = static_cast<std::byte>(words[i / 4] >> 8 * (i % 4) & 0xFFu);
}

} // namespace

uint32_t encodeBc1(const Block8& texels, const ChannelWeights& weights, Bc1Palettes palettes, Effort effort,
                   std::span<std::byte, 8> block)
{
    Bc1Problem problem;
    for (size_t c = 0; c < 3; ++c)
    {
        problem.weights[c] = weights[c];
        for (size_t t = 0; t < 16; ++t)
            problem.texels[c][t] = texels[t][c];
    }
    const std::array<int32_t, 3> axis = principalAxis(problem.texels, kAllTexels);
    Bc1Solution best = fitSingleColor(problem, Bc1Palette::four, kAllTexels);
    tryExtremes(problem, axis, best);
    if (effort == Effort::draft)
        fitClusters<3>(problem, axis, kAllTexels, 1, best);
    else
    {
        const size_t cut_count = effort == Effort::normal ? 4 : 16;
        if (best.error > 0)
            fitFour(problem, axis, cut_count, best);
        if (best.error > 0 && palettes == Bc1Palettes::all)
            fitThree(problem, axis, cut_count, best);
    }
    pack(problem, best, block);
    return best.error;
}

} // namespace hearth::texels
