// Renders an image of a scene's baked ambient occlusion, for reports.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <cstdint>
#include <vector>

namespace hearth::visibility
{

struct GreyImage
{
    uint32_t width = 0, height = 0;
    /// Row by row from the top; 255 times the occlusion, not encoded as sRGB, which would be paler.
    std::vector<uint8_t> texels;

    friend bool operator==(const GreyImage&, const GreyImage&) = default;
};

/// Render the finest level of all instances in their rest poses with an orthographic camera from the front,
/// right and above, such that all of it is in the image. Vertices that see all of their hemisphere are white;
/// the background is dark. Four samples a pixel. Time O(triangles of all instances + texels of their boxes).
/// Scenes whose triangles cover the image hundreds of times over are not drawn to their end.
///
/// scene  the import part, for the instances
/// baked  a clusters part of the same source; meshes without visibility are left out
/// errors: those of readInstanceMeshes and MeshPages::read
Result<GreyImage> renderOcclusion(const formats::PackView& scene, const formats::PackView& baked,
                                  uint32_t width, uint32_t height);

} // namespace hearth::visibility
