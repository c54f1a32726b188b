// Bounds the relative motion of a skin's joints in all poses: the transforms between their bind spaces.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/node_motion.h"
#include "cook/animation_bounds/region_chain.h"

#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

namespace hearth::animation_bounds
{

/// Motion of joint j relative to the main bone b: D = (palette[b])^-1 palette[j], from the bind pose to the
/// bind pose as carried by b. The set contains all poses of all clips and their blends.
class JointMotion
{
public:
    explicit JointMotion(MatrixSet set);

    const MatrixSet& set() const { return set_; }
    const MatrixBall& ball() const { return ball_; }

    /// Return upper bounds for the absolute values of the elements of the linear part minus the unit matrix.
    const Matrix3& deviation() const { return deviation_; }

    /// Add `weight` times the box of all positions that a point can have.
    /// half  half size of the box around the point, axis by axis; 0 for a point alone
    void addPositionBox(Double3 point, Double3 half, double weight, Box3d& box) const;

private:
    using Lanes = double __attribute__((vector_size(2 * sizeof(double))));
    /// Same row of two matrices: a point's coordinate is x * p.x + y * p.y + z * p.z + w.
    struct RowPair
    {
        Lanes x, y, z, w;
    };

    MatrixSet set_;
    MatrixBall ball_;
    Matrix3 deviation_{};
    std::array<std::vector<RowPair>, 3> rows_; ///< by axis
};

/// Relative motion of all joints of one skin. Thread-safe. The first request for two joints costs about a
/// tenth of a millisecond; later requests cost nothing.
class SkinMotion
{
public:
    /// Construct from a scene's motion.
    /// reach  for each joint the box of the points, in the bind pose, that it moves: bounds are tightest for
    ///        these; empty where it moves none
    SkinMotion(const formats::AnimationTables& tables, std::span<const NodeMotion> nodes, uint32_t skin,
               std::span<const Box3d> reach);

    uint32_t jointCount() const { return static_cast<uint32_t>(joints_.size()); }

    /// Return the motion of a joint relative to `main`. Null where the motion has no bound: `main`, or a node
    /// between it and the common ancestor, can be scaled to 0, or its inverse bind matrix has no inverse.
    const JointMotion* relative(uint32_t main, uint32_t joint) const;

    const Affine3d& jointFromBind(uint32_t joint) const { return joints_[joint].joint_from_bind; }
    /// Return the inverse of jointFromBind; nothing where the inverse bind matrix has no inverse.
    const std::optional<Affine3d>& bindFromJoint(uint32_t joint) const
    {
        return joints_[joint].bind_from_joint;
    }

    /// Return the nodes between a main bone and other joints.
    RegionChain regionChain(uint32_t main, std::span<const uint32_t> joints) const;

    /// True if the joint can turn triangles inside out, or flatten them.
    bool canMirror(uint32_t joint) const;

    /// Return the distance from the identity of the joint's motion relative to `main`. Nothing where
    /// relative() is null.
    std::optional<IdentityDeviation> departure(uint32_t main, uint32_t joint) const;

private:
    struct Joint
    {
        Affine3d joint_from_bind;
        std::optional<Affine3d> bind_from_joint; ///< nothing if the matrix is singular
        std::vector<uint32_t> nodes;             ///< its own node first, then the ancestors
        Box3d reach;
    };
    /// Node on the path from one joint to another, and the direction of the path at it.
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

    std::optional<std::vector<Step>> pathBetween(uint32_t main, uint32_t joint) const;
    std::vector<Tolerance> tolerances(std::span<const Step> steps, uint32_t main, uint32_t joint) const;
    std::unique_ptr<JointMotion> computeMotion(uint32_t main, uint32_t joint) const;
    Entry& entry(uint32_t main, uint32_t joint) const;

    std::span<const formats::NodeRecord> records_;
    std::span<const NodeMotion> nodes_;
    std::vector<Affine3d> parent_from_node_; ///< rest pose
    std::vector<Joint> joints_;
    mutable std::mutex mutex_;
    /// guarded by the mutex; addresses of entries are stable
    mutable std::unordered_map<uint64_t, Entry> entries_;
};

} // namespace hearth::animation_bounds
