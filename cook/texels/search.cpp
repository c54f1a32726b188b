// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search.h"

#include "cook/texels/match_coverage.h"
#include "formats/base/assert.h"
#include "formats/texels/decode_texels.h"
#include "formats/texels/plain_decoder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace hearth::texels
{

using namespace formats;

namespace
{

// A 32nd of the blocks of a mip is encoded for an estimate, within bounds, so that five estimates take less
// than a fifth of an encoding.
constexpr uint64_t kSampledPart = 32;

/// Bounds of the number of sampled blocks of a mip.
struct SampleBounds
{
    uint64_t low;
    uint64_t high;
};
constexpr SampleBounds kFinestBounds{256, 1024}, kCoarserBounds{64, 256};

// Blocks in a row of the image that sampled blocks are put into, and rows that a thread encodes at a time.
constexpr uint32_t kMosaicColumns = 32;
constexpr uint32_t kMosaicRows = 4;

// An estimate that is better than the target by .3 dB holds it nearly always; a miss costs an encoding.
constexpr double kEstimateMargin = 0.966;

// Candidates with the most bytes, one of which an image gets that misses its target in all.
constexpr size_t kLastResorts = 3;

/// Blocks of a mip that are encoded for an estimate, by their numbers, ascending.
std::vector<uint64_t> sampleBlocks(uint64_t columns, uint64_t rows, const SampleBounds& bounds)
{
    std::vector<uint64_t> blocks;
    const uint64_t total = columns * rows;
    const uint64_t wanted = std::clamp(total / kSampledPart, bounds.low, bounds.high);
    if (total <= wanted)
    {
        for (uint64_t block = 0; block < total; ++block)
            blocks.push_back(block);
        return blocks;
    }
    // one in each cell of a grid over the mip, at a place that wanders through the cell: a regular step would
    // meet the same place of a pattern again and again
    const double cell = std::sqrt(static_cast<double>(total) / static_cast<double>(wanted));
    const auto across = std::max<uint64_t>(static_cast<uint64_t>(static_cast<double>(columns) / cell), 1);
    const auto down = std::max<uint64_t>(wanted / across, 1);
    for (uint64_t j = 0; j < down; ++j)
        for (uint64_t i = 0; i < across; ++i)
        {
            constexpr double kPlastic = 0.7548776662466927, kPlasticSquared = 0.5698402909980532;
            const auto n = static_cast<double>(j * across + i + 1);
            const double u = n * kPlastic - std::floor(n * kPlastic);
            const double v = n * kPlasticSquared - std::floor(n * kPlasticSquared);
            const auto x = static_cast<uint64_t>((static_cast<double>(i) + u) * static_cast<double>(columns) /
                                                 static_cast<double>(across));
            const auto y = static_cast<uint64_t>((static_cast<double>(j) + v) * static_cast<double>(rows) /
                                                 static_cast<double>(down));
            blocks.push_back(std::min(y, rows - 1) * columns + std::min(x, columns - 1));
        }
    return blocks;
}

/// Part of a mosaic, a few rows of sampled blocks side by side. Texels beyond the edge of the mip repeat the
/// edge, and do not count in the error.
struct Mosaic
{
    uint32_t width = 0, height = 0;
    std::vector<DecodedTexel> texels{};
    std::vector<uint8_t> counts{};    ///< 1: the texel is inside the mip
    std::vector<uint8_t> is_smooth{}; ///< 1: it lies in a smooth cell
};

Mosaic makeMosaic(const PlainImage& image, std::span<const SmoothCells> smooth, uint32_t mip,
                  const TexelFormatTraits& traits, std::span<const uint64_t> blocks)
{
    const TexelFormatTraits& plain = *findTexelFormat(image.record.format);
    const std::span<const std::byte> texels = mipBytes(image, mip);
    const MipExtent extent = mipExtent(image.record, mip);
    const uint32_t bw = traits.block_width, bh = traits.block_height;
    const uint64_t columns = (extent.width + bw - 1) / bw;
    const auto rows = static_cast<uint32_t>((blocks.size() + kMosaicColumns - 1) / kMosaicColumns);
    const auto across = static_cast<uint32_t>(std::min<size_t>(blocks.size(), kMosaicColumns));
    Mosaic mosaic{.width = across * bw, .height = rows * bh};
    mosaic.texels.resize(size_t{mosaic.width} * mosaic.height);
    mosaic.counts.resize(mosaic.texels.size());
    mosaic.is_smooth.resize(mosaic.texels.size());
    for (size_t i = 0; i < size_t{rows} * across; ++i)
    {
        const uint64_t block = blocks[std::min(i, blocks.size() - 1)];
        for (uint32_t y = 0; y < bh; ++y)
            for (uint32_t x = 0; x < bw; ++x)
            {
                const uint64_t column = block % columns * bw + x, row = block / columns * bh + y;
                const uint64_t from = std::min<uint64_t>(row, extent.height - 1) * extent.width +
                                      std::min<uint64_t>(column, extent.width - 1);
                const size_t to = (i / across * bh + y) * mosaic.width + i % across * bw + x;
                mosaic.texels[to] = decodePlainTexel(
                    plain.format, texels.subspan(from * plain.block_bytes, plain.block_bytes));
                mosaic.counts[to] = i < blocks.size() && column < extent.width && row < extent.height;
                mosaic.is_smooth[to] =
                    mosaic.counts[to] != 0 && !smooth.empty() && smooth[mip].contains(column, row);
            }
    }
    return mosaic;
}

/// Errors of texels, of all and of the smooth ones.
struct ErrorSums
{
    ErrorSum all;
    ErrorSum smooth;
};

ErrorSums measureMosaic(const PlainImage& image, const Candidate& candidate, const Mosaic& mosaic,
                        Effort effort)
{
    const std::vector<std::byte> blocks = encodeTexels(
        candidate, arrangeChannels(image, candidate, mosaic.width, mosaic.height, mosaic.texels), effort);
    const std::vector<DecodedTexel> stored =
        decodeMip(*candidate.traits, mosaic.width, mosaic.height, blocks);
    ErrorSums sums{ErrorSum(image.role, image.channels), ErrorSum(image.role, image.channels)};
    for (size_t i = 0; i < stored.size(); ++i)
        if (mosaic.counts[i] != 0)
        {
            const DecodedTexel read = readStored(candidate, stored[i]);
            sums.all.add({&mosaic.texels[i], 1}, {&read, 1});
            if (mosaic.is_smooth[i] != 0)
                sums.smooth.add({&mosaic.texels[i], 1}, {&read, 1});
        }
    return sums;
}

/// Sampled blocks of a mip that a thread encodes at a time.
struct Piece
{
    uint32_t mip;
    std::vector<uint64_t> blocks;
};

std::vector<Piece> listPieces(const PlainImage& image, const TexelFormatTraits& traits)
{
    constexpr size_t kPiece = size_t{kMosaicColumns} * kMosaicRows;
    std::vector<Piece> pieces;
    for (uint32_t mip = 0; mip < countMeasuredMips(image.record); ++mip)
    {
        const MipExtent extent = mipExtent(image.record, mip);
        const std::vector<uint64_t> blocks =
            sampleBlocks((extent.width + traits.block_width - 1) / traits.block_width,
                         (extent.height + traits.block_height - 1) / traits.block_height,
                         mip == 0 ? kFinestBounds : kCoarserBounds);
        for (size_t at = 0; at < blocks.size(); at += kPiece)
            pieces.push_back(
                {mip,
                 {blocks.begin() + static_cast<ptrdiff_t>(at),
                  blocks.begin() + static_cast<ptrdiff_t>(std::min(at + kPiece, blocks.size()))}});
    }
    return pieces;
}

/// Return the larger part of its target that an error takes, of all texels or of the smooth ones.
double findShare(const ImageError& error, const Target& target)
{
    return std::max(error.error / target.error, error.smooth / target.smooth);
}

/// Estimates of the candidates so far, as shares of the target.
class Estimates
{
public:
    Estimates(const PlainImage& image, std::span<const SmoothCells> smooth,
              std::span<const Candidate> candidates, const Target& target, Effort effort)
        : image_(image),
          smooth_(smooth),
          candidates_(candidates),
          target_(target),
          effort_(effort),
          errors_(candidates.size())
    {
    }

    double get(size_t i)
    {
        if (!errors_[i])
            errors_[i] = estimateError(image_, smooth_, candidates_[i], effort_);
        return findShare(*errors_[i], target_);
    }

    /// Return the estimates that were asked for, in the order of the candidates.
    std::vector<CandidateError> list() const
    {
        std::vector<CandidateError> list;
        for (size_t i = 0; i < errors_.size(); ++i)
            if (errors_[i])
                list.push_back({candidates_[i], *errors_[i]});
        return list;
    }

private:
    const PlainImage& image_;
    std::span<const SmoothCells> smooth_;
    std::span<const Candidate> candidates_;
    Target target_;
    Effort effort_;
    std::vector<std::optional<ImageError>> errors_;
};

/// Return the cheapest candidate whose estimate holds the target; their number if none does. Errors mostly
/// fall with bytes, but not always: the next one below those that bisection has tried is tried, too.
size_t findCheapest(Estimates& estimates, size_t count)
{
    const auto holds = [&](size_t i) { return estimates.get(i) <= kEstimateMargin; };
    size_t low = 0, high = count;
    while (low < high)
    {
        const size_t middle = (low + high) / 2;
        if (holds(middle))
            high = middle;
        else
            low = middle + 1;
    }
    return low > 1 && holds(low - 2) ? low - 2 : low;
}

/// Encode, measure what is lost, and compare it with the target. The area of a cut-out is kept as far as the
/// target allows: scaled alphas are an error, too, and must not cost another format.
Encoding encodeMeasured(const PlainImage& image, std::span<const SmoothCells> smooth, Candidate candidate,
                        const Target& target, Effort effort)
{
    candidate.has_smooth_areas = !smooth.empty();
    Encoding encoding{.candidate = candidate, .texels = encodeImage(image, candidate, effort)};
    const auto measure = [&](Encoding& measured)
    {
        measured.error = measureError(image, smooth, candidate, measured.texels);
        measured.share = findShare(measured.error, target);
    };
    measure(encoding);
    Encoding matched = encoding;
    matchCoverage(image, candidate, effort, matched.texels);
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
    for (size_t i = findCheapest(estimates, compressed); i < compressed; ++i)
    {
        if (estimates.get(i) > 1)
            continue;
        Encoding encoding = encodeMeasured(image, smooth, candidates[i], target, effort);
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
    return encodeMeasured(image, smooth, candidates[best_estimate], target, effort);
}

} // namespace

ImageError estimateError(const PlainImage& image, std::span<const SmoothCells> smooth, Candidate candidate,
                         Effort effort)
{
    candidate.has_smooth_areas = !smooth.empty();
    const std::vector<Piece> pieces = listPieces(image, *candidate.traits);
    const ErrorSum none(image.role, image.channels);
    std::vector<ErrorSums> piece_sums(pieces.size(), {none, none});
    tbb::parallel_for(size_t{0}, pieces.size(),
                      [&](size_t i)
                      {
                          const Mosaic mosaic =
                              makeMosaic(image, smooth, pieces[i].mip, *candidate.traits, pieces[i].blocks);
                          piece_sums[i] = measureMosaic(image, candidate, mosaic, effort);
                      });
    std::vector<ErrorSum> all(countMeasuredMips(image.record), none), smooth_sums = all;
    for (size_t i = 0; i < pieces.size(); ++i)
    {
        all[pieces[i].mip].add(piece_sums[i].all);
        smooth_sums[pieces[i].mip].add(piece_sums[i].smooth);
    }
    return {.error = combineMips(image.role, image.channels, all),
            .smooth = combineMips(image.role, image.channels, smooth_sums)};
}

Encoding encodeForTarget(const PlainImage& image, std::span<const Candidate> candidates, const Target& target,
                         Effort effort, bool strict)
{
    HEARTH_ASSERT(!candidates.empty());
    const std::vector<SmoothCells> smooth = findSmoothCells(image);
    if (candidates.size() == 1)
        return encodeMeasured(image, smooth, candidates.back(), target, effort);
    Estimates estimates(image, smooth, candidates.first(candidates.size() - 1), target, effort);
    Encoding encoding = encodeBest(image, candidates, target, effort, strict, smooth, estimates);
    encoding.estimates = estimates.list();
    return encoding;
}

Encoding encodeCandidate(const PlainImage& image, const Candidate& candidate, const Target& target,
                         Effort effort)
{
    return encodeMeasured(image, findSmoothCells(image), candidate, target, effort);
}

} // namespace hearth::texels
