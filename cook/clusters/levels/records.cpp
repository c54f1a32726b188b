// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/records.h"

#include "cook/clusters/pages/pages.h"
#include "formats/base/assert.h"

#include <algorithm>

namespace hearth::clusters
{

using namespace formats;

namespace
{

/// Return the file index of each group of the build: coarse to fine, in spatial order within a level.
IdVector<GroupId, uint32_t> recordNumbers(const Build& build)
{
    IdVector<GroupId, uint32_t> record_of_group(toIndex(build.levels.back().endGroup()));
    uint32_t next = 0;
    for (size_t l = build.levels.size(); l-- > 0;)
        for (size_t g = 0; g < build.levels[l].built.size(); ++g)
            record_of_group[build.levels[l].groupId(g)] = next++;
    return record_of_group;
}

/// Append the records of level l, and the shapes of its clusters in the same order.
void addLevelRecords(const Build& build, uint32_t l, IdSpan<GroupId, const uint32_t> record_of_group,
                     Hierarchy& hierarchy, std::vector<ClusterShape>& shapes, uint32_t vertex_offset,
                     uint32_t index_offset)
{
    const Level& level = build.levels[l];
    LevelRecord& level_record = hierarchy.levels[l];
    level_record.clusters.first = static_cast<uint32_t>(hierarchy.clusters.size());
    for (uint32_t g = 0; g < level.built.size(); ++g)
    {
        const LevelGroup& built = level.built[g];
        GroupRecord group{};
        group.sphere_center = built.sphere.center;
        group.sphere_radius = built.sphere.radius;
        group.error = built.errors.lod;
        group.position_error = built.errors.position;
        group.normal_error = built.errors.attributes.normal;
        group.uv_error = built.errors.attributes.uv;
        group.level = l;
        group.set_offset = built.set_offset;
        group.clusters.first = static_cast<uint32_t>(hierarchy.clusters.size());
        for (const ClusterId member : level.groups.groupMembers(g))
        {
            ClusterShape shape = level.store.shapes[member];
            ClusterRecord record{};
            record.group = record_of_group[level.groupId(g)];
            record.refined_group = kInvalidIndex;
            if (const GroupId refined = level.refined_group[member]; refined != kInvalid)
            {
                HEARTH_ASSERT(record_of_group.contains(refined));
                record.refined_group = record_of_group[refined];
                level_record.max_error = std::max(level_record.max_error, build.group(refined).errors.lod);
            }
            record.level = static_cast<uint8_t>(l);
            record.material = shape.material;
            level_record.triangle_count += shape.triangle_count;
            hierarchy.clusters.push_back(record);
            shape.first_vertex += vertex_offset;
            shape.first_index += index_offset;
            shapes.push_back(shape);
        }
        group.clusters.count = static_cast<uint32_t>(hierarchy.clusters.size()) - group.clusters.first;
        hierarchy.groups.push_back(group);
    }
    level_record.clusters.count =
        static_cast<uint32_t>(hierarchy.clusters.size()) - level_record.clusters.first;
}

} // namespace

void writeRecords(Build& build, Hierarchy& hierarchy)
{
    HEARTH_ASSERT(!build.levels.empty() && hierarchy.clusters.empty());
    const IdVector<GroupId, uint32_t> record_of_group = recordNumbers(build);
    ClusterStore store;
    std::vector<ClusterShape> shapes;
    hierarchy.levels.resize(build.levels.size());
    for (auto l = static_cast<uint32_t>(build.levels.size()); l-- > 0;)
    {
        ClusterStore& from = build.levels[l].store;
        addLevelRecords(build, l, record_of_group, hierarchy, shapes,
                        static_cast<uint32_t>(store.vertices.size()),
                        static_cast<uint32_t>(store.indices.size()));
        store.vertices.insert(store.vertices.end(), from.vertices.begin(), from.vertices.end());
        store.indices.insert(store.indices.end(), from.indices.begin(), from.indices.end());
        from = {};
    }
    HEARTH_ASSERT(hierarchy.groups.size() == record_of_group.size());
    HEARTH_ASSERT(hierarchy.clusters.size() == shapes.size());
    buildPages(build.mesh, store, shapes, build.config, hierarchy);
    if (std::any_of(build.level_of_authored.begin(), build.level_of_authored.end(),
                    [](uint32_t level) { return level != kInvalidIndex; }))
        linkPagesOfSets(hierarchy);
}

} // namespace hearth::clusters
