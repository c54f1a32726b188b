// Samples textures like a path tracer: bilinear on the two nearest mips, all in double.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "formats/texels/decoded_texel.h"
#include "tests/reference/double3.h"

#include <vector>

namespace hearth::reference
{

struct Rgba
{
    Double3 rgb{1, 1, 1};
    double alpha = 1;
};

/// Images of a pack; the view must outlive it.
class TextureSet
{
public:
    /// errors: as for PackView::imageData.
    static Result<TextureSet> load(const formats::PackView& view);

    /// Linear colour at `uv` (before the reference's transform) for a sample that covers `footprint` of the
    /// UV square's side; white if the reference names no image.
    Rgba sample(const formats::TextureRef& texture, Float2 uv, double footprint) const;

private:
    explicit TextureSet(const formats::PackView& view) : view_(&view) {}
    Rgba texel(uint32_t image, uint32_t mip, int64_t x, int64_t y) const;
    Rgba bilinear(const formats::TextureRef& texture, uint32_t mip, double u, double v) const;

    const formats::PackView* view_;
    std::vector<std::vector<std::vector<formats::DecodedTexel>>> images_; ///< by image, mip, texel
};

} // namespace hearth::reference
