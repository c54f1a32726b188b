// Packs the rectangles of instances into one image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/uv_use.h"

#include <optional>
#include <vector>

namespace hearth::receivers
{

/// Texels of an atlas each way: records have 14 bits for each coordinate.
inline constexpr uint32_t kMaxAtlasSide = 16384;

/// Texels around each rectangle that belong to it, so that bilinear taps at its edge read its own values.
/// Rectangles are twice as far apart.
inline constexpr uint32_t kAtlasBorder = 1;

struct AtlasPlace
{
    uint32_t x = 0, y = 0; ///< first texel, without the border
};

struct AtlasLayout
{
    uint32_t width = 0, height = 0; ///< 0 without rectangles
    std::vector<AtlasPlace> places; ///< one for each rectangle
};

/// Pack rectangles with their borders. The same rectangles get the same places.
/// returns  nullopt if they do not fit into kMaxAtlasSide each way
std::optional<AtlasLayout> layOutAtlas(std::span<const RectangleSize> rectangles);

} // namespace hearth::receivers
