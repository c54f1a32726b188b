// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/match_coverage.h"

#include "formats/texels/decode_texels.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hearth::texels
{

using namespace formats;

namespace
{

constexpr uint32_t kMaxRounds = 3;
constexpr uint32_t kAlphas = 65536;

// Bounds of the scale of alpha, beyond which edges become steps.
constexpr double kMinScale = 0.25, kMaxScale = 4;

/// Numbers of texels with each alpha.
using Histogram = std::vector<uint32_t>;

/// Return the smallest alpha that passes the test; kAlphas if none does.
uint32_t findMinPassing(float cutoff)
{
    uint32_t alpha = 0;
    while (alpha < kAlphas && static_cast<float>(alpha) / 65535.0f < cutoff)
        ++alpha;
    return alpha;
}

Histogram countAlphas(std::span<const DecodedTexel> texels)
{
    Histogram histogram(kAlphas);
    for (const DecodedTexel& texel : texels)
        ++histogram[texel[3]];
    return histogram;
}

uint64_t countPassing(const Histogram& histogram, uint32_t min_passing)
{
    uint64_t passing = 0;
    for (uint32_t alpha = min_passing; alpha < kAlphas; ++alpha)
        passing += histogram[alpha];
    return passing;
}

/// Scale of alpha, and how many more texels pass than should, as a share of the mip.
struct Trial
{
    double scale;
    double change = 0;
};

/// Return the scale between two at which no more and no fewer texels than wanted should pass.
double interpolateScale(const Trial& too_low, const Trial& too_high)
{
    const double share = -too_low.change / (too_high.change - too_low.change);
    return too_low.scale + share * (too_high.scale - too_low.scale);
}

/// Mip that is encoded again and again.
class MipCoverage
{
public:
    MipCoverage(const PlainImage& image, std::span<const SmoothCells> smooth, const Candidate& candidate,
                Effort effort, uint32_t mip)
        : image_(image),
          smooth_(smooth),
          candidate_(candidate),
          effort_(effort),
          mip_(mip),
          extent_(mipExtent(image.record, mip)),
          min_passing_(findMinPassing(image.record.alpha_cutoff)),
          wanted_(countPassing(countAlphas(decodeRows(image, mip, 0, extent_.height)), min_passing_))
    {
    }

    /// Improve the blocks of the mip.
    void match(std::span<std::byte> blocks) const
    {
        std::vector<std::byte> tried(blocks.begin(), blocks.end());
        double best = 2;
        std::optional<Trial> too_low, too_high;
        Trial trial{.scale = 1};
        for (uint32_t round = 0;; ++round)
        {
            const Histogram histogram = countAlphas(decode(tried));
            trial.change = measureChange(histogram);
            if (std::abs(trial.change) < best)
            {
                best = std::abs(trial.change);
                std::ranges::copy(tried, blocks.begin());
            }
            if (std::abs(trial.change) <= kMaxCoverageChange || round == kMaxRounds)
                return;
            (trial.change < 0 ? too_low : too_high) = trial;
            const double next =
                too_low && too_high
                    ? interpolateScale(*too_low, *too_high)
                    : std::clamp(trial.scale * findFactor(histogram, trial.change), kMinScale, kMaxScale);
            if (next == trial.scale)
                return;
            trial.scale = next;
            tried = encodeMip(image_, smooth_, candidate_, effort_, mip_, static_cast<float>(next));
        }
    }

private:
    std::vector<DecodedTexel> decode(std::span<const std::byte> blocks) const
    {
        std::vector<DecodedTexel> texels =
            decodeMip(*candidate_.traits, extent_.width, extent_.height, blocks);
        readStored(candidate_, texels);
        return texels;
    }

    double measureChange(const Histogram& histogram) const
    {
        const auto passing = static_cast<double>(countPassing(histogram, min_passing_));
        return (passing - static_cast<double>(wanted_)) / (1.0 * extent_.width * extent_.height);
    }

    /// Return the factor of alpha that should undo a change of the coverage: a step of Newton, with the
    /// slope that the number of alphas near the cutoff tells. Over a wide range, since decoded alphas
    /// come in steps.
    double findFactor(const Histogram& histogram, double change) const
    {
        constexpr double kNear = 0.1;
        const auto low = static_cast<uint32_t>(min_passing_ * (1 - kNear)),
                   high = std::min(static_cast<uint32_t>(min_passing_ * (1 + kNear)), kAlphas);
        const uint64_t near = countPassing(histogram, low) - countPassing(histogram, high);
        const double slope = static_cast<double>(near) / (2 * kNear) / (1.0 * extent_.width * extent_.height);
        return slope > 0 ? std::clamp(1 - change / slope, 0.5, 2.0) : 1;
    }

    const PlainImage& image_;
    std::span<const SmoothCells> smooth_;
    const Candidate& candidate_;
    Effort effort_;
    uint32_t mip_;
    MipExtent extent_;
    uint32_t min_passing_; ///< alpha
    uint64_t wanted_;      ///< texels that pass
};

} // namespace

void matchCoverage(const PlainImage& image, std::span<const SmoothCells> smooth, const Candidate& candidate,
                   Effort effort, std::vector<std::byte>& encoded)
{
    if ((image.record.flags & kImageAlphaTested) == 0 || candidate.traits->family == TexelFamily::plain)
        return;
    size_t at = 0;
    for (uint32_t mip = 0; mip < image.record.mip_count; ++mip)
    {
        const MipExtent extent = mipExtent(image.record, mip);
        const auto bytes =
            static_cast<size_t>(formats::mipBytes(*candidate.traits, extent.width, extent.height));
        MipCoverage(image, smooth, candidate, effort, mip).match(std::span(encoded).subspan(at, bytes));
        at += bytes;
    }
}

} // namespace hearth::texels
