// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect_bounds.h"

#include "cook/json/json.h"
#include "formats/cluster_bounds.h"
#include "pipelines/command/extract.h"
#include "pipelines/command/open_pack.h"

#include <cmath>
#include <limits>
#include <map>

namespace hearth::command
{

using namespace formats;

namespace
{

/// The box around a box that a transform carries.
Box3 carried(const Affine3d& transform, const Box3& box)
{
    constexpr float kFar = std::numeric_limits<float>::infinity();
    const Double3 low = widen(box.min), high = widen(box.max);
    const Double3 middle = transformPoint(transform, (low + high) * 0.5);
    const Double3 half = (high - low) * 0.5;
    const double middles[3] = {middle.x, middle.y, middle.z};
    Box3 result;
    for (int axis = 0; axis < 3; ++axis)
    {
        const auto& row = transform.m[axis];
        const double reach =
            std::abs(row[0]) * half.x + std::abs(row[1]) * half.y + std::abs(row[2]) * half.z;
        // one step of a float outwards: extract rounds its vertices
        result.min[axis] = std::nextafter(static_cast<float>(middles[axis] - reach), -kFar);
        result.max[axis] = std::nextafter(static_cast<float>(middles[axis] + reach), kFar);
    }
    return result;
}

Json boundsPoint(Float3 p)
{
    return {p.x, p.y, p.z};
}

/// The deformed mesh of a mesh; null where nothing deforms it, or no node draws it.
const DeformedMeshRecord* deformedMesh(const PackView& pack, uint32_t mesh)
{
    for (const DeformedMeshRecord& record : pack.deformedMeshes())
        if (record.mesh == mesh)
            return &record;
    return nullptr;
}

/// First triangle of each cluster in the file that extractCut writes at error 0.
std::map<uint32_t, uint32_t> firstTriangles(const PackView& pack, const MeshRecord& mesh)
{
    std::map<uint32_t, uint32_t> first;
    uint32_t triangles = 0;
    for (const uint32_t cluster : clustersOfCut(pack, mesh, 0))
    {
        first[cluster] = triangles;
        triangles += pack.clusters()[cluster].triangle_count;
    }
    return first;
}

Result<Json> meshJson(const PackView& pack, uint32_t mesh_number, const std::optional<ClipTime>& clip)
{
    const MeshRecord& mesh = pack.meshes()[mesh_number];
    const DeformedMeshRecord* const deformed = deformedMesh(pack, mesh_number);
    std::optional<PosedMesh> pose;
    if (clip || isDeformed(mesh))
    {
        HEARTH_ASSIGN_OR_RETURN(pose, PosedMesh::make(pack, mesh_number, clip));
    }
    const std::map<uint32_t, uint32_t> first_triangles = firstTriangles(pack, mesh);
    Json clusters = Json::array();
    for (uint32_t i = 0; i < mesh.clusters.count; ++i)
    {
        const uint32_t number = mesh.clusters.first + i;
        const ClusterRecord& cluster = pack.clusters()[number];
        Box3 box = boxOf(cluster, mesh.grid_step);
        size_t joint = 0;
        if (deformed != nullptr)
        {
            const DeformedClusterRecord& bounds = pack.deformedClusters()[deformed->clusters.first + i];
            box = {bounds.box_min, bounds.box_max};
            joint = bounds.joint;
        }
        if (pose)
            box = carried(pose->palette()[joint], box);
        Json json{{"level", cluster.level},
                  {"box", {{"min", boundsPoint(box.min)}, {"max", boundsPoint(box.max)}}},
                  {"triangles", nullptr}};
        if (const auto first = first_triangles.find(number); first != first_triangles.end())
            json["triangles"] = {{"first", first->second}, {"count", cluster.triangle_count}};
        clusters.push_back(std::move(json));
    }
    return Json{{"mesh", mesh_number}, {"clusters", std::move(clusters)}};
}

} // namespace

Result<std::string> boundsJson(const std::string& path, const std::optional<ClipTime>& clip)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView pack, openPack(path));
    Json meshes = Json::array();
    for (uint32_t i = 0; i < pack.meshes().size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(Json mesh, meshJson(pack, i, clip));
        meshes.push_back(std::move(mesh));
    }
    const Json document{{"meshes", std::move(meshes)}};
    return document.dump() + "\n";
}

} // namespace hearth::command
