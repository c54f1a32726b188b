// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/inspect_bounds.h"

#include "cook/json/json.h"
#include "formats/codecs/cluster_bounds.h"
#include "pipelines/command/extract/extract.h"
#include "pipelines/command/extract/open_pack.h"
#include "pipelines/export/cut.h"
#include "pipelines/export/meshes.h"

#include <map>

namespace hearth::command
{

using namespace formats;
using gltf_export::isDeformed;

namespace
{

Json boundsPoint(Float3 p)
{
    return {p.x, p.y, p.z};
}

/// Find the deformed mesh of a mesh; null if nothing deforms it, or no node draws it.
const DeformedMeshRecord* deformedMesh(const PackView& pack, uint32_t mesh)
{
    for (const DeformedMeshRecord& record : pack.deformedMeshes())
        if (record.mesh == mesh)
            return &record;
    return nullptr;
}

/// Return the first triangle of each cluster in the file that extractCut writes at error 0.
std::map<uint32_t, uint32_t> firstTriangles(const PackView& pack, const MeshRecord& mesh)
{
    std::map<uint32_t, uint32_t> first;
    uint32_t triangles = 0;
    for (const uint32_t cluster : gltf_export::findCutClusters(pack, mesh, 0))
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
        Box3 box = clusterBox(cluster, mesh.grid_step);
        DeformedClusterRecord bounds{};
        if (deformed != nullptr)
        {
            bounds = pack.deformedClusters()[deformed->clusters.first + i];
            box = {bounds.box_min, bounds.box_max};
        }
        if (pose)
        {
            const auto joints = recordsInRange(pack.clusterJoints(), bounds.joints);
            box = transformBox(clusterFrame(pose->palette(), bounds, joints), box);
        }
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
