// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texture_part.h"

#include "cook/textures/constant_images.h"
#include "cook/textures/fill_colors.h"
#include "cook/textures/join_occlusion.h"
#include "cook/textures/part_writer.h"
#include "cook/textures/roughness_uses.h"
#include "formats/pack/image_uses.h"

namespace hearth::textures
{

using namespace formats;

namespace
{

/// Return which images are stored: all but those that materials used and use no longer.
std::vector<bool> listKeptImages(std::span<const MaterialRecord> before,
                                 std::span<const MaterialRecord> after,
                                 std::span<const MaterialLayersRecord> layers, size_t count)
{
    const auto uses_before = imageUses(before, layers, count), uses_after = imageUses(after, layers, count);
    std::vector<bool> is_kept(count);
    for (size_t i = 0; i < count; ++i)
        is_kept[i] = uses_before[i].empty() || !uses_after[i].empty();
    return is_kept;
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

    HEARTH_ASSIGN_OR_RETURN(const Records<MaterialRecord> records,
                            part.records<MaterialRecord>(kChunkMaterials));
    HEARTH_ASSIGN_OR_RETURN(const Records<MaterialLayersRecord> layers,
                            part.records<MaterialLayersRecord>(kChunkMaterialLayers));
    std::vector<MaterialRecord> materials(records.begin(), records.end());
    HEARTH_TRY(replaceConstantImages(part, sources.span(), layers.span(), materials));
    const std::vector<uint32_t> joined = listJoinedOcclusion(materials, layers.span(), sources.span());
    shareOcclusion(joined, materials);

    std::vector<std::vector<RoughnessUse>> roughness_uses(sources.size());
    std::vector<RoughnessUse> missing;
    if (options.specular_aa)
    {
        roughness_uses = listRoughnessUses(materials, layers.span(), sources.span());
        missing = listMissingRoughness(materials, sources.span());
    }
    const std::vector<bool> has_hidden_colors = listHiddenColors(materials, layers.span(), sources.size());

    const PartTables tables{.images = sources.span(),
                            .is_kept =
                                listKeptImages(records.span(), materials, layers.span(), sources.size()),
                            .joined = joined,
                            .materials = materials,
                            .layers = layers.span(),
                            .strings = names};
    PartWriter writer(part, tables, options, statistics != nullptr, container);
    for (uint32_t i = 0; i < sources.size(); ++i)
        HEARTH_TRY(writer.writeImage(i, roughness_uses[i], has_hidden_colors[i]));
    for (const RoughnessUse& use : missing)
        HEARTH_TRY(writer.writeMissingRoughness(use));
    HEARTH_TRY(writer.finish());
    if (statistics == nullptr)
        return success();
    *statistics = std::move(writer.statistics());
    addUses(writer.materials(), writer.layers(), writer.strings(), *statistics);
    return addStoredBytes(output_path, *statistics);
}

} // namespace hearth::textures
