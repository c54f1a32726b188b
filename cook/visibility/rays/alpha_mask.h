// Which points of a material with an alpha mask are there.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <memory>
#include <vector>

namespace hearth::visibility
{

/// The alpha of an image's finest mip, 8 bits a texel.
struct AlphaImage
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> texels;
};

/// errors: those of PackView::imageData
Result<AlphaImage> alphaOf(const formats::PackView& part, uint32_t image);

/// A look into the texture as the renderer's near levels have it: bilinear in the finest mip.
class AlphaMask
{
public:
    /// image  nullptr: without a texture, the material's own alpha decides
    AlphaMask(const formats::MaterialRecord& material, std::shared_ptr<const AlphaImage> image);

    /// Whether the surface is there where its texture has these coordinates, before the material's transform of them.
    bool blocks(Float2 uv) const;

    uint32_t uvSet() const { return texture_.uv_set; }

private:
    float texel(int64_t x, int64_t y) const;

    formats::TextureRef texture_;
    float alpha_;
    float cutoff_;
    std::shared_ptr<const AlphaImage> image_;
};

} // namespace hearth::visibility
