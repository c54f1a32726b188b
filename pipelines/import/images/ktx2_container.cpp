// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/ktx2_container.h"

#include "formats/base/byte_reader.h"

#include <algorithm>
#include <bit>

namespace hearth::import
{

namespace
{

struct Ktx2Header
{
    uint8_t identifier[12];
    uint32_t vk_format;
    uint32_t type_size;
    uint32_t width;
    uint32_t height;
    uint32_t depth;
    uint32_t layer_count;
    uint32_t face_count;
    uint32_t level_count;
    uint32_t scheme;
    uint32_t descriptor_offset;
    uint32_t descriptor_size;
    uint32_t key_value_offset;
    uint32_t key_value_size;
    uint32_t global_data_words[4]; ///< offset and size as 64-bit numbers, which would not be aligned here

    uint64_t globalOffset() const { return global_data_words[0] | uint64_t{global_data_words[1]} << 32; }
    uint64_t globalSize() const { return global_data_words[2] | uint64_t{global_data_words[3]} << 32; }
};
static_assert(sizeof(Ktx2Header) == 80);

struct LevelIndex
{
    uint64_t offset;
    uint64_t size;
    uint64_t uncompressed_size;
};

constexpr uint32_t kDescriptorHeaderBytes = 24; ///< size of the basic descriptor block before its samples
constexpr uint32_t kSampleBytes = 16;
constexpr uint8_t kTransferLinear = 1;
constexpr uint8_t kTransferSrgb = 2;
constexpr uint8_t kFlagPremultiplied = 1;

bool hasGlobalData(uint32_t scheme)
{
    return scheme == static_cast<uint32_t>(Ktx2Scheme::basis_lz);
}

constexpr const char* kCubeMap = "KTX2: a cube map is not an image: save the face that is meant as one";

Status checkDimensions(const EncodedImage& source, const Ktx2Header& header, Ktx2Kind kind)
{
    if (header.face_count == 6 && kind == Ktx2Kind::image)
        return source.unsupported(kCubeMap);
    if (header.depth != 0)
        return source.unsupported("KTX2: a volume is not an image: save the slice that is meant as one");
    if (header.layer_count > 1)
        return source.unsupported("KTX2: an array of " + std::to_string(header.layer_count) +
                                  " layers is not an image: save the layer that is meant as one");
    if (header.height == 0)
        return source.unsupported("KTX2: a line is not an image: save it with a height of 1");
    return success();
}

Status checkHeader(const EncodedImage& source, const Ktx2Header& header, Ktx2Kind kind)
{
    const auto wrong = [&](const char* what) { return source.malformed(std::string("KTX2: ") + what); };
    if (header.width == 0)
        return wrong("pixelWidth is 0");
    if (header.face_count != 1 && header.face_count != 6)
        return wrong("faceCount is neither 1 nor 6");
    if (header.face_count == 6 && (header.width != header.height || header.depth != 0))
        return wrong("a cube map needs square faces and no depth");
    const uint32_t largest = std::max({header.width, header.height, header.depth});
    if (header.level_count > static_cast<uint32_t>(std::bit_width(largest)))
        return wrong("levelCount is more than the size allows");
    if (header.scheme > static_cast<uint32_t>(Ktx2Scheme::zlib))
        return source.unsupported("KTX2: supercompression scheme " + std::to_string(header.scheme) +
                                  " is not known");
    if (header.scheme == static_cast<uint32_t>(Ktx2Scheme::basis_lz) && header.vk_format != 0)
        return wrong("BasisLZ needs vkFormat 0");
    if (header.descriptor_size == 0)
        return wrong("the data format descriptor is missing");
    if (header.key_value_size == 0 && header.key_value_offset != 0)
        return wrong("kvdByteOffset without kvdByteLength");
    if (header.globalSize() == 0 && header.globalOffset() != 0)
        return wrong("sgdByteOffset without sgdByteLength");
    if ((header.globalSize() != 0) != hasGlobalData(header.scheme))
        return wrong("supercompression global data is missing or out of place");
    HEARTH_TRY(checkDimensions(source, header, kind));
    return checkImageSize(source, header.width, header.height);
}

Transfer transferFrom(uint8_t number)
{
    return number == kTransferSrgb     ? Transfer::srgb
           : number == kTransferLinear ? Transfer::linear
                                       : Transfer::unsaid;
}

/// Read the basic block of the data format descriptor: colour model, transfer function, flags and channels.
bool readDescriptor(std::span<const std::byte> bytes, Ktx2File& file)
{
    ByteReader reader(bytes);
    const auto total_size = reader.read<uint32_t>();
    const auto vendor_and_type = reader.read<uint32_t>();
    reader.skip(2); // version
    const auto block_size = reader.read<uint16_t>();
    const auto color_model = reader.read<uint8_t>();
    reader.skip(1); // primaries
    const auto transfer = reader.read<uint8_t>();
    const auto flags = reader.read<uint8_t>();
    if (!flags || *total_size != bytes.size() || *vendor_and_type != 0)
        return false;
    if (*block_size < kDescriptorHeaderBytes || *block_size > bytes.size() - sizeof(uint32_t) ||
        (*block_size - kDescriptorHeaderBytes) % kSampleBytes != 0)
        return false;
    file.color_model = *color_model;
    file.transfer = transferFrom(*transfer);
    file.is_premultiplied = (*flags & kFlagPremultiplied) != 0;
    const uint32_t sample_count = (*block_size - kDescriptorHeaderBytes) / kSampleBytes;
    for (uint32_t i = 0; i < sample_count; ++i)
    {
        // byte 3 of a sample: the channel in the lower four bits
        reader.seek(sizeof(uint32_t) + kDescriptorHeaderBytes + uint64_t{i} * kSampleBytes + 3);
        const auto channel = reader.read<uint8_t>();
        if (!channel)
            return false;
        file.sample_channels.push_back(*channel & 15u);
    }
    return sample_count > 0;
}

/// Read KTXorientation of two dimensions, such as "rd".
Status readOrientation(const EncodedImage& source, std::string_view value, Ktx2File& file)
{
    if (value.size() != 2 || (value[0] != 'r' && value[0] != 'l') || (value[1] != 'd' && value[1] != 'u'))
        return source.malformed("KTX2: KTXorientation is none of rd, ru, ld, lu");
    file.is_mirrored = value[0] == 'l';
    file.is_bottom_up = value[1] == 'u';
    return success();
}

Status readSwizzle(const EncodedImage& source, std::string_view value, Ktx2File& file)
{
    if (value.size() != 4 || value.find_first_not_of("rgba01") != std::string_view::npos)
        return source.malformed("KTX2: KTXswizzle is not four of rgba01");
    file.swizzle = value;
    return success();
}

/// Read the entries of key and value, each of at least two bytes and padded to four.
Status readKeyValues(const EncodedImage& source, std::span<const std::byte> bytes, Ktx2File& file)
{
    ByteReader reader(bytes);
    while (reader.remaining() > 0)
    {
        const auto size = reader.read<uint32_t>();
        const auto entry = size ? reader.readBytes(*size) : std::nullopt;
        if (!entry)
            return source.malformed("KTX2: the key/value data is damaged");
        const std::string_view text(reinterpret_cast<const char*>(entry->data()), entry->size());
        const size_t key_end = text.find('\0');
        if (key_end == 0 || key_end == std::string_view::npos)
            return source.malformed("KTX2: an entry of the key/value data has no key");
        const std::string_view key = text.substr(0, key_end), padded = text.substr(key_end + 1);
        const std::string_view value = padded.substr(0, std::min(padded.find('\0'), padded.size()));
        if (key == "KTXcubemapIncomplete")
            return source.unsupported(kCubeMap);
        if (key == "KTXorientation")
            HEARTH_TRY(readOrientation(source, value, file));
        if (key == "KTXswizzle")
            HEARTH_TRY(readSwizzle(source, value, file));
        reader.skip(std::min<size_t>((4 - *size % 4) % 4, reader.remaining()));
    }
    return success();
}

/// Read the levels. The coarsest comes first in the file; levels overlap neither each other nor the data
/// before them.
std::optional<std::vector<Ktx2Level>> readLevels(std::span<const std::byte> bytes, ByteReader& reader,
                                                 uint32_t count, uint64_t metadata_end)
{
    std::vector<LevelIndex> index(count);
    for (LevelIndex& level : index)
    {
        const auto entry = reader.read<LevelIndex>();
        if (!entry)
            return std::nullopt;
        level = *entry;
    }
    std::vector<Ktx2Level> levels(count);
    uint64_t end = std::max<uint64_t>(metadata_end, reader.position());
    for (size_t i = count; i-- > 0;)
    {
        const auto part = checkedPart(bytes, index[i].offset, index[i].size);
        if (!part || index[i].offset < end || index[i].size == 0)
            return std::nullopt;
        end = index[i].offset + index[i].size;
        levels[i] = {*part, index[i].uncompressed_size};
    }
    return levels;
}

} // namespace

Result<Ktx2File> readKtx2(const EncodedImage& source, Ktx2Kind kind)
{
    ByteReader reader(source.bytes);
    const auto header = reader.read<Ktx2Header>();
    if (!header)
        return source.malformed("KTX2: the file ends in the header");
    HEARTH_TRY(checkHeader(source, *header, kind));

    const auto descriptor = checkedPart(source.bytes, header->descriptor_offset, header->descriptor_size);
    const auto key_values = checkedPart(source.bytes, header->key_value_offset, header->key_value_size);
    const auto global_data = checkedPart(source.bytes, header->globalOffset(), header->globalSize());
    if (!descriptor || !key_values || !global_data)
        return source.malformed("KTX2: a part of the index lies outside the file");

    Ktx2File file;
    HEARTH_TRY(readKeyValues(source, *key_values, file));
    file.vk_format = header->vk_format;
    file.width = header->width;
    file.height = header->height;
    file.faces = header->face_count;
    file.scheme = static_cast<Ktx2Scheme>(header->scheme);
    file.global_data = *global_data;
    if (!readDescriptor(*descriptor, file))
        return source.malformed("KTX2: the data format descriptor is damaged");
    const uint64_t metadata_end = std::max({uint64_t{header->descriptor_offset} + header->descriptor_size,
                                            uint64_t{header->key_value_offset} + header->key_value_size,
                                            header->globalOffset() + header->globalSize()});
    auto levels = readLevels(source.bytes, reader, std::max(1u, header->level_count), metadata_end);
    if (!levels)
        return source.malformed("KTX2: a mip level lies outside the file or out of order");
    file.levels = std::move(*levels);
    return file;
}

} // namespace hearth::import
