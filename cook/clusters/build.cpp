// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/bounds.h"
#include "cook/clusters/grouping.h"
#include "cook/clusters/hierarchy.h"
#include "cook/clusters/pages.h"
#include "cook/clusters/reduce.h"
#include "cook/clusters/split.h"
#include "formats/assert.h"
#include "formats/cluster_bounds.h"

#include <algorithm>
#include <limits>

#include <tbb/parallel_for.h>

namespace hearth::clusters
{

namespace
{

using namespace formats;

/// A group of a level that is built. Groups of all levels are numbered on, finest level first.
struct BuiltGroup
{
    Sphere sphere;
    float error = 0;       ///< infinity for a root
    ClusterStore clusters; ///< what replaces it, until the next level has taken it
    bool stuck = false;
    bool retried = false;
    Reduced outcome; ///< for the counts
};

struct Level
{
    ClusterStore store;
    std::vector<uint32_t> refined_group; ///< for each cluster, number of the group it was made from, or kNone
    std::vector<uint8_t> retries;        ///< for each cluster, how often it was passed on unchanged
    Groups groups;
    uint32_t first_group = 0; ///< number of its first group
    std::vector<BuiltGroup> built;
};

/// The levels so far, and lookups by group number.
struct Build
{
    PreparedMesh mesh;
    const Config& config;
    std::vector<Level> levels;

    const BuiltGroup& group(uint32_t number) const
    {
        const auto after =
            std::upper_bound(levels.begin(), levels.end(), number,
                             [](uint32_t n, const Level& level) { return n < level.first_group; });
        const Level& level = *(after - 1);
        return level.built[number - level.first_group];
    }
};

/// Contains the members' geometry and the spheres of all groups that they were made from.
Sphere groupSphere(const Build& build, const Level& level, std::span<const uint32_t> members)
{
    // the finer spheres hold the points of the finer groups, and with them all of the members' points
    std::vector<Sphere> spheres;
    uint32_t last_refined = kNone;
    for (const uint32_t member : members)
        if (const uint32_t refined = level.refined_group[member]; refined != kNone && refined != last_refined)
        {
            last_refined = refined;
            spheres.push_back(build.group(refined).sphere);
        }
    std::vector<Float3> points;
    for (const Sphere& sphere : spheres)
        points.push_back(sphere.center);
    if (spheres.empty())
        for (const uint32_t member : members)
            for (const uint32_t vertex : level.store.verticesOf(level.store.shapes[member]))
                points.push_back(build.mesh.vertices.positions[vertex]);
    const Sphere around_points = sphereOfPoints(points);
    const Sphere sphere = spheres.empty() ? around_points : sphereOfSpheres(spheres, around_points);
    return {sphere.center, roundUp(sphere.radius * kMonotoneSlack)};
}

float largestError(const Build& build, const Level& level, std::span<const uint32_t> members)
{
    float error = build.mesh.grid.error;
    for (const uint32_t member : members)
        if (level.refined_group[member] != kNone)
            error = std::max(error, build.group(level.refined_group[member]).error);
    return error;
}

/// Simplify a group, or decide what to do with one that is stuck: pass it on, or leave it as a root.
BuiltGroup buildGroup(const Build& build, const Level& level, std::span<const uint32_t> members,
                      std::span<const uint8_t> locked)
{
    BuiltGroup group;
    group.sphere = groupSphere(build, level, members);
    group.error = std::numeric_limits<float>::infinity();
    const bool alone = level.store.shapes.size() == members.size();
    if (alone && members.size() == 1)
        return group;

    const float members_error = largestError(build, level, members);
    Reduced reduced = reduceGroup(build.mesh, level.store, members, locked, members_error, build.config);
    if (reduced.progressed)
    {
        growToHold(group.sphere, reduced.made.positions);
        group.error = reduced.error;
        group.clusters = std::move(reduced.clusters);
        group.outcome = std::move(reduced);
        return group;
    }
    const auto tries =
        std::min_element(members.begin(), members.end(),
                         [&](uint32_t a, uint32_t b) { return level.retries[a] < level.retries[b]; });
    if (alone || level.retries[*tries] >= build.config.max_retries)
    {
        group.stuck = !alone;
        return group;
    }
    group.retried = true;
    group.error = roundUp(members_error * kMonotoneSlack);
    for (const uint32_t member : members)
        group.clusters.appendCluster(level.store, level.store.shapes[member]);
    return group;
}

/// Positions of roots can never move again: what lies beside them is drawn together with them.
void pinRoots(const PreparedMesh& mesh, const Level& level, std::vector<uint8_t>& pinned)
{
    for (uint32_t g = 0; g < level.groups.count(); ++g)
        if (std::isinf(level.built[g].error))
            for (const uint32_t member : level.groups.membersOf(g))
                for (const uint32_t vertex : level.store.verticesOf(level.store.shapes[member]))
                    pinned[mesh.position_of_vertex[vertex]] = 1;
}

/// Take over the vertices that a group has made: its clusters name them as the mesh does from then on.
void takeVertices(PreparedMesh& mesh, Reduced& outcome, ClusterStore& clusters)
{
    const auto first_vertex = static_cast<uint32_t>(mesh.vertices.vertexCount());
    for (uint32_t& vertex : clusters.vertices)
        if (vertex >= kMadeVertex)
            vertex = vertex - kMadeVertex + first_vertex;
    appendVertices(mesh.vertices, outcome.made);
    for (const uint32_t position : outcome.made_positions)
        mesh.position_of_vertex.push_back(mesh.position_count + position);
    mesh.position_count += outcome.made_position_count;
    outcome.made = {};
    outcome.made_positions = {};
}

/// Collect what replaces the level's groups.
Level nextLevel(PreparedMesh& mesh, Level& level)
{
    Level next;
    next.first_group = level.first_group + static_cast<uint32_t>(level.groups.count());
    for (uint32_t g = 0; g < level.groups.count(); ++g)
    {
        BuiltGroup& group = level.built[g];
        const auto members = level.groups.membersOf(g);
        for (size_t i = 0; i < group.clusters.shapes.size(); ++i)
        {
            next.refined_group.push_back(level.first_group + g);
            const int tried = group.retried ? level.retries[members[i]] + 1 : 0;
            next.retries.push_back(static_cast<uint8_t>(tried));
        }
        takeVertices(mesh, group.outcome, group.clusters);
        next.store.append(group.clusters);
        group.clusters = {};
    }
    return next;
}

/// Group, simplify and split level after level until nothing is left to simplify.
void buildLevels(Build& build)
{
    std::vector<uint8_t> pinned(build.mesh.position_count, 0);
    std::vector<uint8_t> locked = pinned;
    Level first;
    first.store = splitMesh(build.mesh);
    first.refined_group.assign(first.store.shapes.size(), kNone);
    first.retries.assign(first.store.shapes.size(), 0);
    build.levels.push_back(std::move(first));
    while (true)
    {
        Level& level = build.levels.back();
        level.groups = groupClusters(build.mesh, level.store, locked, build.config);
        locked = lockSharedPositions(build.mesh, level.store, level.groups, pinned);
        level.built.resize(level.groups.count());
        tbb::parallel_for(size_t{0}, level.groups.count(),
                          [&](size_t g)
                          { level.built[g] = buildGroup(build, level, level.groups.membersOf(g), locked); });
        pinRoots(build.mesh, level, pinned);
        Level next = nextLevel(build.mesh, level);
        pinned.resize(build.mesh.position_count, 0);
        locked.resize(build.mesh.position_count, 0);
        if (next.store.shapes.empty())
            return;
        build.levels.push_back(std::move(next));
    }
}

void countOutcomes(const Build& build, BuildCounts& counts)
{
    for (const Level& level : build.levels)
        for (const BuiltGroup& group : level.built)
        {
            counts.permissive_groups += group.outcome.permissive ? 1 : 0;
            counts.pruned_groups += group.outcome.pruned ? 1 : 0;
            counts.retried_groups += group.retried ? 1 : 0;
            counts.stuck_groups += group.stuck ? 1 : 0;
            counts.loose_pieces += group.outcome.loose_pieces;
        }
}

/// Where the groups of the build stand in the file: coarse to fine, in spatial order within a level.
std::vector<uint32_t> recordNumbers(const Build& build)
{
    std::vector<uint32_t> record_of_group;
    uint32_t next = 0;
    record_of_group.resize(build.levels.back().first_group + build.levels.back().built.size());
    for (size_t l = build.levels.size(); l-- > 0;)
        for (uint32_t g = 0; g < build.levels[l].built.size(); ++g)
            record_of_group[build.levels[l].first_group + g] = next++;
    return record_of_group;
}

/// Geometry of all levels in one store, in the order of the cluster records.
struct Ordered
{
    ClusterStore store;
    std::vector<ClusterShape> shapes;
};

void addLevelRecords(const Build& build, uint32_t l, std::span<const uint32_t> record_of_group,
                     Hierarchy& hierarchy, std::vector<ClusterShape>& shapes, uint32_t vertex_offset,
                     uint32_t index_offset)
{
    const Level& level = build.levels[l];
    LevelRecord& level_record = hierarchy.levels[l];
    level_record.clusters.first = static_cast<uint32_t>(hierarchy.clusters.size());
    for (uint32_t g = 0; g < level.built.size(); ++g)
    {
        const BuiltGroup& built = level.built[g];
        GroupRecord group{};
        group.sphere_center = built.sphere.center;
        group.sphere_radius = built.sphere.radius;
        group.error = built.error;
        group.level = l;
        group.clusters.first = static_cast<uint32_t>(hierarchy.clusters.size());
        for (const uint32_t member : level.groups.membersOf(g))
        {
            ClusterShape shape = level.store.shapes[member];
            ClusterRecord record{};
            record.group = record_of_group[level.first_group + g];
            record.refined_group = kNone;
            if (const uint32_t refined = level.refined_group[member]; refined != kNone)
            {
                record.refined_group = record_of_group[refined];
                level_record.max_error = std::max(level_record.max_error, build.group(refined).error);
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

/// Turn the levels into records and pages.
void writeRecords(Build& build, Hierarchy& hierarchy)
{
    const std::vector<uint32_t> record_of_group = recordNumbers(build);
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
    buildPages(build.mesh, store, shapes, build.config, hierarchy);
}

void fillSourceCounts(const mesh::SourceMesh& source, MeshRecord& mesh)
{
    mesh.source_faces = source.face_count;
    mesh.source_triangles = static_cast<uint32_t>(source.triangleCount());
    mesh.source_vertices = source.source_vertex_count;
    mesh.skinned = source.joint_sets.empty() ? 0 : 1;
    mesh.morph_target_count = static_cast<uint32_t>(source.morph_targets.size());
}

void fillMeshRecord(const PreparedMesh& prepared, Hierarchy& hierarchy)
{
    MeshRecord& mesh = hierarchy.mesh;
    mesh.grid_error = prepared.grid.error;
    mesh.degenerate_triangles = prepared.degenerate_count;
    mesh.lod_count = static_cast<uint32_t>(hierarchy.levels.size());
    mesh.levels = {0, mesh.lod_count};
    mesh.groups = {0, static_cast<uint32_t>(hierarchy.groups.size())};
    mesh.clusters = {0, static_cast<uint32_t>(hierarchy.clusters.size())};
    mesh.pages = {0, static_cast<uint32_t>(hierarchy.pages.size())};
    Box3 box;
    for (const ClusterRecord& cluster : hierarchy.clusters)
        box.add(boxOf(cluster, mesh.grid_step));
    mesh.box_min = box.empty() ? Float3{} : box.min;
    mesh.box_max = box.empty() ? Float3{} : box.max;
}

} // namespace

Hierarchy buildHierarchy(mesh::SourceMesh source, const Config& config)
{
    Hierarchy hierarchy;
    fillSourceCounts(source, hierarchy.mesh);
    Build build{prepareMesh(std::move(source)), config, {}};
    if (build.mesh.triangleCount() > 0)
    {
        buildLevels(build);
        countOutcomes(build, hierarchy.counts);
        writeRecords(build, hierarchy);
    }
    fillMeshRecord(build.mesh, hierarchy);
    return hierarchy;
}

} // namespace hearth::clusters
