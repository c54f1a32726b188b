// Samples an image at the mip that a voxel needs. Mips are decoded on first use.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace hearth::bricks
{

/// Image of a textures part. Thread-safe. The view must outlive it.
class Texture
{
public:
    Texture(const formats::PackView& part, uint32_t image);

    /// Return the coarsest mip with at least `texels` texels along a length on which the finest mip has
    /// `finest`; the finest mip if none has as many.
    uint32_t mipFor(double finest, double texels) const;

    /// Sample linear RGBA, with bilinear filtering.
    /// reference  use of this image, with its wrap modes
    /// uv         after the reference's transform
    Float4 at(const formats::TextureRef& reference, Float2 uv, uint32_t mip) const;

    double width() const { return record_.width; }
    double height() const { return record_.height; }

    /// Return the first error of reading a mip. at() returns 0 for such a mip.
    Status status() const;

private:
    using Texels = std::vector<std::byte>;
    const Texels& mip(uint32_t mip) const;
    Texels read(uint32_t mip) const;
    Float4 texel(const Texels& texels, uint64_t index) const;

    const formats::PackView* part_;
    uint32_t image_;
    formats::ImageRecord record_;
    mutable std::mutex mutex_;
    mutable Status status_ = success();
    mutable std::array<std::atomic<const Texels*>, 32> ready_{}; ///< set once, after `mips_` has the mip
    mutable std::array<std::unique_ptr<const Texels>, 32> mips_;
};

/// Apply the reference's UV transform to `uv`.
Float2 transformed(const formats::TextureRef& reference, Float2 uv);

} // namespace hearth::bricks
