// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/quadric.h"

#include "formats/base/assert.h"

namespace hearth::clusters
{

namespace
{

/// Basis of the gradient of a linear function on a triangle, from its differences along the two edges at
/// corner 0.
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

void addTriangle(Quadrics& quadrics, const GroupMesh& group, TriangleId triangle)
{
    const std::array<WedgeId, 3> wedge = group.corners.triangle(triangle);
    PositionId position[3];
    bool free[3];
    for (size_t k = 0; k < 3; ++k)
    {
        position[k] = group.position_id_of_wedge[wedge[k]];
        free[k] = group.locked[position[k]] == 0;
    }
    const Float3 e1 = group.positions[position[1]] - group.positions[position[0]];
    const Float3 e2 = group.positions[position[2]] - group.positions[position[0]];
    const Float3 normal = cross(e1, e2);
    const float twice_area = length(normal);
    if (!(twice_area > 0))
        return;
    // a third of the area to each corner
    const float weight = twice_area / 6.0f;
    PositionQuadric quadric;
    quadric.addPlane(normal / twice_area, weight);

    const GradientBasis basis = gradientBasis(e1, e2);
    const LaneVector of_e1 = splat(basis.of_e1);
    const LaneVector of_e2 = splat(basis.of_e2);
    const uint32_t rows = group.attribute_rows;
    PlaneSums planes;
    for (uint32_t r = 0; r < rows; ++r)
    {
        const Lanes s0 = group.wedgeAttributes(wedge[0])[r];
        const Lanes s1 = group.wedgeAttributes(wedge[1])[r];
        const Lanes s2 = group.wedgeAttributes(wedge[2])[r];
        const LaneVector gradient = of_e1 * (s1 - s0) + of_e2 * (s2 - s0);
        const LaneVector weighted = gradient * splat(weight);
        planes.add(gradient, weighted);
        for (size_t k = 0; k < 3; ++k)
            if (free[k])
            {
                LaneVector& sum = quadrics.gradients[group.firstRow(wedge[k]) + r].gradient;
                sum = sum + weighted;
            }
    }
    planes.addTo(quadric);
    const float spread = kPointWeight * weight;
    quadric.diagonal_c += Lanes{spread, spread, spread, 0};
    for (size_t k = 0; k < 3; ++k)
        if (free[k])
        {
            quadrics.wedge_weight[wedge[k]] += weight;
            quadrics.position[position[k]].add(quadric);
        }
}

} // namespace

void Quadrics::move(const GroupMesh& group, PositionId from, PositionId to, std::span<const WedgeMove> moves)
{
    HEARTH_RUNTIME_ASSERT(from != to && !moves.empty());
    const Float3 t = group.positions[to] - group.positions[from];
    const LaneVector t_lanes = splat(t);
    const uint32_t rows = group.attribute_rows;
    PositionQuadric moved = position[from];
    Lanes moved_c{};
    LaneVector moved_b{};
    for (const WedgeMove& wedge : moves)
    {
        const float weight = wedge_weight[wedge.from];
        wedge_weight[wedge.to] += weight;
        for (uint32_t r = 0; r < rows; ++r)
        {
            const Lanes delta = group.wedgeAttributes(wedge.to)[r] - group.wedgeAttributes(wedge.from)[r];
            const AttributeGradients g = gradients[group.firstRow(wedge.from) + r];
            AttributeGradients& goal = gradients[group.firstRow(wedge.to) + r];
            moved_c += delta * (weight * delta - 2 * g.offset);
            moved_b = moved_b - g.gradient * delta;
            goal.gradient = goal.gradient + g.gradient;
            goal.offset += g.offset + dot(g.gradient, t_lanes) - weight * delta;
        }
    }
    moved.diagonal_c[3] += sumOfLanes(moved_c);
    moved.b += sumsOfLanes(moved_b);
    position[to].addMoved(moved, t);
}

Quadrics computeQuadrics(const GroupMesh& group)
{
    HEARTH_ASSERT(group.attributes.size() == group.vertex_of_wedge.size() * group.attribute_rows);
    HEARTH_ASSERT(group.attribute_count <= group.attribute_rows * kLanes);
    Quadrics quadrics;
    quadrics.position.resize(group.positions.size());
    quadrics.wedge_weight.resize(group.vertex_of_wedge.size());
    quadrics.gradients.resize(group.vertex_of_wedge.size() * group.attribute_rows);
    for (const TriangleId triangle : group.corners.triangles())
        addTriangle(quadrics, group, triangle);
    return quadrics;
}

PositionQuadric edgeQuadric(Float3 along, Float3 side, float factor)
{
    HEARTH_RUNTIME_ASSERT(factor > 0);
    PositionQuadric quadric;
    const float length2 = dot(along, along);
    if (!(length2 > 0))
        return quadric;
    const Float3 upright = side - along * (dot(side, along) / length2);
    const float height = length(upright);
    if (height > 0)
        quadric.addPlane(upright / height, factor * length2);
    return quadric;
}

} // namespace hearth::clusters
