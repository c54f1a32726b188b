// Estimates every format that the images of a source may have, for a budget of all textures of a pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/texel_request.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::estimates
{

struct EstimatedFormat
{
    std::string_view name; ///< as TexelFormatTraits::name
    uint64_t bytes = 0;    ///< of all mips on the GPU
    double cost = 0;       ///< square of the estimated part of the target, times texels
};

struct EstimatedImage
{
    std::string name;
    std::string content; ///< SHA-256 of texels and their use: the link stores images with equal ones once
    /// the compressed ones of listCandidates; one if there are none, or if a rule names a format
    std::vector<EstimatedFormat> formats{};
};

/// Estimate all images of a source. Errors count as parts of their targets, larger ones of all texels or of
/// smooth ones, so that decibels and degrees add up; and by texels, since a texture with more of them covers
/// more of what is seen. Same results for any number of threads.
/// errors: as cookTexels
Result<std::vector<EstimatedImage>> estimateTexels(const std::string& import_path,
                                                   const std::string& textures_path,
                                                   const texels::TexelOptions& options);

/// Return JSON text with the schema "hearth.estimates/1". `source` is the name of the input.
std::string estimatesJson(const std::string& source, const std::vector<EstimatedImage>& images);

} // namespace hearth::estimates
