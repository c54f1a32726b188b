// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/texel_part.h"

#include "cook/texels/role.h"
#include "formats/container/container_reader.h"
#include "formats/container/container_writer.h"
#include "formats/pack/image_data.h"
#include "formats/pack/pack_check.h"

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

/// Return the record of an encoded image.
ImageRecord describe(const PlainImage& image, const Encoding& encoding)
{
    ImageRecord record = image.record;
    record.format = static_cast<uint32_t>(encoding.candidate.traits->format);
    record.role = static_cast<uint8_t>(image.role);
    for (uint32_t c = 0; c < 4; ++c)
        record.swizzle[c] = static_cast<uint8_t>(encoding.candidate.swizzle[c]);
    record.error = static_cast<float>(encoding.error.error);
    record.error_p999 = static_cast<float>(encoding.error.error_p999);
    record.error_smooth = static_cast<float>(encoding.error.smooth);
    record.coverage_error = static_cast<float>(encoding.error.coverage);
    return record;
}

/// Add the size of each image in the written part.
Status addStoredBytes(const std::string& path, std::span<ImageResult> results)
{
    HEARTH_ASSIGN_OR_RETURN(const ContainerReader part, ContainerReader::open(path, Check::structure));
    for (uint32_t i = 0; i < results.size(); ++i)
        if (const ChunkEntry* entry = part.find(kChunkImageData, i); entry != nullptr)
            results[i].stored_bytes = entry->stored_size;
    return success();
}

} // namespace

Status cookTexels(const std::string& import_path, const std::string& textures_path,
                  const std::string& output_path, const TexelOptions& options,
                  std::vector<ImageResult>& results)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView import_part, openPart(import_path));
    HEARTH_ASSIGN_OR_RETURN(const PackView textures, openPart(textures_path));
    const size_t count = import_part.images().size();
    if (textures.images().size() != count)
        return Error{Issue::meaning_reference, textures_path, "",
                     "has " + std::to_string(textures.images().size()) +
                         " images where the import part has " + std::to_string(count)};
    const std::vector<std::vector<ImageUse>> uses =
        imageUses(import_part.materials(), import_part.materialLayers(), count);

    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));
    std::vector<ImageRecord> records;
    for (uint32_t i = 0; i < count; ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const ChunkData data, textures.imageData(i));
        HEARTH_TRY(checkPlain(textures, i, data.bytes()));
        PlainImage image{.record = textures.images()[i], .mips = data.bytes()};
        const ImageReads reads = findReads(image.record, uses[i], import_part.materials());
        image.role = reads.role;
        image.channels = reads.channels;

        const Target target = findTarget(image.role, options.quality);
        const Encoding encoding = encodeForTarget(image, listCandidates(image, options.families), target,
                                                  options.quality, options.strict);
        records.push_back(describe(image, encoding));
        HEARTH_TRY(addImageData(writer, i, records.back(), encoding.texels));
        results.push_back({.name = std::string(import_part.text(image.record.name)),
                           .record = records.back(),
                           .target = target.error,
                           .holds_target = encoding.share <= 1,
                           .bytes = encoding.texels.size()});
    }
    HEARTH_TRY(writer.addRecords<ImageRecord>(kChunkImages, records));
    HEARTH_TRY(writer.finish());
    return addStoredBytes(output_path, results);
}

} // namespace hearth::texels
