// Checks meshes, levels, groups and clusters, and the page table; geometry_check.cpp checks geometry.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/check_tools.h"
#include "formats/pack/pack_check.h"

namespace hearth::formats::check
{

namespace
{

bool boxContains(Float3 low, Float3 high, const Box3& box)
{
    for (int axis = 0; axis < 3; ++axis)
        if (box.min[axis] < low[axis] || box.max[axis] > high[axis])
            return false;
    return true;
}

/// True if the corners of the cluster's box are grid points that floats represent.
bool isOnGrid(const ClusterRecord& cluster)
{
    for (int axis = 0; axis < 3; ++axis)
        if (cluster.base[axis] < -kMaxGridCoordinate || cluster.base[axis] > kMaxGridCoordinate)
            return false;
    return cluster.extent_shift <= kMaxExtentShift;
}

bool sphereContains(const GroupRecord& outer, const GroupRecord& inner)
{
    const double x = double{outer.sphere_center.x} - inner.sphere_center.x;
    const double y = double{outer.sphere_center.y} - inner.sphere_center.y;
    const double z = double{outer.sphere_center.z} - inner.sphere_center.z;
    return std::sqrt(x * x + y * y + z * z) + inner.sphere_radius <= outer.sphere_radius * (1 + kSphereSlack);
}

Status checkMesh(const PackView& view, size_t i)
{
    const MeshRecord& mesh = view.meshes()[i];
    if (!isLegalLayout(mesh.attributes))
        return makeError(view, Issue::meaning_value, "mesh", i,
                         "attributes " + std::to_string(mesh.attributes));
    if (!(mesh.clusters.count == 0 ? mesh.grid_step == 0 : isPowerOfTwo(mesh.grid_step)) ||
        !isNonNegative(mesh.grid_error))
        return makeError(view, Issue::meaning_value, "mesh", i,
                         "its grid has a step of " + std::to_string(mesh.grid_step) + ", an error of " +
                             std::to_string(mesh.grid_error));
    if (mesh.skinned > 1)
        return makeError(view, Issue::meaning_value, "mesh", i, "skinned " + std::to_string(mesh.skinned));
    if (mesh.clusters.count > 0 && (mesh.skinned != 0) != (influencesPerVertex(mesh.attributes) != 0))
        return makeError(view, Issue::meaning_value, "mesh", i,
                         mesh.skinned != 0 ? "it is skinned, but its vertices have no influences"
                                           : "its vertices have influences, but it is not skinned");
    if (!isValidBox(mesh.box_min, mesh.box_max))
        return makeError(view, Issue::meaning_value, "mesh", i, "its box is empty or not finite");
    if (mesh.lod_count != mesh.levels.count)
        return makeError(view, Issue::meaning_value, "mesh", i, "lod_count is not the number of its levels");
    if ((mesh.levels.count == 0) != (mesh.clusters.count == 0))
        return makeError(view, Issue::meaning_value, "mesh", i,
                         "it has levels without clusters or clusters without levels");
    const uint32_t finest = mesh.levels.count == 0 ? 0 : view.levels()[mesh.levels.first].triangle_count;
    if (mesh.degenerate_triangles > mesh.source_triangles ||
        finest != mesh.source_triangles - mesh.degenerate_triangles)
        return makeError(view, Issue::meaning_value, "mesh", i,
                         "its finest level has " + std::to_string(finest) + " triangles, its source " +
                             std::to_string(mesh.source_triangles) + ", of them without area " +
                             std::to_string(mesh.degenerate_triangles));
    return success();
}

/// Check that levels are ordered finest first and their clusters coarsest first: the last level's clusters
/// come first.
Status checkLevels(const PackView& view, const MeshRecord& mesh)
{
    uint32_t next = mesh.clusters.first;
    for (uint32_t l = mesh.levels.count; l-- > 0;)
    {
        const size_t i = size_t{mesh.levels.first} + l;
        const LevelRecord& level = view.levels()[i];
        if (level.clusters.count == 0 || !isInsideTable(level.clusters, view.clusters().size()))
            return makeError(view, Issue::meaning_range, "level", i, "its clusters lie outside chunk CLUS");
        if (level.clusters.first != next)
            return makeError(view, Issue::meaning_order, "level", i,
                             "clusters start at " + std::to_string(level.clusters.first) + ", expected " +
                                 std::to_string(next));
        next += level.clusters.count;

        uint64_t triangles = 0;
        for (const ClusterRecord& cluster : recordsInRange(view.clusters(), level.clusters))
        {
            if (cluster.level != l)
                return makeError(view, Issue::meaning_order, "level", i, "it has a cluster of another level");
            triangles += cluster.triangle_count;
        }
        if (triangles != level.triangle_count)
            return makeError(view, Issue::meaning_value, "level", i,
                             std::to_string(level.triangle_count) + " triangles, its clusters have " +
                                 std::to_string(triangles));
    }
    if (next != mesh.clusters.first + mesh.clusters.count)
        return makeError(view, Issue::meaning_range, "cluster", next, "it belongs to no level");
    return success();
}

Status checkGroup(const PackView& view, uint32_t mesh_index, uint32_t i)
{
    const MeshRecord& mesh = view.meshes()[mesh_index];
    const GroupRecord& group = view.groups()[i];
    if (!finite(group.sphere_center) || !isNonNegative(group.sphere_radius) || !(group.error >= 0))
        return makeError(view, Issue::meaning_value, "group", i,
                         "its sphere or error is negative or not finite");
    if (!isNonNegative(group.position_error) || !isNonNegative(group.normal_error) ||
        !isNonNegative(group.uv_error) || !(group.position_error <= group.error))
        return makeError(view, Issue::meaning_value, "group", i,
                         "a part of its error is negative or not finite, or the position's exceeds it");
    if (group.page < mesh.pages.first || group.page - mesh.pages.first >= mesh.pages.count)
        return makeError(view, Issue::meaning_reference, "group", i,
                         "page " + std::to_string(group.page) + " is not of its mesh");
    if (!reservedZero(group.reserved))
        return makeError(view, Issue::meaning_padding, "group", i, "a reserved field is not 0");
    if (group.clusters.count == 0)
        return makeError(view, Issue::meaning_value, "group", i, "it has no clusters");
    for (const ClusterRecord& cluster : recordsInRange(view.clusters(), group.clusters))
        if (cluster.group != i || cluster.level != group.level || cluster.page != group.page)
            return makeError(view, Issue::meaning_reference, "group", i,
                             "one of its clusters names another group, level or page");
    return success();
}

/// Check a group after the first of its set: the cut replaces all groups of a set at once only if they are
/// alike.
Status checkSet(const PackView& view, const MeshRecord& mesh, uint32_t i)
{
    const GroupRecord& group = view.groups()[i];
    if (group.set_offset == 0)
        return success();
    if (group.set_offset > i - mesh.groups.first)
        return makeError(view, Issue::meaning_reference, "group", i,
                         "the first group of its set is not of its mesh");
    const GroupRecord& before = view.groups()[i - 1];
    if (before.set_offset != group.set_offset - 1)
        return makeError(view, Issue::meaning_order, "group", i,
                         "it does not follow the group before it in its set");
    if (!(group.sphere_center == before.sphere_center) || group.sphere_radius != before.sphere_radius ||
        group.error != before.error || group.level != before.level ||
        group.position_error != before.position_error || group.normal_error != before.normal_error ||
        group.uv_error != before.uv_error)
        return makeError(view, Issue::meaning_value, "group", i,
                         "its sphere, errors or level are not those of the group before it in its set");
    return success();
}

Status checkClusterValues(const PackView& view, const MeshRecord& mesh, size_t i)
{
    const ClusterRecord& cluster = view.clusters()[i];
    if (cluster.vertex_count < 1 || cluster.vertex_count > kMaxClusterVertices ||
        cluster.triangle_count < 1 || cluster.triangle_count > kMaxClusterTriangles)
        return makeError(view, Issue::meaning_value, "cluster", i,
                         std::to_string(cluster.vertex_count) + " vertices, " +
                             std::to_string(cluster.triangle_count) + " triangles");
    if (!isOnGrid(cluster))
        return makeError(view, Issue::meaning_value, "cluster", i, "its box lies beyond the grid");
    if (!boxContains(mesh.box_min, mesh.box_max, clusterBox(cluster, mesh.grid_step)))
        return makeError(view, Issue::meaning_bounds, "cluster", i, "its box leaves the box of its mesh");
    if (!NormalCode<8>::legal(cluster.cone_axis))
        return makeError(view, Issue::meaning_value, "cluster", i,
                         "the axis of its normal cone has no legal code");
    if (cluster.uv_density != 0 && (mesh.attributes & (kVertexUv0 | kVertexUv1)) == 0)
        return makeError(view, Issue::meaning_value, "cluster", i, "it has a UV density, but no UVs");
    return success();
}

/// Check a cluster against the group it was made from: otherwise the cut rule does not draw each surface
/// exactly once.
Status checkRefinement(const PackView& view, const MeshRecord& mesh, size_t i)
{
    const ClusterRecord& cluster = view.clusters()[i];
    if ((cluster.refined_group == kInvalidIndex) != (cluster.level == 0))
        return makeError(view, Issue::meaning_tree, "cluster", i,
                         "it has no refined group, or has one at level 0");
    if (cluster.refined_group == kInvalidIndex)
        return success();
    if (cluster.refined_group < mesh.groups.first ||
        cluster.refined_group - mesh.groups.first >= mesh.groups.count)
        return makeError(view, Issue::meaning_reference, "cluster", i,
                         "refined group " + std::to_string(cluster.refined_group) + " is not of its mesh");
    const GroupRecord& finer = view.groups()[cluster.refined_group];
    if (finer.set_offset != 0)
        return makeError(view, Issue::meaning_reference, "cluster", i,
                         "its refined group is not the first of its set");
    const GroupRecord& own = view.groups()[cluster.group];
    if (finer.level >= cluster.level)
        return makeError(view, Issue::meaning_tree, "cluster", i,
                         "its refined group is not of a finer level");
    if (!std::isfinite(finer.error))
        return makeError(view, Issue::meaning_value, "cluster", i, "it was made from a root");
    if (!(finer.error <= own.error))
        return makeError(view, Issue::meaning_monotone, "cluster", i,
                         "error " + std::to_string(finer.error) + " of its refined group, " +
                             std::to_string(own.error) + " of its group");
    if (std::isfinite(own.error) &&
        !(finer.position_error <= own.position_error && finer.normal_error <= own.normal_error &&
          finer.uv_error <= own.uv_error))
        return makeError(view, Issue::meaning_monotone, "cluster", i,
                         "a part of its refined group's error exceeds that of its group's");
    if (!sphereContains(own, finer))
        return makeError(view, Issue::meaning_monotone, "cluster", i,
                         "the sphere of its refined group leaves the sphere of its group");
    return success();
}

Status checkLevelErrors(const PackView& view, const MeshRecord& mesh)
{
    for (uint32_t i = mesh.levels.first; i < mesh.levels.first + mesh.levels.count; ++i)
    {
        float max_error = 0;
        for (const ClusterRecord& cluster : recordsInRange(view.clusters(), view.levels()[i].clusters))
            max_error = std::max(max_error, clusterError(cluster, view.groups()));
        if (!(view.levels()[i].max_error == max_error))
            return makeError(view, Issue::meaning_value, "level", i, "max_error is not that of its clusters");
    }
    return success();
}

/// Check that a group has a finite error if and only if something replaces it, or its set.
Status checkRoots(const PackView& view)
{
    std::vector<bool> replaced(view.groups().size(), false);
    for (const ClusterRecord& cluster : view.clusters())
        if (cluster.refined_group != kInvalidIndex)
            replaced[cluster.refined_group] = true;
    for (size_t i = 0; i < replaced.size(); ++i)
    {
        replaced[i] = replaced[i - view.groups()[i].set_offset];
        if (replaced[i] != std::isfinite(view.groups()[i].error))
            return makeError(view, Issue::meaning_tree, "group", i,
                             replaced[i] ? "a root, yet clusters were made from it"
                                         : "no cluster was made from it, yet it is not a root");
    }
    return success();
}

Status checkPage(const PackView& view, uint32_t mesh_index, uint32_t i)
{
    const PageRecord& page = view.pages()[i];
    if (page.mesh != mesh_index)
        return makeError(view, Issue::meaning_reference, "page", i,
                         "it names mesh " + std::to_string(page.mesh));
    if (page.size > kMaxPageBytes || page.codec > static_cast<uint32_t>(PageCodec::clusters) ||
        (page.codec == static_cast<uint32_t>(PageCodec::none) && page.stored_size != page.size))
        return makeError(view, Issue::meaning_value, "page", i,
                         std::to_string(page.size) + " bytes, stored " + std::to_string(page.stored_size) +
                             ", codec " + std::to_string(page.codec));
    if (!reservedZero(page.reserved))
        return makeError(view, Issue::meaning_padding, "page", i, "a reserved field is not 0");
    if (page.clusters.count == 0)
        return makeError(view, Issue::meaning_value, "page", i, "it has no clusters");
    for (const ClusterRecord& cluster : recordsInRange(view.clusters(), page.clusters))
        if (cluster.page != i)
            return makeError(view, Issue::meaning_reference, "page", i,
                             "one of its clusters names another page");
    return success();
}

/// Check that pages are contiguous in chunk PAGE, each at a multiple of 64, with zeros between and after.
Status checkPageBytes(const PackView& view, BulkData bulk)
{
    const std::span<const std::byte> bytes = view.pageBytes();
    size_t end = 0;
    const auto zeroUntil = [&](size_t until)
    { return bulk == BulkData::skip || allZero(bytes.subspan(end, until - end)); };
    for (size_t i = 0; i < view.pages().size(); ++i)
    {
        const PageRecord& page = view.pages()[i];
        const size_t start = alignChunk(end);
        if (page.offset != start)
            return makeError(view, Issue::meaning_order, "page", i,
                             "offset " + std::to_string(page.offset) + ", expected " + std::to_string(start));
        if (start > bytes.size() || page.stored_size > bytes.size() - start)
            return makeError(view, Issue::meaning_range, "page", i, "it lies outside chunk PAGE");
        if (!zeroUntil(start))
            return makeError(view, Issue::meaning_padding, "page", i, "bytes before it are not 0");
        end = start + page.stored_size;
    }
    if (bytes.size() - end >= kChunkAlignment)
        return Error{Issue::meaning_range, view.name(), chunkName(kChunkPages, 0), "bytes belong to no page"};
    if (!zeroUntil(bytes.size()))
        return Error{Issue::meaning_padding, view.name(), chunkName(kChunkPages, 0),
                     "bytes at its end are not 0"};
    return success();
}

/// Return the pages of each set of groups, by the index of the set's first group.
std::vector<std::vector<uint32_t>> collectSetPages(const PackView& view)
{
    std::vector<std::vector<uint32_t>> pages_of_set(view.groups().size());
    for (size_t i = 0; i < pages_of_set.size(); ++i)
    {
        std::vector<uint32_t>& pages = pages_of_set[i - view.groups()[i].set_offset];
        if (pages.empty() || pages.back() != view.groups()[i].page)
            pages.push_back(view.groups()[i].page);
    }
    return pages_of_set;
}

/// Check the parents of each page: the pages of the clusters made from its groups, or their sets; each once,
/// ascending.
Status checkParents(const PackView& view)
{
    const std::vector<std::vector<uint32_t>> pages_of_set = collectSetPages(view);
    // clusters are in page order, so that a page's parents are found in ascending order
    std::vector<std::vector<uint32_t>> implied(view.pages().size());
    for (const ClusterRecord& cluster : view.clusters())
    {
        if (cluster.refined_group == kInvalidIndex)
            continue;
        for (const uint32_t finer_page : pages_of_set[cluster.refined_group])
        {
            std::vector<uint32_t>& parents = implied[finer_page];
            if (finer_page != cluster.page && (parents.empty() || parents.back() != cluster.page))
                parents.push_back(cluster.page);
        }
    }
    for (size_t i = 0; i < implied.size(); ++i)
    {
        const auto stored = recordsInRange(view.pageParents(), view.pages()[i].parents);
        if (std::any_of(stored.begin(), stored.end(), [i](uint32_t parent) { return parent >= i; }))
            return makeError(view, Issue::meaning_order, "page", i, "a parent is not an earlier page");
        if (!std::equal(stored.begin(), stored.end(), implied[i].begin(), implied[i].end()))
            return makeError(view, Issue::meaning_reference, "page", i,
                             "its parents are not what its clusters imply");
    }
    return success();
}

} // namespace

Status checkMeshTables(const PackView& view)
{
    RangeCursor levels(view, "mesh", "level", view.levels().size());
    RangeCursor groups(view, "mesh", "group", view.groups().size());
    RangeCursor clusters(view, "mesh", "cluster", view.clusters().size());
    RangeCursor pages(view, "mesh", "page", view.pages().size());
    for (size_t i = 0; i < view.meshes().size(); ++i)
    {
        const MeshRecord& mesh = view.meshes()[i];
        HEARTH_TRY(levels.take(i, mesh.levels));
        HEARTH_TRY(groups.take(i, mesh.groups));
        HEARTH_TRY(clusters.take(i, mesh.clusters));
        HEARTH_TRY(pages.take(i, mesh.pages));
        HEARTH_TRY(checkMesh(view, i));
    }
    HEARTH_TRY(levels.finish());
    HEARTH_TRY(groups.finish());
    HEARTH_TRY(clusters.finish());
    HEARTH_TRY(pages.finish());

    RangeCursor grouped(view, "group", "cluster", view.clusters().size());
    for (uint32_t m = 0; m < view.meshes().size(); ++m)
    {
        const MeshRecord& mesh = view.meshes()[m];
        HEARTH_TRY(checkLevels(view, mesh));
        for (uint32_t g = 0; g < mesh.groups.count; ++g)
        {
            HEARTH_TRY(grouped.take(mesh.groups.first + g, view.groups()[mesh.groups.first + g].clusters));
            HEARTH_TRY(checkGroup(view, m, mesh.groups.first + g));
            HEARTH_TRY(checkSet(view, mesh, mesh.groups.first + g));
        }
        if (grouped.at() != size_t{mesh.clusters.first} + mesh.clusters.count)
            return makeError(view, Issue::meaning_range, "mesh", m,
                             "its groups do not have exactly its clusters");
        for (uint32_t c = 0; c < mesh.clusters.count; ++c)
        {
            HEARTH_TRY(checkClusterValues(view, mesh, mesh.clusters.first + c));
            HEARTH_TRY(checkRefinement(view, mesh, mesh.clusters.first + c));
        }
        HEARTH_TRY(checkLevelErrors(view, mesh));
    }
    return checkRoots(view);
}

Status checkPageTables(const PackView& view, BulkData bulk)
{
    RangeCursor clusters(view, "page", "cluster", view.clusters().size());
    RangeCursor parents(view, "page", "parent", view.pageParents().size());
    for (uint32_t m = 0; m < view.meshes().size(); ++m)
    {
        const Range pages = view.meshes()[m].pages;
        for (uint32_t i = pages.first; i < pages.first + pages.count; ++i)
        {
            HEARTH_TRY(clusters.take(i, view.pages()[i].clusters));
            HEARTH_TRY(parents.take(i, view.pages()[i].parents));
            HEARTH_TRY(checkPage(view, m, i));
        }
    }
    HEARTH_TRY(clusters.finish());
    HEARTH_TRY(parents.finish());
    HEARTH_TRY(checkPageBytes(view, bulk));
    return checkParents(view);
}

} // namespace hearth::formats::check
