// Decodes ETC1S textures in BasisLZ supercompression, as in KTX2 files of KHR_texture_basisu.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

struct BasisLayout
{
    uint32_t image_count;                      ///< image descriptions in the global data: one for each level
    std::span<const uint32_t> sample_channels; ///< one or two: colour and alpha, or red and green
};

/// Decode the first image of the file, whose slices lie in `level`, into `image` (RGBA8, allocated).
/// Return a description of the damage; empty on success.
std::string_view decodeBasisEtc1s(std::span<const std::byte> global_data, std::span<const std::byte> level,
                                  const BasisLayout& layout, DecodedImage& image);

} // namespace hearth::import
