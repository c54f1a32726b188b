// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/surface/cut.h"

#include <algorithm>
#include <cmath>

namespace hearth::proxy
{

using namespace formats;

namespace
{

bool isInCut(const PackView& part, const ClusterRecord& cluster, float error)
{
    return clusterError(cluster, part.groups()) <= error && part.groups()[cluster.group].error > error;
}

uint64_t countTriangles(const PackView& part, const MeshRecord& mesh, float error)
{
    uint64_t triangles = 0;
    for (const ClusterRecord& cluster : recordsInRange(part.clusters(), mesh.clusters))
        triangles += isInCut(part, cluster, error) ? cluster.triangle_count : 0;
    return triangles;
}

/// Call `use` with each cluster and its geometry. Clusters of a page follow each other.
template <typename Use>
Status forEachCluster(const PackView& part, const MeshRecord& mesh, std::span<const ClusterRecord> clusters,
                      const Use& use)
{
    uint32_t page = kInvalidIndex;
    std::vector<std::byte> bytes;
    for (const ClusterRecord& cluster : clusters)
    {
        if (cluster.page != page)
        {
            HEARTH_ASSIGN_OR_RETURN(bytes, part.decodePage(cluster.page));
            page = cluster.page;
        }
        const auto geometry = ClusterGeometry::at(bytes, cluster, mesh);
        if (!geometry)
            return Error{Issue::meaning_geometry, part.name(), chunkName(kChunkPages, 0),
                         "a cluster lies outside page " + std::to_string(page)};
        use(cluster, *geometry);
    }
    return success();
}

} // namespace

float findCutError(const PackView& part, uint32_t mesh_number, float error, uint64_t max_triangles)
{
    const MeshRecord& mesh = part.meshes()[mesh_number];
    std::vector<float> errors{error};
    for (const GroupRecord& group : recordsInRange(part.groups(), mesh.groups))
        if (group.error > error && std::isfinite(group.error))
            errors.push_back(group.error);
    std::sort(errors.begin(), errors.end());
    const auto found = std::partition_point(
        errors.begin(), errors.end(), [&](float e) { return countTriangles(part, mesh, e) > max_triangles; });
    return found == errors.end() ? errors.back() : *found;
}

Result<Surface> readCut(const PackView& part, uint32_t mesh_number, float error)
{
    const MeshRecord& mesh = part.meshes()[mesh_number];
    std::vector<ClusterRecord> cut;
    for (const ClusterRecord& cluster : recordsInRange(part.clusters(), mesh.clusters))
        if (isInCut(part, cluster, error))
            cut.push_back(cluster);
    Surface surface;
    const auto add = [&](const ClusterRecord& cluster, const ClusterGeometry& geometry)
    {
        const auto first = static_cast<uint32_t>(surface.positions.size());
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
            surface.positions.push_back(geometry.position(v));
        for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
        {
            const std::array<uint32_t, 3> corners = geometry.triangle(t);
            surface.add({first + corners[0], first + corners[1], first + corners[2]}, cluster.material);
        }
    };
    HEARTH_TRY(forEachCluster(part, mesh, cut, add));
    weldByPosition(surface);
    return surface;
}

Result<FinestVertices> readFinestVertices(const PackView& part, uint32_t mesh_number)
{
    const MeshRecord& mesh = part.meshes()[mesh_number];
    FinestVertices vertices;
    if (mesh.levels.count == 0)
        return vertices;
    const auto add = [&](const ClusterRecord&, const ClusterGeometry& geometry)
    {
        for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
        {
            vertices.positions.push_back(geometry.position(v));
            if (geometry.has(kVertexNormal))
                vertices.normals.push_back(geometry.normal(v));
        }
    };
    HEARTH_TRY(forEachCluster(
        part, mesh, recordsInRange(part.clusters(), part.levels()[mesh.levels.first].clusters), add));
    return vertices;
}

} // namespace hearth::proxy
