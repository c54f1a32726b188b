// Reads the KTX 2.0 container (Khronos KTX File Format Specification 2.0): checks everything, decodes
// nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/images/codecs.h"

namespace hearth::import
{

enum class Ktx2Scheme : uint32_t
{
    none = 0,
    basis_lz = 1,
    zstd = 2,
    zlib = 3,
};

/// Colour models of the Khronos data format descriptor that denote a Basis Universal texture.
inline constexpr uint32_t kModelEtc1s = 163;
inline constexpr uint32_t kModelUastc = 166;

struct Ktx2Level
{
    std::span<const std::byte> bytes;
    uint64_t uncompressed_size = 0;
};

struct Ktx2File
{
    uint32_t vk_format = 0;
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t faces = 1; ///< 6: a cube
    Ktx2Scheme scheme = Ktx2Scheme::none;
    uint32_t color_model = 0;
    Transfer transfer = Transfer::unsaid;  ///< of the data format descriptor
    bool is_premultiplied = false;         ///< colours were multiplied by alpha
    bool is_mirrored = false;              ///< columns go from right to left
    bool is_bottom_up = false;             ///< rows go from bottom to top
    std::string swizzle;                   ///< sources of red, green, blue, alpha: "rgba01"; empty: not said
    std::vector<uint32_t> sample_channels; ///< channel of each sample of the data format descriptor
    std::span<const std::byte> global_data;
    std::vector<Ktx2Level> levels; ///< finest first
};

/// Textures that a reader takes.
enum class Ktx2Kind : uint8_t
{
    image,
    image_or_cube,
};

/// Read a texture of two dimensions and one layer, which is a single image unless `kind` lets it be a cube.
/// errors: image_malformed, image_unsupported (arrays, volumes, other cubes), input_too_large.
Result<Ktx2File> readKtx2(const EncodedImage& source, Ktx2Kind kind = Ktx2Kind::image);

} // namespace hearth::import
