// Tells whether two textures lie on the same place of a surface.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <algorithm>

namespace hearth::textures
{

/// Return whether UV sets, transforms and wraps are equal. The images may differ, and so may their sizes.
inline bool liesOnSamePlace(const formats::TextureRef& a, const formats::TextureRef& b)
{
    return a.uv_set == b.uv_set && a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v &&
           std::ranges::equal(a.uv_transform, b.uv_transform);
}

} // namespace hearth::textures
