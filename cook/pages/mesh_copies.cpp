// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/pages/mesh_copies.h"

#include "formats/container/container_writer.h"

#include <algorithm>
#include <vector>

namespace hearth::pages
{

using namespace formats;

namespace
{

/// Tables of meshes, which copies are appended to.
struct MeshTables
{
    std::vector<MeshRecord> meshes;
    std::vector<LevelRecord> levels;
    std::vector<GroupRecord> groups;
    std::vector<ClusterRecord> clusters;
    std::vector<PageRecord> pages;
    std::vector<uint32_t> page_parents;
    std::vector<AuthoredLevelRecord> authored_levels;
    std::vector<uint32_t> page_sources; ///< of each copied page, the page that it is a copy of
    uint64_t page_bytes = 0;
};

template <typename T>
std::vector<T> copyTable(std::span<const T> records)
{
    return {records.begin(), records.end()};
}

/// Append the records of a range, and return the range of the copies.
template <typename T, typename Change>
Range appendRange(std::vector<T>& records, Range range, const Change& change)
{
    const Range copies{static_cast<uint32_t>(records.size()), range.count};
    for (uint32_t i = 0; i < range.count; ++i)
    {
        T record = records[range.first + i];
        change(record);
        records.push_back(record);
    }
    return copies;
}

/// Return an index into the copy of a range, or none for none.
uint32_t moveIndex(uint32_t index, Range from, uint32_t to_first)
{
    return index == kInvalidIndex ? index : index - from.first + to_first;
}

void appendCopy(uint32_t of_mesh, MeshTables& tables)
{
    const auto count = [](const auto& table) { return static_cast<uint32_t>(table.size()); };
    const uint32_t copy = count(tables.meshes);
    const MeshRecord mesh = tables.meshes[of_mesh];
    const uint32_t first_group = count(tables.groups), first_cluster = count(tables.clusters),
                   first_page = count(tables.pages);
    const auto moveGroup = [&](uint32_t& group) { group = moveIndex(group, mesh.groups, first_group); };
    const auto movePage = [&](uint32_t& page) { page = moveIndex(page, mesh.pages, first_page); };
    const auto moveClusters = [&](Range& clusters)
    { clusters.first = clusters.first - mesh.clusters.first + first_cluster; };
    MeshRecord record = mesh;
    record.levels =
        appendRange(tables.levels, mesh.levels, [&](LevelRecord& level) { moveClusters(level.clusters); });
    record.groups = appendRange(tables.groups, mesh.groups,
                                [&](GroupRecord& group)
                                {
                                    moveClusters(group.clusters);
                                    movePage(group.page);
                                });
    record.clusters = appendRange(tables.clusters, mesh.clusters,
                                  [&](ClusterRecord& cluster)
                                  {
                                      movePage(cluster.page);
                                      moveGroup(cluster.group);
                                      moveGroup(cluster.refined_group);
                                  });
    record.pages = appendRange(tables.pages, mesh.pages,
                               [&](PageRecord& page)
                               {
                                   page.mesh = copy;
                                   moveClusters(page.clusters);
                                   page.parents = appendRange(tables.page_parents, page.parents, movePage);
                                   page.offset = tables.page_bytes;
                                   tables.page_bytes += alignChunk(page.stored_size);
                               });
    for (uint32_t page = 0; page < mesh.pages.count; ++page)
        tables.page_sources.push_back(mesh.pages.first + page);
    tables.meshes.push_back(record);
    const size_t authored = tables.authored_levels.size();
    for (size_t i = 0; i < authored; ++i)
        if (tables.authored_levels[i].mesh == of_mesh)
        {
            AuthoredLevelRecord level = tables.authored_levels[i];
            level.mesh = copy;
            tables.authored_levels.push_back(level);
        }
}

Result<MeshTables> makeTables(const PackView& part, std::span<const uint32_t> meshes)
{
    MeshTables tables{.meshes = copyTable(part.meshes()),
                      .levels = copyTable(part.levels()),
                      .groups = copyTable(part.groups()),
                      .clusters = copyTable(part.clusters()),
                      .pages = copyTable(part.pages()),
                      .page_parents = copyTable(part.pageParents()),
                      .authored_levels = copyTable(part.authoredLevels()),
                      .page_sources = {},
                      .page_bytes = alignChunk(part.pageBytes().size())};
    for (const uint32_t mesh : meshes)
    {
        appendCopy(mesh, tables);
        // the tables of clusters and of parents are the longest ones
        if (std::max(tables.clusters.size(), tables.page_parents.size()) >= kInvalidIndex / 2)
            return Error{Issue::input_too_large, part.name(), "",
                         "copies of meshes do not fit into one file: bake with --copies 0"};
    }
    return tables;
}

/// Write the part's own pages and then those of the copies, each aligned.
Status writePages(ContainerWriter& writer, const PackView& part, const MeshTables& tables)
{
    constexpr std::byte kZeros[kChunkAlignment] = {};
    const auto append = [&](std::span<const std::byte> bytes) -> Status
    {
        HEARTH_TRY(writer.append(bytes));
        return writer.append(std::span(kZeros).first(alignChunk(bytes.size()) - bytes.size()));
    };
    HEARTH_TRY(append(part.pageBytes()));
    for (const uint32_t source : tables.page_sources)
    {
        const PageRecord& page = part.pages()[source];
        HEARTH_TRY(append(part.pageBytes().subspan(page.offset, page.stored_size)));
    }
    return success();
}

} // namespace

uint64_t countCopyBytes(const PackView& part, uint32_t mesh)
{
    const MeshRecord& record = part.meshes()[mesh];
    uint64_t bytes = sizeof(MeshRecord) + record.levels.count * sizeof(LevelRecord) +
                     record.groups.count * sizeof(GroupRecord) +
                     record.clusters.count * sizeof(ClusterRecord) + record.pages.count * sizeof(PageRecord);
    for (const PageRecord& page : recordsInRange(part.pages(), record.pages))
        bytes += alignChunk(page.stored_size) + page.parents.count * sizeof(uint32_t);
    return bytes;
}

Status copyMeshes(const PackView& part, std::span<const uint32_t> meshes, const std::string& output_path)
{
    HEARTH_ASSIGN_OR_RETURN(const MeshTables tables, makeTables(part, meshes));
    HEARTH_ASSIGN_OR_RETURN(ContainerWriter writer,
                            ContainerWriter::create(output_path, ContainerKind::part));
    for (const ChunkEntry& entry : part.container().chunks())
    {
        const ChunkId id{entry.type, entry.index, entry.version};
        const auto write = [&]() -> Status
        {
            switch (entry.type)
            {
            case kChunkMeshes:
                return writer.addRecords<MeshRecord>(entry.type, tables.meshes);
            case kChunkLevels:
                return writer.addRecords<LevelRecord>(entry.type, tables.levels);
            case kChunkGroups:
                return writer.addRecords<GroupRecord>(entry.type, tables.groups);
            case kChunkClusters:
                return writer.addRecords<ClusterRecord>(entry.type, tables.clusters);
            case kChunkPageTable:
                return writer.addRecords<PageRecord>(entry.type, tables.pages);
            case kChunkPageParents:
                return writer.addRecords<uint32_t>(entry.type, tables.page_parents);
            case kChunkAuthoredLevels:
                return writer.addRecords<AuthoredLevelRecord>(entry.type, tables.authored_levels);
            case kChunkPages:
                HEARTH_TRY(writer.beginChunk(id, entry.element_size));
                HEARTH_TRY(writePages(writer, part, tables));
                return writer.endChunk();
            default:
                return writer.addStored(id, entry, part.container().stored(entry));
            }
        };
        HEARTH_TRY(write());
    }
    return writer.finish();
}

} // namespace hearth::pages
