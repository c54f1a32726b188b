// Encodes mips in the format of a candidate.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/blocks/block_texels.h"
#include "cook/texels/encoding/candidate.h"
#include "cook/texels/encoding/error_histogram.h"
#include "cook/texels/encoding/smooth_cells.h"
#include "cook/texels/encoding/texel_error.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace hearth::texels
{

/// Length of an encoder's search for the best bytes of a block.
enum class BlockSearch : uint8_t
{
    usual,
    longer, ///< errors of the block are seen
    none,   ///< its bytes are known: they are not written
};

/// Texels of whole rows of blocks, in the channels that are stored, with what the encoder has to know of
/// them.
struct StoredTexels
{
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<formats::DecodedTexel> texels{}; ///< rows from top to bottom
    formats::ImageRole role = formats::ImageRole::none;
    bool is_narrow = true;             ///< all values are multiples of 257: 8 bits
    std::vector<BlockSearch> search{}; ///< [block]; empty: usual
};

/// Return texels with the channels that a candidate stores.
StoredTexels arrangeChannels(const PlainImage& image, const Candidate& candidate, uint32_t width,
                             uint32_t height, std::span<const formats::DecodedTexel> texels);

/// Make of decoded texels, in place, what shaders read.
void readStored(const Candidate& candidate, std::span<formats::DecodedTexel> texels);

/// Encode texels; on the caller's thread.
/// returns  mipBytes(*candidate.traits, texels.width, texels.height)
std::vector<std::byte> encodeTexels(const Candidate& candidate, const StoredTexels& texels, Effort effort);

/// Block of an image with its bytes.
struct EncodedBlock
{
    uint32_t mip = 0;
    uint64_t block = 0;                ///< in rows from the top of the mip
    std::array<std::byte, 16> bytes{}; ///< the first block_bytes of the format
};

/// Encode all mips, finest first, tightly packed. Same bytes for any number of threads.
/// smooth  as findSmoothCells
/// known   blocks that are encoded already, in the same way; ascending by mip and block
std::vector<std::byte> encodeImage(const PlainImage& image, std::span<const SmoothCells> smooth,
                                   const Candidate& candidate, Effort effort,
                                   std::span<const EncodedBlock> known = {});

/// Encode one mip with its alpha multiplied by a scale. Same bytes for any number of threads.
std::vector<std::byte> encodeMip(const PlainImage& image, std::span<const SmoothCells> smooth,
                                 const Candidate& candidate, Effort effort, uint32_t mip, float alpha_scale);

/// Loss of encoding an image.
struct ImageError
{
    double error = 0;      ///< as combineMips
    double smooth = 0;     ///< the same of texels in smooth cells; 0 if they are too few to matter
    double error_p999 = 0; ///< of mip 0: 99.9 % of its texels have no larger one
    double coverage = 0; ///< change of the share of texels that pass the alpha test: the largest of the mips
};

/// Measure encoded mips with the decoders of formats, which know nothing of the encoder.
/// smooth   as findSmoothCells
/// encoded  of all mips, as encodeImage
ImageError measureError(const PlainImage& image, std::span<const SmoothCells> smooth,
                        const Candidate& candidate, std::span<const std::byte> encoded);

} // namespace hearth::texels
