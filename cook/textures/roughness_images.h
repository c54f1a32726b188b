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

/// Rise of roughness, as the RMS over a mip, above which an image is made.
inline constexpr double kMinRoughnessRise = 0.02;

/// Return the largest RMS difference of roughness of a mip.
/// image  with mips, of 8 or 16 bits a channel
/// a, b   its texels, of all mips
double findRoughnessDifference(const formats::ImageRecord& image, std::span<const std::byte> a,
                               std::span<const std::byte> b);

/// Return by how much roughness rises in mips of an image of one roughness: the largest RMS of a mip. Unlike
/// the mean, it sees a few rivets in a smooth plate.
double findRoughnessRise(const formats::ImageRecord& image, std::span<const std::byte> texels);

/// Image of one roughness.
struct RoughnessImage
{
    formats::ImageRecord record{};
    std::vector<std::byte> texels{}; ///< of the finest mip; occlusion and metalness are 1
};

/// Make an image of half the size of a normal map, with a roughness of 0 to 1 everywhere, to the nearest
/// 1/255.
RoughnessImage makeRoughnessImage(const formats::ImageRecord& normals, float roughness);

} // namespace hearth::textures
