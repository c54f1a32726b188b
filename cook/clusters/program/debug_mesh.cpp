// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/program/debug_mesh.h"

#include "cook/clusters/levels/validate.h"
#include "formats/base/atomic_file.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace hearth::clusters
{

namespace
{

bool endsAs(const std::string& path, std::string_view extension)
{
    if (path.size() < extension.size())
        return false;
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::equal(extension.begin(), extension.end(), path.end() - std::ptrdiff_t(extension.size()),
                      [&](char a, char b) { return a == lower(b); });
}

/// Triangles of a cluster with separate vertices, numbered from 0.
struct ClusterMesh
{
    std::vector<uint32_t> positions; ///< for each vertex, index into DecodedHierarchy::positions
    std::vector<uint32_t> corners;   ///< three vertices for each triangle
};

ClusterMesh makeClusterMesh(const DecodedHierarchy::Cluster& cluster)
{
    ClusterMesh mesh;
    mesh.positions = cluster.positions;
    std::sort(mesh.positions.begin(), mesh.positions.end());
    mesh.positions.erase(std::unique(mesh.positions.begin(), mesh.positions.end()), mesh.positions.end());
    for (const uint32_t position : cluster.positions)
    {
        const auto at = std::lower_bound(mesh.positions.begin(), mesh.positions.end(), position);
        mesh.corners.push_back(static_cast<uint32_t>(at - mesh.positions.begin()));
    }
    return mesh;
}

/// Return a bright colour, well distributed, and the same in every run.
std::array<std::byte, 3> clusterColor(uint32_t cluster)
{
    // finaliser of MurmurHash3: neighbouring numbers give unlike colours
    uint32_t hash = cluster;
    hash = (hash ^ (hash >> 16)) * 0x85EBCA6Bu;
    hash = (hash ^ (hash >> 13)) * 0xC2B2AE35u;
    hash ^= hash >> 16;
    const auto channel = [&](uint32_t shift) { return std::byte(64 + ((hash >> shift) & 0xFFu) * 3 / 4); };
    return {channel(0), channel(8), channel(16)};
}

template <typename T>
void put(std::vector<std::byte>& bytes, const T& value)
{
    const auto raw = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

void writePly(const DecodedHierarchy& decoded, formats::Range clusters, AtomicFile& file)
{
    std::vector<std::byte> vertices;
    std::vector<std::byte> faces;
    uint32_t vertex_count = 0;
    size_t face_count = 0;
    for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
    {
        const ClusterMesh mesh = makeClusterMesh(decoded.clusters[c]);
        const auto color = clusterColor(c);
        for (const uint32_t position : mesh.positions)
        {
            put(vertices, decoded.positions[position]);
            vertices.insert(vertices.end(), color.begin(), color.end());
        }
        for (size_t corner = 0; corner < mesh.corners.size(); ++corner)
        {
            if (corner % 3 == 0)
                put(faces, uint8_t{3});
            put(faces, vertex_count + mesh.corners[corner]);
        }
        vertex_count += static_cast<uint32_t>(mesh.positions.size());
        face_count += mesh.corners.size() / 3;
    }
    file.write(fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n"
                           "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
                           "property uchar blue\nelement face {}\nproperty list uchar uint vertex_indices\n"
                           "end_header\n",
                           vertex_count, face_count));
    file.write(vertices);
    file.write(faces);
}

void writeObj(const Hierarchy& hierarchy, const DecodedHierarchy& decoded, uint32_t level, AtomicFile& file)
{
    const formats::Range clusters = hierarchy.levels[level].clusters;
    file.write(fmt::format("o level_{}\n", level));
    uint32_t first_vertex = 1; // OBJ counts from 1
    for (uint32_t c = clusters.first; c < clusters.first + clusters.count; ++c)
    {
        const ClusterMesh mesh = makeClusterMesh(decoded.clusters[c]);
        std::string text = fmt::format("g cluster_{}_of_group_{}\n", c, hierarchy.clusters[c].group);
        for (const uint32_t position : mesh.positions)
        {
            // nine digits restore every float
            const Float3 p = decoded.positions[position];
            text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
        }
        for (size_t t = 0; t < mesh.corners.size(); t += 3)
            text += fmt::format("f {} {} {}\n", first_vertex + mesh.corners[t],
                                first_vertex + mesh.corners[t + 1], first_vertex + mesh.corners[t + 2]);
        first_vertex += static_cast<uint32_t>(mesh.positions.size());
        file.write(text);
    }
}

} // namespace

bool isDebugMeshPath(const std::string& path)
{
    return endsAs(path, ".ply") || endsAs(path, ".obj");
}

Status writeDebugMesh(const Hierarchy& hierarchy, uint32_t level, const std::string& path)
{
    HEARTH_ASSERT(isDebugMeshPath(path));
    if (level >= hierarchy.levels.size())
        return Error{Issue::usage, path, "",
                     fmt::format("there is no level {}: the mesh has {}", level, hierarchy.levels.size())};
    HEARTH_ASSIGN_OR_RETURN(const DecodedHierarchy decoded, decodeHierarchy(hierarchy));
    HEARTH_ASSIGN_OR_RETURN(AtomicFile file, AtomicFile::create(path));
    if (endsAs(path, ".ply"))
        writePly(decoded, hierarchy.levels[level].clusters, file);
    else
        writeObj(hierarchy, decoded, level, file);
    return file.finish();
}

} // namespace hearth::clusters
