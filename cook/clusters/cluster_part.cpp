// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/cluster_part.h"

#include "formats/scene.h"

#include <limits>

namespace hearth::clusters
{

namespace
{

using namespace formats;

/// Tables of all meshes, and the pages as they go into the file.
struct Tables
{
    std::string strings;
    std::vector<MeshRecord> meshes;
    std::vector<LevelRecord> levels;
    std::vector<GroupRecord> groups;
    std::vector<ClusterRecord> clusters;
    std::vector<PageRecord> pages;
    std::vector<uint32_t> page_parents;
};

void move(uint32_t& index, size_t offset)
{
    if (index != kNone)
        index += static_cast<uint32_t>(offset);
}
void move(Range& range, size_t offset)
{
    range.first += static_cast<uint32_t>(offset);
}

/// Append a mesh's tables; its indices, which start at 0, move behind those that are there.
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

bool fits(const Tables& tables)
{
    constexpr size_t kMost = std::numeric_limits<int32_t>::max();
    return tables.strings.size() < kMost && tables.clusters.size() < kMost &&
           tables.page_parents.size() < kMost;
}

template <typename T>
Status addTable(ContainerWriter& writer, uint32_t type, const std::vector<T>& records)
{
    return writer.addRecords(type, std::span<const T>(records));
}

void addCounts(BuildCounts& total, const BuildCounts& counts)
{
    total.permissive_groups += counts.permissive_groups;
    total.pruned_groups += counts.pruned_groups;
    total.retried_groups += counts.retried_groups;
    total.stuck_groups += counts.stuck_groups;
    total.loose_pieces += counts.loose_pieces;
}

} // namespace

Status writeClustersPart(const std::string& import_path, const std::string& output_path, const Config& config,
                         BuildCounts& counts)
{
    HEARTH_ASSIGN_OR_RETURN(const ContainerReader reader,
                            ContainerReader::open(import_path, Check::structure));
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));
    uint32_t mesh_count = 0;
    while (reader.find(kChunkSourceMesh, mesh_count) != nullptr)
        ++mesh_count;

    Tables tables;
    HEARTH_TRY(writer.beginChunk({.type = kChunkPages}, 1));
    for (uint32_t i = 0; i < mesh_count; ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(mesh::SourceMesh source, mesh::readSourceMesh(reader, i));
        const std::string name = source.name;
        Hierarchy hierarchy = buildHierarchy(std::move(source), config);
        addCounts(counts, hierarchy.counts);
        const uint64_t page_offset = writer.chunkSize();
        HEARTH_TRY(writer.append(hierarchy.page_bytes));
        hierarchy.page_bytes = {};
        appendTables(tables, std::move(hierarchy), page_offset, name);
        if (!fits(tables))
            return Error{Issue::input_too_large, import_path, chunkName(kChunkSourceMesh, i),
                         "more than 2^31 clusters"};
    }
    HEARTH_TRY(writer.endChunk());

    // joints, weights and morph targets go on as they are: their cooking needs the source's vertices
    for (uint32_t i = 0; i < mesh_count; ++i)
        if (tables.meshes[i].skinned != 0 || tables.meshes[i].morph_target_count != 0)
        {
            HEARTH_ASSIGN_OR_RETURN(const mesh::SourceMesh source, mesh::readSourceMesh(reader, i));
            HEARTH_TRY(mesh::writeDeformation(writer, i, source));
        }
    HEARTH_TRY(writer.addText(kChunkStrings, tables.strings));
    HEARTH_TRY(addTable(writer, kChunkMeshes, tables.meshes));
    HEARTH_TRY(addTable(writer, kChunkLevels, tables.levels));
    HEARTH_TRY(addTable(writer, kChunkGroups, tables.groups));
    HEARTH_TRY(addTable(writer, kChunkClusters, tables.clusters));
    HEARTH_TRY(addTable(writer, kChunkPageTable, tables.pages));
    HEARTH_TRY(addTable(writer, kChunkPageParents, tables.page_parents));
    return writer.finish();
}

} // namespace hearth::clusters
