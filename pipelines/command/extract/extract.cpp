// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract.h"

#include "formats/base/atomic_file.h"
#include "pipelines/command/extract/open_pack.h"
#include "pipelines/export/cut.h"
#include "pipelines/export/meshes.h"

#include <fmt/format.h>

namespace hearth::command
{

using namespace formats;
using gltf_export::findCutClusters;
using gltf_export::isDeformed;
using gltf_export::PageCache;

namespace
{

std::string plyHeader(const PackView& pack, const MeshRecord& mesh, std::span<const uint32_t> cut)
{
    uint64_t vertices = 0;
    uint64_t triangles = 0;
    for (const uint32_t cluster : cut)
    {
        vertices += pack.clusters()[cluster].vertex_count;
        triangles += pack.clusters()[cluster].triangle_count;
    }
    std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", vertices);
    const auto addFloats = [&](std::initializer_list<const char*> names)
    {
        for (const char* name : names)
            header += fmt::format("property float {}\n", name);
    };
    addFloats({"x", "y", "z"});
    if ((mesh.attributes & kVertexNormal) != 0)
        addFloats({"nx", "ny", "nz"});
    if ((mesh.attributes & kVertexVisibility) != 0)
        addFloats({"axis_x", "axis_y", "axis_z", "aperture", "scale", "ao", "m0", "m1_x", "m1_y", "m1_z"});
    if ((mesh.attributes & kVertexUv0) != 0)
        addFloats({"s", "t"});
    return header +
           fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", triangles);
}

/// Append the visibility of a vertex: cone, ambient occlusion and moments.
/// posed  null: the vertex is not posed
void appendVisibility(std::vector<float>& values, const ClusterGeometry& geometry, uint32_t v,
                      const PosedVertex* posed)
{
    const shared::VisibilityMoments moments = geometry.visibility(v);
    const Float3 m1 = posed != nullptr ? posed->m1 : moments.m1;
    const Float3 normal = posed != nullptr ? posed->normal : geometry.normal(v);
    const shared::VisibilityCone cone = shared::visibilityCone(moments.m0, m1, normal);
    const float ao = shared::decodeVisibilityInFrame(geometry.visibilityCode(v)).m1.z / shared::kVisibilityPi;
    values.insert(values.end(), {cone.axis.x, cone.axis.y, cone.axis.z, cone.aperture, cone.scale, ao,
                                 moments.m0, m1.x, m1.y, m1.z});
}

/// Append the vertices of a cluster.
/// pose  null: the vertices are not posed
void writeVertices(AtomicFile& file, const ClusterGeometry& geometry, const PosedMesh* pose)
{
    std::vector<float> values;
    for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
    {
        const PosedVertex posed = pose != nullptr ? pose->vertex(geometry, v) : PosedVertex{};
        const Float3 position = pose != nullptr ? posed.position : geometry.position(v);
        values.insert(values.end(), {position.x, position.y, position.z});
        if (geometry.has(kVertexNormal))
        {
            const Float3 normal = pose != nullptr ? posed.normal : geometry.normal(v);
            values.insert(values.end(), {normal.x, normal.y, normal.z});
            if (geometry.has(kVertexVisibility))
                appendVisibility(values, geometry, v, pose != nullptr ? &posed : nullptr);
        }
        if (geometry.has(kVertexUv0))
        {
            const Float2 uv = geometry.uv(v, 0);
            values.insert(values.end(), {uv.x, uv.y});
        }
    }
    file.write(std::as_bytes(std::span(values)));
}

void writeFaces(AtomicFile& file, const ClusterGeometry& geometry, uint32_t first_vertex,
                const PosedMesh* pose)
{
    std::vector<std::byte> bytes;
    for (uint32_t t = 0; t < geometry.triangleCount(); ++t)
    {
        bytes.push_back(std::byte{3});
        std::array<uint32_t, 3> corners = geometry.triangle(t);
        if (pose != nullptr && pose->vertex(geometry, corners[0]).mirrored)
            std::swap(corners[1], corners[2]);
        for (const uint32_t corner : corners)
        {
            const uint32_t vertex = first_vertex + corner;
            const auto raw = std::as_bytes(std::span(&vertex, 1));
            bytes.insert(bytes.end(), raw.begin(), raw.end());
        }
    }
    file.write(bytes);
}

} // namespace

Status extractCut(const std::string& path, uint32_t mesh, float error, const std::optional<ClipTime>& clip,
                  const std::string& output)
{
    HEARTH_ASSIGN_OR_RETURN(const PackView pack, openPack(path));
    HEARTH_TRY(checkMesh(pack, path, mesh));
    const MeshRecord& record = pack.meshes()[mesh];
    const std::vector<uint32_t> cut = findCutClusters(pack, record, error);
    std::optional<PosedMesh> pose;
    if (clip || isDeformed(record))
    {
        HEARTH_ASSIGN_OR_RETURN(pose, PosedMesh::make(pack, mesh, clip));
    }
    const PosedMesh* const posed = pose ? &*pose : nullptr;

    HEARTH_ASSIGN_OR_RETURN(AtomicFile file, AtomicFile::create(output));
    file.write(plyHeader(pack, record, cut));
    PageCache pages(pack);
    for (const uint32_t cluster : cut)
    {
        HEARTH_ASSIGN_OR_RETURN(const ClusterGeometry geometry,
                                pages.clusterGeometry(pack.clusters()[cluster], record));
        writeVertices(file, geometry, posed);
    }
    uint32_t first_vertex = 0;
    for (const uint32_t cluster : cut)
    {
        HEARTH_ASSIGN_OR_RETURN(const ClusterGeometry geometry,
                                pages.clusterGeometry(pack.clusters()[cluster], record));
        writeFaces(file, geometry, first_vertex, posed);
        first_vertex += geometry.vertexCount();
    }
    return file.finish();
}

} // namespace hearth::command
