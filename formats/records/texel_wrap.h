// Wraps texel coordinates beyond the edge of an image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <algorithm>
#include <cstdint>

namespace hearth::formats
{

/// Largest texture coordinate: beyond it, floats are too coarse to address texels.
inline constexpr float kMaxUvMagnitude = 1e6f;

/// Return the texel inside the image.
/// wrap  as in TextureRef: a value of Wrap
constexpr int64_t wrapTexel(int64_t texel, int64_t size, uint8_t wrap)
{
    if (texel >= 0 && texel < size) // mostly, and divisions are slow
        return texel;
    if (wrap == static_cast<uint8_t>(Wrap::clamp_to_edge))
        return std::clamp<int64_t>(texel, 0, size - 1);
    if (wrap == static_cast<uint8_t>(Wrap::mirrored_repeat))
    {
        const int64_t place = (texel % (2 * size) + 2 * size) % (2 * size);
        return place < size ? place : 2 * size - 1 - place;
    }
    return (texel % size + size) % size;
}

} // namespace hearth::formats
