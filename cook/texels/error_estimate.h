// Estimates the error of an image in a format from some of its blocks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encode.h"
#include "cook/texels/image_detail.h"

namespace hearth::texels
{

/// Number of blocks that an estimate encodes, of each mip that counts a 32nd within bounds.
enum class SampleSize
{
    usual, ///< 64 to 128 of mip 0, 24 to 32 of each other
    large, ///< 96 to 320, 32 to 80
};

/// Estimate the error of an image in the format of a candidate, and of its smooth texels; on the caller's
/// thread, but for the choice of blocks.
ImageError estimateError(const PlainImage& image, const ImageDetail& detail, const Candidate& candidate,
                         Effort effort, SampleSize size);

} // namespace hearth::texels
