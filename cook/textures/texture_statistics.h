// Statistics of each cooked image, as numbers for people and scripts.
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

/// Use of an image by a material.
struct UseStatistics
{
    std::string material; ///< name of the material, may be empty
    std::string role;     ///< as formats::ImageUse::role
};

struct ImageStatistics
{
    std::string name;
    std::vector<UseStatistics> uses{};
    formats::ImageRecord image{};
    uint64_t bytes = 0;        ///< of all mips
    uint64_t stored_bytes = 0; ///< size in the file
    /// RMS difference between the finest stored mip and the source's image, with all bits that it has, over
    /// four channels, as a share of a channel's whole range. Empty for light (RGBA16F) that was made smaller:
    /// its range has no end.
    std::optional<double> error;
    /// The same for the next mip: the loss of an image of half the size. Empty for light, and if there is no
    /// such mip.
    std::optional<double> half_error;
};

/// Compute the RMS difference between mip `mip`, stretched over the finest, and the finest; see
/// ImageStatistics. Colours are weighted by their alpha: cut-away texels are not visible.
///
/// image     with its mips; not light (asserted)
/// mips      all of them, finest first, as buildMipChain gives them
/// imported  the finest with 16 bits a channel, where the mips have 8; empty: the finest mip
double mipError(const formats::ImageRecord& image, std::span<const std::byte> mips, uint32_t mip,
                std::span<const std::byte> imported = {});

/// Return JSON text with the schema "hearth.textures/1". `source` is the name of the input.
std::string statisticsJson(const std::string& source, std::span<const ImageStatistics> images);

} // namespace hearth::textures
