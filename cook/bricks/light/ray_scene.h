// Embree scene of the opaque triangles of a LOD cut, in voxel coordinates.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "formats/base/result.h"

#include <memory>
#include <optional>

namespace hearth::bricks
{

/// Ray tracing scene. Build once, then use from many threads. Positions and distances are in voxels of the
/// frame.
class RayScene
{
public:
    struct Hit
    {
        Float3 position;
        Float3 normal; ///< unit, of the triangle, on the side of the ray's origin
        uint32_t triangle;
    };

    /// Build from the clusters whose materials have no holes. Triangles block rays from both sides.
    /// errors: errors of decoding pages
    static Result<RayScene> build(const StaticScene& scene, std::span<const InstancedCluster> placed,
                                  const GridFrame& frame);

    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;
    ~RayScene();

    std::optional<Hit> nearest(Float3 position, Float3 direction) const;
    bool occluded(Float3 position, Float3 direction, float far) const;

    /// Return the mean base colour of the material of a hit.
    Float3 albedo(const Hit& hit) const;

    /// True if clusters were excluded because their materials have holes.
    bool hasHoles() const;

private:
    struct State;
    explicit RayScene(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace hearth::bricks
