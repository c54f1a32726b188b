// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texture_part.h"

#include "cook/textures/fill_colors.h"
#include "cook/textures/mip_chain.h"
#include "cook/textures/roughness_uses.h"
#include "cook/textures/texel_codec.h"
#include "formats/container/container_reader.h"
#include "formats/container/container_writer.h"
#include "formats/pack/image_data.h"
#include "formats/pack/image_uses.h"
#include "formats/pack/pack_view.h"
#include "formats/records/scene.h"

#include <algorithm>

namespace hearth::textures
{

using namespace formats;

namespace
{

/// Read the texels of the finest mip.
Result<std::vector<std::byte>> readTexels(const ContainerReader& part, const ImageRecord& image,
                                          uint32_t index)
{
    const std::string where = "image " + std::to_string(index);
    if (image.width == 0 || image.width > kMaxTextureSize || image.height == 0 ||
        image.height > kMaxTextureSize || texelBytes(image.format) == 0)
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

/// Count the finest mips to leave out, until no side is longer than `max_size`.
uint32_t countTooLargeMips(const ImageRecord& image, uint32_t max_size)
{
    uint32_t count = 0;
    while (max_size > 0 && std::max(image.width, image.height) >> count > max_size)
        ++count;
    return count;
}

/// Return the record of the image without its `count` finest mips.
ImageRecord withoutMips(ImageRecord image, uint32_t count)
{
    const MipExtent extent = mipExtent(image, count);
    image.width = extent.width;
    image.height = extent.height;
    image.mip_count -= count;
    return image;
}

/// Return a name; empty if it is not in the table.
std::string readName(std::string_view strings, const StringRef& name)
{
    return isInsideTable({name.offset, name.length}, strings.size())
               ? std::string(strings.substr(name.offset, name.length))
               : "";
}

/// image, chain  with all mips
/// imported      the texels of the import part, where `image` has another format than they; else empty
ImageStatistics computeStatistics(std::string_view strings, const ImageRecord& image,
                                  std::span<const std::byte> chain, uint32_t skipped_mips,
                                  std::span<const std::byte> imported)
{
    ImageStatistics statistics;
    statistics.name = readName(strings, image.name);
    statistics.image = withoutMips(image, skipped_mips);
    statistics.bytes = chain.size() - mipOffset(image, skipped_mips);
    // the finest mip is the imported image, texel by texel: see buildMipChain
    if (skipped_mips == 0 && imported.empty())
        statistics.error = 0;
    if (classifyContent(image) == Content::light)
        return statistics;
    statistics.error = mipError(image, chain, skipped_mips, imported);
    if (skipped_mips + 1 < image.mip_count)
        statistics.half_error = mipError(image, chain, skipped_mips + 1, imported);
    return statistics;
}

/// Materials of an import part.
struct Materials
{
    Records<MaterialRecord> records;
    Records<MaterialLayersRecord> layers;
};

Result<Materials> readMaterials(const ContainerReader& part)
{
    HEARTH_ASSIGN_OR_RETURN(Records<MaterialRecord> records, part.records<MaterialRecord>(kChunkMaterials));
    HEARTH_ASSIGN_OR_RETURN(Records<MaterialLayersRecord> layers,
                            part.records<MaterialLayersRecord>(kChunkMaterialLayers));
    return Materials{std::move(records), std::move(layers)};
}

/// Make the mips of a roughness image that lose the normals of its use.
/// images  of the import part
Result<std::vector<std::byte>> buildRoughnessMips(const ContainerReader& part,
                                                  std::span<const ImageRecord> images,
                                                  const RoughnessUse& use, const ImageRecord& image,
                                                  std::vector<std::byte> texels, uint32_t max_bits)
{
    if (use.normal_image == kInvalidIndex)
        return buildMipChain(image, std::move(texels), max_bits);
    const ImageRecord& normals = images[use.normal_image];
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> normal_texels,
                            readTexels(part, normals, use.normal_image));
    RoughnessFilter filter({normals, normal_texels, use.normal_scale, use.roughness_factor});
    return buildMipChain(image, std::move(texels), max_bits, &filter);
}

/// Add the materials that use each image.
void addUses(const Materials& materials, std::string_view strings, std::span<ImageStatistics> statistics)
{
    const auto uses = imageUses(materials.records.span(), materials.layers.span(), statistics.size());
    for (size_t i = 0; i < statistics.size(); ++i)
        for (const ImageUse& use : uses[i])
            statistics[i].uses.push_back(
                {readName(strings, materials.records[use.material].name), std::string(use.role)});
}

/// Add the size of each image in the written part.
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
                    const TextureOptions& options, std::vector<ImageStatistics>* statistics)
{
    HEARTH_ASSIGN_OR_RETURN(const ContainerReader part, ContainerReader::open(import_path, Check::structure));
    HEARTH_ASSIGN_OR_RETURN(const Records<ImageRecord> sources, part.records<ImageRecord>(kChunkImages));
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));

    HEARTH_ASSIGN_OR_RETURN(const ChunkData strings, part.read(kChunkStrings));
    const std::string_view names(reinterpret_cast<const char*>(strings.bytes().data()),
                                 strings.bytes().size());

    HEARTH_ASSIGN_OR_RETURN(const Materials materials, readMaterials(part));
    std::vector<std::vector<RoughnessUse>> roughness_uses(sources.size());
    if (options.specular_aa)
        roughness_uses = listRoughnessUses(materials.records.span(), materials.layers.span(), sources.span());

    const std::vector<bool> has_hidden_colors =
        listHiddenColors(materials.records.span(), materials.layers.span(), sources.size());

    std::vector<ImageRecord> images(sources.begin(), sources.end());
    for (uint32_t i = 0; i < images.size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> texels, readTexels(part, images[i], i));
        if (has_hidden_colors[i] && isSrgb(images[i].format))
            fillHiddenColors(images[i], texels);
        images[i].mip_count = fullMipCount(images[i].width, images[i].height);
        const uint32_t format = mipFormat(images[i].format, options.max_bits);
        const bool is_narrowed = format != images[i].format;
        const std::vector<std::byte> imported =
            is_narrowed && statistics != nullptr ? texels : std::vector<std::byte>();
        // an image that several normal maps lie over keeps the mean roughness
        const RoughnessUse use = roughness_uses[i].size() == 1 ? roughness_uses[i].front() : RoughnessUse{};
        HEARTH_ASSIGN_OR_RETURN(
            const std::vector<std::byte> chain,
            buildRoughnessMips(part, sources.span(), use, images[i], std::move(texels), options.max_bits));
        images[i].format = format;
        const uint32_t skipped_mips = countTooLargeMips(images[i], options.max_size);
        const ImageRecord kept = withoutMips(images[i], skipped_mips);
        HEARTH_TRY(
            addImageData(writer, i, kept, std::span(chain).subspan(mipOffset(images[i], skipped_mips))));
        if (statistics != nullptr)
            statistics->push_back(computeStatistics(names, images[i], chain, skipped_mips, imported));
        images[i] = kept;
    }
    HEARTH_TRY(writer.addRecords<ImageRecord>(kChunkImages, images));
    HEARTH_TRY(writer.finish());
    if (statistics == nullptr)
        return success();
    addUses(materials, names, *statistics);
    return addStoredBytes(output_path, *statistics);
}

} // namespace hearth::textures
