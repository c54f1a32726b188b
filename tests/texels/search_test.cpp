// The format of an image: its error is what a recount by another decoder says, and holds the target.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/error_estimate.h"
#include "cook/texels/search/search.h"
#include "tests/texels/astc_reference.h"
#include "tests/texels/test_images.h"

#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <string_view>

namespace hearth::texels
{

namespace
{

using namespace test;
using namespace formats;

constexpr Families kAstc{.astc = true};

double toDecibels(double error)
{
    return -20 * std::log10(error);
}

std::array<double, 3> directionFromXy(double x, double y)
{
    const double nx = 2 * x - 1, ny = 2 * y - 1, nz = std::sqrt(std::max(0.0, 1 - nx * nx - ny * ny));
    const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
    return {nx / length, ny / length, nz / length};
}

/// Square of a texel's error, recounted from channels of 0 to 1: of each channel, or of the angle.
std::array<double, 4> squareErrors(ImageRole role, const std::array<double, 4>& a,
                                   const std::array<double, 4>& b)
{
    if (role == ImageRole::normal)
    {
        const auto m = directionFromXy(a[0], a[1]), n = directionFromXy(b[0], b[1]);
        const double chord =
            std::sqrt(std::pow(m[0] - n[0], 2) + std::pow(m[1] - n[1], 2) + std::pow(m[2] - n[2], 2));
        return {std::pow(2 * std::asin(std::min(chord / 2, 1.0)), 2)};
    }
    std::array<double, 4> squares{};
    for (size_t c = 0; c < 4; ++c)
    {
        const double x = role == ImageRole::cutout && c < 3 ? a[c] * a[3] : a[c];
        const double y = role == ImageRole::cutout && c < 3 ? b[c] * b[3] : b[c];
        squares[c] = (x - y) * (x - y);
    }
    return squares;
}

/// Recount the error of an encoding in ASTC with libastcenc's decoder.
double recount(const TestImage& image, const PlainImage& plain, const Encoding& encoding)
{
    const TexelFormatTraits& traits = *encoding.candidate.traits;
    size_t plain_at = 0, stored_at = 0;
    std::array<double, 4> mean{};
    uint32_t mips = 0;
    for (uint32_t mip = 0; mip < image.record.mip_count; ++mip)
    {
        const MipExtent extent = mipExtent(image.record, mip);
        const size_t count = size_t{extent.width} * extent.height;
        const size_t bytes = ((extent.width + traits.block_width - 1u) / traits.block_width) *
                             ((extent.height + traits.block_height - 1u) / traits.block_height) * size_t{16};
        const std::vector<float> decoded = decodeByAstcenc(
            traits, extent.width, extent.height, std::span(encoding.texels).subspan(stored_at, bytes));
        if (mip < 4 && (mip == 0 || std::min(extent.width, extent.height) >= 64))
        {
            ++mips;
            std::array<double, 4> sum{};
            for (size_t i = 0; i < count; ++i)
            {
                std::array<double, 4> a, b;
                for (size_t c = 0; c < 4; ++c)
                {
                    a[c] = std::to_integer<int>(image.mips[plain_at + i * 4 + c]) / 255.0;
                    const Swizzle from = encoding.candidate.swizzle[c];
                    const size_t stored = from == Swizzle::identity ? c : static_cast<size_t>(from) - 3;
                    b[c] = from == Swizzle::zero  ? 0
                           : from == Swizzle::one ? 1
                                                  : double{decoded[i * 4 + stored]};
                }
                const std::array<double, 4> squares = squareErrors(plain.role, a, b);
                for (size_t c = 0; c < 4; ++c)
                    sum[c] += has(plain.channels, static_cast<uint32_t>(c)) ? squares[c] : 0;
            }
            for (size_t c = 0; c < 4; ++c)
                mean[c] += sum[c] / static_cast<double>(count);
        }
        plain_at += count * 4;
        stored_at += bytes;
    }
    EXPECT_EQ(stored_at, encoding.texels.size());
    for (double& channel : mean)
        channel /= mips;
    if (plain.role == ImageRole::normal)
        return std::sqrt(mean[0]);
    if (plain.role == ImageRole::data)
        return std::sqrt(*std::max_element(mean.begin(), mean.end()));
    return std::sqrt((mean[0] + mean[1] + mean[2] + mean[3]) / (has(plain.channels, 3) ? 4 : 3));
}

struct Case
{
    const char* name;
    TestImage image;
    ImageRole role;
    Channels channels;
};

std::vector<Case> makeCases()
{
    const auto holes = [inner = photographic(0.05)](uint32_t c, double x, double y)
    { return c == 3 ? (std::sin(25 * x) * std::sin(19 * y) > 0 ? 1.0 : 0.0) : inner(c, x, y); };
    return {
        {"colour", makeImage(192, 133, 3, TexelFormat::rgba8_srgb, photographic(0.08)), ImageRole::color,
         kRgb},
        {"smooth colour", makeImage(192, 133, 3, TexelFormat::rgba8_srgb, photographic(0)), ImageRole::color,
         kRgb},
        {"cutout", makeImage(128, 128, 2, TexelFormat::rgba8_srgb, holes), ImageRole::cutout, kRgb | kAlpha},
        {"emissive", makeImage(128, 128, 2, TexelFormat::rgba8_srgb, photographic(0.02)), ImageRole::emissive,
         kRgb},
        {"roughness and metalness", makeImage(128, 128, 2, TexelFormat::rgba8_unorm, photographic(0.1)),
         ImageRole::data, kGreen | kBlue},
        {"three numbers", makeImage(128, 128, 2, TexelFormat::rgba8_unorm, photographic(0.05)),
         ImageRole::data, kRgb},
        {"normals", makeImage(192, 128, 2, TexelFormat::rgba8_unorm, bumps(0.6)), ImageRole::normal,
         kRed | kGreen}};
}

TEST(TexelSearch, theErrorIsThatOfARecountAndHoldsTheTarget)
{
    for (const Case& c : makeCases())
    {
        SCOPED_TRACE(c.name);
        const PlainImage plain = c.image.plain(c.role, c.channels);
        const Target target = findTarget(c.role, Effort::draft);
        const Encoding encoding =
            encodeForTarget(plain, listCandidates(plain, kAstc), target, Effort::draft, false);
        ASSERT_EQ(encoding.candidate.traits->family, TexelFamily::astc);
        const double recounted = recount(c.image, plain, encoding);
        EXPECT_NEAR(encoding.error.error, recounted, 1e-3 * recounted) << "libastcenc decodes to half floats";
        EXPECT_LE(encoding.share, 1);
        EXPECT_LE(recounted, target.error * 1.001);
        EXPECT_GE(encoding.error.error_p999, encoding.error.error) << "the worst texels are above the mean";
    }
}

/// Return the candidate of a colour that is larger than libastcenc searches well.
Candidate findAstc8x8(const PlainImage& plain)
{
    for (const Candidate& candidate : listCandidates(plain, kAstc))
        if (std::string_view(candidate.traits->name) == "astc-8x8-srgb")
            return candidate;
    ADD_FAILURE();
    return {};
}

TEST(TexelSearch, smoothAreasAreEncodedFinerThanLibastcencAloneWould)
{
    const auto sky = [](uint32_t c, double x, double y)
    {
        const double wave = 0.5 + 0.1 * std::sin(3 * x + c) * std::cos(2 * y - 0.5 * c);
        return c == 3 ? 1 : wave + (std::abs(std::fmod(2 * x + y, 1.0)) < 0.4 ? 0.2 : 0);
    };
    const TestImage image = makeImage(256, 256, 1, TexelFormat::rgba8_srgb, sky);
    const PlainImage plain = image.plain(ImageRole::color, kRgb);
    const std::vector<SmoothCells> smooth = findSmoothCells(plain);
    ASSERT_FALSE(smooth.empty());
    const Candidate wide = findAstc8x8(plain);
    const Target target = findTarget(plain.role, Effort::normal);
    const ImageError alone = measureError(plain, smooth, wide, encodeImage(plain, {}, wide, Effort::normal));
    const ImageError error = encodeCandidate(plain, wide, target, Effort::normal).error;
    EXPECT_LT(error.smooth, alone.smooth * 0.9);
    EXPECT_LE(error.error, alone.error);
}

TEST(TexelSearch, blocksOfAnEstimateAreThoseOfTheImage)
{
    // the right half is grain; no side is a multiple of a block's
    const auto value = [random = std::mt19937(9)](uint32_t c, double x, double y) mutable
    {
        const double grain = static_cast<double>(random() & 0xFFFF) / 65535.0 - 0.5;
        return c == 3 ? 1 : 0.5 + 0.1 * std::sin(3 * x + c) * std::cos(2 * y) + (x > 0.6 ? 0.5 * grain : 0);
    };
    const TestImage image = makeImage(150, 141, 2, TexelFormat::rgba8_srgb, value);
    const PlainImage plain = image.plain(ImageRole::color, kRgb);
    const ImageDetail detail(plain);
    ASSERT_FALSE(detail.smooth.empty());
    for (const Candidate& candidate : listCandidates(plain, {.astc = true, .etc2 = true, .bc = true}))
    {
        const TexelFormatTraits& traits = *candidate.traits;
        // a few of each encoder: it takes longer to make contexts than to encode
        if (traits.family == TexelFamily::plain ||
            (traits.family == TexelFamily::astc && traits.block_height != 8))
            continue;
        const Effort effort = traits.block_width == 8 ? Effort::normal : Effort::draft;
        ErrorEstimate estimate(plain, detail, candidate, effort);
        estimate.refine();
        std::vector<EncodedBlock> known = estimate.listBlocks();
        ASSERT_GT(known.size(), 30u);
        const std::vector<std::byte> encoded = encodeImage(plain, detail.smooth, candidate, effort);
        EXPECT_EQ(encodeImage(plain, detail.smooth, candidate, effort, known), encoded) << traits.name;
        // known blocks are taken as they are
        std::vector<std::byte> changed = encoded;
        for (EncodedBlock& block : known)
        {
            block.bytes.fill(std::byte{0x55});
            const uint64_t mip_blocks = (150 + traits.block_width - 1u) / traits.block_width *
                                        ((141 + traits.block_height - 1u) / traits.block_height);
            const size_t at = (block.mip * mip_blocks + block.block) * traits.block_bytes;
            std::fill_n(changed.begin() + static_cast<ptrdiff_t>(at), traits.block_bytes, std::byte{0x55});
        }
        EXPECT_EQ(encodeImage(plain, detail.smooth, candidate, effort, known), changed) << traits.name;
    }
}

TEST(TexelSearch, onlyBlocksWhoseErrorsAreSeenAreSearchedLonger)
{
    // no side is a multiple of a block's: the last ones reach over the edges
    constexpr uint32_t kWidth = 250, kHeight = 246, kBlock = 8, kColumns = 32, kBytes = 16;
    const auto sky = [random = std::mt19937(7)](uint32_t c, double x, double y) mutable
    {
        const double wave = 0.5 + 0.1 * std::sin(3 * x + c) * std::cos(2 * y - 0.5 * c);
        const double grain = static_cast<double>(random() & 0xFFFF) / 65535.0 - 0.5;
        return c == 3 ? 1
                      : wave + (x * y > 0.5                                 ? grain
                                : std::abs(std::fmod(2 * x + y, 1.0)) < 0.4 ? 0.2
                                                                            : 0);
    };
    const TestImage image = makeImage(kWidth, kHeight, 1, TexelFormat::rgba8_srgb, sky);
    const PlainImage plain = image.plain(ImageRole::color, kRgb);
    const std::vector<SmoothCells> smooth = findSmoothCells(plain);
    ASSERT_FALSE(smooth.empty());
    const Candidate wide = findAstc8x8(plain);
    const std::vector<std::byte> longer = encodeImage(plain, smooth, wide, Effort::normal);
    const std::vector<std::byte> usual = encodeImage(plain, {}, wide, Effort::normal);
    // an edge spans more than 48 of 255 codes within a cell of 4 x 4 texels
    const auto hasEdge = [&](uint32_t x, uint32_t y)
    {
        std::array<int, 3> low{255, 255, 255}, high{};
        for (uint32_t row = y / 4 * 4; row < std::min(y / 4 * 4 + 4, kHeight); ++row)
            for (uint32_t column = x / 4 * 4; column < std::min(x / 4 * 4 + 4, kWidth); ++column)
                for (uint32_t c = 0; c < 3; ++c)
                {
                    const int code = static_cast<int>(image.mips[(row * kWidth + column) * size_t{4} + c]);
                    low[c] = std::min(low[c], code);
                    high[c] = std::max(high[c], code);
                }
        return high[0] - low[0] > 48 || high[1] - low[1] > 48 || high[2] - low[2] > 48;
    };
    uint32_t changed = 0, hidden = 0;
    for (uint32_t block = 0; block * kBytes < longer.size(); ++block)
    {
        const uint32_t left = block % kColumns * kBlock, top = block / kColumns * kBlock;
        bool has_smooth = false, has_edge = false;
        for (uint32_t y = top; y < std::min(top + kBlock, kHeight); ++y)
            for (uint32_t x = left; x < std::min(left + kBlock, kWidth); ++x)
            {
                has_smooth = has_smooth || smooth[0].contains(x, y);
                has_edge = has_edge || hasEdge(x, y);
            }
        const bool is_seen = has_smooth || !has_edge;
        const bool differs = !std::ranges::equal(std::span(longer).subspan(size_t{block} * kBytes, kBytes),
                                                 std::span(usual).subspan(size_t{block} * kBytes, kBytes));
        EXPECT_TRUE(is_seen || !differs) << block;
        changed += differs ? 1 : 0;
        hidden += is_seen ? 0 : 1;
    }
    EXPECT_GT(changed, 10u);
    EXPECT_GT(hidden, 100u);
}

TEST(TexelSearch, tinyImagesHaveTheFinestOfFormatsWithTheSameBytes)
{
    // one block of 8x8 and of 5x5 covers it, four of 4x4 do, and two of 5x4
    const TestImage five = makeImage(5, 5, 1, TexelFormat::rgba8_srgb, photographic(0.3));
    const PlainImage plain = five.plain(ImageRole::color, kRgb);
    const Target loose{.error = 0.9, .smooth = 0.9};
    const Encoding encoding =
        encodeForTarget(plain, listCandidates(plain, kAstc), loose, Effort::draft, false);
    EXPECT_EQ(encoding.candidate.traits->name, "astc-5x5-srgb");
}

TEST(TexelSearch, noCheaperFootprintHoldsTheTarget)
{
    const Case c = makeCases()[0];
    const PlainImage plain = c.image.plain(c.role, c.channels);
    const std::vector<Candidate> candidates = listCandidates(plain, kAstc);
    const Target target = findTarget(c.role, Effort::draft);
    const Encoding found = encodeForTarget(plain, candidates, target, Effort::draft, false);
    for (const Candidate& candidate : candidates)
    {
        if (candidate.bitsPerTexel() >= found.candidate.bitsPerTexel())
            break;
        const std::vector<std::byte> encoded = encodeImage(plain, {}, candidate, Effort::draft);
        // one that holds it by less than the margin of estimates may be passed over
        EXPECT_GT(measureError(plain, {}, candidate, encoded).error, target.error * 0.94)
            << candidate.traits->name;
    }
}

TEST(TexelSearch, estimatesAreNearTheWhole)
{
    const TestImage large = makeImage(512, 512, 4, TexelFormat::rgba8_srgb, photographic(0.08));
    const PlainImage plain = large.plain(ImageRole::color, kRgb);
    for (const Candidate& candidate : listCandidates(plain, kAstc))
        if (candidate.traits->block_width == candidate.traits->block_height &&
            candidate.traits->block_width != 1)
        {
            const double whole =
                measureError(plain, {}, candidate, encodeImage(plain, {}, candidate, Effort::draft)).error;
            const ImageDetail detail(plain);
            ErrorEstimate estimate(plain, detail, candidate, Effort::draft);
            EXPECT_NEAR(toDecibels(estimate.error().error), toDecibels(whole), 0.9) << candidate.traits->name;
            estimate.refine();
            EXPECT_NEAR(toDecibels(estimate.error().error), toDecibels(whole), 0.45)
                << candidate.traits->name;
        }
}

TEST(TexelSearch, whatMissesItsTargetGetsTheBestOrStaysPlain)
{
    const TestImage noise = makeImage(64, 64, 1, TexelFormat::rgba8_srgb, photographic(1));
    const PlainImage plain = noise.plain(ImageRole::color, kRgb);
    const std::vector<Candidate> candidates = listCandidates(plain, kAstc);
    const Target target = findTarget(ImageRole::color, Effort::high);
    const Encoding missed = encodeForTarget(plain, candidates, target, Effort::draft, false);
    EXPECT_GT(missed.share, 1);
    EXPECT_EQ(missed.candidate.traits->family, TexelFamily::astc);
    for (size_t i = candidates.size() - 4; i + 1 < candidates.size(); ++i)
        EXPECT_LE(missed.error.error,
                  measureError(plain, {}, candidates[i], encodeImage(plain, {}, candidates[i], Effort::draft))
                          .error *
                      1.05);
    const Encoding kept = encodeForTarget(plain, candidates, target, Effort::draft, true);
    EXPECT_EQ(kept.candidate.traits->format, TexelFormat::rgba8_srgb);
    EXPECT_EQ(kept.error.error, 0);
    EXPECT_EQ(kept.texels, noise.mips);
}

TEST(TexelSearch, sameBytesForAnyNumberOfThreads)
{
    const TestImage color = makeImage(300, 211, 4, TexelFormat::rgba8_srgb, photographic(0.08));
    const PlainImage plain = color.plain(ImageRole::color, kRgb);
    const auto encode = [&](size_t threads)
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return encodeForTarget(plain, listCandidates(plain, kAstc), findTarget(plain.role, Effort::draft),
                               Effort::draft, false);
    };
    const Encoding one = encode(1);
    for (const size_t threads : {size_t{2}, size_t{16}})
    {
        const Encoding several = encode(threads);
        EXPECT_EQ(several.texels, one.texels);
        EXPECT_EQ(several.error.error, one.error.error);
        EXPECT_EQ(several.error.error_p999, one.error.error_p999);
    }
}

TEST(TexelSearch, coverageIsCountedBeforeAndAfter)
{
    TestImage image = makeImage(64, 64, 1, TexelFormat::rgba8_srgb,
                                [](uint32_t c, double x, double) { return c == 3 ? x : 0.5; });
    image.record.flags = kImageAlphaTested;
    image.record.alpha_cutoff = 0.5f;
    const PlainImage plain = image.plain(ImageRole::cutout, kRgb | kAlpha);
    const Candidate same = listCandidates(plain, {}).back();
    std::vector<std::byte> texels = encodeImage(plain, {}, same, Effort::draft);
    EXPECT_EQ(measureError(plain, {}, same, texels).coverage, 0);
    for (size_t i = 0; i < 41; ++i)
        texels[i * 64 * 4 + 63 * 4 + 3] = std::byte{0}; // 41 texels no longer pass
    EXPECT_NEAR(measureError(plain, {}, same, texels).coverage, 41.0 / 4096, 1e-9);
}

} // namespace

} // namespace hearth::texels
