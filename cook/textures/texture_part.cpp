// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texture_part.h"

#include "cook/textures/mip_chain.h"
#include "formats/container_reader.h"
#include "formats/container_writer.h"
#include "formats/pack_view.h"
#include "formats/scene.h"

#include <algorithm>

namespace hearth::textures
{

using namespace formats;

namespace
{

/// The texels of the finest mip.
Result<std::vector<std::byte>> readTexels(const ContainerReader& part, const ImageRecord& image,
                                          uint32_t index)
{
    const std::string where = "image " + std::to_string(index);
    if (image.width == 0 || image.width > kLargestSize || image.height == 0 || image.height > kLargestSize ||
        texelBytes(image.format) == 0)
        return Error{Issue::meaning_value, part.name(), where,
                     std::to_string(image.width) + " x " + std::to_string(image.height) +
                         " texels of format " + std::to_string(image.format)};
    if (part.find(kChunkImageData, index) == nullptr)
        return Error{Issue::chunk_missing, part.name(), chunkName(kChunkImageData, index), ""};
    HEARTH_ASSIGN_OR_RETURN(const ChunkData data, part.read(kChunkImageData, index));
    const uint64_t finest = mipOffset(image, 1);
    if (data.bytes().size() < finest)
        return Error{Issue::chunk_size, part.name(), chunkName(kChunkImageData, index),
                     std::to_string(data.bytes().size()) + " bytes, the image has " + std::to_string(finest)};
    return std::vector<std::byte>(data.bytes().begin(),
                                  data.bytes().begin() + static_cast<std::ptrdiff_t>(finest));
}

/// Leave out the finest mips of the chain, until no side is longer than `max_size`; returns the bytes of those.
uint64_t leaveOutLargeMips(ImageRecord& image, uint32_t max_size)
{
    uint32_t left_out = 0;
    while (std::max(image.width, image.height) >> left_out > max_size)
        ++left_out;
    const uint64_t bytes = mipOffset(image, left_out);
    const MipExtent extent = mipExtent(image, left_out);
    image.width = extent.width;
    image.height = extent.height;
    image.mip_count -= left_out;
    return bytes;
}

} // namespace

Status cookTextures(const std::string& import_path, const std::string& output_path, uint32_t max_size)
{
    HEARTH_ASSIGN_OR_RETURN(const ContainerReader part, ContainerReader::open(import_path, Check::structure));
    HEARTH_ASSIGN_OR_RETURN(const Records<ImageRecord> sources, part.records<ImageRecord>(kChunkImages));
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));

    std::vector<ImageRecord> images(sources.begin(), sources.end());
    for (uint32_t i = 0; i < images.size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> texels, readTexels(part, images[i], i));
        images[i].mip_count = fullMipCount(images[i].width, images[i].height);
        const std::vector<std::byte> chain = buildMipChain(images[i], std::move(texels));
        const uint64_t left_out = max_size == 0 ? 0 : leaveOutLargeMips(images[i], max_size);
        HEARTH_TRY(writer.addChunk({.type = kChunkImageData, .index = i}, std::span(chain).subspan(left_out),
                                   1, Codec::zstd));
    }
    HEARTH_TRY(writer.addRecords<ImageRecord>(kChunkImages, images));
    return writer.finish();
}

} // namespace hearth::textures
