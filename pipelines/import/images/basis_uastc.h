// Decodes UASTC LDR 4x4 textures, as in KTX2 files of KHR_texture_basisu.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

inline constexpr uint32_t kUastcBlockBytes = 16;

/// Decode the blocks of an image, row by row, into `image` (RGBA8, allocated). `srgb` selects one of ASTC's
/// two ways to widen colours to 16 bits. Return false if a block is invalid.
bool decodeUastc(std::span<const std::byte> blocks, bool srgb, DecodedImage& image);

/// Return the partition, below `count`, of a texel of a 4x4 block, from an ASTC partition seed.
uint32_t astcPartition(uint32_t seed, uint32_t count, uint32_t x, uint32_t y);

/// Return the ASTC seeds of UASTC's pattern numbers in a mode.
std::span<const uint16_t> uastcSeeds(uint32_t mode);

} // namespace hearth::import
