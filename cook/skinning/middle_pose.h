// A deformed cluster as one joint sees it: a pose in the middle of all, and how far all others are from it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"

#include <optional>

namespace hearth::skinning
{

class MiddlePose
{
public:
    /// In joint `main`; nothing where a joint that moves the cluster has no bounds there.
    /// cluster, vertices  outlive it
    static std::optional<MiddlePose> in(uint32_t main, const DeformedCluster& cluster,
                                        const Deformation& deformation,
                                        std::span<const MorphedVertex> vertices);

    Double3 place(size_t vertex) const { return places_[vertex]; }

    /// How far at most a vertex comes from its place.
    double slack(size_t vertex) const;

    /// How far at most the edge between two vertices comes from that between their places: what both do alike does not
    /// count.
    double edgeSlack(size_t a, size_t b) const;

private:
    struct Part
    {
        uint32_t joint;
        const motion::JointMotion* motion;
    };

    MiddlePose(const DeformedCluster& cluster, std::span<const MorphedVertex> vertices)
        : cluster_(&cluster), vertices_(vertices)
    {
    }
    /// False where the joint has no bounds.
    bool addPart(const Deformation& deformation, uint32_t main, uint32_t joint);
    void addPlace(size_t vertex, double own_weight);

    const DeformedCluster* cluster_;
    std::span<const MorphedVertex> vertices_;
    std::vector<Part> parts_;
    std::vector<Double3> places_;
    std::vector<double> morph_slack_;
};

} // namespace hearth::skinning
