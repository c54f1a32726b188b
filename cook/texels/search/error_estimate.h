// Estimates the error of an image in a format from some of its blocks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encoding/encode.h"
#include "cook/texels/search/block_sample.h"
#include "cook/texels/search/image_detail.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace hearth::texels
{

/// Sums of squares of each channel, of all texels of something and of its smooth ones.
struct SquareSums
{
    std::array<double, 4> all{};
    std::array<double, 4> smooth{};
};

/// Estimate of the error of an image in the format of a candidate, and of its smooth texels: from a 32nd of
/// the blocks of each mip, of the finest at least 32 and at most 64, of each other 12 and 16. It encodes on
/// the caller's thread.
class ErrorEstimate
{
public:
    /// image, detail  outlive the estimate
    ErrorEstimate(const PlainImage& image, const ImageDetail& detail, const Candidate& candidate,
                  Effort effort);

    /// Encode more blocks: of the finest mip at least 64 and at most 160, of each other 16 and 40.
    void refine();

    /// Return what is estimated of all texels and of the smooth ones, and 0 of the rest.
    ImageError error() const;

    /// Return the blocks that were encoded, ascending by mip and block.
    std::vector<EncodedBlock> listBlocks() const;

private:
    /// Block of the sample: its bytes, and sums of squares of its texels.
    struct MeasuredBlock
    {
        std::array<std::byte, 16> bytes{};
        SquareSums sums{};
    };
    using BlockKey = std::pair<uint32_t, uint64_t>; ///< mip and block in it

    void measureBlocks(std::span<const BlockKey> blocks);
    void addSample(std::span<const size_t> wanted);

    const PlainImage* image_;
    const ImageDetail* detail_;
    Candidate candidate_;
    Effort effort_;
    std::vector<BlockSampler> samplers_{}; ///< [mip]
    std::vector<size_t> sampled_;          ///< [mip]: blocks so far
    std::vector<SquareSums> sums_;         ///< [mip]
    std::map<BlockKey, MeasuredBlock> measured_{};
};

} // namespace hearth::texels
