// What an image shows at a place, at the mip that a voxel needs; mips are read when the first asks for them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace hearth::bricks
{

/// An image of a textures part. Any number of threads may look at once. The view must outlive it.
class Texture
{
public:
    Texture(const formats::PackView& part, uint32_t image);

    /// The coarsest mip with at least `texels` texels along a length on which the finest has `finest`; the finest where none
    /// has as many.
    uint32_t mipFor(double finest, double texels) const;

    /// Linear RGBA, bilinear between texels.
    /// reference  a use of this image: how coordinates go on outside [0, 1]
    /// uv         after the reference's transform
    Float4 at(const formats::TextureRef& reference, Float2 uv, uint32_t mip) const;

    double width() const { return record_.width; }
    double height() const { return record_.height; }

    /// The first error of reading a mip, which at() gives 0 for.
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
    mutable std::array<std::atomic<const Texels*>, 32> ready_{}; ///< set once, when `mips_` has it
    mutable std::array<std::unique_ptr<const Texels>, 32> mips_;
};

/// `uv` as the reference transforms it.
Float2 transformed(const formats::TextureRef& reference, Float2 uv);

} // namespace hearth::bricks
