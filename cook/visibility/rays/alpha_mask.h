// Evaluates the alpha test of a material at a point.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <memory>
#include <vector>

namespace hearth::visibility
{

/// Alpha channel of an image's finest mip, 8 bits a texel.
struct AlphaImage
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> texels;
};

/// Read the alpha channel of an image's finest mip.
/// errors: those of PackView::imageData
Result<AlphaImage> readAlpha(const formats::PackView& part, uint32_t image);

/// Alpha test like the renderer's at near levels: a bilinear lookup in the finest mip.
class AlphaMask
{
public:
    /// image  nullptr: no texture, the material's own alpha decides
    AlphaMask(const formats::MaterialRecord& material, std::shared_ptr<const AlphaImage> image);

    /// True if the surface is opaque at these texture coordinates, which the material's UV transform is still
    /// applied to.
    bool isOpaque(Float2 uv) const;

    uint32_t uvSet() const { return texture_.uv_set; }

private:
    formats::TextureRef texture_;
    float alpha_;
    float cutoff_;
    std::shared_ptr<const AlphaImage> image_;
};

} // namespace hearth::visibility
