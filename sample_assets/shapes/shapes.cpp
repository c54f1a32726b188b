// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/shapes/shapes.h"

#include "formats/base/assert.h"
#include "sample_assets/shapes/parallel.h"
#include "sample_assets/shapes/sample_math.h"

#include <algorithm>
#include <numeric>

namespace hearth::samples
{

namespace
{

/// Return for each vertex the first vertex, in a fixed order, with the same position.
std::vector<uint32_t> firstVertexOfPosition(const std::vector<Float3>& positions)
{
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](uint32_t v)
    { return std::tuple(positions[v].x, positions[v].y, positions[v].z, v); };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    std::vector<uint32_t> first(positions.size());
    for (size_t i = 0; i < order.size(); ++i)
    {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    return first;
}

Float3 areaVector(const TriangleMesh& mesh, size_t triangle)
{
    const Float3 a = mesh.positions[mesh.indices[triangle * 3]];
    const Float3 b = mesh.positions[mesh.indices[triangle * 3 + 1]];
    const Float3 c = mesh.positions[mesh.indices[triangle * 3 + 2]];
    return cross(b - a, c - a);
}

} // namespace

TriangleMesh makeGrid(uint32_t columns, uint32_t rows,
                      const std::function<void(Float2 uv, Float3& position, Float2& texture_uv)>& vertex)
{
    TriangleMesh mesh;
    const size_t stride = columns + size_t{1};
    mesh.positions.resize(stride * (rows + size_t{1}));
    mesh.uvs.resize(mesh.positions.size());
    parallelFor(rows + size_t{1},
                [&](size_t row)
                {
                    for (size_t column = 0; column < stride; ++column)
                    {
                        const Float2 uv{static_cast<float>(column) / static_cast<float>(columns),
                                        static_cast<float>(row) / static_cast<float>(rows)};
                        const size_t v = row * stride + column;
                        vertex(uv, mesh.positions[v], mesh.uvs[v]);
                    }
                });
    mesh.indices.reserve(size_t{columns} * rows * 6);
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t column = 0; column < columns; ++column)
        {
            const uint32_t v = row * (columns + 1) + column;
            const uint32_t above = v + columns + 1;
            mesh.indices.insert(mesh.indices.end(), {v, v + 1, above + 1, v, above + 1, above});
        }
    return mesh;
}

TriangleMesh makeBox(Float3 center, Float3 half, float uv_per_metre)
{
    TriangleMesh box;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f})
        {
            const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
            TriangleMesh face =
                makeGrid(1, 1,
                         [&](Float2 uv, Float3& position, Float2& texture_uv)
                         {
                             // u runs backwards on the negative side, so that it faces outwards
                             const float u = (uv.x * 2 - 1) * side, v = uv.y * 2 - 1;
                             position = center;
                             position[axis] += side * half[axis];
                             position[u_axis] += u * half[u_axis];
                             position[v_axis] += v * half[v_axis];
                             texture_uv = Float2{u * half[u_axis], v * half[v_axis]} * uv_per_metre;
                             if (v_axis != 1) // keep "up" of the image along +Y
                                 std::swap(texture_uv.x, texture_uv.y);
                             texture_uv.y = -texture_uv.y;
                         });
            setFlatNormals(face);
            append(box, face);
        }
    return box;
}

TriangleMesh makeBlock(Float3 low, Float3 high, float uv_per_metre)
{
    return makeBox((low + high) * 0.5f, (high - low) * 0.5f, uv_per_metre);
}

TriangleMesh makeLathe(const std::vector<Float2>& profile, uint32_t segments)
{
    TriangleMesh mesh = makeGrid(segments, static_cast<uint32_t>(profile.size()) - 1,
                                 [&](Float2 uv, Float3& position, Float2& texture_uv)
                                 {
                                     const auto ring = static_cast<size_t>(
                                         uv.y * static_cast<float>(profile.size() - 1) + 0.5f);
                                     const Float2 point = profile[profile.size() - 1 - ring];
                                     // the last column has the same bits as the first: the seam is closed
                                     const float angle = uv.x == 1.0f ? 0.0f : uv.x * 2 * kPi;
                                     position = {point.x * cosine(angle), point.y, -point.x * sine(angle)};
                                     texture_uv = {uv.x, 1 - uv.y};
                                 });
    setSmoothNormals(mesh);
    return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& part)
{
    const bool first = mesh.positions.empty();
    const auto base = static_cast<uint32_t>(mesh.positions.size());
    const auto extend = [&](auto& to, const auto& from)
    {
        HEARTH_ASSERT(first || to.empty() == from.empty());
        to.insert(to.end(), from.begin(), from.end());
    };
    extend(mesh.normals, part.normals);
    extend(mesh.uvs, part.uvs);
    extend(mesh.colors, part.colors);
    extend(mesh.joints, part.joints);
    extend(mesh.weights, part.weights);
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    for (const uint32_t index : part.indices)
        mesh.indices.push_back(base + index);
}

TriangleMesh transformed(TriangleMesh mesh, const Placement& placement)
{
    const Float3 s = placement.scale;
    for (Float3& p : mesh.positions)
        p = rotate(placement.rotation, p * s) + placement.translation;
    for (Float3& n : mesh.normals)
        n = normalize(rotate(placement.rotation, {n.x / s.x, n.y / s.y, n.z / s.z}));
    return mesh;
}

void setSmoothNormals(TriangleMesh& mesh)
{
    const std::vector<uint32_t> first = firstVertexOfPosition(mesh.positions);
    std::vector<Float3> sums(mesh.positions.size());
    for (size_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle)
        for (size_t corner = 0; corner < 3; ++corner)
            sums[first[mesh.indices[triangle * 3 + corner]]] += areaVector(mesh, triangle);
    mesh.normals.resize(mesh.positions.size());
    for (size_t v = 0; v < sums.size(); ++v)
    {
        // tiny triangles have areas near the end of float's range: scale before the division
        const Float3 sum = sums[first[v]] * 0x1p40f;
        mesh.normals[v] = normalize(sum);
    }
}

void setFlatNormals(TriangleMesh& mesh)
{
    mesh.normals.assign(mesh.positions.size(), Float3{0, 1, 0});
    for (size_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle)
        for (size_t corner = 0; corner < 3; ++corner)
            mesh.normals[mesh.indices[triangle * 3 + corner]] = normalize(areaVector(mesh, triangle));
}

} // namespace hearth::samples
