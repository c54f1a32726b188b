// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/shapes.h"

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace hearth::shapes
{

namespace
{

using mesh::SourceMesh;

/// Hash a lattice point to a number in [-1, 1].
float lattice(int32_t x, int32_t y, int32_t z, uint32_t seed)
{
    uint32_t h = seed * 0x9E3779B9u;
    for (const int32_t v : {x, y, z})
    {
        h = (h ^ static_cast<uint32_t>(v)) * 0x85EBCA6Bu;
        h ^= h >> 13;
    }
    h *= 0xC2B2AE35u;
    h ^= h >> 16;
    return static_cast<float>(h) / 2147483648.0f - 1.0f;
}

/// Value noise in [-1, 1], smooth.
float noise(Float3 p, uint32_t seed)
{
    const Float3 cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    Float3 f = p - cell;
    f = f * f * (Float3{3, 3, 3} - f * 2.0f);
    const auto x = static_cast<int32_t>(cell.x);
    const auto y = static_cast<int32_t>(cell.y);
    const auto z = static_cast<int32_t>(cell.z);
    float value = 0;
    for (int32_t i = 0; i < 8; ++i)
    {
        const int32_t dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
        const float weight = (dx ? f.x : 1 - f.x) * (dy ? f.y : 1 - f.y) * (dz ? f.z : 1 - f.z);
        value += weight * lattice(x + dx, y + dy, z + dz, seed);
    }
    return value;
}

/// Ridged noise in about [0, 1].
float ridges(Float3 p, int octaves, uint32_t seed)
{
    float sum = 0;
    float amplitude = 0.5f;
    float weight = 1;
    for (int octave = 0; octave < octaves; ++octave)
    {
        float n = 1 - std::abs(noise(p, seed + static_cast<uint32_t>(octave)));
        n *= n * weight;
        weight = std::clamp(2 * n, 0.0f, 1.0f);
        sum += n * amplitude;
        amplitude *= 0.5f;
        p = p * 2.03f;
    }
    return sum;
}

void addQuad(SourceMesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

void finish(SourceMesh& mesh)
{
    mesh.triangle_materials.assign(mesh.triangleCount(), 0);
    mesh.face_count = static_cast<uint32_t>(mesh.triangleCount());
    mesh.source_vertex_count = static_cast<uint32_t>(mesh.vertexCount());
}

/// Area-weighted normals; vertices at the same position share theirs.
void addSmoothNormals(SourceMesh& mesh)
{
    struct Less
    {
        bool operator()(const Float3& a, const Float3& b) const
        {
            return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
        }
    };
    std::vector<Float3> sums(mesh.vertexCount());
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
    {
        const Float3 a = mesh.positions[mesh.indices[i]];
        const Float3 n =
            cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
        for (size_t k = 0; k < 3; ++k)
            sums[mesh.indices[i + k]] += n;
    }
    // only positions on chart borders have several vertices, but all are looked up: fast enough for a test
    // shape
    std::map<Float3, Float3, Less> shared;
    std::vector<uint8_t> seen(mesh.vertexCount(), 0);
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
        shared[mesh.positions[v]] += sums[v];
    mesh.normals.resize(mesh.vertexCount());
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
        mesh.normals[v] = normalizeOr(shared[mesh.positions[v]], {0, 0, 1});
}

/// Return point (i, j) of side `side` of the cube [-n, n]^3. Coordinates are integers, so that shared borders
/// are equal.
Float3 cubePoint(int side, int32_t i, int32_t j, int32_t n)
{
    const auto u = static_cast<float>(2 * i - n);
    const auto v = static_cast<float>(2 * j - n);
    const auto w = static_cast<float>(n);
    switch (side)
    {
    case 0:
        return {w, u, v};
    case 1:
        return {-w, v, u};
    case 2:
        return {v, w, u};
    case 3:
        return {u, -w, v};
    case 4:
        return {u, v, w};
    default:
        return {v, u, -w};
    }
}

} // namespace

SourceMesh rock(uint32_t n, float roughness, uint32_t seed)
{
    SourceMesh mesh;
    const auto size = static_cast<int32_t>(n);
    for (int side = 0; side < 6; ++side)
    {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (int32_t j = 0; j <= size; ++j)
            for (int32_t i = 0; i <= size; ++i)
            {
                Float3 p = cubePoint(side, i, j, size) / static_cast<float>(n);
                // tangent warp: triangles of about equal size
                for (int axis = 0; axis < 3; ++axis)
                    p[axis] = std::tan(p[axis] * std::numbers::pi_v<float> / 4);
                p = p / length(p);
                mesh.positions.push_back(roughness > 0 ? p * (1 + roughness * ridges(p * 2.0f, 8, seed)) : p);
                mesh.uvs[0].push_back(
                    {(static_cast<float>(i) / static_cast<float>(n) + static_cast<float>(side % 3)) / 3,
                     (static_cast<float>(j) / static_cast<float>(n) + static_cast<float>(side / 3)) / 2});
            }
        const uint32_t row = n + 1;
        for (uint32_t j = 0; j < n; ++j)
            for (uint32_t i = 0; i < n; ++i)
            {
                const uint32_t at = first + j * row + i;
                addQuad(mesh, at, at + 1, at + row + 1, at + row);
            }
    }
    addSmoothNormals(mesh);
    finish(mesh);
    return mesh;
}

SourceMesh terrain(uint32_t n, uint32_t seed)
{
    SourceMesh mesh;
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i)
        {
            const float u = static_cast<float>(i) / static_cast<float>(n);
            const float v = static_cast<float>(j) / static_cast<float>(n);
            mesh.positions.push_back({u, 0.15f * ridges({u * 5, v * 5, 0.5f}, 9, seed), -v});
            mesh.uvs[0].push_back({u, v});
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i)
        {
            const uint32_t at = j * (n + 1) + i;
            addQuad(mesh, at, at + 1, at + n + 2, at + n + 1);
        }
    addSmoothNormals(mesh);
    finish(mesh);
    return mesh;
}

SourceMesh foliage(uint32_t count, uint32_t seed)
{
    SourceMesh mesh;
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<float>(random()) / 2147483648.0f - 1.0f; };
    const float half_size = 0.5f / std::cbrt(static_cast<float>(count));
    for (uint32_t i = 0; i < count; ++i)
    {
        Float3 center;
        do
            center = {uniform(), uniform(), uniform()};
        while (length(center) > 1);
        const Float3 u = normalizeOr({uniform(), uniform(), uniform()}, {1, 0, 0});
        const Float3 v = normalizeOr(cross(u, {uniform(), uniform(), uniform()}), {0, 1, 0});
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const Float2 corner : {Float2{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        {
            mesh.positions.push_back(center + u * ((2 * corner.x - 1) * half_size) +
                                     v * ((2 * corner.y - 1) * half_size));
            mesh.normals.push_back(normalizeOr(cross(u, v), {0, 0, 1}));
            mesh.uvs[0].push_back(corner);
        }
        addQuad(mesh, first, first + 1, first + 2, first + 3);
    }
    finish(mesh);
    return mesh;
}

SourceMesh grid(uint32_t n)
{
    SourceMesh mesh;
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i)
        {
            const Float2 uv{static_cast<float>(i) / static_cast<float>(n),
                            static_cast<float>(j) / static_cast<float>(n)};
            mesh.positions.push_back({uv.x, uv.y, 0});
            mesh.normals.push_back({0, 0, 1});
            mesh.uvs[0].push_back(uv);
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i)
        {
            const uint32_t at = j * (n + 1) + i;
            addQuad(mesh, at, at + 1, at + n + 2, at + n + 1);
        }
    finish(mesh);
    return mesh;
}

namespace
{

/// Add a quad with four vertices of its own, a flat normal, and the UVs of a unit square.
void addLooseQuad(SourceMesh& mesh, Float3 a, Float3 b, Float3 c, Float3 d)
{
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    const Float3 normal = normalizeOr(cross(b - a, d - a), {0, 0, 1});
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    mesh.normals.insert(mesh.normals.end(), 4, normal);
    mesh.uvs[0].insert(mesh.uvs[0].end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    addQuad(mesh, first, first + 1, first + 2, first + 3);
}

} // namespace

SourceMesh blocks(uint32_t n)
{
    SourceMesh mesh;
    const auto size = static_cast<int32_t>(n);
    for (int side = 0; side < 6; ++side)
    {
        const Float3 out = normalizeOr(cross(cubePoint(side, 1, 0, size) - cubePoint(side, 0, 0, size),
                                             cubePoint(side, 0, 1, size) - cubePoint(side, 0, 0, size)),
                                       {});
        // cells on the border stay low, so that sides meet without gaps
        const auto height = [&](int32_t i, int32_t j)
        {
            const bool rim = i <= 0 || j <= 0 || i >= size - 1 || j >= size - 1;
            return rim || lattice(i / 3, j / 3, side, 7) < 0 ? 0.0f : 3.0f;
        };
        for (int32_t j = 0; j < size; ++j)
            for (int32_t i = 0; i < size; ++i)
            {
                const auto at = [&](int32_t di, int32_t dj, float h)
                { return cubePoint(side, i + di, j + dj, size) + out * h; };
                const float h = height(i, j);
                addLooseQuad(mesh, at(0, 0, h), at(1, 0, h), at(1, 1, h), at(0, 1, h));
                if (const float right = height(i + 1, j); i + 1 < size && right < h)
                    addLooseQuad(mesh, at(1, 0, right), at(1, 1, right), at(1, 1, h), at(1, 0, h));
                else if (i + 1 < size && right > h)
                    addLooseQuad(mesh, at(1, 1, h), at(1, 0, h), at(1, 0, right), at(1, 1, right));
                if (const float up = height(i, j + 1); j + 1 < size && up < h)
                    addLooseQuad(mesh, at(1, 1, up), at(0, 1, up), at(0, 1, h), at(1, 1, h));
                else if (j + 1 < size && up > h)
                    addLooseQuad(mesh, at(0, 1, h), at(1, 1, h), at(1, 1, up), at(0, 1, up));
            }
    }
    finish(mesh);
    return mesh;
}

SourceMesh tangle(uint32_t point_count, uint32_t triangle_count, uint32_t seed)
{
    SourceMesh mesh;
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<float>(random()) / 2147483648.0f - 1.0f; };
    for (uint32_t i = 0; i < point_count; ++i)
        mesh.positions.push_back({uniform(), uniform(), uniform()});
    for (uint32_t i = 0; i < triangle_count * 3; ++i)
        mesh.indices.push_back(static_cast<uint32_t>(random() % point_count));
    finish(mesh);
    return mesh;
}

SourceMesh soup(uint32_t triangle_count, uint32_t seed)
{
    SourceMesh mesh;
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<float>(random()) / 2147483648.0f - 1.0f; };
    for (uint32_t i = 0; i < triangle_count; ++i)
    {
        const Float3 center{uniform(), uniform(), uniform()};
        for (uint32_t k = 0; k < 3; ++k)
        {
            mesh.positions.push_back(center + Float3{uniform(), uniform(), uniform()} * 0.02f);
            mesh.indices.push_back(i * 3 + k);
        }
    }
    finish(mesh);
    return mesh;
}

SourceMesh moebius(uint32_t segments, uint32_t width)
{
    SourceMesh mesh;
    for (uint32_t i = 0; i < segments; ++i)
        for (uint32_t j = 0; j <= width; ++j)
        {
            const float turn =
                2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(segments);
            const float across = static_cast<float>(j) / static_cast<float>(width) - 0.5f;
            const float radius = 2 + across * std::cos(turn / 2);
            mesh.positions.push_back(
                {radius * std::cos(turn), radius * std::sin(turn), across * std::sin(turn / 2)});
        }
    const uint32_t row = width + 1;
    for (uint32_t i = 0; i < segments; ++i)
        for (uint32_t j = 0; j < width; ++j)
        {
            const bool closing = i + 1 == segments;
            const uint32_t here = i * row + j;
            // the last segment meets the first upside down
            const uint32_t next = closing ? width - j : (i + 1) * row + j;
            addQuad(mesh, here, next, closing ? next - 1 : next + 1, here + 1);
        }
    finish(mesh);
    return mesh;
}

void append(SourceMesh& mesh, const SourceMesh& other)
{
    const auto offset = static_cast<uint32_t>(mesh.positions.size());
    const auto join = [](auto& to, const auto& from)
    {
        if (to.empty() || from.empty())
            to.clear();
        else
            to.insert(to.end(), from.begin(), from.end());
    };
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    join(mesh.normals, other.normals);
    join(mesh.uvs[0], other.uvs[0]);
    for (const uint32_t index : other.indices)
        mesh.indices.push_back(index + offset);
    mesh.triangle_materials.insert(mesh.triangle_materials.end(), other.triangle_materials.begin(),
                                   other.triangle_materials.end());
    mesh.face_count += other.face_count;
    mesh.source_vertex_count += other.source_vertex_count;
}

} // namespace hearth::shapes
