// Fills colours that nobody sees, under an alpha of 0, from their neighbours: a filter of the GPU that
// reaches over the edge of a leaf then meets the leaf's colour, and blocks of compressed texels have no
// edge to keep. Source: S. Gortler and others, "The Lumigraph", 1996 (pull-push).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/material_layers.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hearth::textures
{

/// Return for each image whether the colours of texels with an alpha of 0 are never seen: whether all
/// its uses are base colours of masked or blended materials.
///
/// image_count  of the import part; references beyond it are skipped
std::vector<bool> listHiddenColors(std::span<const formats::MaterialRecord> materials,
                                   std::span<const formats::MaterialLayersRecord> layers, size_t image_count);

/// Replace the colours of texels whose alpha is 0, in 8 bits a channel, by those of the nearest texels
/// around them, blended. All other texels and all alphas stay; so does everything where alpha is 0
/// nowhere or everywhere. Same result for any number of threads.
///
/// image   width, height and format (sRGB, 8 or 16 bits a channel, asserted) are read
/// texels  of the finest mip
void fillHiddenColors(const formats::ImageRecord& image, std::span<std::byte> texels);

} // namespace hearth::textures
