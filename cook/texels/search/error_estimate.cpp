// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/error_estimate.h"

#include "cook/texels/search/block_sample.h"
#include "formats/texels/decode_texels.h"
#include "formats/texels/plain_decoder.h"

#include <algorithm>

namespace hearth::texels
{

using namespace formats;

namespace
{

// One of so many blocks of a mip is encoded, within bounds. Chosen blocks take up to four times as long as
// the mean.
constexpr size_t kSampledPart = 32;

/// Bounds of the number of sampled blocks of a mip.
struct SampleBounds
{
    size_t low;
    size_t high;
};

/// Bounds for mip 0 and for the coarser ones.
struct MipBounds
{
    SampleBounds finest;
    SampleBounds coarser;
};
constexpr MipBounds kFirstBounds{{32, 64}, {12, 16}}, kRefinedBounds{{64, 160}, {16, 40}};

// Blocks in a row of the image that sampled blocks are put into.
constexpr size_t kMosaicColumns = 32;

/// Sampled block of a mip.
struct MipBlock
{
    uint32_t mip;
    uint64_t left, top; ///< first texel
    double weight;
};

/// Mosaic of sampled blocks side by side. Texels beyond the edge of the mip repeat the edge.
struct Mosaic
{
    uint32_t width = 0, height = 0;
    std::vector<DecodedTexel> texels{};
};

/// Return where a block lies in the mosaic: its first texel, in rows of the mosaic.
size_t findPlace(const Mosaic& mosaic, const TexelFormatTraits& traits, size_t index)
{
    const size_t across = mosaic.width / traits.block_width;
    return index / across * traits.block_height * mosaic.width + index % across * traits.block_width;
}

Mosaic makeMosaic(const PlainImage& image, const TexelFormatTraits& traits, std::span<const MipBlock> blocks)
{
    const TexelFormatTraits& plain = *findTexelFormat(image.record.format);
    const uint32_t bw = traits.block_width, bh = traits.block_height;
    const size_t across = std::min(blocks.size(), kMosaicColumns);
    const size_t rows = (blocks.size() + across - 1) / across;
    Mosaic mosaic{.width = static_cast<uint32_t>(across) * bw, .height = static_cast<uint32_t>(rows) * bh};
    mosaic.texels.resize(size_t{mosaic.width} * mosaic.height);
    for (size_t i = 0; i < rows * across; ++i)
    {
        // the end of the last row is filled up
        const MipBlock& block = blocks[std::min(i, blocks.size() - 1)];
        const std::span<const std::byte> texels = mipBytes(image, block.mip);
        const MipExtent extent = mipExtent(image.record, block.mip);
        const size_t place = findPlace(mosaic, traits, i);
        for (uint32_t y = 0; y < bh; ++y)
            for (uint32_t x = 0; x < bw; ++x)
            {
                const uint64_t column = std::min<uint64_t>(block.left + x, extent.width - 1);
                const uint64_t row = std::min<uint64_t>(block.top + y, extent.height - 1);
                mosaic.texels[place + size_t{y} * mosaic.width + x] = decodePlainTexel(
                    plain.format,
                    texels.subspan((row * extent.width + column) * plain.block_bytes, plain.block_bytes));
            }
    }
    return mosaic;
}

/// Return, for each block of a mosaic, whether its errors are seen.
std::vector<uint8_t> findSeenBlocks(std::span<const SmoothCells> smooth, const TexelFormatTraits& traits,
                                    std::span<const MipBlock> blocks, const Mosaic& mosaic)
{
    // what fills up the last row counts for nothing
    std::vector<uint8_t> is_seen(size_t{mosaic.width / traits.block_width} *
                                 (mosaic.height / traits.block_height));
    for (size_t i = 0; i < blocks.size(); ++i)
        is_seen[i] = showsErrors(smooth, blocks[i].mip, blocks[i].left, blocks[i].top, traits);
    return is_seen;
}

void addWeighted(const ErrorSum& block, double weight, std::array<double, 4>& sums)
{
    if (block.count() == 0)
        return;
    const std::array<double, 4> means = block.meanSquares();
    for (uint32_t c = 0; c < 4; ++c)
        sums[c] += means[c] * (weight * static_cast<double>(block.count()));
}

/// Encode sampled blocks and measure them; on the caller's thread, which has contexts of the encoder then.
/// They take as long to make as a sample to encode.
/// sums  [mip]
void measureBlocks(const PlainImage& image, std::span<const SmoothCells> smooth, const Candidate& candidate,
                   std::span<const MipBlock> blocks, Effort effort, std::span<SquareSums> sums)
{
    const TexelFormatTraits& traits = *candidate.traits;
    const Mosaic mosaic = makeMosaic(image, traits, blocks);
    StoredTexels arranged = arrangeChannels(image, candidate, mosaic.width, mosaic.height, mosaic.texels);
    if (!smooth.empty())
        arranged.is_seen = findSeenBlocks(smooth, traits, blocks, mosaic);
    std::vector<DecodedTexel> read =
        decodeMip(traits, mosaic.width, mosaic.height, encodeTexels(candidate, arranged, effort));
    readStored(candidate, read);
    for (size_t i = 0; i < blocks.size(); ++i)
    {
        const MipBlock& block = blocks[i];
        const MipExtent extent = mipExtent(image.record, block.mip);
        const size_t place = findPlace(mosaic, traits, i);
        ErrorSum all(image.role, image.channels), smooth_sum = all;
        for (uint64_t y = 0; y < std::min<uint64_t>(traits.block_height, extent.height - block.top); ++y)
            for (uint64_t x = 0; x < std::min<uint64_t>(traits.block_width, extent.width - block.left); ++x)
            {
                const size_t at = place + y * mosaic.width + x;
                all.add({&mosaic.texels[at], 1}, {&read[at], 1});
                if (!smooth.empty() && smooth[block.mip].contains(block.left + x, block.top + y))
                    smooth_sum.add({&mosaic.texels[at], 1}, {&read[at], 1});
            }
        addWeighted(all, block.weight, sums[block.mip].all);
        addWeighted(smooth_sum, block.weight, sums[block.mip].smooth);
    }
}

/// Return, for each mip, the number of blocks that a sample within bounds has.
std::vector<size_t> countWanted(const PlainImage& image, const ImageDetail& detail,
                                const TexelFormatTraits& traits, const MipBounds& mips)
{
    std::vector<size_t> wanted;
    for (uint32_t mip = 0; mip < detail.mips.size(); ++mip)
    {
        const MipExtent extent = mipExtent(image.record, mip);
        const SampleBounds& bounds = mip == 0 ? mips.finest : mips.coarser;
        const auto blocks =
            static_cast<size_t>(formats::mipBytes(traits, extent.width, extent.height) / traits.block_bytes);
        wanted.push_back(std::clamp(blocks / kSampledPart, bounds.low, bounds.high));
    }
    return wanted;
}

} // namespace

ErrorEstimate::ErrorEstimate(const PlainImage& image, const ImageDetail& detail, const Candidate& candidate,
                             Effort effort)
    : image_(&image),
      detail_(&detail),
      candidate_(candidate),
      effort_(effort),
      sampled_(detail.mips.size()),
      sums_(detail.mips.size())
{
    addSample(countWanted(image, detail, *candidate.traits, kFirstBounds));
}

void ErrorEstimate::refine()
{
    addSample(countWanted(*image_, *detail_, *candidate_.traits, kRefinedBounds));
}

/// Encode more blocks. The new estimate is the mean of the two, each as often as it has blocks.
/// wanted  [mip]
void ErrorEstimate::addSample(std::span<const size_t> wanted)
{
    const TexelFormatTraits& traits = *candidate_.traits;
    std::vector<MipBlock> chosen;
    for (uint32_t mip = 0; mip < wanted.size(); ++mip)
    {
        const size_t all = sampled_[mip] + wanted[mip];
        const double old_share = static_cast<double>(sampled_[mip]) / static_cast<double>(all);
        for (uint32_t c = 0; c < 4; ++c)
        {
            sums_[mip].all[c] *= old_share;
            sums_[mip].smooth[c] *= old_share;
        }
        const std::vector<float> expected =
            detail_->mips[mip].expectErrors(traits.block_width, traits.block_height,
                                            detail_->smooth.empty() ? nullptr : &detail_->smooth[mip]);
        const uint64_t columns =
            (mipExtent(image_->record, mip).width + traits.block_width - 1u) / traits.block_width;
        for (const SampledBlock& block : sampleBlocks(expected, wanted[mip], sampled_[mip]))
            chosen.push_back({mip, block.block % columns * traits.block_width,
                              block.block / columns * traits.block_height, block.weight * (1 - old_share)});
        sampled_[mip] = all;
    }
    measureBlocks(*image_, detail_->smooth, candidate_, chosen, effort_, sums_);
}

ImageError ErrorEstimate::error() const
{
    std::vector<std::array<double, 4>> all, smooth;
    for (uint32_t mip = 0; mip < sums_.size(); ++mip)
    {
        const MipExtent extent = mipExtent(image_->record, mip);
        const double texels = static_cast<double>(uint64_t{extent.width} * extent.height);
        const auto smooth_texels =
            detail_->smooth.empty() ? 0.0 : static_cast<double>(detail_->smooth[mip].countSmoothTexels());
        std::array<double, 4> all_mean{}, smooth_mean{};
        for (uint32_t c = 0; c < 4; ++c)
        {
            all_mean[c] = sums_[mip].all[c] / texels;
            smooth_mean[c] = sums_[mip].smooth[c] / std::max(smooth_texels, 1.0);
        }
        all.push_back(all_mean);
        if (smooth_texels > 0)
            smooth.push_back(smooth_mean);
    }
    return {.error = combineMips(image_->role, image_->channels, all),
            .smooth = combineMips(image_->role, image_->channels, smooth)};
}

} // namespace hearth::texels
