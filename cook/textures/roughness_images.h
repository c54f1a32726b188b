// Decides which materials get a roughness image of their own because their normal maps need it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::textures
{

/// Maximum difference, as the RMS of roughness over a mip, of images that are stored once.
inline constexpr double kMaxSharedDifference = 1.0 / 255;

/// Rise of the mean roughness of a mip that an image is made for.
inline constexpr double kMinRoughnessRise = 0.02;

/// Return the largest RMS difference of roughness of a mip.
/// image  with mips, of 8 or 16 bits a channel
/// a, b   its texels, of all mips
double findRoughnessDifference(const formats::ImageRecord& image, std::span<const std::byte> a,
                               std::span<const std::byte> b);

/// Return by how much the mean roughness of a mip is above that of the finest, at most.
double findRoughnessRise(const formats::ImageRecord& image, std::span<const std::byte> texels);

/// Image of one roughness, and the factor that makes it exact.
struct RoughnessImage
{
    formats::ImageRecord record{};
    std::vector<std::byte> texels{}; ///< of the finest mip; occlusion and metalness are 1
    float factor = 1;                ///< that a shader has to multiply with; above 0, at most 1
};

/// Make an image of half the size of a normal map, with a roughness of 0 to 1 everywhere. The name is that of
/// the normal map. Only a roughness that is no larger than the factor can be shown: in 8 bits it is rounded
/// up, so that the factor is near 1.
RoughnessImage makeRoughnessImage(const formats::ImageRecord& normals, float roughness);

} // namespace hearth::textures
