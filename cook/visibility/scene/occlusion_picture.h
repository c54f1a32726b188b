// A picture of what was baked: the scene's ambient occlusion, for reports.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <cstdint>
#include <vector>

namespace hearth::visibility
{

struct GreyPicture
{
    uint32_t width = 0, height = 0;
    std::vector<uint8_t>
        texels; ///< row by row from the top, 255 times the occlusion: as light, it would be paler

    friend bool operator==(const GreyPicture&, const GreyPicture&) = default;
};

/// The finest level of all instances in their rest poses, from the front, the right and above, all of it in the picture,
/// without perspective. White is what sees all of its hemisphere; the background is dark. Four samples a pixel.
/// Time O(triangles of all instances + texels of their boxes).
///
/// scene  the import part, for the instances
/// baked  a clusters part of the same source; meshes without visibility are left out
/// errors: those of MeshPages::read
Result<GreyPicture> occlusionPicture(const formats::PackView& scene, const formats::PackView& baked,
                                     uint32_t width, uint32_t height);

/// The picture as a PNG file.
std::vector<std::byte> encodePng(const GreyPicture& picture);

} // namespace hearth::visibility
