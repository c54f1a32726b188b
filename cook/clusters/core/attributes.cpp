// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/attributes.h"

#include "cook/mesh/deformation.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>

namespace hearth::clusters
{

namespace
{

// A sum of normals shorter than this has no direction.
constexpr float kMinNormalLength = 0.01f;

// Tangents nearer than this to their normal keep no direction.
constexpr float kMinTangentLength = 1e-3f;

float component(const Float4& weights, size_t i)
{
    return i == 0 ? weights.x : i == 1 ? weights.y : i == 2 ? weights.z : weights.w;
}

float jointWeight(const mesh::SourceMesh& vertices, uint32_t vertex, uint32_t joint)
{
    for (size_t set = 0; set < vertices.joint_sets.size(); ++set)
        for (size_t i = 0; i < 4; ++i)
            if (vertices.joint_sets[set][vertex].joint[i] == joint)
                if (const float weight = component(vertices.weight_sets[set][vertex], i); weight > 0)
                    return weight;
    return 0;
}

void setNormal(mesh::SourceMesh& vertices, uint32_t vertex, Float3 sum)
{
    const float size = length(sum);
    if (!(size > kMinNormalLength))
        return;
    const Float3 normal = sum / size;
    vertices.normals[vertex] = normal;
    if (vertices.tangents.empty())
        return;
    Float4& tangent = vertices.tangents[vertex];
    const Float3 along{tangent.x, tangent.y, tangent.z};
    const Float3 upright = along - normal * dot(along, normal);
    if (const float left = length(upright); left > kMinTangentLength)
        tangent = {upright.x / left, upright.y / left, upright.z / left, tangent.w};
}

/// Assign new weights to some joints. The vertex keeps its other joints, and the main joint gets the
/// remainder to 1.
void setJoints(mesh::SourceMesh& vertices, uint32_t vertex, uint32_t main_joint,
               std::vector<mesh::Influence> influences)
{
    const size_t known = influences.size();
    double sum = 0;
    for (const mesh::Influence& influence : influences)
        sum += influence.weight;
    for (size_t set = 0; set < vertices.joint_sets.size(); ++set)
        for (size_t i = 0; i < 4; ++i)
        {
            const uint16_t joint = vertices.joint_sets[set][vertex].joint[i];
            const auto end = influences.begin() + static_cast<ptrdiff_t>(known);
            const bool is_new = joint == main_joint || std::any_of(influences.begin(), end,
                                                                   [&](const mesh::Influence& influence)
                                                                   { return influence.joint == joint; });
            const auto weight = static_cast<double>(component(vertices.weight_sets[set][vertex], i));
            if (is_new || weight == 0)
                continue;
            influences.push_back({joint, weight});
            sum += weight;
        }
    influences.push_back({static_cast<uint16_t>(main_joint), std::max(1 - sum, 0.0)});
    // extrapolated weights can cancel, so that not even the main joint remains
    if (sum > 0 || influences.back().weight > 0)
        mesh::setInfluences(vertices, vertex, influences);
}

} // namespace

void packAttributes(const mesh::SourceMesh& vertices, uint32_t vertex, const AttributeWeights& weights,
                    Lanes* rows)
{
    HEARTH_RUNTIME_ASSERT(vertex < vertices.vertexCount());
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
    for (const DeformationWeight& joint : weights.joints)
        add(jointWeight(vertices, vertex, joint.index) * joint.length);
    for (const DeformationWeight& morph : weights.morphs)
    {
        const Float3 delta = vertices.morph_targets[morph.index].positions[vertex] * morph.length;
        add(delta.x), add(delta.y), add(delta.z);
    }
    HEARTH_RUNTIME_ASSERT(next == weights.count());
}

void unpackAttributes(const Lanes* rows, const AttributeWeights& weights, mesh::SourceMesh& vertices,
                      uint32_t vertex)
{
    HEARTH_RUNTIME_ASSERT(vertex < vertices.vertexCount());
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
    if (!weights.joints.empty())
    {
        std::vector<mesh::Influence> influences;
        for (const DeformationWeight& joint : weights.joints)
            influences.push_back(
                {static_cast<uint16_t>(joint.index), std::max(double{take(joint.length)}, 0.0)});
        setJoints(vertices, vertex, weights.main_joint, std::move(influences));
    }
}

} // namespace hearth::clusters
