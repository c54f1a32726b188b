// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/error_estimate.h"

#include "cook/texels/block_sample.h"
#include "formats/texels/decode_texels.h"
#include "formats/texels/plain_decoder.h"

#include <tbb/parallel_for.h>

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
constexpr MipBounds kUsualBounds{{64, 128}, {24, 32}}, kLargeBounds{{96, 320}, {32, 80}};

// Blocks in a row of the image that sampled blocks are put into, and rows that a thread encodes at a time.
constexpr size_t kMosaicColumns = 32;
constexpr size_t kMosaicRows = 4;

/// Sampled blocks of a mip that a thread encodes at a time.
struct Piece
{
    uint32_t mip;
    std::vector<SampledBlock> blocks;
};

/// Mosaic of sampled blocks side by side. Texels beyond the edge of the mip repeat the edge.
struct Mosaic
{
    uint32_t width = 0, height = 0;
    std::vector<DecodedTexel> texels{};
};

/// Return where a block of a piece lies in the piece's mosaic: its first texel, in rows of the mosaic.
size_t findPlace(const Mosaic& mosaic, const TexelFormatTraits& traits, size_t index)
{
    const size_t across = mosaic.width / traits.block_width;
    return index / across * traits.block_height * mosaic.width + index % across * traits.block_width;
}

Mosaic makeMosaic(const PlainImage& image, const TexelFormatTraits& traits, const Piece& piece)
{
    const TexelFormatTraits& plain = *findTexelFormat(image.record.format);
    const std::span<const std::byte> texels = mipBytes(image, piece.mip);
    const MipExtent extent = mipExtent(image.record, piece.mip);
    const uint32_t bw = traits.block_width, bh = traits.block_height;
    const uint64_t columns = (extent.width + bw - 1) / bw;
    const size_t across = std::min(piece.blocks.size(), kMosaicColumns);
    const size_t rows = (piece.blocks.size() + across - 1) / across;
    Mosaic mosaic{.width = static_cast<uint32_t>(across) * bw, .height = static_cast<uint32_t>(rows) * bh};
    mosaic.texels.resize(size_t{mosaic.width} * mosaic.height);
    for (size_t i = 0; i < rows * across; ++i)
    {
        // the end of the last row is filled up
        const uint64_t block = piece.blocks[std::min(i, piece.blocks.size() - 1)].block;
        const size_t place = findPlace(mosaic, traits, i);
        for (uint32_t y = 0; y < bh; ++y)
            for (uint32_t x = 0; x < bw; ++x)
            {
                const uint64_t column = std::min<uint64_t>(block % columns * bw + x, extent.width - 1);
                const uint64_t row = std::min<uint64_t>(block / columns * bh + y, extent.height - 1);
                mosaic.texels[place + size_t{y} * mosaic.width + x] = decodePlainTexel(
                    plain.format,
                    texels.subspan((row * extent.width + column) * plain.block_bytes, plain.block_bytes));
            }
    }
    return mosaic;
}

size_t countBlocks(const Mosaic& mosaic, const TexelFormatTraits& traits)
{
    return size_t{mosaic.width / traits.block_width} * (mosaic.height / traits.block_height);
}

/// Return, for each block of a piece's mosaic, whether it has smooth cells in the mip.
/// columns  blocks in a row of the mip
std::vector<uint8_t> findSmoothBlocks(std::span<const SmoothCells> smooth, const TexelFormatTraits& traits,
                                      const Piece& piece, uint64_t columns, size_t count)
{
    std::vector<uint8_t> is_smooth(count); // what fills up the last row counts for nothing
    for (size_t i = 0; i < piece.blocks.size(); ++i)
        is_smooth[i] = hasSmoothCells(smooth, piece.mip, piece.blocks[i].block % columns * traits.block_width,
                                      piece.blocks[i].block / columns * traits.block_height, traits);
    return is_smooth;
}

/// Sums of squares of each channel, of all blocks that the sampled ones stand for.
struct SquareSums
{
    std::array<double, 4> all{};
    std::array<double, 4> smooth{};
};

void addWeighted(const ErrorSum& block, double weight, std::array<double, 4>& sums)
{
    if (block.count() == 0)
        return;
    const std::array<double, 4> means = block.meanSquares();
    for (uint32_t c = 0; c < 4; ++c)
        sums[c] += means[c] * (weight * static_cast<double>(block.count()));
}

SquareSums measurePiece(const PlainImage& image, std::span<const SmoothCells> smooth,
                        const Candidate& candidate, const Piece& piece, Effort effort)
{
    const TexelFormatTraits& traits = *candidate.traits;
    const Mosaic mosaic = makeMosaic(image, traits, piece);
    const MipExtent extent = mipExtent(image.record, piece.mip);
    const uint64_t columns = (extent.width + traits.block_width - 1u) / traits.block_width;
    StoredTexels arranged = arrangeChannels(image, candidate, mosaic.width, mosaic.height, mosaic.texels);
    if (!smooth.empty())
        arranged.is_smooth = findSmoothBlocks(smooth, traits, piece, columns, countBlocks(mosaic, traits));
    const std::vector<std::byte> blocks = encodeTexels(candidate, arranged, effort);
    const std::vector<DecodedTexel> stored = decodeMip(traits, mosaic.width, mosaic.height, blocks);
    SquareSums sums;
    for (size_t i = 0; i < piece.blocks.size(); ++i)
    {
        const uint64_t left = piece.blocks[i].block % columns * traits.block_width;
        const uint64_t top = piece.blocks[i].block / columns * traits.block_height;
        const size_t place = findPlace(mosaic, traits, i);
        ErrorSum all(image.role, image.channels), smooth_sum = all;
        for (uint64_t y = 0; y < std::min<uint64_t>(traits.block_height, extent.height - top); ++y)
            for (uint64_t x = 0; x < std::min<uint64_t>(traits.block_width, extent.width - left); ++x)
            {
                const size_t at = place + y * mosaic.width + x;
                const DecodedTexel read = readStored(candidate, stored[at]);
                all.add({&mosaic.texels[at], 1}, {&read, 1});
                if (!smooth.empty() && smooth[piece.mip].contains(left + x, top + y))
                    smooth_sum.add({&mosaic.texels[at], 1}, {&read, 1});
            }
        addWeighted(all, piece.blocks[i].weight, sums.all);
        addWeighted(smooth_sum, piece.blocks[i].weight, sums.smooth);
    }
    return sums;
}

/// Return the number of blocks of a mip that are to be encoded.
size_t countWanted(size_t blocks, uint32_t mip, SampleSize size)
{
    const MipBounds& mips = size == SampleSize::usual ? kUsualBounds : kLargeBounds;
    const SampleBounds& bounds = mip == 0 ? mips.finest : mips.coarser;
    return std::clamp(blocks / kSampledPart, bounds.low, bounds.high);
}

std::vector<Piece> listPieces(const ImageDetail& detail, const TexelFormatTraits& traits, SampleSize size)
{
    constexpr size_t kPiece = kMosaicColumns * kMosaicRows;
    std::vector<Piece> pieces;
    for (uint32_t mip = 0; mip < detail.mips.size(); ++mip)
    {
        const std::vector<float> expected = detail.mips[mip].expectErrors(
            traits.block_width, traits.block_height, detail.smooth.empty() ? nullptr : &detail.smooth[mip]);
        const std::vector<SampledBlock> blocks =
            sampleBlocks(expected, countWanted(expected.size(), mip, size));
        for (size_t at = 0; at < blocks.size(); at += kPiece)
            pieces.push_back(
                {mip,
                 {blocks.begin() + static_cast<ptrdiff_t>(at),
                  blocks.begin() + static_cast<ptrdiff_t>(std::min(at + kPiece, blocks.size()))}});
    }
    return pieces;
}

} // namespace

ImageError estimateError(const PlainImage& image, const ImageDetail& detail, const Candidate& candidate,
                         Effort effort, SampleSize size)
{
    const std::vector<Piece> pieces = listPieces(detail, *candidate.traits, size);
    std::vector<SquareSums> sums(pieces.size());
    tbb::parallel_for(size_t{0}, pieces.size(),
                      [&](size_t i)
                      { sums[i] = measurePiece(image, detail.smooth, candidate, pieces[i], effort); });

    std::vector<std::array<double, 4>> all, smooth;
    for (uint32_t mip = 0; mip < detail.mips.size(); ++mip)
    {
        const MipExtent extent = mipExtent(image.record, mip);
        const double texels = static_cast<double>(uint64_t{extent.width} * extent.height);
        const auto smooth_texels =
            detail.smooth.empty() ? 0.0 : static_cast<double>(detail.smooth[mip].countSmoothTexels());
        std::array<double, 4> all_mean{}, smooth_mean{};
        for (size_t i = 0; i < pieces.size(); ++i)
            for (uint32_t c = 0; c < 4 && pieces[i].mip == mip; ++c)
            {
                all_mean[c] += sums[i].all[c] / texels;
                smooth_mean[c] += sums[i].smooth[c] / std::max(smooth_texels, 1.0);
            }
        all.push_back(all_mean);
        if (smooth_texels > 0)
            smooth.push_back(smooth_mean);
    }
    return {.error = combineMips(image.role, image.channels, all),
            .smooth = combineMips(image.role, image.channels, smooth)};
}

} // namespace hearth::texels
