// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/encode.h"

#include "cook/texels/encoding/astc_encoder.h"
#include "cook/texels/encoding/block_encoder.h"
#include "formats/base/assert.h"
#include "formats/base/half.h"
#include "formats/texels/decode_texels.h"
#include "formats/texels/plain_encoder.h"
#include "formats/texels/swizzle.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hearth::texels
{

using namespace formats;

namespace
{

// Texels that are encoded at a time: enough that threads rarely meet, few enough that they all have work.
constexpr uint32_t kStripeTexels = 1u << 15;

/// Whole rows of blocks of a mip.
struct Stripe
{
    uint32_t mip;
    uint32_t first_row; ///< of texels
    uint32_t rows;
    size_t first_byte; ///< in all encoded stripes
    size_t bytes;
};

/// List the stripes of mips [first_mip, end_mip).
std::vector<Stripe> listStripes(const PlainImage& image, const TexelFormatTraits& traits, uint32_t first_mip,
                                uint32_t end_mip)
{
    std::vector<Stripe> stripes;
    size_t next = 0;
    for (uint32_t mip = first_mip; mip < end_mip; ++mip)
    {
        const MipExtent extent = mipExtent(image.record, mip);
        const uint32_t block_rows = std::max(kStripeTexels / extent.width / traits.block_height, 1u);
        for (uint32_t y = 0; y < extent.height; y += block_rows * traits.block_height)
        {
            const uint32_t rows = std::min(block_rows * traits.block_height, extent.height - y);
            const auto bytes = static_cast<size_t>(formats::mipBytes(traits, extent.width, rows));
            stripes.push_back({mip, y, rows, next, bytes});
            next += bytes;
        }
    }
    return stripes;
}

/// Multiply alphas, rounded to 8 bits if the image has no more.
void scaleAlpha(float scale, bool is_narrow, std::span<DecodedTexel> texels)
{
    const float step = is_narrow ? 257 : 1;
    for (DecodedTexel& texel : texels)
    {
        const float scaled = std::min(static_cast<float>(texel[3]) * scale, 65535.0f);
        texel[3] = static_cast<uint16_t>(std::floor(scaled / step + 0.5f) * step);
    }
}

/// Return the known blocks of a stripe, with their places in it.
std::vector<EncodedBlock> cutKnown(std::span<const EncodedBlock> known, const TexelFormatTraits& traits,
                                   const Stripe& stripe, uint32_t width)
{
    const uint64_t columns = (width + traits.block_width - 1u) / traits.block_width;
    const uint64_t first = stripe.first_row / traits.block_height * columns;
    const uint64_t end = first + stripe.bytes / traits.block_bytes;
    std::vector<EncodedBlock> cut;
    const auto isBefore = [](const EncodedBlock& a, const EncodedBlock& b)
    { return a.mip != b.mip ? a.mip < b.mip : a.block < b.block; };
    for (auto next = std::ranges::lower_bound(known, EncodedBlock{stripe.mip, first}, isBefore);
         next != known.end() && next->mip == stripe.mip && next->block < end; ++next)
        cut.push_back({stripe.mip, next->block - first, next->bytes});
    return cut;
}

/// Return how long each block of a stripe is searched for; nothing if all are in the usual way.
/// known  as cutKnown
std::vector<BlockSearch> planSearch(std::span<const SmoothCells> smooth, std::span<const EncodedBlock> known,
                                    const TexelFormatTraits& traits, const Stripe& stripe, uint32_t width)
{
    std::vector<BlockSearch> search;
    if (smooth.empty() && known.empty())
        return search;
    for (uint32_t y = stripe.first_row; y < stripe.first_row + stripe.rows; y += traits.block_height)
        for (uint32_t x = 0; x < width; x += traits.block_width)
            search.push_back(showsErrors(smooth, stripe.mip, x, y, traits) ? BlockSearch::longer
                                                                           : BlockSearch::usual);
    for (const EncodedBlock& block : known)
        search[block.block] = BlockSearch::none;
    return search;
}

std::vector<std::byte> encodeStripes(const PlainImage& image, std::span<const SmoothCells> smooth,
                                     const Candidate& candidate, Effort effort,
                                     std::span<const EncodedBlock> all_known, std::span<const Stripe> stripes,
                                     float alpha_scale)
{
    const TexelFormatTraits& traits = *candidate.traits;
    std::vector<std::byte> encoded(stripes.back().first_byte + stripes.back().bytes);
    tbb::parallel_for(size_t{0}, stripes.size(),
                      [&](size_t i)
                      {
                          const Stripe& stripe = stripes[i];
                          const uint32_t width = mipExtent(image.record, stripe.mip).width;
                          std::vector<DecodedTexel> texels =
                              decodeRows(image, stripe.mip, stripe.first_row, stripe.rows);
                          if (alpha_scale != 1)
                              scaleAlpha(alpha_scale, texelBytes(image.record.format) == 4, texels);
                          StoredTexels stored = arrangeChannels(image, candidate, width, stripe.rows, texels);
                          const std::vector<EncodedBlock> known = cutKnown(all_known, traits, stripe, width);
                          stored.search = planSearch(smooth, known, traits, stripe, width);
                          const std::vector<std::byte> bytes = encodeTexels(candidate, stored, effort);
                          HEARTH_ASSERT(bytes.size() == stripe.bytes);
                          const auto place = encoded.begin() + static_cast<ptrdiff_t>(stripe.first_byte);
                          std::ranges::copy(bytes, place);
                          for (const EncodedBlock& block : known)
                              std::copy_n(block.bytes.begin(), traits.block_bytes,
                                          place + static_cast<ptrdiff_t>(block.block * traits.block_bytes));
                      });
    return encoded;
}

/// Error of a stripe.
struct StripeError
{
    ErrorSum sum;
    ErrorSum smooth;
    ErrorHistogram histogram;                       ///< of mip 0
    uint64_t passing_before = 0, passing_after = 0; ///< texels that pass the alpha test
};

StripeError makeStripeError(const PlainImage& image)
{
    return {.sum = ErrorSum(image.role, image.channels),
            .smooth = ErrorSum(image.role, image.channels),
            .histogram = ErrorHistogram(image.role, image.channels)};
}

/// Add the texels of rows of a mip that lie in smooth cells.
void addSmooth(const SmoothCells& smooth, uint32_t width, uint32_t first_row,
               std::span<const DecodedTexel> plain, std::span<const DecodedTexel> read, ErrorSum& sum)
{
    for (size_t row = 0; row * width < plain.size(); ++row)
        for (uint32_t x = 0; x < width;)
        {
            // runs of cells are added at once, since a call for each costs more than the sums
            const bool is_smooth = smooth.contains(x, first_row + row);
            uint32_t end = x + kCellSide;
            while (end < width && smooth.contains(end, first_row + row) == is_smooth)
                end += kCellSide;
            const size_t at = row * width + x, count = std::min(end, width) - x;
            if (is_smooth)
                sum.add(plain.subspan(at, count), read.subspan(at, count));
            x = end;
        }
}

StripeError measureStripe(const PlainImage& image, std::span<const SmoothCells> smooth,
                          const Candidate& candidate, const Stripe& stripe,
                          std::span<const std::byte> encoded)
{
    StripeError error = makeStripeError(image);
    const uint32_t width = mipExtent(image.record, stripe.mip).width;
    const std::vector<DecodedTexel> plain = decodeRows(image, stripe.mip, stripe.first_row, stripe.rows);
    std::vector<DecodedTexel> read =
        decodeMip(*candidate.traits, width, stripe.rows, encoded.subspan(stripe.first_byte, stripe.bytes));
    readStored(candidate, read);
    error.sum.add(plain, read);
    if (!smooth.empty())
        addSmooth(smooth[stripe.mip], width, stripe.first_row, plain, read, error.smooth);
    if (stripe.mip == 0)
        error.histogram.add(plain, read);
    if ((image.record.flags & kImageAlphaTested) != 0)
    {
        const auto passes = [&](const DecodedTexel& texel)
        { return static_cast<float>(texel[3]) / 65535.0f >= image.record.alpha_cutoff; };
        error.passing_before = static_cast<uint64_t>(std::ranges::count_if(plain, passes));
        error.passing_after = static_cast<uint64_t>(std::ranges::count_if(read, passes));
    }
    return error;
}

/// Return 1 as a channel of a decoded texel.
uint16_t findOne(const Candidate& candidate)
{
    return candidate.traits->coding == TexelCoding::float_value ? kHalfOne : uint16_t{0xFFFF};
}

} // namespace

void readStored(const Candidate& candidate, std::span<DecodedTexel> texels)
{
    uint8_t swizzle[4];
    for (uint32_t c = 0; c < 4; ++c)
        swizzle[c] = static_cast<uint8_t>(candidate.swizzle[c]);
    applySwizzle(texels, swizzle, findOne(candidate));
}

StoredTexels arrangeChannels(const PlainImage& image, const Candidate& candidate, uint32_t width,
                             uint32_t height, std::span<const DecodedTexel> texels)
{
    HEARTH_ASSERT(texels.size() == size_t{width} * height);
    StoredTexels stored{.width = width, .height = height, .role = image.role};
    stored.is_narrow = texelBytes(image.record.format) == 4;
    stored.texels.reserve(texels.size());
    const uint16_t one = findOne(candidate);
    for (const DecodedTexel& texel : texels)
    {
        DecodedTexel& next = stored.texels.emplace_back();
        for (uint32_t c = 0; c < 4; ++c)
            next[c] = candidate.stored[c] == kStoredOne ? one : texel[candidate.stored[c]];
    }
    return stored;
}

std::vector<std::byte> encodeTexels(const Candidate& candidate, const StoredTexels& texels, Effort effort)
{
    switch (candidate.traits->family)
    {
    case TexelFamily::astc:
    case TexelFamily::astc_hdr:
        return encodeAstc(candidate, texels, effort);
    case TexelFamily::plain:
    {
        std::vector<std::byte> bytes(texels.texels.size() * candidate.traits->block_bytes);
        encodePlain(*candidate.traits, texels.texels, bytes);
        return bytes;
    }
    case TexelFamily::etc2:
    case TexelFamily::bc:
        break;
    }
    return encodeBlocks(candidate, texels, effort);
}

std::vector<std::byte> encodeImage(const PlainImage& image, std::span<const SmoothCells> smooth,
                                   const Candidate& candidate, Effort effort,
                                   std::span<const EncodedBlock> known)
{
    return encodeStripes(image, smooth, candidate, effort, known,
                         listStripes(image, *candidate.traits, 0, image.record.mip_count), 1);
}

std::vector<std::byte> encodeMip(const PlainImage& image, std::span<const SmoothCells> smooth,
                                 const Candidate& candidate, Effort effort, uint32_t mip, float alpha_scale)
{
    return encodeStripes(image, smooth, candidate, effort, {},
                         listStripes(image, *candidate.traits, mip, mip + 1), alpha_scale);
}

ImageError measureError(const PlainImage& image, std::span<const SmoothCells> smooth,
                        const Candidate& candidate, std::span<const std::byte> encoded)
{
    const uint32_t mips = countMeasuredMips(image.record);
    const std::vector<Stripe> stripes = listStripes(image, *candidate.traits, 0, mips);
    std::vector<StripeError> errors(stripes.size(), makeStripeError(image));
    tbb::parallel_for(size_t{0}, stripes.size(),
                      [&](size_t i)
                      { errors[i] = measureStripe(image, smooth, candidate, stripes[i], encoded); });

    std::vector<ErrorSum> sums(mips, ErrorSum(image.role, image.channels)), smooth_sums = sums;
    ErrorHistogram histogram(image.role, image.channels);
    std::vector<StripeError> mip_errors(mips, makeStripeError(image));
    for (size_t i = 0; i < stripes.size(); ++i)
    {
        StripeError& mip = mip_errors[stripes[i].mip];
        sums[stripes[i].mip].add(errors[i].sum);
        smooth_sums[stripes[i].mip].add(errors[i].smooth);
        mip.passing_before += errors[i].passing_before;
        mip.passing_after += errors[i].passing_after;
        histogram.add(errors[i].histogram);
    }
    ImageError result{.error = combineMips(image.role, image.channels, sums),
                      .smooth = combineMips(image.role, image.channels, smooth_sums),
                      .error_p999 = histogram.findPercentile()};
    for (uint32_t mip = 0; mip < mips; ++mip)
    {
        const double before = static_cast<double>(mip_errors[mip].passing_before);
        const double after = static_cast<double>(mip_errors[mip].passing_after);
        result.coverage =
            std::max(result.coverage, std::abs(after - before) / static_cast<double>(sums[mip].count()));
    }
    return result;
}

} // namespace hearth::texels
