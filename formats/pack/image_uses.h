// Lists the materials that use an image, and the image's role in each.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/material_layers.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hearth::formats
{

struct ImageUse
{
    uint32_t material = 0; ///< index in the table
    /// Role as named by glTF: "baseColor", "metallicRoughness", "normal", "occlusion" or "emissive";
    /// "specular", "clearcoat", "clearcoatNormal" or "sheen" of layers.
    std::string_view role;
};

/// Return the uses of each image, in the order of the materials. References to missing images are skipped.
std::vector<std::vector<ImageUse>> imageUses(std::span<const MaterialRecord> materials,
                                             std::span<const MaterialLayersRecord> layers,
                                             size_t image_count);

/// Return whether all uses of an image have this role; true without a use.
bool hasOnlyRole(std::span<const ImageUse> uses, std::string_view role);

} // namespace hearth::formats
