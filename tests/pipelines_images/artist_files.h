// Writes files as artists' programs write them, byte by byte: TIFF 6.0 and Photoshop's PSD.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hearth::test
{

/// Append the low `size` bytes of a number, last or first byte first.
void appendNumber(std::string& bytes, uint64_t number, size_t size, bool is_big_endian);

struct TiffImage
{
    uint32_t width = 0, height = 0;
    uint32_t bits = 8;               ///< of a channel
    uint32_t sample_format = 1;      ///< 1 unsigned, 2 signed, 3 float
    uint32_t photometric = 2;        ///< 0 white is zero, 1 black is zero, 2 RGB, 3 palette, 5 ink
    std::vector<uint64_t> samples{}; ///< interleaved; floats as bits
    uint32_t channel_count = 3;
    std::vector<uint32_t> extra{}; ///< of channels after the colours: 0 unknown, 1 associated, 2 not
    uint32_t orientation = 1;
    std::vector<uint32_t> palette{}; ///< all reds first, 16 bits
    std::string profile{};
    bool is_tiled = false; ///< in tiles of 16 x 16
    bool is_planar = false;
};

/// Write a file of these images, uncompressed.
std::string makeTiff(const std::vector<TiffImage>& images, bool is_big_endian = false);

struct PsdImage
{
    uint32_t width = 0, height = 0;
    uint32_t depth = 8;
    uint32_t mode = 3; ///< 0 bitmap, 1 grey, 2 indexed, 3 RGB, 4 CMYK, 9 Lab
    uint32_t channel_count = 3;
    std::vector<uint64_t> samples{};     ///< channel by channel; a bitmap: its bytes
    bool has_transparency = false;       ///< the first channel after the colours is the composite's alpha
    std::optional<bool> has_composite{}; ///< nullopt: the file does not say
    std::string palette{};
    std::string profile{};
    bool is_packed = false;
    bool is_big = false; ///< PSB
};

std::string makePsd(const PsdImage& image);

} // namespace hearth::test
