// Names texel formats for people and scripts.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <cstdint>

namespace hearth::formats
{

/// Return the name of a texel format.
/// format  a TexelFormat; others are "unknown"
inline const char* texelFormatName(uint32_t format)
{
    switch (static_cast<TexelFormat>(format))
    {
    case TexelFormat::rgba8_srgb:
        return "rgba8-srgb";
    case TexelFormat::rgba8_unorm:
        return "rgba8-unorm";
    case TexelFormat::rgba16_float:
        return "rgba16-float";
    case TexelFormat::rgba16_unorm:
        return "rgba16-unorm";
    case TexelFormat::rgba16_srgb:
        return "rgba16-srgb";
    }
    return "unknown";
}

} // namespace hearth::formats
