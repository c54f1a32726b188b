// Decodes UASTC LDR 4x4 textures, as KTX2 files of KHR_texture_basisu have them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/part_builder.h"

namespace hearth::import
{

inline constexpr uint32_t kUastcBlockBytes = 16;

/// Decode the blocks of an image, row by row, into `image` (RGBA8, allocated). `srgb` chooses between the two ways in
/// which ASTC widens colours to 16 bits. False where a block is not one that the format has.
bool decodeUastc(std::span<const std::byte> blocks, bool srgb, DecodedImage& image);

/// Which of `count` partitions a texel of a 4x4 block belongs to, by a partition seed of ASTC.
uint32_t astcPartition(uint32_t seed, uint32_t count, uint32_t x, uint32_t y);

/// Seeds of the patterns that UASTC's pattern numbers stand for.
std::span<const uint16_t> uastcSeeds(uint32_t mode);

} // namespace hearth::import
