// Bounds distances between points of two surfaces over all poses of a deformed mesh. See
// cook/clusters/README.md, "Deformed meshes".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/index_types.h"
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

/// Deformation data of the wedges of one surface.
class DeformedSurface
{
public:
    struct Influence
    {
        uint16_t joint;
        double weight;
    };

    /// Append a wedge.
    /// place   position in units of `scale`
    /// source  its vertex `vertex` has the joints, weights and morph deltas
    void add(Float3 place, const mesh::SourceMesh& source, uint32_t vertex, double scale);

    Double3 place(WedgeId wedge) const { return places_[wedge]; }
    std::span<const Influence> influences(WedgeId wedge) const
    {
        const uint32_t w = toIndex(wedge);
        return std::span(influences_)
            .subspan(first_influence_[w], first_influence_[w + 1] - first_influence_[w]);
    }
    std::span<const Double3> deltas(WedgeId wedge) const
    {
        return std::span(deltas_).subspan(toIndex(wedge) * delta_count_, delta_count_);
    }

private:
    IdVector<WedgeId, Double3> places_;
    std::vector<Influence> influences_;
    std::vector<size_t> first_influence_{0};
    std::vector<Double3> deltas_; ///< for each wedge, one for each target
    size_t delta_count_ = 0;
};

/// Point of a surface: barycentric coordinates in a triangle of three wedges.
struct DeformedPoint
{
    const DeformedSurface* surface;
    std::array<WedgeId, 3> wedges;
    std::array<double, 3> parts; ///< sum to 1
};

/// Bounds distances over all poses; caches the joint motions that it has queried.
///
/// A skinned point is the sum over joints of M_j h_j with h_j = w_j (x, 1), so it is linear in the data of
/// the vertices. With D_j = M_b^-1 M_j for a main joint b, two points differ by at most the norm of M_b times
/// |dx| + sum over j of (rotation_j |d(w_j (x - pivot_j))| + shift_j |dw_j|), where |D_j x - x| <= rotation_j
/// |x - pivot_j| + shift_j in all poses. Each morph target adds |d delta| and rotation_j |d(w_j delta)| times
/// its largest weight. The bound is convex along straight lines on both surfaces.
class DeformationMetric
{
public:
    /// center, scale  of the surfaces' local positions: object = center + scale * local
    DeformationMetric(Double3 center, double scale, const MeshMotion& motion);

    /// Find a joint relative to which the motion of all joints of these triangles is bounded: among those of
    /// the point's triangle the one with the most weight there, else any of the skin; nothing if there is
    /// none.
    std::optional<uint32_t> mainJoint(const DeformedPoint& point, std::span<const DeformedPoint> others);

    /// Return the bound of the distance in local units, for a scale of 1 of the main joint's transform. All
    /// joints of both points must be bounded relative to the main joint.
    double between(const DeformedPoint& a, const DeformedPoint& b, uint32_t main);

private:
    /// animation_bounds::IdentityDeviation in local units.
    struct IdentityDeviation
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

    const IdentityDeviation& departure(uint32_t main, uint32_t joint);
    double morphTerm(const DeformedPoint& a, const DeformedPoint& b, uint32_t main);

    Double3 center_;
    double scale_;
    const MeshMotion& motion_;
    std::unordered_map<uint32_t, std::vector<IdentityDeviation>> departures_; ///< by main joint, then joint
};

} // namespace hearth::clusters
