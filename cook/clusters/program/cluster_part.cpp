// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/program/cluster_part.h"

#include "cook/clusters/program/part_motion.h"
#include "cook/mesh/free_memory.h"
#include "formats/base/assert.h"
#include "formats/pack/pack_view.h"
#include "formats/records/material_layers.h"
#include "formats/records/provenance.h"

#include <chrono>
#include <limits>

#include <tbb/parallel_for.h>

namespace hearth::clusters
{

namespace
{

using namespace formats;

/// Tables of all meshes; the pages go to the file directly.
struct Tables
{
    std::string strings;
    std::vector<MeshRecord> meshes;
    std::vector<LevelRecord> levels;
    std::vector<GroupRecord> groups;
    std::vector<ClusterRecord> clusters;
    std::vector<PageRecord> pages;
    std::vector<uint32_t> page_parents;
    std::vector<AuthoredLevelRecord> authored_levels;
};

void move(uint32_t& index, size_t offset)
{
    if (index != kInvalidIndex)
        index += static_cast<uint32_t>(offset);
}
void move(Range& range, size_t offset)
{
    range.first += static_cast<uint32_t>(offset);
}

/// Append a mesh's tables; its indices, which start at 0, are offset behind the existing ones.
void appendTables(Tables& tables, Hierarchy hierarchy, uint64_t page_offset, const std::string& name)
{
    const auto mesh_index = static_cast<uint32_t>(tables.meshes.size());
    hierarchy.mesh.name = {static_cast<uint32_t>(tables.strings.size()), static_cast<uint32_t>(name.size())};
    tables.strings += name;
    move(hierarchy.mesh.levels, tables.levels.size());
    move(hierarchy.mesh.groups, tables.groups.size());
    move(hierarchy.mesh.clusters, tables.clusters.size());
    move(hierarchy.mesh.pages, tables.pages.size());
    for (LevelRecord& level : hierarchy.levels)
        move(level.clusters, tables.clusters.size());
    for (GroupRecord& group : hierarchy.groups)
    {
        move(group.clusters, tables.clusters.size());
        move(group.page, tables.pages.size());
    }
    for (ClusterRecord& cluster : hierarchy.clusters)
    {
        move(cluster.page, tables.pages.size());
        move(cluster.group, tables.groups.size());
        move(cluster.refined_group, tables.groups.size());
    }
    for (PageRecord& page : hierarchy.pages)
    {
        page.offset += page_offset;
        page.mesh = mesh_index;
        move(page.clusters, tables.clusters.size());
        move(page.parents, tables.page_parents.size());
    }
    for (uint32_t& parent : hierarchy.page_parents)
        move(parent, tables.pages.size());

    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    tables.meshes.push_back(hierarchy.mesh);
    append(tables.levels, hierarchy.levels);
    append(tables.groups, hierarchy.groups);
    append(tables.clusters, hierarchy.clusters);
    append(tables.pages, hierarchy.pages);
    append(tables.page_parents, hierarchy.page_parents);
}

StringRef addText(Tables& tables, std::string_view text)
{
    const StringRef ref{static_cast<uint32_t>(tables.strings.size()), static_cast<uint32_t>(text.size())};
    tables.strings += text;
    return text.empty() ? StringRef{} : ref;
}

bool fits(const Tables& tables)
{
    constexpr size_t kMaxIndex = std::numeric_limits<int32_t>::max();
    return tables.strings.size() < kMaxIndex && tables.clusters.size() < kMaxIndex &&
           tables.page_parents.size() < kMaxIndex;
}

template <typename T>
Status addTable(ContainerWriter& writer, uint32_t type, const std::vector<T>& records)
{
    return writer.addRecords(type, std::span<const T>(records));
}

} // namespace

uint32_t meshCount(const ContainerReader& part)
{
    uint32_t count = 0;
    while (part.find(kChunkSourceMesh, count) != nullptr)
        ++count;
    return count;
}

Result<std::vector<std::string>> materialNames(const ContainerReader& part)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView view, PackView::read(part));
    std::vector<std::string> names;
    for (const MaterialRecord& material : view.materials())
        names.emplace_back(view.text(material.name));
    return names;
}

namespace
{

/// Return the UV sets that textures of each material read, as in Config.
std::vector<uint8_t> findReadUvSets(const PackView& view)
{
    std::vector<uint8_t> sets(view.materials().size(), 0);
    const auto add = [&](uint32_t material, const TextureRef& texture)
    {
        if (texture.image != kInvalidIndex)
            sets[material] = static_cast<uint8_t>(sets[material] | 1u << (texture.uv_set & 3u));
    };
    for (uint32_t material = 0; material < sets.size(); ++material)
        for (const auto field : kMaterialTextureFields)
            add(material, view.materials()[material].*field);
    for (const MaterialLayersRecord& layers : view.materialLayers())
        if (layers.material < sets.size())
            for (const auto field : kLayerTextures)
                add(layers.material, layers.*field);
    return sets;
}

/// Authored LOD: its mesh, and its number and name for users.
struct AuthoredLodMesh
{
    uint32_t mesh;
    uint32_t number; ///< kInvalidIndex: no number
    std::string name;
};

/// Authored LODs of each mesh, finest first.
struct LodLists
{
    std::vector<std::vector<AuthoredLodMesh>> of_mesh;
    std::vector<uint8_t> is_lod;
};

Result<LodLists> readLodLists(const ContainerReader& part, uint32_t mesh_count)
{
    LodLists lists{std::vector<std::vector<AuthoredLodMesh>>(mesh_count),
                   std::vector<uint8_t>(mesh_count, 0)};
    HEARTH_ASSIGN_OR_RETURN(const Records<AuthoredLodRecord> records,
                            part.records<AuthoredLodRecord>(kChunkAuthoredLods));
    HEARTH_ASSIGN_OR_RETURN(const ChunkData strings, part.read(kChunkStrings));
    const std::string_view text(reinterpret_cast<const char*>(strings.bytes().data()),
                                strings.bytes().size());
    for (const AuthoredLodRecord& record : records)
    {
        if (record.mesh >= mesh_count || record.lod >= mesh_count || record.mesh == record.lod)
            return Error{Issue::meaning_reference, part.name(), chunkName(kChunkAuthoredLods, 0),
                         "a record names a mesh that does not exist, or one as its own level"};
        if (!isInsideTable({record.name.offset, record.name.length}, text.size()))
            return Error{Issue::meaning_range, part.name(), chunkName(kChunkAuthoredLods, 0),
                         "a name lies outside chunk STRS"};
        lists.of_mesh[record.mesh].push_back(
            {record.lod, record.number, std::string(text.substr(record.name.offset, record.name.length))});
        lists.is_lod[record.lod] = 1;
    }
    return lists;
}

/// Append records of the levels that authored LODs became; `level_of_lod` as Hierarchy::authored_levels.
void appendAuthoredLevels(Tables& tables, uint32_t mesh, std::span<const uint32_t> level_of_lod,
                          std::span<const AuthoredLodMesh> lods)
{
    HEARTH_ASSERT(level_of_lod.empty() || level_of_lod.size() == lods.size());
    for (size_t i = 0; i < level_of_lod.size(); ++i)
        if (level_of_lod[i] != kInvalidIndex)
            tables.authored_levels.push_back(
                {mesh, level_of_lod[i], lods[i].number, addText(tables, lods[i].name)});
}

/// Build a mesh. A mesh that is an authored LOD of another is part of that one, and has no hierarchy itself.
Result<BuiltMesh> buildMesh(const ContainerReader& part, const LodLists& lods, const PartMotion& motion,
                            std::span<const uint8_t> read_uv_sets, uint32_t index,
                            const MeshConfigurer& configure)
{
    const auto start = std::chrono::steady_clock::now();
    HEARTH_ASSIGN_OR_RETURN(mesh::SourceMesh source, mesh::readSourceMesh(part, index));
    BuiltMesh built;
    built.name = source.name;
    if (configure)
        built.config = configure(built.name);
    built.config.read_uv_sets.assign(read_uv_sets.begin(), read_uv_sets.end());
    if (lods.is_lod[index] != 0)
        return built;
    std::vector<mesh::SourceMesh> authored;
    for (const AuthoredLodMesh& lod : lods.of_mesh[index])
    {
        HEARTH_ASSIGN_OR_RETURN(mesh::SourceMesh level, mesh::readSourceMesh(part, lod.mesh));
        authored.push_back(std::move(level));
    }
    HEARTH_ASSIGN_OR_RETURN(const OwnedMotion owned, motion.meshMotion(index, source));
    built.hierarchy = buildHierarchy(std::move(source), authored, built.config, &owned.motion);
    built.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return built;
}

/// Return the end of the batch of meshes, from `first` on, that are built side by side; at least one. A fifth
/// of the work on a large mesh is single-threaded. Building takes about three times the bytes of the source
/// meshes.
uint32_t endOfBatch(const ContainerReader& part, uint32_t first, uint32_t mesh_count)
{
    constexpr uint64_t kBatchBytes = uint64_t{256} << 20;
    uint64_t bytes = 0;
    uint32_t end = first;
    while (end < mesh_count)
    {
        bytes += part.find(kChunkSourceMesh, end)->size;
        if (end > first && bytes > kBatchBytes)
            break;
        ++end;
    }
    return end;
}

/// Build the meshes of a batch; each has a result or an error.
std::vector<Result<BuiltMesh>> buildBatch(const ContainerReader& part, const LodLists& lods,
                                          const PartMotion& motion, std::span<const uint8_t> read_uv_sets,
                                          Range meshes, const MeshConfigurer& configure)
{
    std::vector<Result<BuiltMesh>> batch(meshes.count, BuiltMesh{});
    tbb::parallel_for(uint32_t{0}, meshes.count,
                      [&](uint32_t i) {
                          batch[i] = buildMesh(part, lods, motion, read_uv_sets, meshes.first + i, configure);
                      });
    return batch;
}

} // namespace

Status writeClustersPart(const ContainerReader& part, const std::string& output_path,
                         const MeshConfigurer& configure, const MeshObserver& observe)
{
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));
    const uint32_t mesh_count = meshCount(part);
    HEARTH_ASSIGN_OR_RETURN(const LodLists lods, readLodLists(part, mesh_count));
    HEARTH_ASSIGN_OR_RETURN(const PartMotion motion, PartMotion::read(part));
    HEARTH_ASSIGN_OR_RETURN(const PackView view, PackView::read(part));
    const std::vector<uint8_t> read_uv_sets = findReadUvSets(view);
    Tables tables;
    HEARTH_TRY(writer.beginChunk({.type = kChunkPages, .version = chunkVersion(kChunkPages)}, 1));
    for (uint32_t first = 0; first < mesh_count;)
    {
        const uint32_t end = endOfBatch(part, first, mesh_count);
        for (Result<BuiltMesh>& result :
             buildBatch(part, lods, motion, read_uv_sets, {first, end - first}, configure))
        {
            HEARTH_ASSIGN_OR_RETURN(BuiltMesh built, std::move(result));
            if (observe)
                HEARTH_TRY(observe(first, built));
            const uint64_t page_offset = writer.chunkSize();
            HEARTH_TRY(writer.append(built.hierarchy.page_bytes));
            mesh::freeMemory(built.hierarchy.page_bytes);
            const std::vector<uint32_t> level_of_lod = std::move(built.hierarchy.authored_levels);
            appendTables(tables, std::move(built.hierarchy), page_offset, built.name);
            appendAuthoredLevels(tables, first, level_of_lod, lods.of_mesh[first]);
            if (!fits(tables))
                return Error{Issue::input_too_large, part.name(), chunkName(kChunkSourceMesh, first),
                             "more than 2^31 clusters"};
            ++first;
        }
    }
    HEARTH_TRY(writer.endChunk());

    HEARTH_TRY(writer.addText(kChunkStrings, tables.strings));
    HEARTH_TRY(addTable(writer, kChunkMeshes, tables.meshes));
    HEARTH_TRY(addTable(writer, kChunkLevels, tables.levels));
    HEARTH_TRY(addTable(writer, kChunkGroups, tables.groups));
    HEARTH_TRY(addTable(writer, kChunkClusters, tables.clusters));
    HEARTH_TRY(addTable(writer, kChunkPageTable, tables.pages));
    HEARTH_TRY(addTable(writer, kChunkPageParents, tables.page_parents));
    if (!tables.authored_levels.empty())
        HEARTH_TRY(addTable(writer, kChunkAuthoredLevels, tables.authored_levels));
    return writer.finish();
}

} // namespace hearth::clusters
