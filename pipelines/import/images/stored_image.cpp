// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/stored_image.h"

#include "formats/base/assert.h"
#include "formats/base/half.h"
#include "formats/texels/decode_texels.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace hearth::import
{

namespace
{

using formats::DecodedTexel;

constexpr uint16_t kUnormOne = 0xFFFF;

/// Return the bits of a channel in a texel.
uint32_t readBits(std::span<const std::byte> texel, ChannelBits bits)
{
    const size_t first_byte = bits.first / 8u;
    uint64_t word = 0;
    std::memcpy(&word, texel.data() + first_byte, std::min(sizeof(word), texel.size() - first_byte));
    return static_cast<uint32_t>(word >> (bits.first % 8u) & ((uint64_t{1} << bits.count) - 1));
}

/// Return the nearest of 0 to 65535.
uint16_t widenUnorm(uint32_t value, uint32_t bits)
{
    const uint32_t max = (1u << bits) - 1;
    return static_cast<uint16_t>((uint64_t{value} * kUnormOne + max / 2) / max);
}

/// Return a number from -max to max, or below, as one of 0 to 65535.
uint16_t unormFromSnorm(int32_t value, int32_t max)
{
    const int64_t shifted = int64_t{std::max(value, -max)} + max;
    return static_cast<uint16_t>((shifted * kUnormOne + max) / (2 * int64_t{max}));
}

uint16_t unormFromSnormBits(uint32_t value, uint32_t bits)
{
    const uint32_t sign = 1u << (bits - 1);
    const auto number =
        static_cast<int32_t>(value) - ((value & sign) != 0 ? static_cast<int32_t>(2 * sign) : 0);
    return unormFromSnorm(number, static_cast<int32_t>(sign - 1));
}

/// Return the finite half of a float of 32, 16, 11 or 10 bits.
uint16_t halfFromBits(uint32_t value, uint32_t bits)
{
    if (bits == 32)
        return halfFromFloat(std::bit_cast<float>(value));
    // floats of 11 and 10 bits are halves without sign and without the last bits
    const uint32_t shift = bits == 16 ? 0 : 15 - bits;
    return halfFromFloat(floatFromHalf(static_cast<uint16_t>(value << shift)));
}

uint16_t convert(uint32_t value, uint32_t bits, ChannelCoding coding)
{
    switch (coding)
    {
    case ChannelCoding::unorm:
        return widenUnorm(value, bits);
    case ChannelCoding::snorm:
        return unormFromSnormBits(value, bits);
    case ChannelCoding::float_value:
        break;
    }
    return halfFromBits(value, bits);
}

/// True if all floats of 32 bits are halves, too.
bool fitHalves(std::span<const std::byte> floats)
{
    for (size_t at = 0; at + sizeof(float) <= floats.size(); at += sizeof(float))
    {
        float value = 0;
        std::memcpy(&value, floats.data() + at, sizeof(value));
        if (floatFromHalf(halfFromFloat(value)) != value)
            return false;
    }
    return true;
}

/// Return the type that holds all numbers of a format. Compressed formats of one and two channels have more
/// than 8 bits; the others were made from 8.
ChannelType channelType(const StoredFormat& format)
{
    if (format.hasFloats())
        return ChannelType::float16;
    const bool is_small = format.traits != nullptr
                              ? format.traits->channels > 2
                              : format.plain.coding == ChannelCoding::unorm &&
                                    std::all_of(format.plain.channels.begin(), format.plain.channels.end(),
                                                [](ChannelBits bits) { return bits.count <= 8; });
    return is_small ? ChannelType::unorm8 : ChannelType::unorm16;
}

bool isFloat32(const StoredFormat& format)
{
    return format.traits == nullptr && format.plain.channels[0].count == 32;
}

bool hasOnlyRed(const StoredFormat& format)
{
    if (format.traits != nullptr)
        return format.traits->channels == 1;
    const auto& channels = format.plain.channels;
    return channels[0].count != 0 && channels[1].count == 0 && channels[3].count == 0;
}

/// Converts rows of blocks to texels of 16 bits a channel: numbers from 0 on, or finite halves.
class RowDecoder
{
public:
    RowDecoder(const StoredImage& stored)
        : stored_(stored),
          one_(stored.format.hasFloats() ? kHalfOne : kUnormOne),
          copies_red_(stored.swizzle.empty() && hasOnlyRed(stored.format))
    {
    }

    /// Decode the texels of a row of blocks.
    void decode(std::span<const std::byte> blocks, std::span<DecodedTexel> texels) const
    {
        if (stored_.format.traits == nullptr)
            decodePlain(blocks, texels);
        else
            decodeBlocks(*stored_.format.traits, blocks, texels);
        if (!stored_.swizzle.empty())
            for (DecodedTexel& texel : texels)
                texel = swizzle(texel);
        if (copies_red_)
            for (DecodedTexel& texel : texels)
                texel[1] = texel[2] = texel[0];
    }

private:
    void decodePlain(std::span<const std::byte> bytes, std::span<DecodedTexel> texels) const
    {
        const PlainLayout& layout = stored_.format.plain;
        for (size_t i = 0; i < texels.size(); ++i)
        {
            const auto bits = bytes.subspan(i * layout.texel_bytes, layout.texel_bytes);
            texels[i] = {0, 0, 0, one_};
            for (size_t c = 0; c < 4; ++c)
                if (const ChannelBits channel = layout.channels[c]; channel.count != 0)
                    texels[i][c] = convert(readBits(bits, channel), channel.count, layout.coding);
        }
    }

    void decodeBlocks(const formats::TexelFormatTraits& traits, std::span<const std::byte> blocks,
                      std::span<DecodedTexel> texels) const
    {
        formats::decodeBlockRow(traits, stored_.width, static_cast<uint32_t>(texels.size() / stored_.width),
                                blocks, texels);
        for (DecodedTexel& texel : texels)
            for (size_t c = 0; c < traits.channels; ++c)
                if (traits.coding == formats::TexelCoding::snorm)
                    texel[c] = unormFromSnorm(static_cast<int16_t>(texel[c]), INT16_MAX);
                else if (traits.coding == formats::TexelCoding::float_value)
                    texel[c] = halfFromBits(texel[c], 16);
    }

    DecodedTexel swizzle(const DecodedTexel& texel) const
    {
        DecodedTexel swizzled;
        for (size_t c = 0; c < 4; ++c)
        {
            const char from = stored_.swizzle[c];
            const size_t source = std::string_view("rgba").find(from);
            swizzled[c] = source != std::string_view::npos ? texel[source] : from == '1' ? one_ : uint16_t{0};
        }
        return swizzled;
    }

    const StoredImage& stored_;
    uint16_t one_;
    bool copies_red_;
};

void store(std::span<const DecodedTexel> texels, ChannelType type, std::span<std::byte> out)
{
    if (type != ChannelType::unorm8)
    {
        std::memcpy(out.data(), texels.data(), texels.size_bytes());
        return;
    }
    for (size_t i = 0; i < texels.size(); ++i)
        for (size_t c = 0; c < 4; ++c)
            out[4 * i + c] = std::byte{formats::narrowUnorm(texels[i][c])};
}

} // namespace

Result<DecodedImage> decodeStored(const EncodedImage& source, const StoredImage& stored)
{
    HEARTH_ASSERT(stored.bytes.size() == stored.format.levelBytes(stored.width, stored.height));
    HEARTH_ASSERT(stored.swizzle.empty() || stored.swizzle.size() == 4);
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image,
                            allocateImage(source, stored.width, stored.height, channelType(stored.format)));
    const RowDecoder decoder(stored);
    const uint32_t step = stored.format.blockHeight();
    const auto row_bytes = static_cast<size_t>(stored.format.levelBytes(stored.width, 1));
    std::vector<DecodedTexel> texels(size_t{stored.width} * step);
    for (uint32_t y = 0; y < stored.height; y += step)
    {
        const size_t count = size_t{stored.width} * std::min(step, stored.height - y);
        const auto rows = std::span(texels).first(count);
        decoder.decode(stored.bytes.subspan(y / step * row_bytes, row_bytes), rows);
        store(rows, image.type,
              std::span(image.texels).subspan(size_t{y} * stored.width * image.texelBytes()));
    }
    if (isFloat32(stored.format) && !fitHalves(stored.bytes))
        image.notes.push_back({Issue::image_depth, "its channels are floats of 32 bits, 16 are kept"});
    return image;
}

Result<std::vector<Float3>> decodeStoredFloats(const EncodedImage& source, const StoredImage& stored)
{
    HEARTH_ASSERT(stored.format.hasFloats());
    std::vector<Float3> texels(size_t{stored.width} * stored.height);
    if (!isFloat32(stored.format))
    {
        HEARTH_ASSIGN_OR_RETURN(const DecodedImage image, decodeStored(source, stored));
        for (size_t i = 0; i < texels.size(); ++i)
        {
            DecodedTexel texel;
            std::memcpy(texel.data(), image.texels.data() + i * sizeof(texel), sizeof(texel));
            texels[i] = {floatFromHalf(texel[0]), floatFromHalf(texel[1]), floatFromHalf(texel[2])};
        }
        return texels;
    }
    HEARTH_TRY(checkImageSize(source, stored.width, stored.height));
    const std::string_view swizzle = !stored.swizzle.empty()     ? stored.swizzle
                                     : hasOnlyRed(stored.format) ? std::string_view("rrr1")
                                                                 : std::string_view("rgba");
    const PlainLayout& layout = stored.format.plain;
    for (size_t i = 0; i < texels.size(); ++i)
    {
        const auto bits = stored.bytes.subspan(i * layout.texel_bytes, layout.texel_bytes);
        for (size_t c = 0; c < 3; ++c)
        {
            const size_t from = std::string_view("rgba").find(swizzle[c]);
            float& value = texels[i][static_cast<int>(c)];
            if (from == std::string_view::npos)
                value = swizzle[c] == '1' ? 1.0f : 0.0f;
            else if (layout.channels[from].count != 0)
                value = std::bit_cast<float>(readBits(bits, layout.channels[from]));
            else
                value = from == 3 ? 1.0f : 0.0f;
        }
    }
    return texels;
}

} // namespace hearth::import
