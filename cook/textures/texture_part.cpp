// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texture_part.h"

#include "cook/textures/fill_colors.h"
#include "cook/textures/mip_chain.h"
#include "cook/textures/roughness_images.h"
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

/// Textures part being written. Materials change where they get another roughness image.
class PartWriter
{
public:
    PartWriter(const ContainerReader& part, std::span<const ImageRecord> sources, const Materials& materials,
               std::string_view names, const TextureOptions& options, bool has_statistics,
               ContainerWriter& writer)
        : part_(part),
          sources_(sources),
          materials_(materials.records.begin(), materials.records.end()),
          names_(names),
          options_(options),
          has_statistics_(has_statistics),
          writer_(writer),
          records_(sources.begin(), sources.end()),
          statistics_(has_statistics ? sources.size() : 0)
    {
    }

    /// Write the mips of an image.
    /// uses        of the image as roughness, empty: none
    /// fills_alpha its colours under an alpha of 0 are filled
    Status writeImage(uint32_t index, std::span<const RoughnessUse> uses, bool fills_alpha);

    /// Write an image for materials that have none, if their roughness rises.
    Status writeMissingRoughness(const RoughnessUse& use);

    /// Write the tables.
    Status finish();

    std::span<const MaterialRecord> materials() const { return materials_; }
    std::vector<ImageStatistics>& statistics() { return statistics_; }

private:
    Result<std::vector<std::byte>> buildMips(const RoughnessUse& use, const ImageRecord& image,
                                             std::vector<std::byte> texels);
    Status writeVariants(uint32_t index, std::span<const RoughnessUse> uses, const ImageRecord& image,
                         const std::vector<std::byte>& texels, const std::vector<std::byte>& chain);
    Status writeChain(uint32_t index, ImageRecord image, std::span<const std::byte> chain,
                      std::span<const std::byte> imported);
    uint32_t addImage();
    void useImage(const RoughnessUse& use, uint32_t image);

    const ContainerReader& part_;
    std::span<const ImageRecord> sources_;
    std::vector<MaterialRecord> materials_;
    std::string_view names_;
    const TextureOptions& options_;
    bool has_statistics_;
    ContainerWriter& writer_;
    std::vector<ImageRecord> records_;
    std::vector<ImageStatistics> statistics_; ///< of each record, if they are wanted
    bool has_changed_materials_ = false;
};

/// Make the mips of an image, with its roughness widened by the normals of a use.
Result<std::vector<std::byte>> PartWriter::buildMips(const RoughnessUse& use, const ImageRecord& image,
                                                     std::vector<std::byte> texels)
{
    if (use.normal_image == kInvalidIndex)
        return buildMipChain(image, std::move(texels), options_.max_bits);
    const ImageRecord& normals = sources_[use.normal_image];
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> normal_texels,
                            readTexels(part_, normals, use.normal_image));
    RoughnessFilter filter({normals, normal_texels, use.normal_scale, use.roughness_factor});
    return buildMipChain(image, std::move(texels), options_.max_bits, &filter);
}

/// Write mips without those that are too large.
/// image     of the chain
/// imported  as for computeStatistics
Status PartWriter::writeChain(uint32_t index, ImageRecord image, std::span<const std::byte> chain,
                              std::span<const std::byte> imported)
{
    const uint32_t skipped_mips = countTooLargeMips(image, options_.max_size);
    records_[index] = withoutMips(image, skipped_mips);
    HEARTH_TRY(addImageData(writer_, index, records_[index],
                            chain.subspan(static_cast<size_t>(mipOffset(image, skipped_mips)))));
    if (has_statistics_)
        statistics_[index] = computeStatistics(names_, image, chain, skipped_mips, imported);
    return success();
}

/// Add a place for an image after all others, and return its number.
uint32_t PartWriter::addImage()
{
    records_.emplace_back();
    statistics_.resize(has_statistics_ ? records_.size() : 0);
    return static_cast<uint32_t>(records_.size() - 1);
}

/// Give materials another roughness image.
void PartWriter::useImage(const RoughnessUse& use, uint32_t image)
{
    for (const uint32_t material : use.materials)
        materials_[material].metallic_roughness_texture.image = image;
    has_changed_materials_ = true;
}

Status PartWriter::writeImage(uint32_t index, std::span<const RoughnessUse> uses, bool fills_alpha)
{
    ImageRecord image = sources_[index];
    HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> texels, readTexels(part_, image, index));
    if (fills_alpha && isSrgb(image.format))
        fillHiddenColors(image, texels);
    image.mip_count = fullMipCount(image.width, image.height);
    const uint32_t format = mipFormat(image.format, options_.max_bits);
    const bool is_read_again = uses.size() > 1 || (format != image.format && has_statistics_);
    const std::vector<std::byte> imported = is_read_again ? texels : std::vector<std::byte>();
    HEARTH_ASSIGN_OR_RETURN(
        const std::vector<std::byte> chain,
        buildMips(uses.empty() ? RoughnessUse{} : uses.front(), image, std::move(texels)));
    if (uses.size() > 1)
        HEARTH_TRY(writeVariants(index, uses.subspan(1), image, imported, chain));
    const bool is_narrowed = format != image.format;
    image.format = format;
    return writeChain(index, image, chain, is_narrowed ? imported : std::span<const std::byte>());
}

/// Write images for further uses of a roughness image, one for those that hardly differ.
/// image   with the number of its mips, in the format of the import part
/// texels  of the finest mip
/// chain   of the image itself
Status PartWriter::writeVariants(uint32_t index, std::span<const RoughnessUse> uses, const ImageRecord& image,
                                 const std::vector<std::byte>& texels, const std::vector<std::byte>& chain)
{
    ImageRecord stored = image;
    stored.format = mipFormat(image.format, options_.max_bits);
    std::vector<std::pair<uint32_t, std::vector<std::byte>>> variants{{index, chain}};
    for (const RoughnessUse& use : uses)
    {
        HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> variant, buildMips(use, image, texels));
        const auto found = std::ranges::find_if(
            variants, [&](const auto& other)
            { return findRoughnessDifference(stored, other.second, variant) <= kMaxSharedDifference; });
        if (found == variants.end())
        {
            const uint32_t added = addImage();
            const bool is_narrowed = stored.format != image.format;
            HEARTH_TRY(
                writeChain(added, stored, variant, is_narrowed ? texels : std::span<const std::byte>()));
            useImage(use, added);
            variants.emplace_back(added, std::move(variant));
        }
        else if (found->first != index)
            useImage(use, found->first);
    }
    return success();
}

Status PartWriter::writeMissingRoughness(const RoughnessUse& use)
{
    RoughnessImage made = makeRoughnessImage(sources_[use.normal_image], use.roughness_factor);
    made.record.mip_count = fullMipCount(made.record.width, made.record.height);
    RoughnessUse exact = use;
    exact.roughness_factor = made.factor;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> chain,
                            buildMips(exact, made.record, std::move(made.texels)));
    if (findRoughnessRise(made.record, chain) * double{made.factor} <= kMinRoughnessRise)
        return success();
    const uint32_t added = addImage();
    for (const uint32_t material : use.materials)
    {
        MaterialRecord& record = materials_[material];
        record.metallic_roughness_texture = record.normal_texture;
        record.roughness = made.factor;
    }
    useImage(use, added);
    return writeChain(added, made.record, chain, {});
}

Status PartWriter::finish()
{
    HEARTH_TRY(writer_.addRecords<ImageRecord>(kChunkImages, records_));
    if (has_changed_materials_)
        HEARTH_TRY(writer_.addRecords<MaterialRecord>(kChunkMaterials, materials_));
    return writer_.finish();
}

/// Add the materials that use each image.
void addUses(std::span<const MaterialRecord> materials, std::span<const MaterialLayersRecord> layers,
             std::string_view strings, std::span<ImageStatistics> statistics)
{
    const auto uses = imageUses(materials, layers, statistics.size());
    for (size_t i = 0; i < statistics.size(); ++i)
        for (const ImageUse& use : uses[i])
            statistics[i].uses.push_back(
                {readName(strings, materials[use.material].name), std::string(use.role)});
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
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter container,
                            ContainerWriter::create(output_path, ContainerKind::part));

    HEARTH_ASSIGN_OR_RETURN(const ChunkData strings, part.read(kChunkStrings));
    const std::string_view names(reinterpret_cast<const char*>(strings.bytes().data()),
                                 strings.bytes().size());

    HEARTH_ASSIGN_OR_RETURN(const Materials materials, readMaterials(part));
    const std::span<const MaterialRecord> records = materials.records.span();
    const std::span<const MaterialLayersRecord> layers = materials.layers.span();
    std::vector<std::vector<RoughnessUse>> roughness_uses(sources.size());
    std::vector<RoughnessUse> missing;
    if (options.specular_aa)
    {
        roughness_uses = listRoughnessUses(records, layers, sources.span());
        missing = listMissingRoughness(records, sources.span());
    }
    const std::vector<bool> has_hidden_colors = listHiddenColors(records, layers, sources.size());

    PartWriter writer(part, sources.span(), materials, names, options, statistics != nullptr, container);
    for (uint32_t i = 0; i < sources.size(); ++i)
        HEARTH_TRY(writer.writeImage(i, roughness_uses[i], has_hidden_colors[i]));
    for (const RoughnessUse& use : missing)
        HEARTH_TRY(writer.writeMissingRoughness(use));
    HEARTH_TRY(writer.finish());
    if (statistics == nullptr)
        return success();
    *statistics = std::move(writer.statistics());
    addUses(writer.materials(), layers, names, *statistics);
    return addStoredBytes(output_path, *statistics);
}

} // namespace hearth::textures
