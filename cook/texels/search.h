// Finds the format with the fewest bytes that keeps the error of an image below a target.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/encode.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::texels
{

/// Errors that an image may have, in the unit of combineMips.
struct Target
{
    double error;  ///< of all texels
    double smooth; ///< of smooth ones (SmoothCells), where the eye sees seams between blocks; may be infinite
};

/// Return the target of a role: peak signal-to-noise ratios of 34, 36.5, 42 dB for colours, of smooth texels
/// 48, 53, 55; 33, 36, 40 for data; 4.5, 3, 2 degrees for normals; .1, .05, .03 stops for light. Measured
/// over four mips, of which the coarser ones lose more: the finest mip is 1 to 5 dB better.
Target findTarget(formats::ImageRole role, Effort quality);

/// Return the target of an image: that of its role, 3 dB better for cut-outs and for colours of at most
/// 256 texels a side. No mip averages their errors away: a test of alpha turns them into whole pixels, and
/// small images are seen from near.
Target findTarget(const PlainImage& image, Effort quality);

/// Return a target that a person sets for all texels, in the unit of the role (imageErrorUnit). That of
/// smooth texels stays as far from it, in decibels, as in findTarget.
Target makeTarget(formats::ImageRole role, Effort quality, double wanted);

/// Estimate the error of an image in the format of a candidate, and of its smooth texels, from some of its
/// blocks, spread evenly: 256 to 1024 of mip 0, 64 to 256 of each other mip that counts.
ImageError estimateError(const PlainImage& image, std::span<const SmoothCells> smooth, Candidate candidate,
                         Effort effort);

/// Error of a candidate, estimated or measured.
struct CandidateError
{
    Candidate candidate{};
    ImageError error{};
};

struct Encoding
{
    Candidate candidate{};
    std::vector<std::byte> texels{}; ///< as encodeImage
    ImageError error{};
    double share = 0; ///< larger part of its target that an error takes; at most 1 if it holds the target
    std::vector<CandidateError> estimates{}; ///< of the candidates that the search looked at
};

/// Encode an image in the cheapest candidate that holds the target over the measured mips; where none does,
/// in the compressed one that is nearest to it, or, if `strict`, in the plain format.
/// candidates  as listCandidates: ascending by bytes, the plain one last
Encoding encodeForTarget(const PlainImage& image, std::span<const Candidate> candidates, const Target& target,
                         Effort effort, bool strict);

/// Encode an image in the format of a candidate, whether it holds the target or not.
Encoding encodeCandidate(const PlainImage& image, const Candidate& candidate, const Target& target,
                         Effort effort);

} // namespace hearth::texels
