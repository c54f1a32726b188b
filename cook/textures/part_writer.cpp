// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/part_writer.h"

#include "cook/textures/fill_colors.h"
#include "cook/textures/join_occlusion.h"
#include "cook/textures/mip_chain.h"
#include "cook/textures/read_texels.h"
#include "cook/textures/roughness_images.h"
#include "cook/textures/texel_codec.h"
#include "formats/pack/image_data.h"
#include "formats/pack/pack_view.h"

#include <algorithm>

namespace hearth::textures
{

using namespace formats;

namespace
{

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

/// Give textures of a record the numbers of images in the part. References to missing images stay.
template <typename Record, typename Textures>
void renumber(Record& record, const Textures& textures, std::span<const uint32_t> numbers)
{
    for (TextureRef Record::*const texture : textures)
        if (uint32_t& image = (record.*texture).image; image < numbers.size())
            image = numbers[image];
}

} // namespace

std::string readName(std::string_view strings, const StringRef& name)
{
    return isInsideTable({name.offset, name.length}, strings.size())
               ? std::string(strings.substr(name.offset, name.length))
               : "";
}

PartWriter::PartWriter(const ContainerReader& part, const PartTables& tables, const TextureOptions& options,
                       bool has_statistics, ContainerWriter& writer)
    : part_(part),
      tables_(tables),
      materials_(tables.materials.begin(), tables.materials.end()),
      layers_(tables.layers.begin(), tables.layers.end()),
      options_(options),
      writer_(writer),
      strings_(tables.strings),
      has_statistics_(has_statistics)
{
    numberImages();
}

/// Number the images that are kept, for the materials too.
void PartWriter::numberImages()
{
    numbers_.assign(tables_.images.size(), kInvalidIndex);
    for (size_t i = 0; i < numbers_.size(); ++i)
        if (tables_.is_kept[i])
            numbers_[i] = addImage();
    if (records_.size() == numbers_.size())
        return;
    has_changed_materials_ = true;
    for (MaterialRecord& material : materials_)
        renumber(material, kMaterialTextureFields, numbers_);
    for (MaterialLayersRecord& layers : layers_)
        renumber(layers, kLayerTextures, numbers_);
}

/// Read the finest mip of an image, with the occlusion that it takes up.
Result<std::vector<std::byte>> PartWriter::readJoined(uint32_t source)
{
    HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> texels, readTexels(part_, tables_.images[source], source));
    if (const uint32_t occlusion = tables_.joined[source]; occlusion != kInvalidIndex)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> red,
                                readTexels(part_, tables_.images[occlusion], occlusion));
        copyRed(static_cast<TexelFormat>(tables_.images[source].format), red, texels);
    }
    return texels;
}

/// Make the mips of an image, with its roughness widened by the normals of a use.
Result<std::vector<std::byte>> PartWriter::buildMips(const RoughnessUse& use, const ImageRecord& image,
                                                     std::vector<std::byte> texels)
{
    if (use.normal_image == kInvalidIndex)
        return buildMipChain(image, std::move(texels), options_.max_bits);
    const ImageRecord& normals = tables_.images[use.normal_image];
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
        statistics_[index] = computeStatistics(strings_, image, chain, skipped_mips, imported);
    return success();
}

/// Add a place for an image after all others, and return its number.
uint32_t PartWriter::addImage()
{
    records_.emplace_back();
    statistics_.resize(has_statistics_ ? records_.size() : 0);
    return static_cast<uint32_t>(records_.size() - 1);
}

/// Add the name of the roughness image that is made of another image.
/// number  from 1 on, of those that are made of it
StringRef PartWriter::addName(const StringRef& source, uint32_t number)
{
    std::string name = readName(strings_, source);
    name += name.empty() ? "roughness" : " roughness";
    if (number > 1)
        name += " " + std::to_string(number);
    const StringRef added{static_cast<uint32_t>(strings_.size()), static_cast<uint32_t>(name.size())};
    strings_ += name;
    return added;
}

/// Give materials another roughness image, which has the same occlusion.
void PartWriter::useImage(const RoughnessUse& use, uint32_t image)
{
    for (const uint32_t index : use.materials)
    {
        MaterialRecord& material = materials_[index];
        uint32_t& roughness = material.metallic_roughness_texture.image;
        if (material.occlusion_texture.image == roughness)
            material.occlusion_texture.image = image;
        roughness = image;
    }
    has_changed_materials_ = true;
}

Status PartWriter::writeImage(uint32_t source, std::span<const RoughnessUse> uses, bool fills_alpha)
{
    const uint32_t index = numbers_[source];
    if (index == kInvalidIndex)
        return success();
    ImageRecord image = tables_.images[source];
    HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> texels, readJoined(source));
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
            stored.name = addName(image.name, static_cast<uint32_t>(variants.size()));
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
    RoughnessImage made = makeRoughnessImage(tables_.images[use.normal_image], use.roughness_factor);
    made.record.mip_count = fullMipCount(made.record.width, made.record.height);
    RoughnessUse whole = use;
    whole.roughness_factor = 1;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> chain,
                            buildMips(whole, made.record, std::move(made.texels)));
    if (findRoughnessRise(made.record, chain) <= kMinRoughnessRise)
        return success();
    const uint32_t added = addImage();
    made.record.name = addName(tables_.images[use.normal_image].name, ++made_images_[use.normal_image]);
    for (const uint32_t index : use.materials)
    {
        MaterialRecord& material = materials_[index];
        material.metallic_roughness_texture = material.normal_texture;
        material.metallic_roughness_texture.image = added;
        material.roughness = 1;
    }
    has_changed_materials_ = true;
    return writeChain(added, made.record, chain, {});
}

Status PartWriter::finish()
{
    if (strings_.size() > tables_.strings.size())
        HEARTH_TRY(writer_.addText(kChunkStrings, strings_));
    HEARTH_TRY(writer_.addRecords<ImageRecord>(kChunkImages, records_));
    if (has_changed_materials_)
    {
        HEARTH_TRY(writer_.addRecords<MaterialRecord>(kChunkMaterials, materials_));
        if (!layers_.empty())
            HEARTH_TRY(writer_.addRecords<MaterialLayersRecord>(kChunkMaterialLayers, layers_));
    }
    return writer_.finish();
}

} // namespace hearth::textures
