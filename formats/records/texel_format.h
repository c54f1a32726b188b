// Formats of texels: the one table that readers, encoders, decoders, the renderer and texture files share.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace hearth::formats
{

/// Value of ImageRecord::format. Of ASTC a format is a first value, below, plus the number of its footprint.
enum class TexelFormat : uint32_t
{
    rgba8_srgb = 0,  ///< colour; alpha linear
    rgba8_unorm = 1, ///< data
    rgba16_float = 2,
    rgba16_unorm = 3, ///< data of a source with 16 bits
    rgba16_srgb = 4,  ///< parts only: colour of a source with 16 bits; packs have rgba8_srgb
    rg8_unorm = 5,
    r8_unorm = 6,
    rgb9e5_float = 7,
    astc_unorm = 16, ///< 4x4; + footprint
    astc_srgb = 32,  ///< 4x4; + footprint
    astc_float = 48, ///< 4x4; + footprint. Needs an extension of the device
    etc2_rgb8_unorm = 64,
    etc2_rgb8_srgb = 65,
    etc2_rgba8_unorm = 66,
    etc2_rgba8_srgb = 67,
    eac_r11_unorm = 68,
    eac_rg11_unorm = 69,
    etc2_rgb8a1_unorm = 70, ///< this and the next three: only read from texture files
    etc2_rgb8a1_srgb = 71,
    eac_r11_snorm = 72,
    eac_rg11_snorm = 73,
    bc1_rgb_unorm = 80,
    bc1_rgb_srgb = 81,
    bc3_unorm = 82,
    bc3_srgb = 83,
    bc4_unorm = 84,
    bc5_unorm = 85,
    bc6h_ufloat = 86,
    bc7_unorm = 87,
    bc7_srgb = 88,
    bc1_rgba_unorm = 89, ///< this and the next ones: only read from texture files
    bc1_rgba_srgb = 90,
    bc2_unorm = 91,
    bc2_srgb = 92,
    bc4_snorm = 93,
    bc5_snorm = 94,
    bc6h_sfloat = 95,
};

/// Compression that a device has in full or lacks.
enum class TexelFamily : uint8_t
{
    plain, ///< every device
    astc,
    astc_hdr,
    etc2, ///< with EAC
    bc,
};

/// Meaning of a channel's bits.
enum class TexelCoding : uint8_t
{
    unorm,       ///< 0 to 1
    snorm,       ///< -1 to 1
    srgb,        ///< red, green, blue by the transfer function of sRGB; alpha 0 to 1
    float_value, ///< floats of 16 bits or fewer, linear light
};

struct TexelFormatTraits
{
    TexelFormat format;
    std::string_view name; ///< for people and scripts: "astc-6x6-srgb"
    TexelFamily family;
    TexelCoding coding;
    uint8_t channels;    ///< from red on: 1 to 4
    uint8_t block_width; ///< texels; 1 unless compressed
    uint8_t block_height;
    uint8_t block_bytes;
    uint32_t vulkan_format; ///< number of the VkFormat
};

/// Values of TexelFormat are less.
inline constexpr uint32_t kTexelFormatEnd = 96;

/// Number of ASTC's two-dimensional footprints.
inline constexpr uint32_t kAstcFootprints = 14;

/// True if the format is only read from texture files.
constexpr bool isFileFormat(TexelFormat format)
{
    return (format >= TexelFormat::etc2_rgb8a1_unorm && format <= TexelFormat::eac_rg11_snorm) ||
           format >= TexelFormat::bc1_rgba_unorm;
}

/// Return the format of ASTC with a footprint.
/// first      astc_unorm, astc_srgb or astc_float
/// footprint  0 to kAstcFootprints - 1
constexpr TexelFormat astcFormat(TexelFormat first, uint32_t footprint)
{
    return static_cast<TexelFormat>(static_cast<uint32_t>(first) + footprint);
}

namespace detail
{

// clang-format off
/// Rows of the three formats of an ASTC footprint.
#define HEARTH_ASTC(number, width, height) \
    {astcFormat(TexelFormat::astc_unorm, number), "astc-" #width "x" #height "-unorm", TexelFamily::astc, \
     TexelCoding::unorm, 4, width, height, 16, 157 + 2 * (number)}, \
    {astcFormat(TexelFormat::astc_srgb, number), "astc-" #width "x" #height "-srgb", TexelFamily::astc, \
     TexelCoding::srgb, 4, width, height, 16, 158 + 2 * (number)}, \
    {astcFormat(TexelFormat::astc_float, number), "astc-" #width "x" #height "-float", TexelFamily::astc_hdr, \
     TexelCoding::float_value, 4, width, height, 16, 1000066000 + (number)}
inline constexpr TexelFormatTraits kTexelFormats[] = {
    {TexelFormat::rgba8_srgb,       "rgba8-srgb",       TexelFamily::plain, TexelCoding::srgb,        4, 1, 1, 4, 43},
    {TexelFormat::rgba8_unorm,      "rgba8-unorm",      TexelFamily::plain, TexelCoding::unorm,       4, 1, 1, 4, 37},
    {TexelFormat::rgba16_float,     "rgba16-float",     TexelFamily::plain, TexelCoding::float_value, 4, 1, 1, 8, 97},
    {TexelFormat::rgba16_unorm,     "rgba16-unorm",     TexelFamily::plain, TexelCoding::unorm,       4, 1, 1, 8, 91},
    {TexelFormat::rgba16_srgb,      "rgba16-srgb",      TexelFamily::plain, TexelCoding::srgb,        4, 1, 1, 8, 0},
    {TexelFormat::rg8_unorm,        "rg8-unorm",        TexelFamily::plain, TexelCoding::unorm,       2, 1, 1, 2, 16},
    {TexelFormat::r8_unorm,         "r8-unorm",         TexelFamily::plain, TexelCoding::unorm,       1, 1, 1, 1, 9},
    {TexelFormat::rgb9e5_float,     "rgb9e5-float",     TexelFamily::plain, TexelCoding::float_value, 3, 1, 1, 4, 123},
    HEARTH_ASTC(0, 4, 4),    HEARTH_ASTC(1, 5, 4),   HEARTH_ASTC(2, 5, 5),   HEARTH_ASTC(3, 6, 5),
    HEARTH_ASTC(4, 6, 6),    HEARTH_ASTC(5, 8, 5),   HEARTH_ASTC(6, 8, 6),   HEARTH_ASTC(7, 8, 8),
    HEARTH_ASTC(8, 10, 5),   HEARTH_ASTC(9, 10, 6),  HEARTH_ASTC(10, 10, 8), HEARTH_ASTC(11, 10, 10),
    HEARTH_ASTC(12, 12, 10), HEARTH_ASTC(13, 12, 12),
    {TexelFormat::etc2_rgb8_unorm,  "etc2-rgb8-unorm",  TexelFamily::etc2,  TexelCoding::unorm,       3, 4, 4, 8, 147},
    {TexelFormat::etc2_rgb8_srgb,   "etc2-rgb8-srgb",   TexelFamily::etc2,  TexelCoding::srgb,        3, 4, 4, 8, 148},
    {TexelFormat::etc2_rgba8_unorm, "etc2-rgba8-unorm", TexelFamily::etc2,  TexelCoding::unorm,       4, 4, 4, 16, 151},
    {TexelFormat::etc2_rgba8_srgb,  "etc2-rgba8-srgb",  TexelFamily::etc2,  TexelCoding::srgb,        4, 4, 4, 16, 152},
    {TexelFormat::eac_r11_unorm,    "eac-r11-unorm",    TexelFamily::etc2,  TexelCoding::unorm,       1, 4, 4, 8, 153},
    {TexelFormat::eac_rg11_unorm,   "eac-rg11-unorm",   TexelFamily::etc2,  TexelCoding::unorm,       2, 4, 4, 16, 155},
    {TexelFormat::etc2_rgb8a1_unorm, "etc2-rgb8a1-unorm", TexelFamily::etc2, TexelCoding::unorm,      4, 4, 4, 8, 149},
    {TexelFormat::etc2_rgb8a1_srgb, "etc2-rgb8a1-srgb", TexelFamily::etc2,  TexelCoding::srgb,        4, 4, 4, 8, 150},
    {TexelFormat::eac_r11_snorm,    "eac-r11-snorm",    TexelFamily::etc2,  TexelCoding::snorm,       1, 4, 4, 8, 154},
    {TexelFormat::eac_rg11_snorm,   "eac-rg11-snorm",   TexelFamily::etc2,  TexelCoding::snorm,       2, 4, 4, 16, 156},
    {TexelFormat::bc1_rgb_unorm,    "bc1-rgb-unorm",    TexelFamily::bc,    TexelCoding::unorm,       3, 4, 4, 8, 131},
    {TexelFormat::bc1_rgb_srgb,     "bc1-rgb-srgb",     TexelFamily::bc,    TexelCoding::srgb,        3, 4, 4, 8, 132},
    {TexelFormat::bc3_unorm,        "bc3-unorm",        TexelFamily::bc,    TexelCoding::unorm,       4, 4, 4, 16, 137},
    {TexelFormat::bc3_srgb,         "bc3-srgb",         TexelFamily::bc,    TexelCoding::srgb,        4, 4, 4, 16, 138},
    {TexelFormat::bc4_unorm,        "bc4-unorm",        TexelFamily::bc,    TexelCoding::unorm,       1, 4, 4, 8, 139},
    {TexelFormat::bc5_unorm,        "bc5-unorm",        TexelFamily::bc,    TexelCoding::unorm,       2, 4, 4, 16, 141},
    {TexelFormat::bc6h_ufloat,      "bc6h-ufloat",      TexelFamily::bc,    TexelCoding::float_value, 3, 4, 4, 16, 143},
    {TexelFormat::bc7_unorm,        "bc7-unorm",        TexelFamily::bc,    TexelCoding::unorm,       4, 4, 4, 16, 145},
    {TexelFormat::bc7_srgb,         "bc7-srgb",         TexelFamily::bc,    TexelCoding::srgb,        4, 4, 4, 16, 146},
    {TexelFormat::bc1_rgba_unorm,   "bc1-rgba-unorm",   TexelFamily::bc,    TexelCoding::unorm,       4, 4, 4, 8, 133},
    {TexelFormat::bc1_rgba_srgb,    "bc1-rgba-srgb",    TexelFamily::bc,    TexelCoding::srgb,        4, 4, 4, 8, 134},
    {TexelFormat::bc2_unorm,        "bc2-unorm",        TexelFamily::bc,    TexelCoding::unorm,       4, 4, 4, 16, 135},
    {TexelFormat::bc2_srgb,         "bc2-srgb",         TexelFamily::bc,    TexelCoding::srgb,        4, 4, 4, 16, 136},
    {TexelFormat::bc4_snorm,        "bc4-snorm",        TexelFamily::bc,    TexelCoding::snorm,       1, 4, 4, 8, 140},
    {TexelFormat::bc5_snorm,        "bc5-snorm",        TexelFamily::bc,    TexelCoding::snorm,       2, 4, 4, 16, 142},
    {TexelFormat::bc6h_sfloat,      "bc6h-sfloat",      TexelFamily::bc,    TexelCoding::float_value, 3, 4, 4, 16, 144},
};
// clang-format on
#undef HEARTH_ASTC

/// [value of a TexelFormat]: row of kTexelFormats + 1; 0: there is no such format.
inline constexpr auto kTexelFormatRows = []
{
    std::array<uint8_t, kTexelFormatEnd> rows{};
    uint8_t row = 0;
    for (const TexelFormatTraits& traits : kTexelFormats)
        rows[static_cast<uint32_t>(traits.format)] = ++row;
    return rows;
}();

} // namespace detail

/// Return the traits of a format; null if it does not exist.
constexpr const TexelFormatTraits* findTexelFormat(uint32_t format)
{
    if (format >= detail::kTexelFormatRows.size() || detail::kTexelFormatRows[format] == 0)
        return nullptr;
    return &detail::kTexelFormats[detail::kTexelFormatRows[format] - 1];
}

/// True if a pack may have images of the format.
constexpr bool isPackFormat(uint32_t format)
{
    const TexelFormatTraits* const traits = findTexelFormat(format);
    return traits != nullptr && traits->format != TexelFormat::rgba16_srgb && !isFileFormat(traits->format);
}

/// Return the traits of a format that exists (contract of the caller).
constexpr const TexelFormatTraits& texelTraits(TexelFormat format)
{
    return *findTexelFormat(static_cast<uint32_t>(format));
}

/// Return the traits of the format with a name; null if there is none.
constexpr const TexelFormatTraits* findTexelFormat(std::string_view name)
{
    for (const TexelFormatTraits& traits : detail::kTexelFormats)
        if (traits.name == name)
            return &traits;
    return nullptr;
}

/// Return the name of a format; "unknown" if it does not exist.
constexpr std::string_view texelFormatName(uint32_t format)
{
    const TexelFormatTraits* const traits = findTexelFormat(format);
    return traits == nullptr ? "unknown" : traits->name;
}

/// Return the bytes of a mip of width x height texels; blocks that reach over the edge are whole.
constexpr uint64_t mipBytes(const TexelFormatTraits& traits, uint32_t width, uint32_t height)
{
    const uint64_t columns = (uint64_t{width} + traits.block_width - 1) / traits.block_width;
    const uint64_t rows = (uint64_t{height} + traits.block_height - 1) / traits.block_height;
    return columns * rows * traits.block_bytes;
}

} // namespace hearth::formats
