// Positions of a deformed cluster in a middle pose, relative to a joint, with the maximum distance of all
// other poses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"

#include <optional>

namespace hearth::skinning
{

/// Middle pose of a cluster in the space of a joint, with error bounds.
class MiddlePose
{
public:
    /// Compute the pose in joint `main`; nothing if a joint that moves the cluster has no bounds there.
    /// cluster, vertices  must outlive it
    static std::optional<MiddlePose> in(uint32_t main, const DeformedCluster& cluster,
                                        const Deformation& deformation,
                                        std::span<const MorphedVertex> vertices);

    /// Return the position of a vertex in the middle pose.
    Double3 place(size_t vertex) const { return places_[vertex]; }

    /// Return the maximum distance of a vertex from its middle position over all poses.
    double slack(size_t vertex) const;

    /// Return the maximum change of the edge vector between two vertices over all poses. Motion that is
    /// common to both does not count.
    double edgeSlack(size_t a, size_t b) const;

private:
    struct Part
    {
        uint32_t joint;
        const animation_bounds::JointMotion* motion;
    };

    MiddlePose(const DeformedCluster& cluster, std::span<const MorphedVertex> vertices)
        : cluster_(&cluster), vertices_(vertices)
    {
    }
    /// Add a joint. False if it has no bounds.
    bool addPart(const Deformation& deformation, uint32_t main, uint32_t joint);
    void addPosition(size_t vertex, double own_weight);

    const DeformedCluster* cluster_;
    std::span<const MorphedVertex> vertices_;
    std::vector<Part> parts_;
    std::vector<Double3> places_;
    std::vector<double> morph_slack_;
};

} // namespace hearth::skinning
