// Decodes DDS images: the formats of Direct3D 9 by masks and codes, those of DXGI by the header that Direct3D
// 10 added. Only the finest level is decoded. Rows are tightly packed, whatever the pitch says, as in
// Microsoft's readers.
// Source: Microsoft, "Programming Guide for DDS", and DXGI_FORMAT.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/byte_reader.h"
#include "pipelines/import/images/channels.h"
#include "pipelines/import/images/stored_image.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <optional>

namespace hearth::import
{

namespace
{

struct DdsHeader
{
    uint32_t signature;
    uint32_t size;
    uint32_t flags;
    uint32_t height;
    uint32_t width;
    uint32_t pitch;
    uint32_t depth;
    uint32_t level_count;
    uint32_t reserved[11];
    uint32_t format_size;
    uint32_t format_flags;
    uint32_t code;
    uint32_t bit_count;
    uint32_t masks[4]; ///< red or luminance, green, blue, alpha
    uint32_t caps[4];
    uint32_t reserved_end;
};
static_assert(sizeof(DdsHeader) == 128);

struct Dx10Header
{
    uint32_t format;
    uint32_t dimension;
    uint32_t flags;
    uint32_t layer_count;
    uint32_t alpha_mode;
};

constexpr uint32_t kHeaderSize = 124, kFormatSize = 32;
constexpr uint32_t kFormatHasAlpha = 0x1, kFormatIsAlpha = 0x2, kFormatHasCode = 0x4, kFormatIsRgb = 0x40,
                   kFormatIsLuminance = 0x20000;
constexpr uint32_t kCaps2Cube = 0x200, kCaps2Volume = 0x200000;
constexpr uint32_t kDimensionTexture2d = 3, kDimensionTexture3d = 4, kDx10Cube = 0x4;

enum class Alpha : uint8_t
{
    straight,
    premultiplied,
    opaque,
    custom, ///< numbers that are not opacity
};

struct DdsFormat
{
    StoredFormat stored;
    Alpha alpha = Alpha::straight;
    bool is_srgb = false;
};

constexpr uint32_t fourCc(const char (&text)[5])
{
    uint32_t code = 0;
    for (uint32_t i = 0; i < 4; ++i)
        code |= static_cast<uint32_t>(static_cast<unsigned char>(text[i])) << (8 * i);
    return code;
}

struct CodeRow
{
    uint32_t code;
    uint32_t vulkan_format;
    Alpha alpha = Alpha::straight;
};

// codes of pixel formats: names of compressed ones, numbers of D3DFORMAT
constexpr CodeRow kCodes[] = {
    {fourCc("DXT1"), 133},
    {fourCc("DXT2"), 135, Alpha::premultiplied},
    {fourCc("DXT3"), 135},
    {fourCc("DXT4"), 137, Alpha::premultiplied},
    {fourCc("DXT5"), 137},
    {fourCc("ATI1"), 139},
    {fourCc("BC4U"), 139},
    {fourCc("BC4S"), 140},
    {fourCc("ATI2"), 141},
    {fourCc("BC5U"), 141},
    {fourCc("BC5S"), 142},
    {36, 91},   // A16B16G16R16
    {110, 92},  // Q16W16V16U16
    {111, 76},  // R16F
    {112, 83},  // G16R16F
    {113, 97},  // A16B16G16R16F
    {114, 100}, // R32F
    {115, 103}, // G32R32F
    {116, 109}, // A32B32G32R32F
};

struct DxgiRow
{
    uint32_t dxgi_format;
    uint32_t vulkan_format;
    bool is_srgb = false;
    Alpha alpha = Alpha::straight;
};

constexpr DxgiRow kDxgiFormats[] = {
    {2, 109}, // R32G32B32A32_FLOAT
    {6, 106}, // R32G32B32_FLOAT
    {10, 97}, // R16G16B16A16_FLOAT, UNORM, SNORM
    {11, 91},
    {13, 92},
    {16, 103}, // R32G32_FLOAT
    {24, 64},  // R10G10B10A2_UNORM
    {26, 122}, // R11G11B10_FLOAT
    {28, 37},  // R8G8B8A8_UNORM, UNORM_SRGB, SNORM
    {29, 43, true},
    {31, 38},
    {34, 83}, // R16G16_FLOAT, UNORM, SNORM
    {35, 77},
    {37, 78},
    {41, 100}, // R32_FLOAT
    {49, 16},  // R8G8_UNORM, SNORM
    {51, 17},
    {54, 76}, // R16_FLOAT, UNORM, SNORM
    {56, 70},
    {58, 71},
    {61, 9}, // R8_UNORM, SNORM
    {63, 10},
    {65, 1000470001}, // A8_UNORM
    {67, 123},        // R9G9B9E5_SHAREDEXP
    {71, 133},        // BC1_UNORM, UNORM_SRGB, and so on
    {72, 134, true},
    {74, 135},
    {75, 136, true},
    {77, 137},
    {78, 138, true},
    {80, 139}, // BC4_UNORM, SNORM
    {81, 140},
    {83, 141}, // BC5_UNORM, SNORM
    {84, 142},
    {85, 4},  // B5G6R5_UNORM
    {86, 8},  // B5G5R5A1_UNORM
    {87, 44}, // B8G8R8A8_UNORM, B8G8R8X8_UNORM, the same in sRGB
    {88, 44, false, Alpha::opaque},
    {91, 50, true},
    {93, 50, true, Alpha::opaque},
    {95, 143}, // BC6H_UF16, SF16
    {96, 144},
    {98, 145}, // BC7_UNORM, UNORM_SRGB
    {99, 146, true},
    {115, 1000340000}, // B4G4R4A4_UNORM
};

/// Return the channel of a mask; nullopt if its bits are not in a row, or more than 16.
std::optional<ChannelBits> channelFrom(uint32_t mask)
{
    if (mask == 0)
        return ChannelBits{};
    const int first = std::countr_zero(mask), count = std::popcount(mask);
    if (count > 16 || mask >> first != (1u << count) - 1)
        return std::nullopt;
    return ChannelBits{static_cast<uint8_t>(first), static_cast<uint8_t>(count)};
}

/// Return the layout that the masks of a legacy format describe.
Result<DdsFormat> readMasks(const EncodedImage& source, const DdsHeader& header)
{
    const uint32_t bits = header.bit_count;
    if (bits != 8 && bits != 16 && bits != 24 && bits != 32)
        return source.malformed("DDS: " + std::to_string(bits) + " bits for a texel");
    const bool is_grey = (header.format_flags & kFormatIsLuminance) != 0;
    const bool is_rgb = (header.format_flags & kFormatIsRgb) != 0;
    const bool has_alpha = (header.format_flags & (kFormatHasAlpha | kFormatIsAlpha)) != 0;
    DdsFormat format{{nullptr, {ChannelCoding::unorm, static_cast<uint8_t>(bits / 8), {}}}};
    for (size_t c = 0; c < 4; ++c)
    {
        const bool is_used = c == 3 ? has_alpha : is_grey || is_rgb;
        const uint32_t mask = is_used ? header.masks[c < 3 && is_grey ? 0 : c] : 0u;
        const auto channel = channelFrom(mask);
        if (!channel || (uint64_t{mask} >> bits) != 0)
            return source.malformed("DDS: the masks of the channels are damaged");
        format.stored.plain.channels[c] = *channel;
    }
    const auto& channels = format.stored.plain.channels;
    if (std::all_of(channels.begin(), channels.end(), [](ChannelBits channel) { return channel.count == 0; }))
        return source.malformed("DDS: no channel has a mask");
    return format;
}

Result<DdsFormat> readLegacyFormat(const EncodedImage& source, const DdsHeader& header)
{
    if ((header.format_flags & kFormatHasCode) != 0)
    {
        const auto* const row = std::find_if(std::begin(kCodes), std::end(kCodes),
                                             [&](const CodeRow& r) { return r.code == header.code; });
        if (row != std::end(kCodes))
            return DdsFormat{*findStoredFormat(row->vulkan_format), row->alpha};
        return source.unsupported("DDS: pixel format code " + std::to_string(header.code) + " is not read");
    }
    if ((header.format_flags & (kFormatIsRgb | kFormatIsLuminance | kFormatIsAlpha)) != 0)
        return readMasks(source, header);
    return source.unsupported("DDS: pixel formats with flags " + std::to_string(header.format_flags) +
                              " (palettes, YUV, bump maps) are not read");
}

Alpha readAlpha(uint32_t alpha_mode)
{
    switch (alpha_mode & 7u)
    {
    case 2:
        return Alpha::premultiplied;
    case 3:
        return Alpha::opaque;
    case 4:
        return Alpha::custom;
    default:
        return Alpha::straight;
    }
}

Result<DdsFormat> readDx10Format(const EncodedImage& source, const Dx10Header& header)
{
    const auto* const row = std::find_if(std::begin(kDxgiFormats), std::end(kDxgiFormats),
                                         [&](const DxgiRow& r) { return r.dxgi_format == header.format; });
    if (row == std::end(kDxgiFormats))
        return source.unsupported("DDS: DXGI format " + std::to_string(header.format) + " is not read");
    const Alpha alpha = row->alpha == Alpha::opaque ? Alpha::opaque : readAlpha(header.alpha_mode);
    return DdsFormat{*findStoredFormat(row->vulkan_format), alpha, row->is_srgb};
}

/// Check that the texture is one image. dx10  null: there is no such header
Status checkDimensions(const EncodedImage& source, const DdsHeader& header, const Dx10Header* dx10)
{
    if ((header.caps[1] & kCaps2Cube) != 0 || (dx10 != nullptr && (dx10->flags & kDx10Cube) != 0))
        return source.unsupported("DDS: a cube map is not an image: save the face that is meant as one");
    if ((header.caps[1] & kCaps2Volume) != 0 || (dx10 != nullptr && dx10->dimension == kDimensionTexture3d))
        return source.unsupported("DDS: a volume is not an image: save the slice that is meant as one");
    if (dx10 != nullptr && dx10->dimension != kDimensionTexture2d)
        return source.unsupported("DDS: resource dimension " + std::to_string(dx10->dimension) +
                                  " is not that of an image");
    if (dx10 != nullptr && dx10->layer_count > 1)
        return source.unsupported("DDS: an array of " + std::to_string(dx10->layer_count) +
                                  " layers is not an image: save the layer that is meant as one");
    return checkImageSize(source, header.width, header.height);
}

/// Make alpha opacity, or drop it.
void applyAlpha(Alpha alpha, DecodedImage& image)
{
    if (alpha == Alpha::premultiplied)
        straightenAlpha(image);
    if (alpha == Alpha::opaque || alpha == Alpha::custom)
        dropAlpha(image);
    if (alpha == Alpha::custom)
        image.notes.push_back({Issue::image_alpha,
                               "alpha is not opacity, as the alpha mode of the DDS says: it is "
                               "not kept"});
}

} // namespace

Result<DecodedImage> decodeDds(const EncodedImage& source)
{
    ByteReader reader(source.bytes);
    const auto header = reader.read<DdsHeader>();
    if (!header)
        return source.malformed("DDS: the file ends in the header");
    if (header->size != kHeaderSize || header->format_size != kFormatSize)
        return source.malformed("DDS: the header is damaged");
    std::optional<Dx10Header> dx10;
    if ((header->format_flags & kFormatHasCode) != 0 && header->code == fourCc("DX10"))
    {
        dx10 = reader.read<Dx10Header>();
        if (!dx10)
            return source.malformed("DDS: the file ends in the header");
    }
    HEARTH_TRY(checkDimensions(source, *header, dx10 ? &*dx10 : nullptr));
    HEARTH_ASSIGN_OR_RETURN(const DdsFormat format,
                            dx10 ? readDx10Format(source, *dx10) : readLegacyFormat(source, *header));
    const auto texels = reader.readBytes(format.stored.levelBytes(header->width, header->height));
    if (!texels)
        return source.malformed("DDS: the file ends before its image does");
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image,
                            decodeStored(source, {format.stored, header->width, header->height, *texels}));
    applyAlpha(format.alpha, image);
    image.transfer = format.is_srgb ? Transfer::srgb : Transfer::unsaid;
    return image;
}

} // namespace hearth::import
