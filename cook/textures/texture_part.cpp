// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texture_part.h"

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

    HEARTH_ASSIGN_OR_RETURN(const Records<MaterialRecord> materials,
                            part.records<MaterialRecord>(kChunkMaterials));
    HEARTH_ASSIGN_OR_RETURN(const Records<MaterialLayersRecord> layers,
                            part.records<MaterialLayersRecord>(kChunkMaterialLayers));
    const ImportTables tables{
        .images = sources.span(), .materials = materials.span(), .layers = layers.span(), .strings = names};
    std::vector<std::vector<RoughnessUse>> roughness_uses(sources.size());
    std::vector<RoughnessUse> missing;
    if (options.specular_aa)
    {
        roughness_uses = listRoughnessUses(tables.materials, tables.layers, tables.images);
        missing = listMissingRoughness(tables.materials, tables.images);
    }
    const std::vector<bool> has_hidden_colors =
        listHiddenColors(tables.materials, tables.layers, sources.size());
    const std::vector<uint32_t> joined = listJoinedOcclusion(tables.materials, tables.layers, tables.images);

    PartWriter writer(part, tables, joined, options, statistics != nullptr, container);
    for (uint32_t i = 0; i < sources.size(); ++i)
        HEARTH_TRY(writer.writeImage(i, roughness_uses[i], has_hidden_colors[i]));
    for (const RoughnessUse& use : missing)
        HEARTH_TRY(writer.writeMissingRoughness(use));
    HEARTH_TRY(writer.finish());
    if (statistics == nullptr)
        return success();
    *statistics = std::move(writer.statistics());
    addUses(writer.materials(), writer.layers(), names, *statistics);
    return addStoredBytes(output_path, *statistics);
}

} // namespace hearth::textures
