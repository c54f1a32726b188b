// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/texel_source.h"

#include "cook/texels/role.h"
#include "formats/container/container_reader.h"
#include "formats/pack/pack_check.h"
#include "formats/pack/part_materials.h"

#include <utility>

namespace hearth::texels
{

using namespace formats;

namespace
{

Result<PackView> openPart(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::open(path, Check::structure));
    return PackView::read(std::move(reader));
}

/// Check what the encoders take for granted of an image of the textures part.
Status checkPlain(const PackView& textures, uint32_t index, std::span<const std::byte> mips)
{
    const ImageRecord& image = textures.images()[index];
    const std::string where = "image " + std::to_string(index);
    if (image.width == 0 || image.width > kMaxImageSize || image.height == 0 ||
        image.height > kMaxImageSize || image.mip_count == 0 || image.mip_count > 32 ||
        texelBytes(image.format) < 4)
        return Error{Issue::meaning_value, textures.name(), where,
                     std::to_string(image.width) + " x " + std::to_string(image.height) +
                         " texels of format " + std::to_string(image.format)};
    if (mips.size() != mipOffset(image, image.mip_count))
        return Error{Issue::chunk_size, textures.name(), chunkName(kChunkImageData, index),
                     std::to_string(mips.size()) + " bytes, its mips have " +
                         std::to_string(mipOffset(image, image.mip_count))};
    return success();
}

} // namespace

Result<TexelSource> TexelSource::open(const std::string& import_path, const std::string& textures_path)
{
    HEARTH_ASSIGN_OR_RETURN(PackView import_part, openPart(import_path));
    HEARTH_ASSIGN_OR_RETURN(PackView textures, openPart(textures_path));
    const size_t count = textures.images().size();
    if (!matchesImages(import_part, textures))
        return Error{Issue::meaning_reference, textures_path, "",
                     "has " + std::to_string(count) + " images where the import part has " +
                         std::to_string(import_part.images().size())};
    TexelSource source(std::move(import_part), std::move(textures));
    source.uses_ = imageUses(findMaterials(source.import_part_, source.textures_),
                             findMaterialLayers(source.import_part_, source.textures_), count);
    return source;
}

Result<LoadedImage> TexelSource::load(uint32_t index) const
{
    HEARTH_ASSIGN_OR_RETURN(ChunkData data, textures_.imageData(index));
    HEARTH_TRY(checkPlain(textures_, index, data.bytes()));
    LoadedImage loaded{.data = std::move(data)};
    loaded.image = {.record = images()[index], .mips = loaded.data.bytes()};
    const ImageReads reads =
        findReads(loaded.image.record, uses_[index], findMaterials(import_part_, textures_));
    loaded.image.role = reads.role;
    loaded.image.channels = reads.channels;
    loaded.name = findImageName(import_part_, textures_, loaded.image.record);
    loaded.place = {Issue::texture_rule, import_part_.name(),
                    "image " + std::to_string(index) + " \"" + loaded.name + "\"", ""};
    return loaded;
}

} // namespace hearth::texels
