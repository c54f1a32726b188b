// The materials that show an image, and the role it has in each.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hearth::formats
{

struct ImageUse
{
    uint32_t material = 0; ///< index of the table
    /// As glTF calls it: "baseColor", "metallicRoughness", "normal", "occlusion" or "emissive".
    std::string_view role;
};

/// The uses of each image, in the order of the materials. References to images that are not there are
/// passed over.
std::vector<std::vector<ImageUse>> imageUses(std::span<const MaterialRecord> materials, size_t image_count);

} // namespace hearth::formats
