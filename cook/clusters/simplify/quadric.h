// Quadric error of a position and of the attributes around it, relative to the vertex. M. Garland, P.
// Heckbert, "Surface simplification using quadric error metrics", 1997; attributes as in H. Hoppe, "New
// quadric metric for simplifying meshes with appearance attributes", 1999. See cook/clusters/README.md,
// "Simplifying".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/group_mesh.h"
#include "formats/base/math.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace hearth::clusters
{

/// Quadric E(x) = x^T A x + 2 b.x + c with x the offset from the vertex's own position: near zero, so floats
/// suffice.
struct PositionQuadric
{
    Lanes diagonal_c{}; ///< a00, a11, a22, c
    Lanes mixed{};      ///< a01, a02, a12
    Lanes b{};

    /// Add a plane through the vertex itself: b and c stay unchanged.
    void addPlane(Float3 unit_normal, float weight)
    {
        const Lanes n{unit_normal.x, unit_normal.y, unit_normal.z, 0};
        const Lanes weighted = n * splat(weight);
        diagonal_c += n * weighted;
        mixed += __builtin_shufflevector(n, n, 0, 0, 1, 3) * __builtin_shufflevector(weighted, n, 1, 2, 2, 3);
    }

    /// Add a quadric of the same vertex.
    void add(const PositionQuadric& other)
    {
        diagonal_c += other.diagonal_c;
        mixed += other.mixed;
        b += other.b;
    }

    Lanes timesA(Float3 x) const
    {
        // a00 x + a01 y + a02 z, a01 x + a11 y + a12 z, a02 x + a12 y + a22 z
        const Lanes xyz{x.x, x.y, x.z, 0};
        const Lanes of_y = __builtin_shufflevector(xyz, xyz, 1, 0, 0, 3);
        const Lanes of_z = __builtin_shufflevector(xyz, xyz, 2, 2, 1, 3);
        return diagonal_c * xyz + __builtin_shufflevector(mixed, mixed, 0, 0, 1, 3) * of_y +
               __builtin_shufflevector(mixed, mixed, 1, 2, 2, 3) * of_z;
    }

    float at(Float3 x) const
    {
        const Lanes xyz{x.x, x.y, x.z, 0};
        return sumOfLanes(xyz * (timesA(x) + b + b)) + diagonal_c[3];
    }

    /// Evaluate at four offsets.
    Lanes at(LaneVector x) const
    {
        const auto all = [](float value) { return splat(value); };
        const Lanes twice{2, 2, 2, 2};
        const Lanes of_x =
            all(diagonal_c[0]) * x.x + twice * (all(mixed[0]) * x.y + all(mixed[1]) * x.z + all(b[0]));
        const Lanes of_y = all(diagonal_c[1]) * x.y + twice * (all(mixed[2]) * x.z + all(b[1]));
        const Lanes of_z = all(diagonal_c[2]) * x.z + twice * all(b[2]);
        return x.x * of_x + x.y * of_y + x.z * of_z + all(diagonal_c[3]);
    }

    /// Add the quadric of another vertex that moves by `t` to this one.
    void addMoved(const PositionQuadric& other, Float3 t)
    {
        const float c = other.at(t);
        b += other.b + other.timesA(t);
        diagonal_c += Lanes{other.diagonal_c[0], other.diagonal_c[1], other.diagonal_c[2], c};
        mixed += other.mixed;
    }
};

/// Matrix A of several planes, lane by lane.
struct PlaneSums
{
    Lanes a00{}, a11{}, a22{}, a01{}, a02{}, a12{};

    void add(LaneVector normal, LaneVector weighted)
    {
        a00 += normal.x * weighted.x;
        a11 += normal.y * weighted.y;
        a22 += normal.z * weighted.z;
        a01 += normal.x * weighted.y;
        a02 += normal.x * weighted.z;
        a12 += normal.y * weighted.z;
    }

    void addTo(PositionQuadric& quadric) const
    {
        const std::array<Lanes, kLanes> diagonal = transposed({a00, a11, a22, Lanes{}});
        const std::array<Lanes, kLanes> mixed = transposed({a01, a02, a12, Lanes{}});
        quadric.diagonal_c += (diagonal[0] + diagonal[1]) + (diagonal[2] + diagonal[3]);
        quadric.mixed += (mixed[0] + mixed[1]) + (mixed[2] + mixed[3]);
    }
};

/// Four attributes of a wedge: the area-weighted sums of their linear functions (gradient . x + offset) over
/// the triangles of the wedge, relative to the wedge's own position and values.
struct AttributeGradients
{
    LaneVector gradient{};
    Lanes offset{};
};

/// Quadrics of a group. Each position has one PositionQuadric, which includes the attributes' contributions
/// to A, b and c; each wedge has an area weight and attribute_rows gradients.
struct Quadrics
{
    IdVector<PositionId, PositionQuadric> position;
    IdVector<WedgeId, float> wedge_weight;
    std::vector<AttributeGradients> gradients;

    /// Return the error that the attributes of a wedge add when it moves by `t`, lane by lane.
    Lanes attributeError(const GroupMesh& group, WedgeMove move, LaneVector t) const
    {
        const float weight = wedge_weight[move.from];
        const Lanes* from = group.wedgeAttributes(move.from);
        const Lanes* to = group.wedgeAttributes(move.to);
        const AttributeGradients* g = gradients.data() + group.firstRow(move.from);
        Lanes error{};
        for (uint32_t r = 0; r < group.attribute_rows; ++r)
        {
            const Lanes delta = to[r] - from[r];
            error += delta * (weight * delta - 2 * (dot(g[r].gradient, t) + g[r].offset));
        }
        return error;
    }

    /// Return the errors of collapses from a position with one wedge to four ends.
    /// t  offsets of the ends
    Lanes errorsOfFour(const GroupMesh& group, PositionId position_from, WedgeId wedge,
                       const std::array<WedgeId, kLanes>& to, LaneVector t) const
    {
        Lanes error = position[position_from].at(t);
        const Lanes weight = splat(wedge_weight[wedge]);
        const Lanes* from = group.wedgeAttributes(wedge);
        const AttributeGradients* g = gradients.data() + group.firstRow(wedge);
        for (uint32_t r = 0, left = group.attribute_count; r < group.attribute_rows; ++r)
        {
            const std::array<Lanes, kLanes> of_ends =
                transposed({group.wedgeAttributes(to[0])[r], group.wedgeAttributes(to[1])[r],
                            group.wedgeAttributes(to[2])[r], group.wedgeAttributes(to[3])[r]});
            const uint32_t count = std::min(left, uint32_t{kLanes});
            left -= count;
            for (uint32_t i = 0; i < count; ++i)
            {
                const Lanes delta = of_ends[i] - splat(from[r][i]);
                const Lanes change = splat(g[r].gradient.x[i]) * t.x + splat(g[r].gradient.y[i]) * t.y +
                                     splat(g[r].gradient.z[i]) * t.z + splat(g[r].offset[i]);
                error += delta * (weight * delta - (change + change));
            }
        }
        return error;
    }

    /// Return the most that optimal attributes at its target could subtract from the error of a wedge.
    Lanes maxAttributeGain(const GroupMesh& group, WedgeId wedge, LaneVector t) const
    {
        const AttributeGradients* g = gradients.data() + group.firstRow(wedge);
        Lanes squares{};
        for (uint32_t r = 0; r < group.attribute_rows; ++r)
        {
            const Lanes change = dot(g[r].gradient, t) + g[r].offset;
            squares += change * change;
        }
        return squares * inverseOr0(wedge_weight[wedge]);
    }

    /// Add the quadrics of a position to those of its collapse target, with its wedges.
    void move(const GroupMesh& group, PositionId from, PositionId to, std::span<const WedgeMove> moves);
};

/// Return the squared distance of two wedges' attributes.
inline float attributeDistance2(const GroupMesh& group, WedgeId a, WedgeId b)
{
    const Lanes* attributes_a = group.wedgeAttributes(a);
    const Lanes* attributes_b = group.wedgeAttributes(b);
    Lanes squares{};
    for (uint32_t r = 0; r < group.attribute_rows; ++r)
    {
        const Lanes d = attributes_a[r] - attributes_b[r];
        squares += d * d;
    }
    return sumOfLanes(squares);
}

// Weight of the distance to the position itself against the distances to planes. It makes one position
// optimal where the surface is flat, like uncertain normals would (P. Trettner, L. Kobbelt, "Fast and robust
// QEF minimization using probabilistic quadrics", 2020).
inline constexpr float kPointWeight = 1e-5f;

/// Compute the quadrics of all triangles and attributes; those of locked positions are never used and left
/// out.
Quadrics computeQuadrics(const GroupMesh& group);

/// Compute the quadric that holds an edge in place: the plane through it perpendicular to a triangle beside
/// it.
/// along  from one end of the edge to the other
/// side   from the same end to the triangle's third corner
PositionQuadric edgeQuadric(Float3 along, Float3 side, float factor);

// An open border has no surface on its other side to hold it: a large weight against the planes of the
// surface keeps its shape. Seams are held by both sides, and get the same weight again.
inline constexpr float kBorderWeight = 10.0f;
inline constexpr float kSeamWeight = 1.0f;

} // namespace hearth::clusters
