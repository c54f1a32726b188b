// Bounds of the positions of a cluster's vertices while poses stay in a region.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/four.h"
#include "cook/animation_bounds/region_chain.h"
#include "cook/skinning/deformed_cluster.h"

namespace hearth::skinning
{

/// Vertex with the axes along which it may leave the box of the sampled poses, a bit each.
struct ActiveVertex
{
    uint16_t vertex;
    uint8_t axes;

    bool isActive(size_t axis) const { return (axes >> axis & 1) != 0; }
};
using ActiveVertices = std::vector<ActiveVertex>;

/// Joints that move some of the vertices, besides the main bone, and the way there.
struct Movers
{
    std::vector<uint32_t> joints; ///< indices into the joints of the RegionPositions
    std::vector<uint32_t> links;  ///< of its chain
    std::vector<uint32_t> nodes;  ///< of the links
};

/// Positions of a cluster's vertices in the space of joint `main`.
class RegionPositions
{
public:
    /// cluster, vertices  are not needed afterwards
    RegionPositions(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
                    std::span<const MorphedVertex> vertices);

    /// Find what moves some of the vertices.
    void findMovers(std::span<const ActiveVertex> vertices, Movers& movers) const;

    /// Return the work of bounding all vertices.
    size_t fullWork() const;

    /// Return all vertices, active along all axes.
    ActiveVertices all() const;

    /// Add the positions of the vertices in the middle of a region to `sampled`.
    void addMiddle(const animation_bounds::PoseRegion& region, animation_bounds::Box3d& sampled);

    /// Compute one box for each vertex over a region, empty along axes that are not active; false if there
    /// are no bounds.
    /// movers   result of findMovers for these vertices
    /// sampled  grows by positions that vertices certainly have in some pose
    /// work     grows by the work done
    bool place(const animation_bounds::PoseRegion& region, std::span<const ActiveVertex> vertices,
               const Movers& movers, animation_bounds::Box3d& sampled,
               std::vector<animation_bounds::Box3d>& boxes, size_t& work);

private:
    /// Joint that moves a vertex besides the main bone.
    struct Influence
    {
        std::array<double, 4> point; ///< position of the vertex in the joint's space, and 1, times the weight
        double distance = 0;         ///< of the vertex from the pivot of the joint's motion
        uint32_t joint;              ///< index into joints_
    };
    /// Contribution of the main bone to a vertex.
    struct MainBoneTerm
    {
        std::array<double, 3> place;
        double slack; ///< of morph targets
        size_t first; ///< index of its first influence
        size_t end;
    };

    /// Polynomial of a coordinate: its terms, and zeros.
    using Polynomial = std::array<animation_bounds::Four, 3>;
    static_assert(sizeof(Polynomial) >= animation_bounds::kTerms * sizeof(double));

    /// Transform from a joint to the main bone's bind space.
    struct Motion
    {
        std::array<std::array<Polynomial, 4>, 3> elements; ///< of the affine transform
        double linear_slack; ///< distance from the polynomials, by distance from the pivot
        double point_slack;
    };

    struct Kernels;

    void addVertex(uint32_t main, const DeformedCluster& cluster, const MorphedVertex& vertex, size_t v);
    void setPivot(uint32_t joint, Double3 pivot);

    const animation_bounds::PoseRegions& regions_;
    const animation_bounds::SkinMotion& skin_;
    uint32_t main_;
    std::vector<uint32_t> joints_;
    animation_bounds::RegionChain chain_;
    double bind_norm_;
    std::vector<Influence> influences_;
    std::vector<Double3> places_; ///< of the vertices in the joints' spaces, by influence
    std::vector<MainBoneTerm> main_bone_terms_;
    std::vector<std::vector<uint32_t>> influences_of_joints_; ///< by index into joints_
    std::vector<Double3> pivots_;                             ///< by index into joints_
    std::vector<uint64_t> joint_sets_;                        ///< of vertices, joint_set_words_ each
    size_t joint_set_words_;
    std::vector<animation_bounds::TransformModel> models_; ///< by link
    std::vector<Motion> motions_;                          ///< by index into joints_
    std::vector<double> slacks_;                           ///< of the active vertices
    std::vector<Affine3d> middles_;
};

} // namespace hearth::skinning
