// Cut-outs: as many decoded texels pass the alpha test as plain ones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/match_coverage.h"

#include "cook/texels/search/search.h"
#include "formats/texels/decode_texels.h"
#include "tests/texels/test_images.h"

#include <tbb/global_control.h>

#include <cmath>
#include <gtest/gtest.h>

namespace hearth::texels
{

namespace
{

using namespace test;
using namespace formats;

/// Make narrow leaves, of which each lies across its cell of a grid; their edges are soft.
TestImage makeLeaves(uint32_t side, uint32_t mips, float cutoff, double softness)
{
    const auto leaves = [softness, color = photographic(0.05)](uint32_t c, double x, double y)
    {
        if (c != 3)
            return color(c, x, y);
        const double u = std::fmod(11 * x, 1.0) - 0.5, v = std::fmod(11 * y, 1.0) - 0.5;
        const double turn = 1.7 * std::floor(11 * x) + 2.9 * std::floor(11 * y);
        const double along = u * std::cos(turn) + v * std::sin(turn);
        const double across = v * std::cos(turn) - u * std::sin(turn);
        const double half_width = 0.16 * (1 - 5 * along * along);
        return std::clamp((half_width - std::abs(across)) / softness + 0.5, 0.0, 1.0);
    };
    TestImage image = makeImage(side, side, mips, TexelFormat::rgba8_srgb, leaves);
    image.record.flags = kImageAlphaTested;
    image.record.alpha_cutoff = cutoff;
    return image;
}

/// Count the share of decoded texels of a mip that pass, less that of plain ones.
double recountChange(const PlainImage& plain, const Candidate& candidate, std::span<const std::byte> encoded,
                     uint32_t mip)
{
    ImageRecord record = plain.record;
    record.format = static_cast<uint32_t>(candidate.traits->format);
    const MipExtent extent = mipExtent(record, mip);
    const auto first = static_cast<size_t>(mipOffset(record, mip)),
               end = static_cast<size_t>(mipOffset(record, mip + 1));
    const std::vector<DecodedTexel> decoded =
        decodeMip(*candidate.traits, extent.width, extent.height, encoded.subspan(first, end - first));
    double change = 0;
    for (size_t i = 0; i < decoded.size(); ++i)
    {
        const auto stored =
            std::to_integer<int>(plain.mips[static_cast<size_t>(mipOffset(plain.record, mip)) + 4 * i + 3]);
        change += static_cast<float>(decoded[i][3]) / 65535.0f >= plain.record.alpha_cutoff ? 1 : 0;
        change -= static_cast<float>(stored) / 255.0f >= plain.record.alpha_cutoff ? 1 : 0;
    }
    return std::abs(change) / static_cast<double>(decoded.size());
}

const Candidate* findCandidate(std::span<const Candidate> candidates, TexelFormat format)
{
    const auto found = std::ranges::find_if(candidates, [&](const Candidate& candidate)
                                            { return candidate.traits->format == format; });
    return found == candidates.end() ? nullptr : &*found;
}

TEST(MatchCoverage, decodedTexelsOfLeavesCoverWhatPlainOnesDid)
{
    for (const float cutoff : {0.5f, 0.8f})
    {
        const TestImage leaves = makeLeaves(128, 2, cutoff, 0.25);
        const PlainImage plain = leaves.plain(ImageRole::cutout, kRgb | kAlpha);
        const std::vector<Candidate> candidates = listCandidates(plain, {.astc = true});
        double worst_before = 0;
        for (const TexelFormat format :
             {astcFormat(TexelFormat::astc_srgb, 7), astcFormat(TexelFormat::astc_srgb, 11)})
        {
            const Candidate& candidate = *findCandidate(candidates, format);
            std::vector<std::byte> encoded = encodeImage(plain, {}, candidate, Effort::draft);
            std::array<double, 2> before{};
            for (uint32_t mip = 0; mip < 2; ++mip)
                before[mip] = recountChange(plain, candidate, encoded, mip);
            matchCoverage(plain, {}, candidate, Effort::draft, encoded);
            for (uint32_t mip = 0; mip < 2; ++mip)
            {
                const double after = recountChange(plain, candidate, encoded, mip);
                EXPECT_LE(after, 0.005) << candidate.traits->name << " mip " << mip << " cutoff " << cutoff;
                EXPECT_LE(after, before[mip]);
                worst_before = std::max(worst_before, before[mip]);
            }
        }
        EXPECT_GT(worst_before, 0.005) << "there was something to match";
    }
}

TEST(MatchCoverage, mipsThatCoverEnoughStayAsTheyAre)
{
    const TestImage leaves = makeLeaves(128, 2, 0.5f, 0.25);
    PlainImage plain = leaves.plain(ImageRole::cutout, kRgb | kAlpha);
    const std::vector<Candidate> candidates = listCandidates(plain, {.astc = true});
    const Candidate& fine = *findCandidate(candidates, TexelFormat::astc_srgb);
    const std::vector<std::byte> encoded = encodeImage(plain, {}, fine, Effort::draft);
    std::vector<std::byte> matched = encoded;
    matchCoverage(plain, {}, fine, Effort::draft, matched);
    EXPECT_EQ(matched, encoded);

    const Candidate& coarse = *findCandidate(candidates, astcFormat(TexelFormat::astc_srgb, 13));
    const std::vector<std::byte> blended = encodeImage(plain, {}, coarse, Effort::draft);
    plain.record.flags = 0;
    matched = blended;
    matchCoverage(plain, {}, coarse, Effort::draft, matched);
    EXPECT_EQ(matched, blended) << "there is no alpha test";
}

TEST(MatchCoverage, theSearchMatchesForAnyNumberOfThreads)
{
    const TestImage leaves = makeLeaves(128, 2, 0.4f, 0.25);
    const PlainImage plain = leaves.plain(ImageRole::cutout, kRgb | kAlpha);
    const std::vector<Candidate> all = listCandidates(plain, {.astc = true});
    const std::array candidates{*findCandidate(all, astcFormat(TexelFormat::astc_srgb, 7)), all.back()};
    const auto encode = [&](size_t threads)
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return encodeForTarget(plain, candidates, {0.2, 1}, Effort::draft, false);
    };
    const Encoding one = encode(1), several = encode(7);
    EXPECT_EQ(one.texels, several.texels);
    const std::vector<std::byte> unmatched = encodeImage(plain, {}, one.candidate, Effort::draft);
    EXPECT_LT(one.error.coverage, measureError(plain, {}, one.candidate, unmatched).coverage / 2);
}

TEST(MatchCoverage, costsNoOtherFormat)
{
    const TestImage leaves = makeLeaves(128, 2, 0.2f, 0.02);
    const PlainImage plain = leaves.plain(ImageRole::cutout, kRgb | kAlpha);
    const std::vector<Candidate> all = listCandidates(plain, {.astc = true});
    const Candidate& coarse = *findCandidate(all, astcFormat(TexelFormat::astc_srgb, 11));
    std::vector<std::byte> encoded = encodeImage(plain, {}, coarse, Effort::draft);
    const double unmatched = measureError(plain, {}, coarse, encoded).error;
    matchCoverage(plain, {}, coarse, Effort::draft, encoded);
    const double matched = measureError(plain, {}, coarse, encoded).error;
    ASSERT_GT(matched, 1.5 * unmatched) << "scaled alphas are an error";
    const std::array candidates{coarse, *findCandidate(all, TexelFormat::astc_srgb), all.back()};
    const Target target{(matched + unmatched) / 2, 1};
    EXPECT_EQ(encodeForTarget(plain, candidates, target, Effort::draft, false).candidate.traits,
              coarse.traits);
}

} // namespace

} // namespace hearth::texels
