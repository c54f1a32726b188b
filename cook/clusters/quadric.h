// Quadric error of a position and the attributes around it, relative to the vertex that it belongs to.
// M. Garland, P. Heckbert, "Surface simplification using quadric error metrics", 1997; attributes as in H. Hoppe,
// "New quadric metric for simplifying meshes with appearance attributes", 1999. See README.md, "Simplifying".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/group_mesh.h"
#include "formats/math.h"

#include <span>
#include <vector>

namespace hearth::clusters
{

/// E(x) = x^T A x + 2 b.x + c, where x is the offset from the vertex's own place: near zero, so that floats suffice.
struct PositionQuadric
{
    float a00 = 0, a11 = 0, a22 = 0, a01 = 0, a02 = 0, a12 = 0;
    Float3 b;
    float c = 0;

    void addPlane(Float3 unit_normal, float weight)
    {
        // the plane goes through the vertex itself: b and c get nothing
        const Float3 n = unit_normal * weight;
        a00 += n.x * unit_normal.x;
        a11 += n.y * unit_normal.y;
        a22 += n.z * unit_normal.z;
        a01 += n.x * unit_normal.y;
        a02 += n.x * unit_normal.z;
        a12 += n.y * unit_normal.z;
    }

    /// Add one of the same vertex.
    void add(const PositionQuadric& other)
    {
        a00 += other.a00;
        a11 += other.a11;
        a22 += other.a22;
        a01 += other.a01;
        a02 += other.a02;
        a12 += other.a12;
        b += other.b;
        c += other.c;
    }

    Float3 timesA(Float3 x) const
    {
        return {a00 * x.x + a01 * x.y + a02 * x.z, a01 * x.x + a11 * x.y + a12 * x.z,
                a02 * x.x + a12 * x.y + a22 * x.z};
    }

    float at(Float3 x) const { return dot(x, timesA(x)) + 2 * dot(b, x) + c; }

    /// Add `other` when its vertex moves by `t` to this one.
    void addMoved(const PositionQuadric& other, Float3 t)
    {
        c += other.at(t);
        b += other.b + other.timesA(t);
        a00 += other.a00;
        a11 += other.a11;
        a22 += other.a22;
        a01 += other.a01;
        a02 += other.a02;
        a12 += other.a12;
    }
};

/// Four attributes of one wedge: the area-weighted sums of their linear functions (gradient . x + offset) over the
/// triangles that the wedge stands for, relative to the wedge's own place and values.
struct AttributeGradients
{
    LaneVector gradient{};
    Lanes offset{};
};

/// All quadrics of a group. Each position has one PositionQuadric, which takes in what the attributes contribute to
/// A, b and c; each wedge has an area weight and attribute_rows gradients.
struct Quadrics
{
    std::vector<PositionQuadric> position;
    std::vector<float> wedge_weight;
    std::vector<AttributeGradients> gradients;

    /// What the attributes of a wedge add to the error, lane by lane, when it moves by `t`.
    Lanes attributeError(const GroupMesh& group, WedgeMove move, LaneVector t) const
    {
        const float weight = wedge_weight[move.from];
        const Lanes* from = group.attributesOf(move.from);
        const Lanes* to = group.attributesOf(move.to);
        const AttributeGradients* g = gradients.data() + size_t{move.from} * group.attribute_rows;
        Lanes error{};
        for (uint32_t r = 0; r < group.attribute_rows; ++r)
        {
            const Lanes delta = to[r] - from[r];
            error += delta * (weight * delta - 2 * (dot(g[r].gradient, t) + g[r].offset));
        }
        return error;
    }

    /// What the best possible attributes at its goal would take off the error of a wedge.
    Lanes mostGain(const GroupMesh& group, uint32_t wedge, LaneVector t) const
    {
        const AttributeGradients* g = gradients.data() + size_t{wedge} * group.attribute_rows;
        Lanes squares{};
        for (uint32_t r = 0; r < group.attribute_rows; ++r)
        {
            const Lanes change = dot(g[r].gradient, t) + g[r].offset;
            squares += change * change;
        }
        return squares * inverseOr0(wedge_weight[wedge]);
    }

    /// Add the quadrics of a position to those of another that it goes to, with its wedges.
    void move(const GroupMesh& group, uint32_t from, uint32_t to, std::span<const WedgeMove> moves);
};

/// Squared distance of two wedges' attributes.
inline float attributeDistance2(const GroupMesh& group, uint32_t a, uint32_t b)
{
    const Lanes* attributes_a = group.attributesOf(a);
    const Lanes* attributes_b = group.attributesOf(b);
    Lanes squares{};
    for (uint32_t r = 0; r < group.attribute_rows; ++r)
    {
        const Lanes d = attributes_a[r] - attributes_b[r];
        squares += d * d;
    }
    return sumOfLanes(squares);
}

// Weight of the distances to the positions themselves against those to the planes: makes one place the best where the
// surface is flat, as uncertain normals would (P. Trettner, L. Kobbelt, "Fast and robust QEF minimization using
// probabilistic quadrics", 2020).
inline constexpr float kSpread = 1e-3f;

/// The planes and attributes of all triangles; what locked positions have is never asked for and left out.
Quadrics initialQuadrics(const GroupMesh& group);

/// What holds an edge in place: the plane through it that stands upright on a triangle beside it.
/// along  from one end of the edge to the other;  side: from there to the triangle's third corner
PositionQuadric edgeQuadric(Float3 along, Float3 side, float factor);

// An open border has no surface on its other side that would hold it: a large weight against the planes of the surface
// keeps its shape. Seams are held by both sides, and get as much again.
inline constexpr float kBorderWeight = 10.0f;
inline constexpr float kSeamWeight = 1.0f;

} // namespace hearth::clusters
