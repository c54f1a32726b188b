// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/search.h"

#include "cook/texels/search/error_estimate.h"
#include "cook/texels/search/match_coverage.h"
#include "formats/base/assert.h"
#include "formats/pack/pack_view.h"

#include <algorithm>
#include <cmath>

namespace hearth::texels
{

using namespace formats;

namespace
{

// Few blocks tell which candidates are far from the target; more are encoded while there is doubt. Estimates
// from 224 blocks are off by 6 % rms, and by less as the square root of the blocks grows. A wrong one costs
// bytes if it is too large, and an encoding if it is too small. So a candidate is encoded only if its
// estimate holds the target with room for doubt.
constexpr struct
{
    double low, high;
} kDoubts[] = {{0.75, 1.3}, {0.9, 1.06}};
constexpr double kSureShares[] = {0.9, 0.93, 0.97};

// Power of the bits by which errors fall: the usual one below and above the target, and the least that a
// guess believes. A share of 0 has no logarithm.
constexpr double kUsualSlopeToFewer = -0.8, kUsualSlopeToMore = -1.1, kFlattestSlope = -0.3, kMinShare = 1e-3;

// Guesses alone may come near from one side, a candidate at a time. After so many the middle has its turn.
constexpr uint32_t kGuesses = 3;

// ETC2 is up to a third worse than its neighbours: one that misses by less says little of those below.
constexpr double kNearShare = 1.35;

// Candidates with the most bytes, one of which an image gets that misses its target in all.
constexpr size_t kLastResorts = 3;

/// Return the larger part of its target that an error takes, of all texels or of the smooth ones.
double findShare(const ImageError& error, const Target& target)
{
    return std::max(error.error / target.error, error.smooth / target.smooth);
}

/// Estimates of the candidates so far, as shares of the target.
class Estimates
{
public:
    Estimates(const PlainImage& image, const ImageDetail& detail, std::span<const Candidate> candidates,
              const Target& target, Effort effort)
        : image_(image),
          detail_(detail),
          candidates_(candidates),
          target_(target),
          effort_(effort),
          estimates_(candidates.size())
    {
    }

    double get(size_t i)
    {
        if (!estimates_[i])
        {
            estimates_[i].emplace(image_, detail_, candidates_[i], effort_);
            for (const auto& doubt : kDoubts)
                if (const double share = findShare(estimates_[i]->error(), target_);
                    share > doubt.low && share < doubt.high)
                    estimates_[i]->refine();
        }
        return findShare(estimates_[i]->error(), target_);
    }

    /// Return true if the candidate is all but sure to hold the target.
    bool isSafe(size_t i)
    {
        for (const double sure : kSureShares)
        {
            if (get(i) <= sure || get(i) > 1)
                return get(i) <= sure;
            if (sure != std::ranges::max(kSureShares))
                estimates_[i]->refine();
        }
        return false;
    }

    /// Return the blocks of a candidate that are encoded, as encodeImage takes them.
    std::vector<EncodedBlock> listBlocks(size_t i) const
    {
        return estimates_[i] ? estimates_[i]->listBlocks() : std::vector<EncodedBlock>();
    }

    /// Return the estimates that were asked for, in the order of the candidates.
    std::vector<CandidateError> list() const
    {
        std::vector<CandidateError> list;
        for (size_t i = 0; i < estimates_.size(); ++i)
            if (estimates_[i])
                list.push_back({candidates_[i], estimates_[i]->error()});
        return list;
    }

private:
    const PlainImage& image_;
    const ImageDetail& detail_;
    std::span<const Candidate> candidates_;
    Target target_;
    Effort effort_;
    std::vector<std::optional<ErrorEstimate>> estimates_;
};

/// Guess which of candidates [low, high) is the cheapest that holds the target: where a line through what is
/// known beside them, logarithms of shares over those of bits, meets it.
size_t guessCheapest(Estimates& estimates, std::span<const Candidate> candidates, size_t low, size_t high)
{
    const auto bits = [&](size_t i) { return std::log2(candidates[i].bitsPerTexel()); };
    const auto share = [&](size_t i) { return std::log2(std::max(estimates.get(i), kMinShare)); };
    const bool knows_low = low > 0, knows_high = high < candidates.size();
    double slope = knows_high ? kUsualSlopeToFewer : kUsualSlopeToMore;
    size_t nearest = knows_high ? high : low - 1;
    if (knows_low && knows_high)
    {
        if (bits(high) > bits(low - 1))
            slope = (share(high) - share(low - 1)) / (bits(high) - bits(low - 1));
        nearest = std::abs(share(low - 1)) < std::abs(share(high)) ? low - 1 : high;
    }
    const double wanted = bits(nearest) - share(nearest) / std::min(slope, kFlattestSlope);
    size_t guess = low;
    while (guess + 1 < high && bits(guess) < wanted)
        ++guess;
    return guess;
}

/// Return the cheapest candidate whose estimate holds the target; their number if none does. Errors mostly
/// fall with bytes, so what is cheaper than one that misses is not tried; but for what lies behind ETC2.
size_t findCheapest(Estimates& estimates, std::span<const Candidate> candidates)
{
    const auto holds = [&](size_t i) { return estimates.get(i) <= 1; };
    size_t low = 0, high = candidates.size();
    for (uint32_t step = 0; low < high; ++step)
    {
        const bool guesses = step > 0 && (step <= kGuesses || step % 2 == 1);
        const size_t next = guesses ? guessCheapest(estimates, candidates, low, high) : (low + high) / 2;
        if (holds(next))
            high = next;
        else
            low = next + 1;
    }
    const bool is_behind_etc2 = low > 1 && candidates[low - 1].traits->family == TexelFamily::etc2;
    return is_behind_etc2 && estimates.get(low - 1) < kNearShare && holds(low - 2) ? low - 2 : low;
}

/// Encode, measure what is lost, and compare it with the target. The area of a cut-out is kept as far as the
/// target allows: scaled alphas are an error, too, and must not cost another format.
/// known  as encodeImage
Encoding encodeMeasured(const PlainImage& image, std::span<const SmoothCells> smooth,
                        const Candidate& candidate, const Target& target, Effort effort,
                        std::span<const EncodedBlock> known = {})
{
    Encoding encoding{.candidate = candidate, .texels = encodeImage(image, smooth, candidate, effort, known)};
    const auto measure = [&](Encoding& measured)
    {
        measured.error = measureError(image, smooth, candidate, measured.texels);
        measured.share = findShare(measured.error, target);
    };
    measure(encoding);
    Encoding matched = encoding;
    matchCoverage(image, smooth, candidate, effort, matched.texels);
    if (matched.texels == encoding.texels)
        return encoding;
    measure(matched);
    return matched.share <= std::max(encoding.share, 1.0) ? matched : encoding;
}

/// Encode in the cheapest compressed candidate that holds the target, or in the nearest; see encodeForTarget.
Encoding encodeBest(const PlainImage& image, std::span<const Candidate> candidates, const Target& target,
                    Effort effort, bool strict, std::span<const SmoothCells> smooth, Estimates& estimates)
{
    const size_t compressed = candidates.size() - 1;
    std::optional<Encoding> best;
    for (size_t i = findCheapest(estimates, candidates.first(compressed)); i < compressed; ++i)
    {
        if (!estimates.isSafe(i))
            continue;
        Encoding encoding =
            encodeMeasured(image, smooth, candidates[i], target, effort, estimates.listBlocks(i));
        if (encoding.share <= 1)
            return encoding;
        if (!best || encoding.share < best->share)
            best = std::move(encoding);
    }
    if (strict)
        return encodeMeasured(image, smooth, candidates.back(), target, effort);
    if (best)
        return *std::move(best);
    size_t best_estimate = compressed - 1;
    for (size_t i = compressed - std::min(compressed, kLastResorts); i < compressed; ++i)
        if (estimates.get(i) < estimates.get(best_estimate))
            best_estimate = i;
    return encodeMeasured(image, smooth, candidates[best_estimate], target, effort,
                          estimates.listBlocks(best_estimate));
}

/// Leave out candidates that take no fewer bytes than one of more bits a texel: a mip that is smaller than a
/// block takes a whole one. The last candidate, without compression, stays.
std::vector<Candidate> keepUseful(const PlainImage& image, std::span<const Candidate> candidates)
{
    const auto bytes = [&](const Candidate& candidate)
    {
        ImageRecord record = image.record;
        record.format = static_cast<uint32_t>(candidate.traits->format);
        return mipOffset(record, record.mip_count);
    };
    std::vector<Candidate> kept;
    for (const Candidate& candidate : candidates)
    {
        while (!kept.empty() && bytes(kept.back()) >= bytes(candidate) &&
               kept.back().bitsPerTexel() < candidate.bitsPerTexel())
            kept.pop_back();
        kept.push_back(candidate);
    }
    return kept;
}

} // namespace

Encoding encodeForTarget(const PlainImage& image, std::span<const Candidate> all_candidates,
                         const Target& target, Effort effort, bool strict)
{
    HEARTH_ASSERT(!all_candidates.empty());
    const std::vector<Candidate> candidates = keepUseful(image, all_candidates);
    if (candidates.size() == 1)
        return encodeCandidate(image, candidates.back(), target, effort);
    const ImageDetail detail(image);
    Estimates estimates(image, detail, std::span(candidates).first(candidates.size() - 1), target, effort);
    Encoding encoding = encodeBest(image, candidates, target, effort, strict, detail.smooth, estimates);
    encoding.estimates = estimates.list();
    return encoding;
}

Encoding encodeCandidate(const PlainImage& image, const Candidate& candidate, const Target& target,
                         Effort effort)
{
    return encodeMeasured(image, findSmoothCells(image), candidate, target, effort);
}

} // namespace hearth::texels
