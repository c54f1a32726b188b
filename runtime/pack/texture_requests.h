// Converts the feedback of materials to the mips of their images that a view wants.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <span>
#include <vector>

namespace hearth::pack
{

/// Image as a material reads it.
struct TextureUse
{
    uint32_t image;
    float texels_log2; ///< log2 of the texels of mip 0 along a UV unit
};

/// Return how a texture reference reads its image. Where the UV transform or the image has more texels along
/// one axis, the fewer count, but an eighth of the more at least: anisotropic samplers go by the axis that
/// has fewer texels a pixel, and take eight along the other.
TextureUse makeTextureUse(const formats::PackView& view, const formats::TextureRef& texture);

/// Return the priority of a mip: pixels that a texel of the next coarser mip covers. Above 1 the view is
/// blurred without the mip.
///
/// pixels_log2  log2 of the pixels that a UV unit of the material covers
float mipPriority(const TextureUse& use, float pixels_log2, uint32_t mip);

} // namespace hearth::pack
