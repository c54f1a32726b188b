// Elimination of the attributes from the quadric: H. Hoppe, "New quadric metric for simplifying meshes with
// appearance attributes", 1999.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/simplify/placement.h"

#include "cook/clusters/simplify/triangle_flip.h"
#include "cook/mesh/grid.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hearth::clusters
{

namespace
{

// Maximum distance that a position moves, in parts of its longest edge.
constexpr float kMaxMove = 1.0f;

constexpr int kMaxHalvings = 2;

// Positions leave the source's box by at most this part of its longest side. Corners of a coarse ball lie
// outside it by a few hundredths, so that its volume stays.
constexpr double kMaxOvershoot = 0.05;

/// Solve A x = -b for a symmetric positive definite A.
std::optional<Float3> solve(const PositionQuadric& q)
{
    const double a00 = q.diagonal_c[0], a11 = q.diagonal_c[1], a22 = q.diagonal_c[2];
    const double a01 = q.mixed[0], a02 = q.mixed[1], a12 = q.mixed[2];
    const double b0 = q.b[0], b1 = q.b[1], b2 = q.b[2];
    const double c00 = a11 * a22 - a12 * a12, c01 = a02 * a12 - a01 * a22, c02 = a01 * a12 - a02 * a11;
    const double c11 = a00 * a22 - a02 * a02, c12 = a01 * a02 - a00 * a12, c22 = a00 * a11 - a01 * a01;
    const double det = a00 * c00 + a01 * c01 + a02 * c02;
    const double trace = a00 + a11 + a22;
    if (!(a00 > 0) || !(c22 > 0) || !(det > 1e-12 * trace * trace * trace))
        return std::nullopt;
    const double x = -(c00 * b0 + c01 * b1 + c02 * b2) / det;
    const double y = -(c01 * b0 + c11 * b1 + c12 * b2) / det;
    const double z = -(c02 * b0 + c12 * b1 + c22 * b2) / det;
    return Float3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

class Placer
{
public:
    Placer(const GroupMesh& group, StarMesh& mesh, const Quadrics& quadrics)
        : group_(group),
          mesh_(mesh),
          quadrics_(quadrics),
          result_{group.positions, IdVector<PositionId, Float3>(group.positions.size()),
                  IdVector<PositionId, uint8_t>(group.positions.size(), 0), group.attributes}
    {
    }

    Placement run(IdSpan<PositionId, const uint8_t> movable)
    {
        for (const PositionId position : movable.ids())
            if (movable[position] != 0 && mesh_.degree(position) > 0)
                place(position);
        return std::move(result_);
    }

private:
    void place(PositionId position)
    {
        if (!gatherWedges(position))
            return;
        PositionQuadric quadric = quadrics_.position[position];
        for (const WedgeId wedge : wedges_)
            eliminateAttributes(wedge, quadric);
        const std::optional<Float3> best = solve(quadric);
        Float3 offset = best ? *best : Float3{};
        const float longest = longestEdge(position);
        if (!(dot(offset, offset) <= kMaxMove * kMaxMove * longest * longest))
            offset = {};
        result_.object_positions[position] = toObjectSpace(group_, group_.positions[position]);
        for (int halvings = 0; halvings <= kMaxHalvings; ++halvings, offset = offset * 0.5f)
        {
            const Float3 object_position = toObjectSpace(group_, group_.positions[position] + offset);
            const Float3 place = toLocalSpace(group_, object_position);
            if (flipsTriangle(position, place))
                continue;
            result_.positions[position] = place;
            result_.object_positions[position] = object_position;
            break;
        }
        for (const WedgeId wedge : wedges_)
            solveAttributes(wedge, result_.positions[position] - group_.positions[position]);
        result_.modified[position] = 1;
    }

    /// Collect the wedges of a position. False at an open border: its position stays, the next mesh may lie
    /// against it.
    bool gatherWedges(PositionId position)
    {
        if (mesh_.gatherFan(position))
        {
            wedges_.assign(1, mesh_.fanWedge());
            return true;
        }
        mesh_.gather(position);
        const auto ring = mesh_.ring();
        wedges_.assign(mesh_.wedges().begin(), mesh_.wedges().end());
        return std::all_of(ring.begin(), ring.end(),
                           [&](const Spoke& spoke) { return spoke.regular(mesh_.layers()); });
    }

    float longestEdge(PositionId position) const
    {
        float longest2 = 0;
        for (const StarCorner corner : mesh_.star(position))
        {
            // around a closed star, each neighbour is the next corner once
            const Float3 along =
                result_.positions[mesh_.positionIdAt(nextCorner(corner))] - group_.positions[position];
            longest2 = std::max(longest2, dot(along, along));
        }
        return std::sqrt(longest2);
    }

    /// Reduce the quadric to the position alone, with the wedge's attributes optimal at each position (Schur
    /// complement).
    void eliminateAttributes(WedgeId wedge, PositionQuadric& quadric) const
    {
        const Lanes inverse = splat(inverseOr0(quadrics_.wedge_weight[wedge]));
        PlaneSums sums;
        LaneVector of_b{};
        for (uint32_t r = 0; r < group_.attribute_rows; ++r)
        {
            const AttributeGradients& g = quadrics_.gradients[group_.firstRow(wedge) + r];
            const LaneVector scaled = g.gradient * inverse;
            sums.add(g.gradient, scaled);
            of_b = of_b + scaled * g.offset;
        }
        PositionQuadric gain;
        sums.addTo(gain);
        gain.b = sumsOfLanes(of_b);
        quadric.diagonal_c -= gain.diagonal_c;
        quadric.mixed -= gain.mixed;
        quadric.b -= gain.b;
    }

    void solveAttributes(WedgeId wedge, Float3 offset)
    {
        const Lanes inverse = splat(inverseOr0(quadrics_.wedge_weight[wedge]));
        const LaneVector moved = splat(offset);
        for (uint32_t r = 0; r < group_.attribute_rows; ++r)
        {
            const AttributeGradients& g = quadrics_.gradients[group_.firstRow(wedge) + r];
            result_.attributes[group_.firstRow(wedge) + r] += (dot(g.gradient, moved) + g.offset) * inverse;
        }
    }

    bool flipsTriangle(PositionId position, Float3 place) const
    {
        for (const StarCorner corner : mesh_.star(position))
            if (moveFlipsTriangle(result_.positions[mesh_.positionIdAt(nextCorner(corner))],
                                  result_.positions[mesh_.positionIdAt(previousCorner(corner))],
                                  result_.positions[position], place))
                return true;
        return false;
    }

    const GroupMesh& group_;
    StarMesh& mesh_;
    const Quadrics& quadrics_;
    Placement result_;
    std::vector<WedgeId> wedges_; ///< wedges of the current position
};

} // namespace

Float3 toObjectSpace(const GroupMesh& group, Float3 local)
{
    HEARTH_RUNTIME_ASSERT(group.grid_step > 0);
    const Box3& box = group.mesh_box;
    double longest = 0;
    for (int axis = 0; axis < 3; ++axis)
        longest = std::max(longest, double{box.max[axis]} - box.min[axis]);
    Float3 place;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double coordinate =
            std::clamp(group.center[axis] + group.scale * local[axis],
                       box.min[axis] - kMaxOvershoot * longest, box.max[axis] + kMaxOvershoot * longest);
        place[axis] = mesh::snap(coordinate, group.grid_step);
    }
    return place;
}

Float3 toLocalSpace(const GroupMesh& group, Float3 object)
{
    Float3 place;
    for (int axis = 0; axis < 3; ++axis)
        place[axis] = static_cast<float>((object[axis] - group.center[axis]) / group.scale);
    return place;
}

Placement optimizePlacement(const GroupMesh& group, StarMesh& mesh, const Quadrics& quadrics,
                            IdSpan<PositionId, const uint8_t> movable)
{
    HEARTH_ASSERT(movable.size() == group.positions.size());
    HEARTH_ASSERT(quadrics.position.size() == group.positions.size() &&
                  quadrics.wedge_weight.size() == group.vertex_of_wedge.size());
    return Placer(group, mesh, quadrics).run(movable);
}

namespace
{

/// Growth of an island: p becomes to + (p - from) * factor.
struct IslandGrowth
{
    Float3 from, to;
    float factor = 1;
};

/// Return the growth of an island by `factor` that ends inside the source's box: islands with less room grow
/// less, and those at its sides move.
IslandGrowth fitGrowth(const GroupMesh& group, const Box3& island, float factor)
{
    const Float3 low = toLocalSpace(group, group.mesh_box.min),
                 high = toLocalSpace(group, group.mesh_box.max);
    const Float3 size = island.max - island.min;
    for (int axis = 0; axis < 3; ++axis)
        if (size[axis] * factor > high[axis] - low[axis])
            factor = std::max((high[axis] - low[axis]) / size[axis], 1.0f);
    IslandGrowth growth{island.center(), island.center(), factor};
    for (int axis = 0; axis < 3; ++axis)
    {
        const float half = size[axis] * 0.5f * factor;
        growth.to[axis] = std::max(std::min(growth.to[axis], high[axis] - half), low[axis] + half);
    }
    return growth;
}

} // namespace

void growIslands(const GroupMesh& group, const Growth& growth, Placement& placement)
{
    HEARTH_ASSERT(growth.factor >= 1);
    for (const std::vector<PositionId>& island : growth.islands)
    {
        Box3 box;
        for (const PositionId position : island)
            box.add(placement.positions[position]);
        const IslandGrowth fitted = fitGrowth(group, box, growth.factor);
        if (!(fitted.factor > 1))
            continue;
        for (const PositionId position : island)
        {
            placement.object_positions[position] = toObjectSpace(
                group, fitted.to + (placement.positions[position] - fitted.from) * fitted.factor);
            placement.positions[position] = toLocalSpace(group, placement.object_positions[position]);
            placement.modified[position] = 1;
        }
    }
}

} // namespace hearth::clusters
