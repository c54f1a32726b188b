// Finds the normal maps that lie over the texels of roughness images.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/index.h"
#include "formats/records/material_layers.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hearth::textures
{

/// Use of a roughness image by materials that have the same normal map and the same factors.
struct RoughnessUse
{
    uint32_t normal_image = kInvalidIndex; ///< kInvalidIndex: mips lose no normals
    float normal_scale = 0;                ///< 0 without a normal map
    float roughness_factor = 1;            ///< above 0; 1 without a normal map
    std::vector<uint32_t> materials{};     ///< ascending; empty: other uses of the image
};

/// Return the uses of each image as roughness, in the order of the materials, but one without a normal map
/// first; none of images that no material reads the roughness of. A material counts if it is lit and its
/// factor is not 0. Its normal map counts if it lies on the same place of the surface: with equal UV sets,
/// transforms and wraps.
///
/// images  of the import part; references beyond them are skipped
std::vector<std::vector<RoughnessUse>>
listRoughnessUses(std::span<const formats::MaterialRecord> materials,
                  std::span<const formats::MaterialLayersRecord> layers,
                  std::span<const formats::ImageRecord> images);

/// Return the uses that have a normal map, but no roughness image. The factor may be 0.
std::vector<RoughnessUse> listMissingRoughness(std::span<const formats::MaterialRecord> materials,
                                               std::span<const formats::ImageRecord> images);

} // namespace hearth::textures
