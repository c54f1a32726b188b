// How far apart points of two surfaces can come in any pose of a deformed mesh. See cook/clusters/README.md, "Deformed meshes".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/mesh_motion.h"
#include "cook/mesh/source_mesh.h"
#include "formats/base/double3.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace hearth::clusters
{

/// What deforms the vertices of one surface.
class DeformedSurface
{
public:
    struct Influence
    {
        uint16_t joint;
        double weight;
    };

    /// Append a vertex.
    /// place    in units of `scale`
    /// source   has its joints, weights and morph deltas as number `vertex`
    void add(Float3 place, const mesh::SourceMesh& source, uint32_t vertex, double scale);

    Double3 place(uint32_t vertex) const { return places_[vertex]; }
    std::span<const Influence> influences(uint32_t vertex) const
    {
        return std::span(influences_)
            .subspan(first_influence_[vertex], first_influence_[vertex + 1] - first_influence_[vertex]);
    }
    std::span<const Double3> deltas(uint32_t vertex) const
    {
        return std::span(deltas_).subspan(vertex * delta_count_, delta_count_);
    }

private:
    std::vector<Double3> places_;
    std::vector<Influence> influences_;
    std::vector<size_t> first_influence_{0};
    std::vector<Double3> deltas_; ///< of each vertex, one for each target
    size_t delta_count_ = 0;
};

/// A point of a surface: in a triangle, by its three vertices.
struct DeformedPoint
{
    const DeformedSurface* surface;
    std::array<uint32_t, 3> vertices;
    std::array<double, 3> parts; ///< sum 1
};

/// Bounds distances over all poses; keeps what it has asked of the motion. A skinned point is the sum over joints of M_j h_j with h_j = w_j (x, 1), so it is linear in what vertices
/// have, and with D_j = M_b^-1 M_j for a main bone b two points differ by at most the norm of M_b times
///     |dx| + sum over j of (rotation_j |d(w_j (x - pivot_j))| + shift_j |dw_j|),
/// where |D_j x - x| <= rotation_j |x - pivot_j| + shift_j in all poses; each morph target adds |d delta| and
/// rotation_j |d(w_j delta)| times its largest weight. It is convex along straight lines on both surfaces.
class DeformationMetric
{
public:
    /// center, scale  of the surfaces' places: object = center + scale * place
    DeformationMetric(Double3 center, double scale, const MeshMotion& motion);

    /// A joint against which the motion of all joints of these triangles has a bound: of those of the point's triangle that
    /// have one the one with the most weight there, else any of the skin; nothing where there is none.
    std::optional<uint32_t> mainJoint(const DeformedPoint& point, std::span<const DeformedPoint> others);

    /// In units of the places, for a scale of 1 of the main joint's transform. All joints of both points have a bound
    /// against the main joint.
    double between(const DeformedPoint& a, const DeformedPoint& b, uint32_t main);

private:
    /// motion::Departure in units of the places.
    struct Departure
    {
        enum class State : uint8_t
        {
            unknown,
            bounded,
            unbounded,
        };
        State state = State::unknown;
        Double3 pivot;
        double rotation = 0;
        double shift = 0;
    };

    const Departure& departure(uint32_t main, uint32_t joint);
    double morphTerm(const DeformedPoint& a, const DeformedPoint& b, uint32_t main);

    Double3 center_;
    double scale_;
    const MeshMotion& motion_;
    std::unordered_map<uint32_t, std::vector<Departure>> departures_; ///< by main joint, then joint
};

} // namespace hearth::clusters
