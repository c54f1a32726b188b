// Formats of the images that frames show, and what they hold of a colour.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/device_table.h"

#include <cstdint>
#include <span>

namespace hearth::gpu
{

/// Content of an image that a frame shows.
enum class ColorContent : uint8_t
{
    display,  ///< display-linear colours, to which the format applies the sRGB curve
    codes,    ///< sRGB codes: the shader applies the curve
    radiance, ///< scene-linear colours, ahead of the tone curve
};

struct ColorFormat
{
    VkFormat format;
    const char* name; ///< without VK_FORMAT_
    ColorContent content;
    uint32_t bytes; ///< a pixel
};

/// Format of the images of FrameTargets, unless a renderer has another one.
inline constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_SRGB;

/// Formats that a renderer may have.
std::span<const ColorFormat> colorFormats();

/// Return a format of colorFormats(); null if it is none of them.
const ColorFormat* findColorFormat(VkFormat format);

} // namespace hearth::gpu
