// What the joints of a skin can do to each other in all poses: the transforms between their bind spaces.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/node_motion.h"
#include "cook/animation_bounds/region_chain.h"

#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

namespace hearth::motion
{

/// What joint j does as the main bone b sees it: D = (palette[b])^-1 palette[j], from the bind pose to the bind pose as b
/// carries it. All poses of all clips and their blends are in the set.
class JointMotion
{
public:
    explicit JointMotion(MatrixSet set);

    const MatrixSet& set() const { return set_; }
    const MatrixBall& ball() const { return ball_; }

    /// Add `weight` times the box of where a point can come.
    /// half  the point may be this far away, axis by axis
    void addPlaces(Double3 point, Double3 half, double weight, Box3d& box) const;

private:
    using Lanes = double __attribute__((vector_size(2 * sizeof(double))));
    /// The same row of two matrices: a point comes to x * p.x + y * p.y + z * p.z + w.
    struct RowPair
    {
        Lanes x, y, z, w;
    };

    MatrixSet set_;
    MatrixBall ball_;
    std::array<std::vector<RowPair>, 3> rows_; ///< by axis
};

/// The motion of one skin. Any number of threads may ask at once. Two joints that are asked for the first time cost
/// about a tenth of a millisecond, later nothing.
class SkinMotion
{
public:
    /// reach  for each joint a box of the points, in the bind pose, that it moves: bounds are tightest for them; empty
    ///        where it moves none
    SkinMotion(const formats::MotionTables& tables, std::span<const NodeMotion> nodes, uint32_t skin,
               std::span<const Box3d> reach);

    uint32_t jointCount() const { return static_cast<uint32_t>(joints_.size()); }

    /// Null where the motion has no bound: where `main`, or a node between it and what both hang on, can be scaled to
    /// 0, or its inverse bind matrix has no inverse.
    const JointMotion* relative(uint32_t main, uint32_t joint) const;

    const Affine3d& jointFromBind(uint32_t joint) const { return joints_[joint].joint_from_bind; }
    /// Nothing where the inverse bind matrix has no inverse.
    const std::optional<Affine3d>& bindFromJoint(uint32_t joint) const
    {
        return joints_[joint].bind_from_joint;
    }

    /// The nodes between a main bone and other joints.
    RegionChain regionChain(uint32_t main, std::span<const uint32_t> joints) const;

    /// Whether the joint can turn triangles inside out, or make them flat.
    bool canMirror(uint32_t joint) const;

    /// How far the transform of the joint's motion relative to `main` is from doing nothing. Null as above.
    std::optional<Departure> departure(uint32_t main, uint32_t joint) const;

private:
    struct Joint
    {
        Affine3d joint_from_bind;
        std::optional<Affine3d> bind_from_joint; ///< nothing where it is flat
        std::vector<uint32_t> nodes;             ///< its own first, then its ancestors
        Box3d reach;
    };
    /// A node on the way from one joint to another, and whether the way goes down to it.
    struct Step
    {
        uint32_t node;
        bool down;
    };
    struct Entry
    {
        std::once_flag once;
        std::unique_ptr<JointMotion> motion;
    };

    std::optional<std::vector<Step>> way(uint32_t main, uint32_t joint) const;
    std::vector<Tolerance> tolerances(std::span<const Step> steps, uint32_t main, uint32_t joint) const;
    std::unique_ptr<JointMotion> measured(uint32_t main, uint32_t joint) const;
    Entry& entry(uint32_t main, uint32_t joint) const;

    std::span<const formats::NodeRecord> records_;
    std::span<const NodeMotion> nodes_;
    std::vector<Affine3d> parent_from_node_; ///< at rest
    std::vector<Joint> joints_;
    mutable std::mutex mutex_;
    mutable std::unordered_map<uint64_t, Entry> entries_; ///< under the mutex; entries stay where they are
};

} // namespace hearth::motion
