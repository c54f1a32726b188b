// The opaque triangles of a cut, in voxels, as Embree sees them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "formats/base/result.h"

#include <memory>
#include <optional>

namespace hearth::bricks
{

/// Built once, then read from many threads. Places and distances are in voxels of the frame.
class RayScene
{
public:
    struct Hit
    {
        Float3 place;
        Float3 normal; ///< unit, of the triangle, towards where the ray came from
    };

    /// Of clusters whose materials have no holes. Both faces of a triangle stop rays.
    /// errors: those of decoding pages
    static Result<RayScene> build(const StaticScene& scene, std::span<const PlacedCluster> placed,
                                  const GridFrame& frame);

    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;
    ~RayScene();

    std::optional<Hit> nearest(Float3 place, Float3 direction) const;
    bool occluded(Float3 place, Float3 direction, float far) const;

    /// Whether clusters were left out, for the holes in their materials.
    bool hasHoles() const;

private:
    struct State;
    explicit RayScene(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace hearth::bricks
