// Decodes KTX2 images: uncompressed formats, Zstandard supercompression, and Basis Universal. Only the finest
// level is decoded, because hearth-textures makes the mips. GPU block formats (BC, ETC2, ASTC) are not
// supported.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/half.h"
#include "formats/container/container_reader.h"
#include "pipelines/import/images/basis_etc1s.h"
#include "pipelines/import/images/basis_uastc.h"
#include "pipelines/import/images/ktx2_container.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

namespace hearth::import
{

namespace
{

enum class Component : uint8_t
{
    unorm8,
    unorm16,
    float16,
    float32,
};

/// Memory layout of an uncompressed VkFormat.
struct TexelLayout
{
    uint32_t vk_format;
    Component component;
    uint8_t channels;
    bool blue_first = false;
};

// Numbers of VkFormat. sRGB formats are laid out as their UNORM counterparts: the use of an image decides its
// colour space, not its format.
constexpr std::array kLayouts = {
    TexelLayout{9, Component::unorm8, 1},        TexelLayout{15, Component::unorm8, 1},
    TexelLayout{16, Component::unorm8, 2},       TexelLayout{22, Component::unorm8, 2},
    TexelLayout{23, Component::unorm8, 3},       TexelLayout{29, Component::unorm8, 3},
    TexelLayout{30, Component::unorm8, 3, true}, TexelLayout{36, Component::unorm8, 3, true},
    TexelLayout{37, Component::unorm8, 4},       TexelLayout{43, Component::unorm8, 4},
    TexelLayout{44, Component::unorm8, 4, true}, TexelLayout{50, Component::unorm8, 4, true},
    TexelLayout{70, Component::unorm16, 1},      TexelLayout{77, Component::unorm16, 2},
    TexelLayout{84, Component::unorm16, 3},      TexelLayout{91, Component::unorm16, 4},
    TexelLayout{76, Component::float16, 1},      TexelLayout{83, Component::float16, 2},
    TexelLayout{90, Component::float16, 3},      TexelLayout{97, Component::float16, 4},
    TexelLayout{100, Component::float32, 1},     TexelLayout{103, Component::float32, 2},
    TexelLayout{106, Component::float32, 3},     TexelLayout{109, Component::float32, 4},
};

uint32_t componentBytes(Component component)
{
    return component == Component::unorm8 ? 1 : component == Component::float32 ? 4 : 2;
}

ChannelType channelType(Component component)
{
    switch (component)
    {
    case Component::unorm8:
        return ChannelType::unorm8;
    case Component::unorm16:
        return ChannelType::unorm16;
    case Component::float16:
    case Component::float32:
        break;
    }
    return ChannelType::float16;
}

/// Convert one stored component to the image's form: 8 or 16 bits, or the bits of a half.
uint16_t convert(const uint8_t* bytes, Component component)
{
    uint16_t word = 0;
    float value = 0;
    switch (component)
    {
    case Component::unorm8:
        return bytes[0];
    case Component::unorm16:
        std::memcpy(&word, bytes, sizeof(word));
        return word;
    case Component::float16:
        std::memcpy(&word, bytes, sizeof(word));
        return halfFromFloat(floatFromHalf(word));
    case Component::float32:
        std::memcpy(&value, bytes, sizeof(value));
        return halfFromFloat(value);
    }
    return 0;
}

/// True if all floats are halves, too.
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

void copyTexels(std::span<const std::byte> bytes, const TexelLayout& layout, DecodedImage& image)
{
    const auto* in = reinterpret_cast<const uint8_t*>(bytes.data());
    const uint32_t step = componentBytes(layout.component);
    const uint16_t one = image.type == ChannelType::unorm8    ? uint16_t{255}
                         : image.type == ChannelType::unorm16 ? uint16_t{65535}
                                                              : halfFromFloat(1);
    const size_t count = size_t{image.width} * image.height;
    for (size_t i = 0; i < count; ++i)
    {
        std::array<uint16_t, 4> texel = {0, 0, 0, one};
        for (size_t c = 0; c < layout.channels; ++c, in += step)
            texel[c] = convert(in, layout.component);
        if (layout.blue_first)
            std::swap(texel[0], texel[2]);
        // one channel is grey; two channels are red and green: KTX2 cannot name formats of grey with alpha
        if (layout.channels == 1)
            texel[1] = texel[2] = texel[0];
        if (image.type != ChannelType::unorm8)
            std::memcpy(image.texels.data() + i * sizeof(texel), texel.data(), sizeof(texel));
        else
            std::transform(texel.begin(), texel.end(), imageBytes(image) + i * 4,
                           [](uint16_t c) { return static_cast<uint8_t>(c); });
    }
}

/// Block of texels of a format; a texel of an uncompressed format is a block of side 1.
struct BlockSize
{
    uint32_t side;
    uint64_t bytes;

    uint64_t levelBytes(uint32_t width, uint32_t height) const
    {
        return ((uint64_t{width} + side - 1) / side) * ((uint64_t{height} + side - 1) / side) * bytes;
    }
};

/// True if all levels have the size of the format, and each level without supercompression starts on a
/// multiple of 4 and of the block size.
bool levelsFit(const EncodedImage& source, const Ktx2File& file, BlockSize block)
{
    const uint64_t alignment = std::lcm(block.bytes, uint64_t{4});
    for (size_t i = 0; i < file.levels.size(); ++i)
    {
        const Ktx2Level& level = file.levels[i];
        const auto offset = static_cast<uint64_t>(level.bytes.data() - source.bytes.data());
        if (level.uncompressed_size !=
            block.levelBytes(std::max(1u, file.width >> i), std::max(1u, file.height >> i)))
            return false;
        if (file.scheme == Ktx2Scheme::none &&
            (level.bytes.size() != level.uncompressed_size || offset % alignment != 0))
            return false;
    }
    return true;
}

/// Return the finest level, decompressed.
Result<std::vector<std::byte>> readFinestLevel(const EncodedImage& source, const Ktx2File& file,
                                               BlockSize block)
{
    if (!levelsFit(source, file, block))
        return source.malformed("KTX2: a mip level does not have the size or place that the format asks for");
    const Ktx2Level& level = file.levels[0];
    if (file.scheme == Ktx2Scheme::none)
        return std::vector<std::byte>(level.bytes.begin(), level.bytes.end());
    if (file.scheme != Ktx2Scheme::zstd)
        return source.unsupported("KTX2: ZLIB supercompression is not read");
    // before memory is allocated for what the level claims
    if (!formats::isSingleFrame(level.bytes, level.uncompressed_size))
        return source.malformed("KTX2: the Zstandard data is damaged");
    std::vector<std::byte> texels(static_cast<size_t>(level.uncompressed_size));
    if (!formats::decompress(level.bytes, texels))
        return source.malformed("KTX2: the Zstandard data is damaged");
    return texels;
}

Result<DecodedImage> decodeUncompressed(const EncodedImage& source, const Ktx2File& file,
                                        const TexelLayout& layout)
{
    const BlockSize texel{1, uint64_t{layout.channels} * componentBytes(layout.component)};
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> texels, readFinestLevel(source, file, texel));
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image,
                            allocateImage(source, file.width, file.height, channelType(layout.component)));
    copyTexels(texels, layout, image);
    if (layout.component == Component::float32 && !fitHalves(texels))
        image.notes.push_back({Issue::image_depth, "its channels are floats of 32 bits, 16 are kept"});
    return image;
}

/// Check glTF's requirement for the size of Basis Universal textures.
Status checkBasisSize(const EncodedImage& source, const Ktx2File& file)
{
    if (file.width % 4 == 0 && file.height % 4 == 0)
        return success();
    return source.malformed("KTX2: KHR_texture_basisu asks for sizes that are multiples of 4, this is " +
                            std::to_string(file.width) + " x " + std::to_string(file.height));
}

Result<DecodedImage> decodeUastcImage(const EncodedImage& source, const Ktx2File& file)
{
    HEARTH_TRY(checkBasisSize(source, file));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> blocks,
                            readFinestLevel(source, file, {4, kUastcBlockBytes}));
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image,
                            allocateImage(source, file.width, file.height, ChannelType::unorm8));
    if (!decodeUastc(blocks, file.is_srgb, image))
        return source.malformed("KTX2: UASTC: a block is damaged");
    return image;
}

Result<DecodedImage> decodeEtc1s(const EncodedImage& source, const Ktx2File& file)
{
    HEARTH_TRY(checkBasisSize(source, file));
    const bool sizes_zero = std::all_of(file.levels.begin(), file.levels.end(),
                                        [](const Ktx2Level& level) { return level.uncompressed_size == 0; });
    if (!sizes_zero || file.color_model != kModelEtc1s || file.sample_channels.size() > 2)
        return source.malformed("KTX2: BasisLZ needs one or two ETC1S samples and no uncompressed sizes");
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image,
                            allocateImage(source, file.width, file.height, ChannelType::unorm8));
    const std::string_view problem =
        decodeBasisEtc1s(file.global_data, file.levels[0].bytes,
                         {static_cast<uint32_t>(file.levels.size()), file.sample_channels}, image);
    if (!problem.empty())
        return source.malformed("KTX2: ETC1S: " + std::string(problem));
    return image;
}

} // namespace

Result<DecodedImage> decodeKtx2(const EncodedImage& source)
{
    HEARTH_ASSIGN_OR_RETURN(const Ktx2File file, readKtx2(source));
    if (file.scheme == Ktx2Scheme::basis_lz)
        return decodeEtc1s(source, file);
    if (file.vk_format == 0 && file.color_model == kModelUastc)
        return decodeUastcImage(source, file);
    const auto layout = std::find_if(kLayouts.begin(), kLayouts.end(),
                                     [&](const TexelLayout& l) { return l.vk_format == file.vk_format; });
    if (layout == kLayouts.end())
        return source.unsupported("KTX2: VkFormat " + std::to_string(file.vk_format) + " with colour model " +
                                  std::to_string(file.color_model) + " is not read");
    return decodeUncompressed(source, file, *layout);
}

} // namespace hearth::import
