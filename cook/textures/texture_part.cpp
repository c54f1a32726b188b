// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texture_part.h"

#include "cook/textures/mip_chain.h"
#include "formats/container_reader.h"
#include "formats/container_writer.h"
#include "formats/pack_view.h"
#include "formats/scene.h"

namespace hearth::textures
{

using namespace formats;

namespace
{

// What Vulkan devices on phones can use; larger sizes could also overflow the sizes of the data.
constexpr uint32_t kMaxSize = 16384;

/// The texels of the finest mip.
Result<std::vector<std::byte>> readTexels(const ContainerReader& part, const ImageRecord& image,
                                          uint32_t index)
{
    const std::string where = "image " + std::to_string(index);
    if (image.width == 0 || image.width > kMaxSize || image.height == 0 || image.height > kMaxSize ||
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

ImageStatistics statisticsOf(const std::string_view strings, const ImageRecord& image,
                             std::span<const std::byte> chain)
{
    ImageStatistics statistics;
    if (insideTable({image.name.offset, image.name.length}, strings.size()))
        statistics.name = strings.substr(image.name.offset, image.name.length);
    statistics.image = image;
    statistics.bytes = chain.size();
    // the finest mip is the imported image, texel by texel: see buildMipChain
    statistics.error = 0;
    if (texelBytes(image.format) == 4 && image.mip_count > 1)
        statistics.half_error = halfError(image, chain);
    return statistics;
}

/// How much of the part that was written is each image's.
Status addStoredBytes(const std::string& path, std::span<ImageStatistics> statistics)
{
    HEARTH_ASSIGN_OR_RETURN(const ContainerReader part, ContainerReader::open(path, Check::structure));
    for (uint32_t i = 0; i < statistics.size(); ++i)
        if (const ChunkEntry* entry = part.find(kChunkImageData, i); entry != nullptr)
            statistics[i].stored_bytes = entry->stored_size;
    return success();
}

} // namespace

Status cookTextures(const std::string& import_path, const std::string& output_path,
                    std::vector<ImageStatistics>* statistics)
{
    HEARTH_ASSIGN_OR_RETURN(const ContainerReader part, ContainerReader::open(import_path, Check::structure));
    HEARTH_ASSIGN_OR_RETURN(const Records<ImageRecord> sources, part.records<ImageRecord>(kChunkImages));
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));

    HEARTH_ASSIGN_OR_RETURN(const ChunkData strings, part.read(kChunkStrings));
    const std::string_view names(reinterpret_cast<const char*>(strings.bytes().data()),
                                 strings.bytes().size());

    std::vector<ImageRecord> images(sources.begin(), sources.end());
    for (uint32_t i = 0; i < images.size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> texels, readTexels(part, images[i], i));
        images[i].mip_count = fullMipCount(images[i].width, images[i].height);
        const std::vector<std::byte> chain = buildMipChain(images[i], std::move(texels));
        HEARTH_TRY(writer.addChunk({.type = kChunkImageData, .index = i}, chain, 1, Codec::zstd));
        if (statistics != nullptr)
            statistics->push_back(statisticsOf(names, images[i], chain));
    }
    HEARTH_TRY(writer.addRecords<ImageRecord>(kChunkImages, images));
    HEARTH_TRY(writer.finish());
    return statistics == nullptr ? success() : addStoredBytes(output_path, *statistics);
}

} // namespace hearth::textures
