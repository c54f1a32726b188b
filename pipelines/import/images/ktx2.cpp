// Decodes KTX2 images: the formats that devices sample, plain or compressed, supercompression by Zstandard or
// zlib, and Basis Universal. Only the finest level is decoded, because hearth-textures makes the mips.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/container/container_reader.h"
#include "pipelines/import/images/basis_etc1s.h"
#include "pipelines/import/images/basis_uastc.h"
#include "pipelines/import/images/channels.h"
#include "pipelines/import/images/float_image.h"
#include "pipelines/import/images/ktx2_container.h"
#include "pipelines/import/images/stored_image.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

namespace hearth::import
{

namespace
{

/// True if all levels have the size of the format, and each level without supercompression starts on a
/// multiple of 4 and of the block size.
bool levelsFit(const EncodedImage& source, const Ktx2File& file, const StoredFormat& format)
{
    const uint64_t alignment = std::lcm(uint64_t{format.blockBytes()}, uint64_t{4});
    for (size_t i = 0; i < file.levels.size(); ++i)
    {
        const Ktx2Level& level = file.levels[i];
        const auto offset = static_cast<uint64_t>(level.bytes.data() - source.bytes.data());
        if (level.uncompressed_size !=
            file.faces * format.levelBytes(std::max(1u, file.width >> i), std::max(1u, file.height >> i)))
            return false;
        if (file.scheme == Ktx2Scheme::none &&
            (level.bytes.size() != level.uncompressed_size || offset % alignment != 0))
            return false;
    }
    return true;
}

/// Decompress data that must be exactly one zlib stream.
bool inflate(std::span<const std::byte> stored, std::span<std::byte> out)
{
    auto size = static_cast<uLongf>(out.size());
    auto stored_size = static_cast<uLong>(stored.size());
    return ::uncompress2(reinterpret_cast<Bytef*>(out.data()), &size,
                         reinterpret_cast<const Bytef*>(stored.data()), &stored_size) == Z_OK &&
           size == out.size() && stored_size == stored.size();
}

/// Bytes of a level: in the file, or decompressed.
struct LevelBytes
{
    std::span<const std::byte> bytes;
    std::vector<std::byte> decompressed{};
};

/// Return the finest level, decompressed.
Result<LevelBytes> readFinestLevel(const EncodedImage& source, const Ktx2File& file,
                                   const StoredFormat& format)
{
    if (!levelsFit(source, file, format))
        return source.malformed("KTX2: a mip level does not have the size or place that the format asks for");
    const Ktx2Level& level = file.levels[0];
    if (file.scheme == Ktx2Scheme::none)
        return LevelBytes{level.bytes};
    const bool is_zstd = file.scheme == Ktx2Scheme::zstd;
    const auto damaged = [&]
    {
        return source.malformed(is_zstd ? "KTX2: the Zstandard data is damaged"
                                        : "KTX2: the zlib data is damaged");
    };
    // before memory is allocated for what the level claims
    if (is_zstd ? !formats::isSingleFrame(level.bytes, level.uncompressed_size)
                : level.uncompressed_size / kMaxDeflateRatio > level.bytes.size())
        return damaged();
    LevelBytes read{{}, std::vector<std::byte>(static_cast<size_t>(level.uncompressed_size))};
    if (is_zstd ? !formats::decompress(level.bytes, read.decompressed)
                : !inflate(level.bytes, read.decompressed))
        return damaged();
    read.bytes = read.decompressed;
    return read;
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
    // blocks of the same size as those of ASTC 4x4
    const StoredFormat format{&formats::texelTraits(formats::TexelFormat::astc_unorm), {}};
    static_assert(kUastcBlockBytes == 16);
    HEARTH_ASSIGN_OR_RETURN(const LevelBytes level, readFinestLevel(source, file, format));
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image,
                            allocateImage(source, file.width, file.height, ChannelType::unorm8));
    if (!decodeUastc(level.bytes, file.transfer == Transfer::srgb, image))
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

Result<DecodedImage> decodeTexels(const EncodedImage& source, const Ktx2File& file)
{
    if (file.scheme == Ktx2Scheme::basis_lz)
        return decodeEtc1s(source, file);
    if (file.vk_format == 0 && file.color_model == kModelUastc)
        return decodeUastcImage(source, file);
    const auto format = findStoredFormat(file.vk_format);
    if (!format)
        return source.unsupported("KTX2: VkFormat " + std::to_string(file.vk_format) + " with colour model " +
                                  std::to_string(file.color_model) + " is not read");
    HEARTH_ASSIGN_OR_RETURN(const LevelBytes level, readFinestLevel(source, file, *format));
    return decodeStored(source, {*format, file.width, file.height, level.bytes, file.swizzle});
}

/// Put the rows from top to bottom, and the columns from left to right.
void turn(const Ktx2File& file, DecodedImage& image)
{
    const size_t texel_bytes = image.texelBytes(), row_bytes = image.width * texel_bytes;
    std::byte* const texels = image.texels.data();
    if (file.is_bottom_up)
        for (size_t y = 0; y < image.height / 2; ++y)
            std::swap_ranges(texels + y * row_bytes, texels + (y + 1) * row_bytes,
                             texels + (image.height - 1 - y) * row_bytes);
    if (file.is_mirrored)
        for (size_t y = 0; y < image.height; ++y)
            for (size_t x = 0; x < image.width / 2; ++x)
                std::swap_ranges(texels + y * row_bytes + x * texel_bytes,
                                 texels + y * row_bytes + (x + 1) * texel_bytes,
                                 texels + y * row_bytes + (image.width - 1 - x) * texel_bytes);
}

} // namespace

Result<DecodedImage> decodeKtx2(const EncodedImage& source)
{
    HEARTH_ASSIGN_OR_RETURN(const Ktx2File file, readKtx2(source));
    HEARTH_ASSIGN_OR_RETURN(DecodedImage image, decodeTexels(source, file));
    turn(file, image);
    if (file.is_premultiplied)
        straightenAlpha(image);
    image.transfer = file.transfer;
    return image;
}

Result<FloatImage> decodeKtx2Floats(const EncodedImage& source)
{
    HEARTH_ASSIGN_OR_RETURN(const Ktx2File file, readKtx2(source, Ktx2Kind::image_or_cube));
    const auto format = findStoredFormat(file.vk_format);
    if (!format || !format->hasFloats())
        return source.unsupported("KTX2: VkFormat " + std::to_string(file.vk_format) + " has no floats");
    if (file.is_mirrored || file.is_bottom_up)
        return source.unsupported("KTX2: floats are read with KTXorientation rd alone");
    HEARTH_ASSIGN_OR_RETURN(const LevelBytes level, readFinestLevel(source, file, *format));
    FloatImage image{file.width, file.height, file.faces, {}};
    const size_t face_bytes = level.bytes.size() / file.faces;
    for (uint32_t face = 0; face < file.faces; ++face)
    {
        const StoredImage stored{*format, file.width, file.height,
                                 level.bytes.subspan(face * face_bytes, face_bytes), file.swizzle};
        HEARTH_ASSIGN_OR_RETURN(const std::vector<Float3> texels, decodeStoredFloats(source, stored));
        image.texels.insert(image.texels.end(), texels.begin(), texels.end());
    }
    return image;
}

} // namespace hearth::import
