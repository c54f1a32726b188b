// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/attributes.h"

#include <cmath>

namespace hearth::clusters
{

namespace
{

// A sum of normals shorter than this has no direction.
constexpr float kShortestNormal = 0.01f;

// Tangents nearer than this to their normal keep no direction.
constexpr float kShortestTangent = 1e-3f;

void setNormal(mesh::SourceMesh& vertices, uint32_t vertex, Float3 sum)
{
    const float size = length(sum);
    if (!(size > kShortestNormal))
        return;
    const Float3 normal = sum / size;
    vertices.normals[vertex] = normal;
    if (vertices.tangents.empty())
        return;
    Float4& tangent = vertices.tangents[vertex];
    const Float3 along{tangent.x, tangent.y, tangent.z};
    const Float3 upright = along - normal * dot(along, normal);
    if (const float left = length(upright); left > kShortestTangent)
        tangent = {upright.x / left, upright.y / left, upright.z / left, tangent.w};
}

} // namespace

void packAttributes(const mesh::SourceMesh& vertices, uint32_t vertex, const AttributeWeights& weights,
                    Lanes* rows)
{
    size_t next = 0;
    const auto add = [&](float value)
    {
        rows[next / kLanes][next % kLanes] = value;
        ++next;
    };
    if (weights.normal > 0)
    {
        const Float3 n = vertices.normals[vertex] * weights.normal;
        add(n.x), add(n.y), add(n.z);
    }
    if (weights.uv > 0)
    {
        const Float2 uv = vertices.uvs[0][vertex] * weights.uv;
        add(uv.x), add(uv.y);
    }
    if (weights.color > 0)
    {
        const Float4 c = vertices.colors[vertex];
        add(c.x * weights.color), add(c.y * weights.color), add(c.z * weights.color),
            add(c.w * weights.color);
    }
}

void unpackAttributes(const Lanes* rows, const AttributeWeights& weights, mesh::SourceMesh& vertices,
                      uint32_t vertex)
{
    size_t next = 0;
    const auto take = [&](float weight)
    {
        const float value = rows[next / kLanes][next % kLanes] / weight;
        ++next;
        return value;
    };
    if (weights.normal > 0)
    {
        const float x = take(weights.normal), y = take(weights.normal), z = take(weights.normal);
        setNormal(vertices, vertex, {x, y, z});
    }
    if (weights.uv > 0)
    {
        const float u = take(weights.uv), v = take(weights.uv);
        vertices.uvs[0][vertex] = {u, v};
    }
    if (weights.color > 0)
    {
        const auto unit = [&] { return std::clamp(take(weights.color), 0.0f, 1.0f); };
        const float r = unit(), g = unit(), b = unit(), a = unit();
        vertices.colors[vertex] = {r, g, b, a};
    }
}

} // namespace hearth::clusters
