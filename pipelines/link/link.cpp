// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/link/link.h"

#include "cook/tools/source_name.h"
#include "cook/tools/source_sky.h"
#include "formats/container/container_writer.h"
#include "formats/pack/image_data.h"
#include "formats/pack/instance_meshes.h"
#include "formats/pack/pack_check.h"
#include "formats/pack/part_materials.h"
#include "formats/scene/sky_image.h"
#include "pipelines/link/asset_bounds.h"
#include "pipelines/link/image_table.h"
#include "pipelines/link/merge_meta.h"
#include "pipelines/link/rebase.h"
#include "pipelines/verify/verify_pack.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <unistd.h>
#include <vector>

namespace hearth::link
{

using namespace formats;

namespace
{

// Size of the pieces in which pages of a part are copied, so that a large part does not have to fit into
// memory.
constexpr size_t kCopyBytes = size_t{1} << 20;

struct Source
{
    PackView import_part;
    PackView clusters_part;
    PackView textures_part;
    PackView skinning_part;
    PackView proxy_part; ///< the import part, with those of an artist, where there is none
    Records<DeformedGroupRecord> deformed_groups; ///< of the skinning part
    std::vector<uint32_t> instance_meshes;        ///< of the clusters part
    std::string name;                             ///< of the asset
    StringRef name_ref{};                         ///< in the merged strings
    TableOffsets offsets{};
};

/// Light probes of all parts, one behind the other.
struct ProbeTables
{
    std::vector<ProbeRecord> records;
    std::vector<uint32_t> texels;
};

/// Open parts of what a pack has once.
struct OpenPackParts
{
    std::vector<SpecularTableRecord> specular;
    std::optional<PackView> bricks;
    ProbeTables probes;
    std::optional<PackView> receivers;
};

Result<PackView> openPart(const std::string& path)
{
    // every chunk is hashed when it is read or copied: the file need not be hashed as a whole before
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::open(path, Check::structure));
    if (reader.kind() != ContainerKind::part)
        return Error{Issue::container_kind, path, "", "this is a pack, not a part"};
    return PackView::read(std::move(reader));
}

uint64_t countChunks(const ContainerReader& reader, uint32_t type)
{
    uint64_t count = 0;
    for (const ChunkEntry& entry : reader.chunks())
        count += entry.type == type ? 1 : 0;
    return count;
}

/// Check that the parts are of the same source: the cookers keep the numbers of meshes and images.
Status checkSameSource(const Source& source)
{
    const auto differ = [](const PackView& part, const char* what, uint64_t has, uint64_t expected)
    {
        return Error{Issue::meaning_reference, part.name(), "",
                     "has " + std::to_string(has) + " " + what + " where the import part has " +
                         std::to_string(expected)};
    };
    const uint64_t meshes = countChunks(source.import_part.container(), kChunkSourceMesh);
    const bool has_copies = countChunks(source.clusters_part.container(), kChunkInstanceMeshes) > 0;
    if (source.clusters_part.meshes().size() < meshes ||
        (source.clusters_part.meshes().size() > meshes && !has_copies))
        return differ(source.clusters_part, "meshes", source.clusters_part.meshes().size(), meshes);
    const uint64_t images = source.import_part.images().size();
    if (!matchesImages(source.import_part, source.textures_part))
        return differ(source.textures_part, "images", source.textures_part.images().size(), images);
    if (!findStrings(source.import_part, source.textures_part).starts_with(source.import_part.strings()))
        return Error{Issue::meaning_reference, source.textures_part.name(), "",
                     "has other strings than the import part"};
    const uint64_t instances = source.import_part.instances().size();
    const uint64_t surroundings = source.clusters_part.surroundings().size();
    if (surroundings != 0 && surroundings != instances)
        return differ(source.clusters_part, "surroundings of instances", surroundings, instances);
    for (const DeformedGroupRecord& group : source.deformed_groups.span())
        if (group.group >= source.clusters_part.groups().size())
            return Error{Issue::meaning_reference, source.skinning_part.name(), "",
                         "has a sphere for group " + std::to_string(group.group) +
                             ", the clusters part has " +
                             std::to_string(source.clusters_part.groups().size())};
    return success();
}

Result<Source> openSource(const SourceParts& parts)
{
    HEARTH_ASSIGN_OR_RETURN(PackView import_part, openPart(parts.import_part));
    HEARTH_ASSIGN_OR_RETURN(PackView clusters_part, openPart(parts.clusters_part));
    HEARTH_ASSIGN_OR_RETURN(PackView textures_part, openPart(parts.textures_part));
    HEARTH_ASSIGN_OR_RETURN(PackView skinning_part, openPart(parts.skinning_part));
    PackView proxy_part = import_part;
    if (!parts.proxy_part.empty())
    {
        HEARTH_ASSIGN_OR_RETURN(proxy_part, openPart(parts.proxy_part));
    }
    HEARTH_TRY(checkProxies(proxy_part));
    HEARTH_ASSIGN_OR_RETURN(Records<DeformedGroupRecord> deformed_groups,
                            skinning_part.container().records<DeformedGroupRecord>(kChunkDeformedGroups));
    HEARTH_ASSIGN_OR_RETURN(std::vector<uint32_t> instance_meshes,
                            readInstanceMeshes(import_part, clusters_part));
    std::string name = readAssetName(import_part.meta());
    Source source{std::move(import_part),     std::move(clusters_part), std::move(textures_part),
                  std::move(skinning_part),   std::move(proxy_part),    std::move(deformed_groups),
                  std::move(instance_meshes), std::move(name)};
    HEARTH_TRY(checkSameSource(source));
    return source;
}

/// Advance the start of a table by `count` records; return false if the table grows past 32-bit indices.
bool advanceOffset(uint32_t& offset, uint64_t count)
{
    if (count >= kInvalidIndex - uint64_t{offset})
        return false;
    offset += static_cast<uint32_t>(count);
    return true;
}

/// Compute the offsets of the source after `source`. Return false if a table grows past 32-bit indices.
bool advanceOffsets(const Source& source, TableOffsets& next)
{
    const PackView& scene = source.import_part;
    const PackView& meshes = source.clusters_part;
    const PackView& deformed = source.skinning_part;
    const PackView& proxies = source.proxy_part;
    next = source.offsets;
    next.strings = source.offsets.mesh_strings;
    next.page_bytes += alignChunk(meshes.pageBytes().size());
    return advanceOffset(next.strings, meshes.strings().size()) && advanceOffset(next.assets, 1) &&
           advanceOffset(next.nodes, scene.nodes().size()) &&
           advanceOffset(next.cameras, scene.cameras().size()) &&
           advanceOffset(next.lights, scene.lights().size()) &&
           advanceOffset(next.materials, scene.materials().size()) &&
           advanceOffset(next.images, source.textures_part.images().size()) &&
           advanceOffset(next.skins, scene.skins().size()) &&
           advanceOffset(next.joints, scene.joints().size()) &&
           advanceOffset(next.animations, scene.animations().size()) &&
           advanceOffset(next.channels, scene.channels().size()) &&
           advanceOffset(next.keys, scene.keys().size()) &&
           advanceOffset(next.key_words, scene.keyBits().size()) &&
           advanceOffset(next.morph_weights, scene.morphWeights().size()) &&
           advanceOffset(next.meshes, meshes.meshes().size()) &&
           advanceOffset(next.levels, meshes.levels().size()) &&
           advanceOffset(next.groups, meshes.groups().size()) &&
           advanceOffset(next.clusters, meshes.clusters().size()) &&
           advanceOffset(next.pages, meshes.pages().size()) &&
           advanceOffset(next.page_parents, meshes.pageParents().size()) &&
           advanceOffset(next.radiance_transfers, meshes.radianceTransfers().size()) &&
           advanceOffset(next.proxy_sections, proxies.proxySections().size()) &&
           advanceOffset(next.proxy_positions, proxies.proxyPositions().size()) &&
           advanceOffset(next.proxy_indices, proxies.proxyIndices().size()) &&
           advanceOffset(next.proxy_bindings, proxies.proxyBindings().size()) &&
           advanceOffset(next.deformed_clusters, deformed.deformedClusters().size()) &&
           advanceOffset(next.cluster_joints, deformed.clusterJoints().size());
}

/// Compute the offsets of every source in the merged tables; the sources' names follow all other strings.
Status assignOffsets(std::vector<Source>& sources, const std::string& output)
{
    const Error too_large{Issue::input_too_large, output, "",
                          "the sources together are too large for one pack: a table has at most " +
                              std::to_string(kInvalidIndex - 1) + " records"};
    TableOffsets next;
    for (Source& source : sources)
    {
        source.offsets = next;
        source.offsets.mesh_strings = next.strings;
        const uint64_t strings = findStrings(source.import_part, source.textures_part).size();
        if (!advanceOffset(source.offsets.mesh_strings, strings) || !advanceOffsets(source, next))
            return too_large;
    }
    for (Source& source : sources)
    {
        source.name_ref = {next.strings, static_cast<uint32_t>(source.name.size())};
        if (!advanceOffset(next.strings, source.name.size()))
            return too_large;
    }
    return success();
}

Status writeMeta(ContainerWriter& writer, std::span<const Source> sources, const OpenPackParts& pack_parts,
                 std::span<const std::string> skipped, uint64_t texture_budget, const std::string& output)
{
    std::vector<std::string_view> of_pack;
    for (const std::optional<PackView>* const part : {&pack_parts.bricks, &pack_parts.receivers})
        if (*part)
            of_pack.push_back((*part)->meta());
    std::vector<PartMetas> metas;
    for (const Source& source : sources)
        metas.push_back(
            {source.import_part.meta(), source.clusters_part.meta(), source.textures_part.meta()});
    HEARTH_ASSIGN_OR_RETURN(const std::string text,
                            mergeMeta(metas, of_pack, skipped, texture_budget, output));
    return writer.addText(kChunkMeta, text);
}

Status writeStrings(ContainerWriter& writer, std::span<const Source> sources)
{
    std::string strings;
    for (const Source& source : sources)
    {
        strings += findStrings(source.import_part, source.textures_part);
        strings += source.clusters_part.strings();
    }
    for (const Source& source : sources)
        strings += source.name;
    return writer.addText(kChunkStrings, strings);
}

Status writeAssets(ContainerWriter& writer, std::span<const Source> sources)
{
    std::vector<AssetRecord> assets;
    uint32_t first_instance = 0;
    for (const Source& source : sources)
    {
        const auto count = [](auto table) { return static_cast<uint32_t>(table.size()); };
        const PackView& scene = source.import_part;
        HEARTH_ASSIGN_OR_RETURN(Box3 box,
                                computeRestBounds(scene, source.clusters_part, source.skinning_part));
        if (box.empty())
            box = {{0, 0, 0}, {0, 0, 0}};
        assets.push_back({.name = source.name_ref,
                          .instances = {first_instance, count(scene.instances())},
                          .meshes = {source.offsets.meshes, count(source.clusters_part.meshes())},
                          .nodes = {source.offsets.nodes, count(scene.nodes())},
                          .box_min = box.min,
                          .box_max = box.max});
        first_instance += count(scene.instances());
    }
    return writer.addRecords<AssetRecord>(kChunkAssets, assets);
}

/// Write the tables of all sources one after the other: records that refer to nothing.
template <typename T>
Status writeJoined(ContainerWriter& writer, std::span<const Source> sources, uint32_t type,
                   PackView Source::*part, std::span<const T> (PackView::*table)() const)
{
    std::vector<T> merged;
    for (const Source& source : sources)
    {
        const std::span<const T> records = ((source.*part).*table)();
        merged.insert(merged.end(), records.begin(), records.end());
    }
    return writer.addRecords<T>(type, merged);
}

/// Write one table, merged from all sources, with references into the merged tables.
template <typename T>
Status writeTable(ContainerWriter& writer, std::span<const Source> sources, uint32_t type,
                  PackView Source::*part, std::span<const T> (PackView::*table)() const)
{
    std::vector<T> merged;
    for (const Source& source : sources)
        for (T record : ((source.*part).*table)())
        {
            rebase(record, source.offsets);
            merged.push_back(record);
        }
    return writer.addRecords<T>(type, merged);
}

/// Write the packed keys of all sources; no chunk if there are none.
Status writeKeyBits(ContainerWriter& writer, std::span<const Source> sources)
{
    const auto isPacked = [](const Source& source) { return !source.import_part.keyBits().empty(); };
    return std::any_of(sources.begin(), sources.end(), isPacked)
               ? writeJoined(writer, sources, kChunkKeyBits, &Source::import_part, &PackView::keyBits)
               : success();
}

/// Write the materials of all sources with the images of the pack.
Status writeMaterials(ContainerWriter& writer, std::span<const Source> sources, const ImageTable& images)
{
    std::vector<MaterialRecord> merged;
    for (const Source& source : sources)
        for (MaterialRecord record : findMaterials(source.import_part, source.textures_part))
        {
            rebase(record, source.offsets);
            for (TextureRef MaterialRecord::*const texture : kMaterialTextureFields)
                (record.*texture).image = images.find((record.*texture).image);
            merged.push_back(record);
        }
    return writer.addRecords<MaterialRecord>(kChunkMaterials, merged);
}

/// Write the layers of the materials of all sources; no chunk if there are none.
Status writeMaterialLayers(ContainerWriter& writer, std::span<const Source> sources, const ImageTable& images)
{
    std::vector<MaterialLayersRecord> merged;
    for (const Source& source : sources)
        for (MaterialLayersRecord record : findMaterialLayers(source.import_part, source.textures_part))
        {
            rebase(record, source.offsets);
            for (TextureRef MaterialLayersRecord::*const texture : kLayerTextures)
                (record.*texture).image = images.find((record.*texture).image);
            merged.push_back(record);
        }
    return merged.empty() ? success() : writer.addRecords<MaterialLayersRecord>(kChunkMaterialLayers, merged);
}

/// Write the images of the pack, and where the pieces of their texels are.
Status writeImages(ContainerWriter& writer, std::span<const Source> sources, const ImageTable& images)
{
    std::vector<ImageRecord> records;
    std::vector<TexturePieceRecord> pieces;
    for (const ImagePlace& place : images.places())
    {
        ImageRecord record = sources[place.source].textures_part.images()[place.image];
        rebase(record, sources[place.source].offsets);
        record.target = place.target;
        record.target_smooth = place.target_smooth;
        HEARTH_ASSIGN_OR_RETURN(const std::vector<TexturePieceRecord> own,
                                readPieces(sources[place.source].textures_part, place.image));
        record.pieces = {static_cast<uint32_t>(pieces.size()), static_cast<uint32_t>(own.size())};
        pieces.insert(pieces.end(), own.begin(), own.end());
        records.push_back(record);
    }
    HEARTH_TRY(writer.addRecords<ImageRecord>(kChunkImages, records));
    return writer.addRecords<TexturePieceRecord>(kChunkTexturePieces, pieces);
}

/// Write the instances of all sources with the meshes that they draw: those of the source, or copies.
Status writeInstances(ContainerWriter& writer, std::span<const Source> sources)
{
    std::vector<InstanceRecord> merged;
    for (const Source& source : sources)
        for (size_t i = 0; i < source.instance_meshes.size(); ++i)
        {
            InstanceRecord record = source.import_part.instances()[i];
            record.mesh = source.instance_meshes[i];
            rebase(record, source.offsets);
            merged.push_back(record);
        }
    return writer.addRecords<InstanceRecord>(kChunkInstances, merged);
}

Status writeScene(ContainerWriter& writer, std::span<const Source> sources, const ImageTable& images)
{
    const auto write = [&]<typename T>(uint32_t type, std::span<const T> (PackView::*table)() const)
    { return writeTable(writer, sources, type, &Source::import_part, table); };
    HEARTH_TRY(write(kChunkNodes, &PackView::nodes));
    HEARTH_TRY(writeInstances(writer, sources));
    HEARTH_TRY(write(kChunkCameras, &PackView::cameras));
    HEARTH_TRY(write(kChunkLights, &PackView::lights));
    HEARTH_TRY(write(kChunkShadowSpheres, &PackView::shadowSpheres));
    HEARTH_TRY(writeMaterials(writer, sources, images));
    HEARTH_TRY(writeMaterialLayers(writer, sources, images));
    HEARTH_TRY(writeImages(writer, sources, images));
    HEARTH_TRY(write(kChunkSkins, &PackView::skins));
    HEARTH_TRY(write(kChunkJoints, &PackView::joints));
    HEARTH_TRY(write(kChunkAnimations, &PackView::animations));
    HEARTH_TRY(write(kChunkChannels, &PackView::channels));
    HEARTH_TRY(writeJoined(writer, sources, kChunkKeys, &Source::import_part, &PackView::keys));
    HEARTH_TRY(writeKeyBits(writer, sources));
    return writeJoined(writer, sources, kChunkMorphWeights, &Source::import_part, &PackView::morphWeights);
}

/// Return the extras of a source. Copies of a mesh have those of the mesh.
std::vector<ExtrasRecord> collectExtras(const Source& source)
{
    const std::span<const ExtrasRecord> own = source.import_part.extras();
    std::vector<ExtrasRecord> extras(own.begin(), own.end());
    const std::vector<uint32_t> originals =
        findOriginalMeshes(source.import_part, source.instance_meshes, source.clusters_part.meshes().size());
    for (uint32_t mesh = 0; mesh < originals.size(); ++mesh)
    {
        if (originals[mesh] == mesh)
            continue;
        for (ExtrasRecord record : own)
            if (static_cast<ExtrasOwner>(record.owner) == ExtrasOwner::mesh &&
                record.index == originals[mesh])
            {
                record.index = mesh;
                extras.push_back(record);
            }
    }
    return extras;
}

/// Write the extras of all sources, sorted by object; no chunk if there are none.
Status writeExtras(ContainerWriter& writer, std::span<const Source> sources)
{
    std::vector<ExtrasRecord> merged;
    for (const Source& source : sources)
        for (ExtrasRecord record : collectExtras(source))
        {
            rebase(record, source.offsets);
            merged.push_back(record);
        }
    std::stable_sort(merged.begin(), merged.end(),
                     [](const ExtrasRecord& a, const ExtrasRecord& b)
                     { return makeExtrasKey(a.owner, a.index) < makeExtrasKey(b.owner, b.index); });
    return merged.empty() ? success() : writer.addRecords<ExtrasRecord>(kChunkExtras, merged);
}

/// Write the groups of all sources; groups of deformed meshes get the spheres that hold in all poses.
Status writeGroups(ContainerWriter& writer, std::span<const Source> sources)
{
    std::vector<GroupRecord> merged;
    for (const Source& source : sources)
    {
        const size_t first = merged.size();
        for (GroupRecord group : source.clusters_part.groups())
        {
            rebase(group, source.offsets);
            merged.push_back(group);
        }
        for (const DeformedGroupRecord& deformed : source.deformed_groups.span())
        {
            merged[first + deformed.group].sphere_center = deformed.sphere_center;
            merged[first + deformed.group].sphere_radius = deformed.sphere_radius;
        }
    }
    return writer.addRecords<GroupRecord>(kChunkGroups, merged);
}

Status writeMeshes(ContainerWriter& writer, std::span<const Source> sources)
{
    const auto write = [&]<typename T>(uint32_t type, std::span<const T> (PackView::*table)() const)
    { return writeTable(writer, sources, type, &Source::clusters_part, table); };
    HEARTH_TRY(write(kChunkMeshes, &PackView::meshes));
    HEARTH_TRY(write(kChunkLevels, &PackView::levels));
    HEARTH_TRY(writeGroups(writer, sources));
    HEARTH_TRY(write(kChunkClusters, &PackView::clusters));
    HEARTH_TRY(write(kChunkPageTable, &PackView::pages));
    return write(kChunkPageParents, &PackView::pageParents);
}

/// Write the list of authored levels; no chunk if there are none.
Status writeAuthoredLevels(ContainerWriter& writer, std::span<const Source> sources)
{
    const auto hasSome = [](const Source& source) { return !source.clusters_part.authoredLevels().empty(); };
    if (std::none_of(sources.begin(), sources.end(), hasSome))
        return success();
    return writeTable(writer, sources, kChunkAuthoredLevels, &Source::clusters_part,
                      &PackView::authoredLevels);
}

/// Write the proxies of all sources; no chunks if there are none.
Status writeProxies(ContainerWriter& writer, std::span<const Source> sources)
{
    const auto hasSome = [](const Source& source) { return !source.proxy_part.proxies().empty(); };
    if (std::ranges::none_of(sources, hasSome))
        return success();
    const auto write = [&]<typename T>(uint32_t type, std::span<const T> (PackView::*table)() const)
    { return writeTable(writer, sources, type, &Source::proxy_part, table); };
    HEARTH_TRY(write(kChunkProxies, &PackView::proxies));
    HEARTH_TRY(write(kChunkProxySections, &PackView::proxySections));
    const auto join = [&]<typename T>(uint32_t type, std::span<const T> (PackView::*table)() const)
    { return writeJoined(writer, sources, type, &Source::proxy_part, table); };
    HEARTH_TRY(join(kChunkProxyPositions, &PackView::proxyPositions));
    HEARTH_TRY(join(kChunkProxyIndices, &PackView::proxyIndices));
    return join(kChunkProxyBindings, &PackView::proxyBindings);
}

/// Write the surroundings of instances; no chunks if no source has any.
Status writeSurroundings(ContainerWriter& writer, std::span<const Source> sources)
{
    const auto isBaked = [](const Source& source) { return !source.clusters_part.surroundings().empty(); };
    if (std::none_of(sources.begin(), sources.end(), isBaked))
        return success();
    std::vector<SurroundingsRecord> merged;
    for (const Source& source : sources)
    {
        for (SurroundingsRecord record : source.clusters_part.surroundings())
        {
            rebase(record, source.offsets);
            merged.push_back(record);
        }
        if (!isBaked(source))
            merged.resize(merged.size() + source.import_part.instances().size(), kPlainSurroundings);
    }
    HEARTH_TRY(writer.addRecords<SurroundingsRecord>(kChunkSurroundings, merged));
    return writeJoined(writer, sources, kChunkRadianceTransfers, &Source::clusters_part,
                       &PackView::radianceTransfers);
}

/// Write the bounds of deformed meshes; no chunks if no source has any.
Status writeDeformedMeshes(ContainerWriter& writer, std::span<const Source> sources)
{
    const auto write = [&]<typename T>(uint32_t type, std::span<const T> (PackView::*table)() const)
    { return writeTable(writer, sources, type, &Source::skinning_part, table); };
    const auto isDeformed = [](const Source& source)
    { return !source.skinning_part.deformedMeshes().empty(); };
    if (std::none_of(sources.begin(), sources.end(), isDeformed))
        return success();
    HEARTH_TRY(write(kChunkDeformedMeshes, &PackView::deformedMeshes));
    HEARTH_TRY(write(kChunkDeformedClusters, &PackView::deformedClusters));
    // joint numbers are relative to their skin
    return writeJoined(writer, sources, kChunkClusterJoints, &Source::skinning_part,
                       &PackView::clusterJoints);
}

Status writePages(ContainerWriter& writer, std::span<const Source> sources)
{
    constexpr std::byte kZeros[kChunkAlignment] = {};
    HEARTH_TRY(writer.beginChunk({.type = kChunkPages, .version = chunkVersion(kChunkPages)}, 1));
    for (const Source& source : sources)
    {
        const std::span<const std::byte> pages = source.clusters_part.pageBytes();
        for (size_t at = 0; at < pages.size(); at += kCopyBytes)
            HEARTH_TRY(writer.append(pages.subspan(at, std::min(kCopyBytes, pages.size() - at))));
        HEARTH_TRY(writer.append(std::span(kZeros).first(alignChunk(pages.size()) - pages.size())));
    }
    return writer.endChunk();
}

/// Copy the chunks of a type as they are stored, with `offset` added to their index.
Status copyChunks(ContainerWriter& writer, const PackView& part, uint32_t type, uint32_t offset)
{
    for (const ChunkEntry& entry : part.container().chunks())
        if (entry.type == type)
            HEARTH_TRY(
                writer.addStored({.type = type, .index = entry.index + offset, .version = entry.version},
                                 entry, part.container().stored(entry)));
    return success();
}

/// Copy the texels of the images of the pack as they are stored.
Status copyImages(ContainerWriter& writer, std::span<const Source> sources, const ImageTable& images)
{
    for (uint32_t i = 0; i < images.places().size(); ++i)
    {
        const ImagePlace& place = images.places()[i];
        const ContainerReader& part = sources[place.source].textures_part.container();
        if (const ChunkEntry* const entry = part.find(kChunkImageData, place.image))
            HEARTH_TRY(writer.addStored({.type = kChunkImageData, .index = i, .version = entry->version},
                                        *entry, part.stored(*entry)));
    }
    return success();
}

/// Return the one table that all parts have; empty if there are no parts.
Result<std::vector<SpecularTableRecord>> readSpecular(std::span<const std::string> paths)
{
    std::vector<SpecularTableRecord> tables;
    for (const std::string& path : paths)
    {
        HEARTH_ASSIGN_OR_RETURN(const PackView part, openPart(path));
        if (part.specularTables().size() != 1)
            return Error{Issue::chunk_missing, path, chunkName(kChunkSpecular, 0),
                         "this is not a specular part: it has " +
                             std::to_string(part.specularTables().size()) + " tables"};
        const SpecularTableRecord& table = part.specularTables()[0];
        if (tables.empty())
            tables.push_back(table);
        else if (std::memcmp(&tables[0], &table, sizeof(table)) != 0)
            return Error{Issue::meaning_reference, path, "",
                         "its table of specular occlusion is not that of " + paths[0] + ": a pack has one"};
    }
    return tables;
}

/// Open the part with the pack's bricks, or with the reason why it has none; nullopt if `path` is empty.
Result<std::optional<PackView>> openBricks(const std::string& path)
{
    if (path.empty())
        return std::optional<PackView>();
    HEARTH_ASSIGN_OR_RETURN(PackView part, openPart(path));
    if (!part.brickGrid().empty())
        HEARTH_TRY(checkBricks(part)); // a failure here names the part
    else if (!hasSettings(part.meta(), "bricks"))
        return Error{Issue::chunk_missing, path, chunkName(kChunkBrickGrid, 0),
                     "this is not a bricks part: it has no grid"};
    return std::optional<PackView>(std::move(part));
}

/// Open the part with the pack's receivers, or with the reason why it has none; nullopt if `path` is empty.
/// bricks  part with the grid whose faces may be receivers
Result<std::optional<PackView>> openReceivers(const std::string& path, const std::optional<PackView>& bricks)
{
    if (path.empty())
        return std::optional<PackView>();
    HEARTH_ASSIGN_OR_RETURN(PackView part, openPart(path));
    HEARTH_TRY(checkReceivers(part)); // a failure here names the part
    if (part.receivers().lamps.empty() && !hasSettings(part.meta(), "receivers"))
        return Error{Issue::chunk_missing, path, chunkName(kChunkReceiverLamps, 0),
                     "this is not a receivers part: it has no lamps"};
    if (!part.faceAtlases().empty())
    {
        const uint32_t faces = bricks && !bricks->brickGrid().empty() ? bricks->brickGrid()[0].face_count : 0;
        if (const FaceAtlasSize size = faceAtlasSize(faces);
            part.faceAtlases()[0].width != size.width || part.faceAtlases()[0].height != size.height)
            return Error{Issue::meaning_reference, path, chunkName(kChunkFaceReceivers, 0),
                         "it has the light of other bricks than the pack, which has " +
                             std::to_string(faces) + " faces; cook it again with --bricks"};
    }
    return std::optional<PackView>(std::move(part));
}

/// Copy the chunks of a part that a pack has once, if it has any.
Status copyTables(ContainerWriter& writer, const std::optional<PackView>& part,
                  std::span<const uint32_t> types)
{
    if (part)
        for (const uint32_t type : types)
            HEARTH_TRY(copyChunks(writer, *part, type, 0));
    return success();
}

void addProbes(const PackView& part, ProbeTables& tables)
{
    for (ProbeRecord record : part.probes())
    {
        record.texels.first += static_cast<uint32_t>(tables.texels.size());
        tables.records.push_back(record);
    }
    tables.texels.insert(tables.texels.end(), part.probeTexels().begin(), part.probeTexels().end());
}

/// Open the parts with the pack's light probes.
Result<std::vector<PackView>> openProbes(std::span<const std::string> paths)
{
    std::vector<PackView> parts;
    for (const std::string& path : paths)
    {
        HEARTH_ASSIGN_OR_RETURN(PackView part, openPart(path));
        HEARTH_TRY(checkProbes(part)); // a failure here names the part
        if (part.probes().empty())
            return Error{Issue::chunk_missing, path, chunkName(kChunkProbes, 0),
                         "this is not a probe part: it has no probe"};
        parts.push_back(std::move(part));
    }
    return parts;
}

/// Warn of the skies of sources that are not the pack's, since its image of the sky is named.
void warnOfSkies(std::span<const Source> sources)
{
    for (const Source& source : sources)
        if (shared::findSkyProbe(source.import_part.probes()))
            std::fprintf(stderr, "%s\n",
                         formatMessage({Issue::dropped, tools::readSourceName(source.import_part), "",
                                        "its image-based light is not the sky of the pack: "
                                        "environment.file names another"})
                             .c_str());
}

/// Read the pack's light probes: the sky that a source brings along, unless a part has one, and all of
/// the parts.
Result<ProbeTables> readProbes(std::span<const std::string> paths, std::span<const Source> sources)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<PackView> parts, openProbes(paths));
    ProbeTables tables;
    const auto hasSky = [](const PackView& part) { return shared::findSkyProbe(part.probes()).has_value(); };
    if (std::ranges::any_of(parts, hasSky))
        warnOfSkies(sources);
    else
    {
        std::vector<const PackView*> import_parts;
        for (const Source& source : sources)
            import_parts.push_back(&source.import_part);
        HEARTH_ASSIGN_OR_RETURN(const PackView* const of_source, tools::findSourceSky(import_parts));
        if (of_source != nullptr)
        {
            HEARTH_TRY(checkProbes(*of_source));
            addProbes(*of_source, tables);
        }
    }
    for (const PackView& part : parts)
        addProbes(part, tables);
    return tables;
}

Result<OpenPackParts> openPackParts(const PackParts& parts, std::span<const Source> sources)
{
    OpenPackParts opened;
    HEARTH_ASSIGN_OR_RETURN(opened.specular, readSpecular(parts.specular));
    HEARTH_ASSIGN_OR_RETURN(opened.bricks, openBricks(parts.bricks));
    HEARTH_ASSIGN_OR_RETURN(opened.probes, readProbes(parts.probes, sources));
    HEARTH_ASSIGN_OR_RETURN(opened.receivers, openReceivers(parts.receivers, opened.bricks));
    return opened;
}

Status writeReflectionTables(ContainerWriter& writer, const OpenPackParts& parts)
{
    if (!parts.specular.empty())
        HEARTH_TRY(writer.addRecords<SpecularTableRecord>(kChunkSpecular, parts.specular));
    if (parts.probes.records.empty())
        return success();
    HEARTH_TRY(writer.addRecords<ProbeRecord>(kChunkProbes, parts.probes.records));
    return writer.addRecords<uint32_t>(kChunkProbeTexels, parts.probes.texels);
}

Status writePack(const std::string& path, std::span<const Source> sources, const OpenPackParts& pack_parts,
                 std::span<const std::string> skipped, uint64_t texture_budget)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer, ContainerWriter::create(path, ContainerKind::pack));
    HEARTH_TRY(writeMeta(writer, sources, pack_parts, skipped, texture_budget, path));
    HEARTH_TRY(writeStrings(writer, sources));
    std::vector<const PackView*> textures;
    for (const Source& source : sources)
        textures.push_back(&source.textures_part);
    const ImageTable images(textures);
    HEARTH_TRY(writeScene(writer, sources, images));
    HEARTH_TRY(writeAssets(writer, sources));
    HEARTH_TRY(writeExtras(writer, sources));
    HEARTH_TRY(writeMeshes(writer, sources));
    HEARTH_TRY(writeAuthoredLevels(writer, sources));
    HEARTH_TRY(writeDeformedMeshes(writer, sources));
    HEARTH_TRY(writeProxies(writer, sources));
    HEARTH_TRY(writeReflectionTables(writer, pack_parts));
    HEARTH_TRY(writeSurroundings(writer, sources));
    HEARTH_TRY(copyTables(writer, pack_parts.bricks, kBrickChunks));
    HEARTH_TRY(copyTables(writer, pack_parts.receivers, kReceiverChunks));
    HEARTH_TRY(copyTables(writer, pack_parts.receivers, kFaceReceiverChunks));
    HEARTH_TRY(writePages(writer, sources));
    HEARTH_TRY(copyImages(writer, sources, images));
    return writer.finish();
}

/// Check the pack as the runtime will read it, before it appears under its name.
Status checkPackFile(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerReader reader, ContainerReader::open(path));
    HEARTH_ASSIGN_OR_RETURN(const PackView pack, PackView::read(std::move(reader)));
    return verify::verifyPack(pack);
}

} // namespace

Status linkPack(std::span<const SourceParts> sources, const std::string& output, const PackParts& pack_parts,
                std::span<const std::string> skipped, uint64_t texture_budget)
{
    std::vector<Source> opened;
    for (const SourceParts& parts : sources)
    {
        HEARTH_ASSIGN_OR_RETURN(Source source, openSource(parts));
        opened.push_back(std::move(source));
    }
    HEARTH_TRY(assignOffsets(opened, output));
    HEARTH_ASSIGN_OR_RETURN(const OpenPackParts once, openPackParts(pack_parts, opened));

    const std::string unchecked = output + ".unchecked-" + std::to_string(::getpid());
    Status status = writePack(unchecked, opened, once, skipped, texture_budget);
    if (status.ok())
        status = checkPackFile(unchecked);
    if (status.ok() && ::rename(unchecked.c_str(), output.c_str()) != 0)
        status =
            Error{Issue::cannot_write, output, "", std::string("cannot rename: ") + std::strerror(errno)};
    if (status.ok())
        return success();

    ::unlink(unchecked.c_str());
    Error error = std::move(status).error();
    if (error.file == unchecked)
        error.file = output; // the name that the user passed
    return error;
}

} // namespace hearth::link
