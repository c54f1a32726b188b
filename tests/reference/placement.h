// Where a pose puts the vertices of a pack's instances, written out from glTF 2.0, 3.7.3.3: nothing is shared with the
// runtime but what a pose is (formats/scene/animation.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/scene/animation.h"
#include "tests/reference/double3.h"
#include "tests/reference/pack_geometry.h"

#include <vector>

namespace hearth::reference
{

/// In the world.
struct PlacedVertex
{
    Double3 position;
    Double3 normal;        ///< on the front side, of any length; 0 where the mesh has none
    Double3 tangent;       ///< of any length; 0 where the mesh has none
    bool mirrored = false; ///< here triangles turn the other way round
};

class Placement
{
public:
    /// pose  of the pack; null: at rest. The geometry must outlive the placement, the pose need not.
    explicit Placement(const PackGeometry& geometry, const formats::ScenePose* pose = nullptr);

    const PackGeometry& geometry() const { return *geometry_; }
    bool isDeformed(uint32_t instance) const { return !instances_[instance].palette.empty(); }

    /// Of an instance that is not deformed.
    const Affine3d& worldFromObject(uint32_t instance) const
    {
        return instances_[instance].world_from_object;
    }

    PlacedVertex vertex(uint32_t instance, const formats::ClusterGeometry& cluster, uint32_t vertex) const;

private:
    struct Instance
    {
        Affine3d world_from_object;
        std::vector<Affine3d> palette;
        std::vector<double> morph_weights;
    };
    const PackGeometry* geometry_;
    std::vector<Instance> instances_;
};

} // namespace hearth::reference
