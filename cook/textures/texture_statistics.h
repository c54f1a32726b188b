// What became of each image, as numbers for people and scripts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::textures
{

/// A material that shows an image.
struct UseStatistics
{
    std::string material; ///< its name, which may be empty
    std::string role;     ///< as formats::ImageUse::role
};

struct ImageStatistics
{
    std::string name;
    std::vector<UseStatistics> uses{};
    formats::ImageRecord image{};
    uint64_t bytes = 0;        ///< of all mips
    uint64_t stored_bytes = 0; ///< as they lie in the file
    /// RMS difference of the finest mip as it is stored from the image as it was imported; of the whole range of a
    /// channel, over four channels. Nothing for light (RGBA16F) that was made smaller: its range has no end.
    std::optional<double> error;
    /// The same of the mip after it: what an image of half the size would lose. Nothing for light, and where there is none.
    std::optional<double> half_error;
};

/// RMS difference of mip `mip`, stretched over the finest, from that; see ImageStatistics. Colours count by their alpha: what is
/// cut away is not seen. Exact sums, so the same for any order of texels.
///
/// image    with its mips; RGBA8
/// mips     all of them, finest first, as buildMipChain gives them
double mipError(const formats::ImageRecord& image, std::span<const std::byte> mips, uint32_t mip);

/// Schema "hearth.textures/1". `source` is the name of what was read.
std::string statisticsJson(const std::string& source, std::span<const ImageStatistics> images);

} // namespace hearth::textures
