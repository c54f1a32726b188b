// Generates tangents in the manner of MikkTSpace (M. S. Mikkelsen, "Simulation of Wrinkled Surfaces
// Revisited", 2008): each corner's tangent is weighted by its angle, in the plane of the vertex normal, and
// mirrored UVs are kept apart.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/generate_tangents.h"

#include "pipelines/import/part/mesh_pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace hearth::import
{

namespace
{

/// Handedness of the UVs of a triangle.
enum class Handedness : uint8_t
{
    right = 0,    ///< v runs down the image: bitangent = cross(normal, tangent)
    mirrored = 1, ///< bitangent = -cross(normal, tangent)
    none = 2,     ///< the UVs have no area
};

struct FaceTangent
{
    Float3 direction; ///< unit, towards larger u
    Handedness handedness = Handedness::none;
};

FaceTangent faceTangent(const mesh::SourceMesh& mesh, const std::vector<Float2>& uvs, const uint32_t* corner)
{
    const Float2 u1 = uvs[corner[1]] - uvs[corner[0]];
    const Float2 u2 = uvs[corner[2]] - uvs[corner[0]];
    const double area = double{u1.x} * double{u2.y} - double{u2.x} * double{u1.y};
    if (!(area != 0.0) || !std::isfinite(area))
        return {};
    const Float3 p0 = mesh.positions[corner[0]];
    const Float3 e1 = mesh.positions[corner[1]] - p0;
    const Float3 e2 = mesh.positions[corner[2]] - p0;
    const double sign = area < 0 ? -1.0 : 1.0;
    std::array<double, 3> t{};
    for (int axis = 0; axis < 3; ++axis)
        t[static_cast<size_t>(axis)] =
            sign * (double{e1[axis]} * double{u2.y} - double{e2[axis]} * double{u1.y});
    const double length = std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
    if (!(length > 0) || !std::isfinite(length))
        return {};
    const auto unit = [&](size_t axis) { return static_cast<float>(t[axis] / length); };
    // glTF's v runs down while a normal map's green runs up, so the usual sign is reversed
    return {{unit(0), unit(1), unit(2)}, area < 0 ? Handedness::right : Handedness::mirrored};
}

/// Return an id for each vertex. Vertices with equal position, normal and UV share it, so that an unindexed
/// triangle soup is smooth too.
std::vector<uint32_t> weldVertices(const mesh::SourceMesh& mesh, const std::vector<Float2>& uvs)
{
    const auto key = [&](uint32_t v)
    {
        const Float3 p = mesh.positions[v];
        const Float3 n = mesh.normals[v];
        return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z, uvs[v].x, uvs[v].y);
    };
    std::vector<uint32_t> order(mesh.vertexCount());
    std::iota(order.begin(), order.end(), 0u);
    tbb::parallel_sort(order.begin(), order.end(),
                       [&](uint32_t a, uint32_t b)
                       {
                           const auto key_a = key(a);
                           const auto key_b = key(b);
                           return key_a < key_b || (key_a == key_b && a < b);
                       });
    std::vector<uint32_t> welded(order.size());
    uint32_t number = 0;
    for (size_t i = 0; i < order.size(); ++i)
    {
        if (i > 0 && key(order[i]) != key(order[i - 1]))
            ++number;
        welded[order[i]] = number;
    }
    return welded;
}

float cornerAngle(const mesh::SourceMesh& mesh, const uint32_t* corner, size_t k)
{
    const Float3 p = mesh.positions[corner[k]];
    const Float3 a = normalizeOr(mesh.positions[corner[(k + 1) % 3]] - p, {});
    const Float3 b = normalizeOr(mesh.positions[corner[(k + 2) % 3]] - p, {});
    return std::acos(std::clamp(dot(a, b), -1.0f, 1.0f));
}

/// Return the contribution of each corner of a triangle to the tangent of its vertex.
std::array<Float3, 3> cornerTangents(const mesh::SourceMesh& mesh, const FaceTangent& face,
                                     const uint32_t* corner)
{
    std::array<Float3, 3> tangents;
    for (size_t k = 0; k < 3; ++k)
    {
        const Float3 normal = mesh.normals[corner[k]];
        const Float3 in_plane = normalizeOr(face.direction - normal * dot(normal, face.direction), {});
        tangents[k] = in_plane * cornerAngle(mesh, corner, k);
    }
    return tangents;
}

/// Return the sums for each welded vertex, right-handed ones first: element 2 * welded + handedness. Sums are
/// in the order of the triangles, independent of the number of threads.
std::vector<Float3> sumTangents(const mesh::SourceMesh& mesh, const std::vector<FaceTangent>& faces,
                                const std::vector<uint32_t>& welded)
{
    constexpr size_t kBlock = size_t{1} << 16;
    std::vector<Float3> sums(mesh.vertexCount() * 2);
    std::vector<std::array<Float3, 3>> block(std::min(kBlock, faces.size()));
    for (size_t begin = 0; begin < faces.size(); begin += kBlock)
    {
        const size_t end = std::min(faces.size(), begin + kBlock);
        tbb::parallel_for(begin, end,
                          [&](size_t i)
                          {
                              if (faces[i].handedness != Handedness::none)
                                  block[i - begin] =
                                      cornerTangents(mesh, faces[i], mesh.indices.data() + 3 * i);
                          });
        for (size_t i = begin; i < end; ++i)
            for (size_t k = 0; faces[i].handedness != Handedness::none && k < 3; ++k)
                sums[size_t{welded[mesh.indices[3 * i + k]]} * 2 +
                     static_cast<size_t>(faces[i].handedness)] += block[i - begin][k];
    }
    return sums;
}

/// Vertices that a vertex is split into: an index for each handedness, or kInvalidIndex.
using VertexCopies = std::array<uint32_t, 2>;

/// Find the copies that the triangles need; a vertex without any keeps a right-handed one.
std::vector<VertexCopies> findCopies(const mesh::SourceMesh& mesh, const std::vector<FaceTangent>& faces)
{
    std::vector<VertexCopies> copies(mesh.vertexCount(), {kInvalidIndex, kInvalidIndex});
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner)
        if (const Handedness handedness = faces[corner / 3].handedness; handedness != Handedness::none)
            copies[mesh.indices[corner]][static_cast<size_t>(handedness)] = 0;
    uint32_t next = 0;
    for (VertexCopies& copy : copies)
    {
        if (copy[0] == kInvalidIndex && copy[1] == kInvalidIndex)
            copy[0] = 0;
        for (uint32_t& vertex : copy)
            if (vertex != kInvalidIndex)
                vertex = next++;
    }
    return copies;
}

} // namespace

void generateTangents(mesh::SourceMesh& mesh, uint32_t uv_set)
{
    HEARTH_ASSERT(uv_set < mesh::kUvSetCount && mesh.uvs[uv_set].size() == mesh.vertexCount() &&
                  mesh.normals.size() == mesh.vertexCount());
    const std::vector<Float2>& uvs = mesh.uvs[uv_set];
    std::vector<FaceTangent> faces(mesh.triangleCount());
    tbb::parallel_for(size_t{0}, faces.size(),
                      [&](size_t i) { faces[i] = faceTangent(mesh, uvs, mesh.indices.data() + 3 * i); });
    const std::vector<uint32_t> welded = weldVertices(mesh, uvs);
    const std::vector<Float3> sums = sumTangents(mesh, faces, welded);
    const std::vector<VertexCopies> copies = findCopies(mesh, faces);

    std::vector<uint32_t> old_from_new;
    std::vector<Float4> tangents;
    for (uint32_t vertex = 0; vertex < copies.size(); ++vertex)
        for (size_t handedness = 0; handedness < 2; ++handedness)
            if (copies[vertex][handedness] != kInvalidIndex)
            {
                const Float3 fallback = anyTangent(mesh.normals[vertex]);
                const Float3 t = normalizeOr(sums[size_t{welded[vertex]} * 2 + handedness], fallback);
                old_from_new.push_back(vertex);
                tangents.push_back({t.x, t.y, t.z, handedness == 0 ? 1.0f : -1.0f});
            }
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner)
    {
        const VertexCopies& copy = copies[mesh.indices[corner]];
        const Handedness handedness = faces[corner / 3].handedness;
        const bool mirrored = handedness == Handedness::mirrored || copy[0] == kInvalidIndex;
        mesh.indices[corner] = copy[mirrored ? 1 : 0];
    }
    mesh.tangents.clear();
    gatherVertices(mesh, old_from_new);
    mesh.tangents = std::move(tangents);
}

} // namespace hearth::import
