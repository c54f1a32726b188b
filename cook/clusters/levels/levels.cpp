// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/levels.h"

#include "cook/clusters/core/bounds.h"
#include "cook/clusters/error/deformed_deviation.h"
#include "cook/clusters/levels/balance.h"
#include "cook/clusters/levels/level_plan.h"
#include "cook/clusters/partition/split.h"
#include "cook/clusters/surface/surface_bound.h"
#include "cook/mesh/free_memory.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace hearth::clusters
{

using namespace formats;

namespace
{

/// Return a sphere that contains the members' geometry and the spheres of all groups that they were made
/// from.
Sphere groupSphere(const Build& build, const Level& level, std::span<const ClusterId> members)
{
    // the finer spheres contain the points of the finer groups, and so all of the members' points
    std::vector<Sphere> spheres;
    GroupId last_refined = kInvalid;
    for (const ClusterId member : members)
        if (const GroupId refined = level.refined_group[member];
            refined != kInvalid && refined != last_refined)
        {
            last_refined = refined;
            spheres.push_back(build.group(refined).sphere);
        }
    std::vector<Float3> points;
    for (const Sphere& sphere : spheres)
        points.push_back(sphere.center);
    if (spheres.empty())
        for (const ClusterId member : members)
            for (const VertexId vertex : level.store.clusterVertices(level.store.shapes[member]))
                points.push_back(build.mesh.positions()[vertex]);
    const Sphere around_points = sphereOfPoints(points);
    const Sphere sphere = spheres.empty() ? around_points : sphereOfSpheres(spheres, around_points);
    return {sphere.center, roundUp(sphere.radius * kMonotoneSlack)};
}

ErrorAccumulator accumulateErrors(const Build& build, const Level& level, std::span<const ClusterId> members)
{
    ErrorAccumulator errors(build.mesh.grid.error);
    for (const ClusterId member : members)
        if (const GroupId refined = level.refined_group[member]; refined != kInvalid)
            errors.add(build.group(refined).errors, level.store.shapes[member].triangle_count);
    return errors;
}

/// Pass a stuck group on unchanged if it has retries left or an authored LOD will replace it; else leave it
/// as a root.
void retryOrKeep(const Build& build, const Level& level, std::span<const ClusterId> members,
                 LevelGroup& group)
{
    const auto tries =
        std::min_element(members.begin(), members.end(),
                         [&](ClusterId a, ClusterId b) { return level.retries[a] < level.retries[b]; });
    const bool alone = level.store.shapes.size() == members.size();
    if (build.authored.empty() && (alone || level.retries[*tries] >= build.config.max_retries))
    {
        group.stuck = !alone;
        return;
    }
    group.retried = true;
    group.errors = accumulateErrors(build, level, members).errorsOfReplacement({}, build.config);
    for (const ClusterId member : members)
        group.clusters.appendCluster(level.store, level.store.shapes[member]);
}

size_t countTriangles(const ClusterStore& store)
{
    size_t count = 0;
    for (const ClusterShape& shape : store.shapes)
        count += shape.triangle_count;
    return count;
}

GroupErrors reductionErrors(const Build& build, const Level& level, std::span<const ClusterId> members,
                            const GroupReduction& reduced, const GroupGoal& goal)
{
    return accumulateErrors(build, level, members)
        .errorsOfReplacement({reduced.distance, reduced.attributes, goal.error_weight}, build.config);
}

/// True if the group cannot be distinguished from the source on the grid.
bool losesNothing(const PreparedMesh& mesh, const GroupErrors& errors)
{
    constexpr float kGridTolerance = 1.5f;
    return errors.lod <= kGridTolerance * mesh.grid.error;
}

/// Simplify a group, or handle a stuck one: pass it on, or leave it as a root.
LevelGroup buildGroup(const Build& build, const Level& level, std::span<const ClusterId> members,
                      IdSpan<MeshPositionId, const uint8_t> locked, const GroupGoal& goal)
{
    LevelGroup group;
    group.sphere = groupSphere(build, level, members);
    group.errors = rootErrors();
    if (level.store.shapes.size() == 1)
        return group;

    GroupReduction reduced = reduceGroup(build.mesh, level.store, members, locked, goal, build.config);
    GroupErrors errors = reductionErrors(build, level, members, reduced, goal);
    const size_t left = roundToFullClusters(countTriangles(reduced.clusters));
    if (reduced.progressed && goal.may_exceed && losesNothing(build.mesh, errors) &&
        left > kMaxClusterTriangles)
    {
        GroupGoal further = goal;
        further.triangles = left - kMaxClusterTriangles;
        further.stop.reset();
        GroupReduction smaller = reduceGroup(build.mesh, level.store, members, locked, further, build.config);
        const GroupErrors of_smaller = reductionErrors(build, level, members, smaller, further);
        if (smaller.progressed && losesNothing(build.mesh, of_smaller))
        {
            reduced = std::move(smaller);
            errors = of_smaller;
        }
    }
    // an error beyond the float range cannot be stored: its group becomes a root
    if (!reduced.progressed ||
        std::max(errors.lod, errors.attributes.uv) >= std::numeric_limits<float>::max())
    {
        retryOrKeep(build, level, members, group);
        return group;
    }
    HEARTH_ASSERT(errors.lod >= 0 && errors.position >= 0);
    growToContain(group.sphere, reduced.made.positions);
    group.errors = errors;
    group.clusters = std::move(reduced.clusters);
    group.outcome = std::move(reduced);
    return group;
}

/// Return, for each group of the level, the triangles of its replacement, or its own if it is a root.
std::vector<size_t> keptTriangles(const Level& level)
{
    std::vector<size_t> kept;
    for (size_t g = 0; g < level.built.size(); ++g)
    {
        kept.push_back(countTriangles(level.built[g].clusters));
        if (level.built[g].isRoot())
            for (const ClusterId member : level.groups.groupMembers(g))
                kept.back() += level.store.shapes[member].triangle_count;
    }
    return kept;
}

/// Build the level's groups by the plan. If a target is missed because some groups cannot do their share, the
/// others do more.
void buildGroups(const Build& build, Level& level, IdSpan<MeshPositionId, const uint8_t> locked,
                 LevelPlan plan)
{
    // the first correction mostly suffices; each one builds the level again
    constexpr int kMaxCorrections = 3;
    HEARTH_ASSERT(plan.goals.size() == level.groups.count());
    std::vector<uint8_t> wanted(level.groups.count(), 1);
    level.built.resize(level.groups.count());
    for (int correction = 0; correction <= kMaxCorrections; ++correction)
    {
        tbb::parallel_for(size_t{0}, level.groups.count(),
                          [&](size_t g)
                          {
                              if (wanted[g] != 0)
                                  level.built[g] = buildGroup(build, level, level.groups.groupMembers(g),
                                                              locked, plan.goals[g]);
                          });
        if (!correctPlan(plan, keptTriangles(level), wanted))
            return;
    }
}

/// Pin the positions of roots, which can never move again: their neighbours are drawn together with them.
void pinRoots(const PreparedMesh& mesh, const Level& level, IdVector<MeshPositionId, uint8_t>& pinned)
{
    for (uint32_t g = 0; g < level.groups.count(); ++g)
        if (level.built[g].isRoot())
            for (const ClusterId member : level.groups.groupMembers(g))
                for (const VertexId vertex : level.store.clusterVertices(level.store.shapes[member]))
                    pinned[mesh.position_id_of_vertex[vertex]] = 1;
}

/// Move the vertices that a group has made to the mesh and renumber its clusters' vertices.
void takeVertices(PreparedMesh& mesh, GroupReduction& outcome, ClusterStore& clusters)
{
    const auto first_vertex = static_cast<uint32_t>(mesh.vertices.vertexCount());
    for (VertexId& vertex : clusters.vertices)
        if (isNewVertex(vertex))
            vertex = VertexId{newVertexNumber(vertex) + first_vertex};
    HEARTH_ASSERT(outcome.new_position_ids.size() == outcome.made.vertexCount());
    appendVertices(mesh.vertices, outcome.made);
    for (const uint32_t position : outcome.new_position_ids)
        mesh.position_id_of_vertex.push_back(MeshPositionId{mesh.position_count + position});
    mesh.position_count += outcome.new_position_count;
    HEARTH_ASSERT(mesh.position_id_of_vertex.size() == mesh.vertices.vertexCount());
    outcome.made = {};
    mesh::freeMemory(outcome.new_position_ids);
}

/// Collect the replacements of the level's groups.
Level nextLevel(PreparedMesh& mesh, Level& level)
{
    Level next;
    next.first_group = level.endGroup();
    next.drawn_below = level.drawn_below;
    for (uint32_t g = 0; g < level.groups.count(); ++g)
    {
        LevelGroup& group = level.built[g];
        const auto members = level.groups.groupMembers(g);
        for (size_t i = 0; i < group.clusters.shapes.size(); ++i)
        {
            next.refined_group.push_back(level.groupId(g));
            const int tried = group.retried ? std::min(level.retries[members[i]] + 1, 255) : 0;
            next.retries.push_back(static_cast<uint8_t>(tried));
        }
        takeVertices(mesh, group.outcome, group.clusters);
        next.store.append(group.clusters);
        group.clusters = {};
        if (group.isRoot())
            for (const ClusterId member : members)
                next.drawn_below += level.store.shapes[member].triangle_count;
    }
    mesh::freeMemory(level.store.errors);
    return next;
}

/// Return a sphere around those of all groups and the vertices of the authored LOD.
Sphere setSphere(const Build& build, const Level& level, const AuthoredLod& authored)
{
    std::vector<Sphere> spheres;
    std::vector<Float3> points;
    for (size_t g = 0; g < level.groups.count(); ++g)
        spheres.push_back(groupSphere(build, level, level.groups.groupMembers(g)));
    for (const Sphere& sphere : spheres)
        points.push_back(sphere.center);
    Sphere sphere = sphereOfSpheres(spheres, sphereOfPoints(points));
    points.clear();
    for (const VertexId vertex : authored.corners)
        points.push_back(build.mesh.positions()[vertex]);
    growToContain(sphere, points);
    return {sphere.center, roundUp(sphere.radius * kMonotoneSlack)};
}

/// Replace all groups of the level at once by the next authored LOD, and return that level.
Level switchToAuthored(Build& build, Level& level, const LevelPlan& plan,
                       CornerSpan<const VertexId> source_corners)
{
    const AuthoredLod& authored = build.authored.front();
    const IdSpan<VertexId, const Float3> positions = build.mesh.positions();
    const auto all = std::span<const ClusterId>(level.groups.members.items());
    // distances below the error of the level below make no difference
    const float carried = *std::max_element(level.store.errors.begin(), level.store.errors.end());
    const SurfaceBound bound =
        boundSurfaces({positions, source_corners}, {positions, authored.corners}, double{carried});
    const double upper = build.mesh.deforms()
                             ? boundDeformedSurfaces(build.mesh, source_corners, authored.corners)
                             : bound.upper;
    // without a bound the level is practically never drawn
    constexpr double kMaxDistance = 1e30;
    const float distance = roundUp(std::min(upper + double{build.mesh.grid.error}, kMaxDistance));
    float weight = 1;
    for (const GroupGoal& goal : plan.goals)
        weight = std::max(weight, goal.error_weight);

    LevelGroup group;
    group.sphere = setSphere(build, level, authored);
    group.errors =
        accumulateErrors(build, level, all)
            .errorsAgainstSource({distance, measureAttributes(build.mesh, source_corners, authored), weight},
                                 build.config);
    group.outcome.loose_pieces = bound.loose_pieces;
    HEARTH_ASSERT(authored.authored < build.level_of_authored.size());
    level.built.assign(level.groups.count(), group);
    for (uint32_t g = 0; g < level.built.size(); ++g)
        level.built[g].set_offset = g;

    Level next;
    next.first_group = level.endGroup();
    build.mesh.corners = authored.corners;
    build.mesh.materials = authored.materials;
    next.store = splitMesh(build.mesh);
    mesh::freeMemory(build.mesh.corners.values());
    mesh::freeMemory(build.mesh.materials.values());
    mesh::freeMemory(level.store.errors);
    next.store.errors.assign(next.store.errors.size(), distance);
    next.refined_group.assign(next.store.shapes.size(), level.first_group);
    next.retries.assign(next.store.shapes.size(), 0);
    build.level_of_authored[authored.authored] = static_cast<uint32_t>(build.levels.size());
    build.authored = build.authored.subspan(1);
    return next;
}

/// True if the planned level would have no more triangles than the next authored LOD.
bool authoredIsNext(const Build& build, const LevelPlan& plan)
{
    uint64_t planned = 0;
    for (const GroupGoal& goal : plan.goals)
        planned += goal.triangles;
    return !build.authored.empty() && planned <= build.authored.front().triangleCount();
}

/// Return the level that replaces the groups: their simplification, or an authored LOD.
Level replaceGroups(Build& build, Level& level, IdSpan<MeshPositionId, const uint8_t> locked,
                    CornerSpan<const VertexId> source_corners)
{
    LevelPlan plan = planLevel(build.config.reduction, static_cast<uint32_t>(build.levels.size() - 1),
                               level.store, level.groups, level.drawn_below);
    if (authoredIsNext(build, plan))
        return switchToAuthored(build, level, plan, source_corners);
    if (plan.balanced)
        balanceGoals({build.mesh, level.store, level.groups, locked, build.config}, plan.goals);
    buildGroups(build, level, locked, plan);
    if (!build.authored.empty() && isStuck(plan, keptTriangles(level)))
        return switchToAuthored(build, level, plan, source_corners);
    return nextLevel(build.mesh, level);
}

} // namespace

void buildLevels(Build& build)
{
    HEARTH_ASSERT(build.levels.empty() && build.mesh.triangleCount() > 0);
    // authored LODs are measured against the source, and replace it in the mesh
    const CornerVector<VertexId> source_corners =
        build.authored.empty() ? CornerVector<VertexId>{} : build.mesh.corners;
    IdVector<MeshPositionId, uint8_t> pinned(build.mesh.position_count, 0);
    IdVector<MeshPositionId, uint8_t> locked = pinned;
    Level first;
    first.store = splitMesh(build.mesh);
    mesh::freeMemory(build.mesh.corners.values());
    mesh::freeMemory(build.mesh.materials.values());
    first.refined_group.assign(first.store.shapes.size(), kInvalid);
    first.retries.assign(first.store.shapes.size(), 0);
    build.levels.push_back(std::move(first));
    while (true)
    {
        Level& level = build.levels.back();
        HEARTH_ASSERT(level.refined_group.size() == level.store.shapes.size() &&
                      level.retries.size() == level.store.shapes.size());
        level.groups = groupClusters(build.mesh, level.store, locked, build.config);
        locked = lockSharedPositions(build.mesh, level.store, level.groups, pinned);
        const size_t authored_left = build.authored.size();
        Level next = replaceGroups(build, level, locked, source_corners);
        HEARTH_ASSERT(level.built.size() == level.groups.count());
        pinRoots(build.mesh, level, pinned);
        if (build.authored.size() != authored_left)
            locked.assign(locked.size(), 0);
        pinned.resize(build.mesh.position_count, 0);
        locked.resize(build.mesh.position_count, 0);
        if (next.store.shapes.empty())
            return;
        build.levels.push_back(std::move(next));
    }
}

} // namespace hearth::clusters
