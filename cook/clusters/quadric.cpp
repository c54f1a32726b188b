// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/quadric.h"

#include <algorithm>

namespace hearth::clusters
{

namespace
{

// An open border may only move along itself; this weight against the planes of the surface keeps its shape. Seams are
// kept less strictly: the surface on their other side holds them too. (Both as in meshoptimizer, found by trial there.)
constexpr float kBorderWeight = 10.0f;
constexpr float kSeamWeight = 1.0f;

/// A directed edge of a triangle between wedges, sortable by the positions of its ends.
struct HalfEdge
{
    uint64_t key; ///< smaller position in the high half, larger in the low
    uint32_t corner;
};

/// Gradient of a function on a triangle with the given differences along its two edges from corner 0.
struct GradientBasis
{
    Float3 of_e1;
    Float3 of_e2;
};

GradientBasis gradientBasis(Float3 e1, Float3 e2)
{
    const float d11 = dot(e1, e1);
    const float d12 = dot(e1, e2);
    const float d22 = dot(e2, e2);
    const float det = d11 * d22 - d12 * d12;
    // needles have no useful gradient
    if (!(det > 1e-6f * d11 * d22))
        return {};
    return {(e1 * d22 - e2 * d12) / det, (e2 * d11 - e1 * d12) / det};
}

void addTriangle(Quadrics& quadrics, const GroupMesh& group, size_t first_corner)
{
    uint32_t wedge[3];
    uint32_t position[3];
    for (size_t k = 0; k < 3; ++k)
    {
        wedge[k] = group.corners[first_corner + k];
        position[k] = group.position_of_wedge[wedge[k]];
    }
    const Float3 e1 = group.positions[position[1]] - group.positions[position[0]];
    const Float3 e2 = group.positions[position[2]] - group.positions[position[0]];
    const Float3 normal = cross(e1, e2);
    const float twice_area = length(normal);
    if (!(twice_area > 0))
        return;
    // a third of the area to each corner
    const float weight = twice_area / 6.0f;
    for (const uint32_t p : position)
        quadrics.position[p].addPlane(normal / twice_area, weight);

    const GradientBasis basis = gradientBasis(e1, e2);
    const uint32_t count = group.attribute_count;
    for (uint32_t i = 0; i < count; ++i)
    {
        const float s0 = group.attributes[wedge[0] * count + i];
        const float s1 = group.attributes[wedge[1] * count + i];
        const float s2 = group.attributes[wedge[2] * count + i];
        const Float3 gradient = basis.of_e1 * (s1 - s0) + basis.of_e2 * (s2 - s0);
        for (size_t k = 0; k < 3; ++k)
        {
            quadrics.position[position[k]].addOuterProduct(gradient, weight);
            quadrics.gradients[wedge[k] * count + i].gradient += gradient * weight;
        }
    }
    for (const uint32_t w : wedge)
        quadrics.wedge_weight[w] += weight;
}

/// The plane through an edge that stands upright on its triangle holds the edge in place.
void addEdgePlane(Quadrics& quadrics, const GroupMesh& group, uint32_t corner, float factor)
{
    const uint32_t first = corner - corner % 3;
    const uint32_t from = group.positionAt(corner);
    const uint32_t to = group.positionAt(first + (corner + 1) % 3);
    const uint32_t apex = group.positionAt(first + (corner + 2) % 3);
    const Float3 edge = group.positions[to] - group.positions[from];
    const Float3 side = group.positions[apex] - group.positions[from];
    const float edge_length2 = dot(edge, edge);
    if (!(edge_length2 > 0))
        return;
    const Float3 upright = side - edge * (dot(side, edge) / edge_length2);
    const float height = length(upright);
    if (!(height > 0))
        return;
    for (const uint32_t p : {from, to})
        quadrics.position[p].addPlane(upright / height, factor * edge_length2);
}

uint64_t edgeKey(uint32_t a, uint32_t b)
{
    const auto [low, high] = std::minmax(a, b);
    return uint64_t{low} << 32 | high;
}

/// Hold open borders, edges of more than two triangles, and seams.
void addEdgePlanes(Quadrics& quadrics, const GroupMesh& group)
{
    std::vector<HalfEdge> edges;
    edges.reserve(group.corners.size());
    for (uint32_t corner = 0; corner < group.corners.size(); ++corner)
    {
        const uint32_t next = corner - corner % 3 + (corner + 1) % 3;
        edges.push_back({edgeKey(group.positionAt(corner), group.positionAt(next)), corner});
    }
    std::sort(edges.begin(), edges.end(),
              [](const HalfEdge& a, const HalfEdge& b)
              { return a.key != b.key ? a.key < b.key : a.corner < b.corner; });
    const auto nextWedge = [&](uint32_t corner)
    { return group.corners[corner - corner % 3 + (corner + 1) % 3]; };
    for (size_t i = 0; i < edges.size();)
    {
        size_t end = i + 1;
        while (end < edges.size() && edges[end].key == edges[i].key)
            ++end;
        const uint32_t a = edges[i].corner;
        const uint32_t b = edges[end - 1].corner;
        const bool regular = end - i == 2 && group.positionAt(a) != group.positionAt(b);
        const bool smooth = regular && group.corners[a] == nextWedge(b) && group.corners[b] == nextWedge(a);
        if (!smooth)
            for (size_t k = i; k < end; ++k)
                addEdgePlane(quadrics, group, edges[k].corner, regular ? kSeamWeight : kBorderWeight);
        i = end;
    }
}

} // namespace

Quadrics initialQuadrics(const GroupMesh& group)
{
    Quadrics quadrics;
    quadrics.position.resize(group.positions.size());
    quadrics.wedge_weight.resize(group.vertex_of_wedge.size());
    quadrics.gradients.resize(group.vertex_of_wedge.size() * group.attribute_count);
    for (size_t corner = 0; corner < group.corners.size(); corner += 3)
        addTriangle(quadrics, group, corner);
    addEdgePlanes(quadrics, group);
    return quadrics;
}

} // namespace hearth::clusters
