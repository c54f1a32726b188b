// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/error_estimate.h"

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

/// Part of a mip that a block covers.
struct BlockArea
{
    uint32_t mip;
    uint64_t left, top;             ///< first texel
    uint64_t columns = 0, rows = 0; ///< of texels within the mip
};

BlockArea findArea(const PlainImage& image, const TexelFormatTraits& traits, uint32_t mip, uint64_t block)
{
    const MipExtent extent = mipExtent(image.record, mip);
    const uint64_t across = (extent.width + traits.block_width - 1u) / traits.block_width;
    BlockArea area{
        .mip = mip, .left = block % across * traits.block_width, .top = block / across * traits.block_height};
    area.columns = std::min<uint64_t>(traits.block_width, extent.width - area.left);
    area.rows = std::min<uint64_t>(traits.block_height, extent.height - area.top);
    return area;
}

/// Append the texels of a block. Beyond the edge of the mip they repeat the edge.
void appendTexels(const PlainImage& image, const TexelFormatTraits& traits, const BlockArea& area,
                  std::vector<DecodedTexel>& texels)
{
    const TexelFormatTraits& plain = *findTexelFormat(image.record.format);
    const std::span<const std::byte> bytes = mipBytes(image, area.mip);
    const uint64_t width = mipExtent(image.record, area.mip).width;
    for (uint64_t y = 0; y < traits.block_height; ++y)
        for (uint64_t x = 0; x < traits.block_width; ++x)
        {
            const uint64_t column = area.left + std::min(x, area.columns - 1);
            const uint64_t row = area.top + std::min(y, area.rows - 1);
            texels.push_back(decodePlainTexel(
                plain.format, bytes.subspan((row * width + column) * plain.block_bytes, plain.block_bytes)));
        }
}

/// Add the sum of squares of texels.
void addSquares(const ErrorSum& texels, std::array<double, 4>& sums)
{
    if (texels.count() == 0)
        return;
    const std::array<double, 4> means = texels.meanSquares();
    for (uint32_t c = 0; c < 4; ++c)
        sums[c] += means[c] * static_cast<double>(texels.count());
}

/// Return the sums of squares of a block's texels.
/// plain, read  of the whole block, in rows from the top
SquareSums sumSquares(const PlainImage& image, std::span<const SmoothCells> smooth,
                      const TexelFormatTraits& traits, const BlockArea& area,
                      std::span<const DecodedTexel> plain, std::span<const DecodedTexel> read)
{
    ErrorSum all(image.role, image.channels), smooth_sum = all;
    for (uint64_t y = 0; y < area.rows; ++y)
        for (uint64_t x = 0; x < area.columns; ++x)
        {
            const size_t at = y * traits.block_width + x;
            all.add(plain.subspan(at, 1), read.subspan(at, 1));
            if (!smooth.empty() && smooth[area.mip].contains(area.left + x, area.top + y))
                smooth_sum.add(plain.subspan(at, 1), read.subspan(at, 1));
        }
    SquareSums sums;
    addSquares(all, sums.all);
    addSquares(smooth_sum, sums.smooth);
    return sums;
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
    const TexelFormatTraits& traits = *candidate.traits;
    for (uint32_t mip = 0; mip < detail.mips.size(); ++mip)
        samplers_.emplace_back(detail.mips[mip].expectErrors(
            traits.block_width, traits.block_height, detail.smooth.empty() ? nullptr : &detail.smooth[mip]));
    addSample(countWanted(image, detail, traits, kFirstBounds));
}

void ErrorEstimate::refine()
{
    addSample(countWanted(*image_, *detail_, *candidate_.traits, kRefinedBounds));
}

/// Encode blocks, one below the other, and measure them; on the caller's thread, which has contexts of the
/// encoder then. They take as long to make as a sample to encode.
void ErrorEstimate::measureBlocks(std::span<const BlockKey> blocks)
{
    if (blocks.empty())
        return;
    const TexelFormatTraits& traits = *candidate_.traits;
    std::vector<BlockArea> areas;
    std::vector<DecodedTexel> plain;
    std::vector<BlockSearch> search;
    for (const auto& [mip, block] : blocks)
    {
        const BlockArea& area = areas.emplace_back(findArea(*image_, traits, mip, block));
        appendTexels(*image_, traits, area, plain);
        search.push_back(showsErrors(detail_->smooth, mip, area.left, area.top, traits) ? BlockSearch::longer
                                                                                        : BlockSearch::usual);
    }
    const uint32_t height = traits.block_height * static_cast<uint32_t>(blocks.size());
    StoredTexels stored = arrangeChannels(*image_, candidate_, traits.block_width, height, plain);
    stored.search = std::move(search);
    const std::vector<std::byte> encoded = encodeTexels(candidate_, stored, effort_);
    std::vector<DecodedTexel> read = decodeMip(traits, traits.block_width, height, encoded);
    readStored(candidate_, read);
    const size_t texels = plain.size() / blocks.size();
    for (size_t i = 0; i < blocks.size(); ++i)
    {
        MeasuredBlock& measured = measured_[blocks[i]];
        std::copy_n(encoded.begin() + static_cast<ptrdiff_t>(i * traits.block_bytes), traits.block_bytes,
                    measured.bytes.begin());
        measured.sums = sumSquares(*image_, detail_->smooth, traits, areas[i],
                                   std::span(plain).subspan(i * texels, texels),
                                   std::span(read).subspan(i * texels, texels));
    }
}

/// Encode more blocks. The new estimate is the mean of the two, each as often as it has blocks.
/// wanted  [mip]
void ErrorEstimate::addSample(std::span<const size_t> wanted)
{
    std::vector<std::vector<SampledBlock>> samples;
    std::vector<BlockKey> missing;
    for (uint32_t mip = 0; mip < wanted.size(); ++mip)
    {
        samples.push_back(samplers_[mip].sample(wanted[mip], sampled_[mip]));
        for (const SampledBlock& sampled : samples.back())
            if (!measured_.contains({mip, sampled.block}))
                missing.emplace_back(mip, sampled.block);
    }
    measureBlocks(missing);
    for (uint32_t mip = 0; mip < wanted.size(); ++mip)
    {
        const size_t all = sampled_[mip] + wanted[mip];
        const double old_share = static_cast<double>(sampled_[mip]) / static_cast<double>(all);
        for (uint32_t c = 0; c < 4; ++c)
        {
            sums_[mip].all[c] *= old_share;
            sums_[mip].smooth[c] *= old_share;
            for (const SampledBlock& sampled : samples[mip])
            {
                const SquareSums& block = measured_.at({mip, sampled.block}).sums;
                sums_[mip].all[c] += block.all[c] * (sampled.weight * (1 - old_share));
                sums_[mip].smooth[c] += block.smooth[c] * (sampled.weight * (1 - old_share));
            }
        }
        sampled_[mip] = all;
    }
}

std::vector<EncodedBlock> ErrorEstimate::listBlocks() const
{
    std::vector<EncodedBlock> blocks;
    for (const auto& [key, measured] : measured_)
        blocks.push_back({key.first, key.second, measured.bytes});
    return blocks;
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
