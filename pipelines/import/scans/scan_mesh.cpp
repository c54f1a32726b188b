// Converts the polygons of a scan to a triangle mesh.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/scans/scan_polygons.h"
#include "pipelines/import/scans/triangulate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace hearth::import
{

namespace
{

struct Triangles
{
    std::vector<uint32_t> corners; ///< three for each triangle
    std::vector<uint32_t> materials;
};

Triangles triangulate(const ScanPolygons& scan)
{
    Triangles triangles;
    triangles.corners.reserve(scan.corner_positions.size());
    std::vector<Float3> polygon;
    std::vector<uint32_t> local;
    uint32_t first = 0;
    for (size_t face = 0; face < scan.face_ends.size(); ++face)
    {
        const uint32_t end = scan.face_ends[face];
        const uint32_t material = scan.face_materials.empty() ? kInvalidIndex : scan.face_materials[face];
        if (end - first == 3)
            triangles.corners.insert(triangles.corners.end(), {first, first + 1, first + 2});
        else
        {
            polygon.clear();
            local.clear();
            for (uint32_t corner = first; corner < end; ++corner)
                polygon.push_back(scan.positions[scan.corner_positions[corner]]);
            triangulatePolygon(polygon, local);
            for (uint32_t corner : local)
                triangles.corners.push_back(first + corner);
        }
        triangles.materials.resize(triangles.corners.size() / 3, material);
        first = end;
    }
    return triangles;
}

/// Key of a vertex: a position may occur with several normals and UVs.
struct VertexKey
{
    uint32_t position = 0;
    uint32_t normal = 0;
    uint32_t uv = 0;
    friend bool operator==(const VertexKey&, const VertexKey&) = default;
};

uint64_t hashKey(const VertexKey& key)
{
    // multipliers of splitmix64; every bit of the key reaches the upper half, which selects the slot
    uint64_t h = key.position * 0x9E3779B97F4A7C15u;
    h = (h ^ (h >> 29) ^ key.normal) * 0xBF58476D1CE4E5B9u;
    h = (h ^ (h >> 32) ^ key.uv) * 0x94D049BB133111EBu;
    return h ^ (h >> 31);
}

/// Numbers distinct keys in order of first occurrence.
class VertexTable
{
public:
    explicit VertexTable(size_t expected) : slots_(std::bit_ceil(expected * 2 + 16), kInvalidIndex) {}

    uint32_t findOrAdd(const VertexKey& key)
    {
        const size_t mask = slots_.size() - 1;
        size_t slot = hashKey(key) & mask;
        while (slots_[slot] != kInvalidIndex && keys_[slots_[slot]] != key)
            slot = (slot + 1) & mask;
        if (slots_[slot] == kInvalidIndex)
        {
            slots_[slot] = static_cast<uint32_t>(keys_.size());
            keys_.push_back(key);
            if (keys_.size() * 2 > slots_.size())
                grow();
            return static_cast<uint32_t>(keys_.size() - 1);
        }
        return slots_[slot];
    }

    const std::vector<VertexKey>& keys() const { return keys_; }

private:
    void grow()
    {
        slots_.assign(slots_.size() * 2, kInvalidIndex);
        const size_t mask = slots_.size() - 1;
        for (uint32_t i = 0; i < keys_.size(); ++i)
        {
            size_t slot = hashKey(keys_[i]) & mask;
            while (slots_[slot] != kInvalidIndex)
                slot = (slot + 1) & mask;
            slots_[slot] = i;
        }
    }

    std::vector<uint32_t> slots_;
    std::vector<VertexKey> keys_;
};

template <typename T>
T valueOr(const std::vector<T>& values, uint32_t index, T fallback)
{
    return index == kInvalidIndex ? fallback : values[index];
}

/// Make vertices of the distinct corners that triangles use; fill positions, attributes and indices.
void weldCorners(const ScanPolygons& scan, const Triangles& triangles, mesh::SourceMesh& mesh)
{
    const bool has_corner_normals = !scan.corner_normals.empty();
    const bool own_uvs = !scan.corner_uvs.empty();
    VertexTable table(scan.positions.size());
    mesh.indices.reserve(triangles.corners.size());
    for (uint32_t corner : triangles.corners)
    {
        const uint32_t position = scan.corner_positions[corner];
        mesh.indices.push_back(
            table.findOrAdd({position, has_corner_normals ? scan.corner_normals[corner] : 0,
                             own_uvs ? scan.corner_uvs[corner] : 0}));
    }
    for (const VertexKey& key : table.keys())
    {
        mesh.positions.push_back(scan.positions[key.position]);
        if (!scan.colors.empty())
            mesh.colors.push_back(scan.colors[key.position]);
        if (!scan.normals.empty())
            mesh.normals.push_back(
                valueOr(scan.normals, has_corner_normals ? key.normal : key.position, Float3{}));
        if (!scan.uvs.empty())
            mesh.uvs[0].push_back(valueOr(scan.uvs, own_uvs ? key.uv : key.position, Float2{}));
    }
}

/// Make a vertex of each used position, in the order of the file; for scans without corner attributes.
void makePositionVertices(ScanPolygons& scan, const Triangles& triangles, mesh::SourceMesh& mesh)
{
    std::vector<uint32_t> new_from_old(scan.positions.size(), kInvalidIndex);
    for (uint32_t corner : triangles.corners)
        new_from_old[scan.corner_positions[corner]] = 0;
    uint32_t count = 0;
    const auto keep = [&](auto& values, uint32_t to, size_t from)
    {
        if (!values.empty())
            values[to] = values[from];
    };
    for (size_t old = 0; old < new_from_old.size(); ++old)
    {
        if (new_from_old[old] == kInvalidIndex)
            continue;
        keep(scan.positions, count, old);
        keep(scan.colors, count, old);
        keep(scan.normals, count, old);
        keep(scan.uvs, count, old);
        new_from_old[old] = count++;
    }
    const auto move = [&](auto& from, auto& to)
    {
        from.resize(std::min<size_t>(count, from.size()));
        to = std::move(from);
    };
    move(scan.positions, mesh.positions);
    move(scan.colors, mesh.colors);
    move(scan.normals, mesh.normals);
    move(scan.uvs, mesh.uvs[0]);
    mesh.indices.reserve(triangles.corners.size());
    for (uint32_t corner : triangles.corners)
        mesh.indices.push_back(new_from_old[scan.corner_positions[corner]]);
}

/// Return the area-weighted normals of the triangles around each vertex, not of unit length.
std::vector<Float3> computeMeanNormals(const mesh::SourceMesh& mesh)
{
    std::vector<Float3> sums(mesh.vertexCount());
    for (size_t t = 0; t < mesh.triangleCount(); ++t)
    {
        const uint32_t* v = &mesh.indices[t * 3];
        const Float3 area =
            cross(mesh.positions[v[1]] - mesh.positions[v[0]], mesh.positions[v[2]] - mesh.positions[v[0]]);
        for (int k = 0; k < 3; ++k)
            sums[v[k]] += area;
    }
    return sums;
}

/// Make normals unit vectors and fill in missing ones.
void completeNormals(mesh::SourceMesh& mesh)
{
    const auto usable = [](Float3 n) { return isFinite(n) && length(n) > 1e-20f; };
    const bool complete = std::all_of(mesh.normals.begin(), mesh.normals.end(), usable);
    const std::vector<Float3> means = complete ? std::vector<Float3>() : computeMeanNormals(mesh);
    for (size_t i = 0; i < mesh.normals.size(); ++i)
    {
        const Float3 normal = usable(mesh.normals[i]) ? mesh.normals[i] : means[i];
        mesh.normals[i] = normalizeOr(normal, {0, 1, 0});
    }
}

} // namespace

Float4 linearColor(float red, float green, float blue, float alpha)
{
    const auto linear = [](float c)
    {
        if (!(c > 0))
            return 0.0f;
        c = std::min(c, 1.0f);
        return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    };
    return {linear(red), linear(green), linear(blue), alpha >= 0 ? std::min(alpha, 1.0f) : 0.0f};
}

mesh::SourceMesh meshFromScan(ScanPolygons&& scan)
{
    mesh::SourceMesh mesh;
    Triangles triangles = triangulate(scan);
    mesh.face_count = static_cast<uint32_t>(scan.face_ends.size());
    mesh.source_vertex_count = static_cast<uint32_t>(scan.vertex_count);
    if (scan.corner_normals.empty() && scan.corner_uvs.empty())
        makePositionVertices(scan, triangles, mesh);
    else
        weldCorners(scan, triangles, mesh);
    mesh.triangle_materials = std::move(triangles.materials);
    completeNormals(mesh);
    return mesh;
}

} // namespace hearth::import
