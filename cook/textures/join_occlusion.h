// Joins occlusion with metallic-roughness images: materials read it from a channel that they leave unused.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/material_layers.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::textures
{

/// Return for each image the occlusion image that joins its red channel; kInvalidIndex: none. An occlusion
/// image joins if that makes it useless: each material that uses it has a metallic-roughness image of the
/// same size and format on the same place of the surface, whose red channel nobody reads, and which has no
/// other occlusion in another material.
///
/// images  of the import part; references beyond them are skipped
std::vector<uint32_t> listJoinedOcclusion(std::span<const formats::MaterialRecord> materials,
                                          std::span<const formats::MaterialLayersRecord> layers,
                                          std::span<const formats::ImageRecord> images);

/// Let materials read their occlusion from the image that it joined.
/// joined  of listJoinedOcclusion()
void shareOcclusion(std::span<const uint32_t> joined, std::span<formats::MaterialRecord> materials);

/// Copy the red channel. Both have the same number of texels of `format`: RGBA of 8 or 16 bits (asserted).
void copyRed(formats::TexelFormat format, std::span<const std::byte> from, std::span<std::byte> to);

} // namespace hearth::textures
