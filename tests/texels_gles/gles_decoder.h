// Decodes ETC2 and EAC by Mesa's OpenGL ES 3, without a window: an independent oracle.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hearth::test
{

/// Context of OpenGL ES 3 on the software rasterizer.
class GlesDecoder
{
public:
    /// throws std::runtime_error if there is no such context
    GlesDecoder();
    ~GlesDecoder();
    GlesDecoder(const GlesDecoder&) = delete;
    GlesDecoder& operator=(const GlesDecoder&) = delete;

    /// Return what shaders read from the texels; sRGB is not linearised.
    ///
    /// traits  family etc2
    /// width, height  texels; multiples of 4
    /// blocks  mipBytes(traits, width, height)
    std::vector<std::array<float, 4>> decode(const formats::TexelFormatTraits& traits, uint32_t width,
                                             uint32_t height, std::span<const std::byte> blocks) const;

    /// Return the name of the device.
    std::string name() const;

private:
    struct Context;
    std::unique_ptr<Context> context_;
};

} // namespace hearth::test
