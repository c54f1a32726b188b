// Places the vertices of a pack's instances in a pose, written from glTF 2.0, 3.7.3.3. Shares nothing with
// the runtime except the definition of a pose (formats/scene/animation.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/scene/animation.h"
#include "tests/reference/double3.h"
#include "tests/reference/pack_geometry.h"

#include <vector>

namespace hearth::reference
{

/// A vertex in world space.
struct PlacedVertex
{
    Double3 position;
    Double3 normal;        ///< on the front side, of any length; 0 where the mesh has none
    Double3 tangent;       ///< of any length; 0 where the mesh has none
    bool mirrored = false; ///< the transform reverses the winding of triangles
};

class Placement
{
public:
    /// pose  of the pack; null: rest pose. The geometry must outlive the placement, the pose need not.
    explicit Placement(const PackGeometry& geometry, const formats::ScenePose* pose = nullptr);

    const PackGeometry& geometry() const { return *geometry_; }
    bool isDeformed(uint32_t instance) const { return !instances_[instance].palette.empty(); }

    /// Transform of an instance that is not deformed.
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
