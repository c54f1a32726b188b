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
        bool is_front;
    };

    enum class Normals
    {
        flat,
        smooth, ///< those of the vertices, too: smoothNormal
    };

    /// Build from the clusters whose materials have no holes. Triangles block rays from both sides.
    /// errors: errors of decoding pages
    static Result<RayScene> build(const StaticScene& scene, std::span<const InstancedCluster> placed,
                                  const GridFrame& frame, Normals normals = Normals::flat);

    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;
    ~RayScene();

    std::optional<Hit> nearest(Float3 position, Float3 direction) const;
    bool occluded(Float3 position, Float3 direction, float far) const;

    struct SurfacePoint
    {
        Float3 position;
        Float3 normal; ///< unit, of the front
    };

    /// Return points on the triangles, even in area: at most `count`, none without triangles.
    std::vector<SurfacePoint> sampleSurface(uint32_t count) const;

    /// Return the normal of a hit between those of the vertices, unit, on the side of the hit's normal. The
    /// hit's normal where the vertices have none. Only with smooth normals.
    Float3 smoothNormal(const Hit& hit) const;

    /// Return the mean albedo of the material of a hit.
    Float3 albedo(const Hit& hit) const;
    /// Return the material of a hit, which is the scene's.
    const SurfaceMaterial& material(const Hit& hit) const;

private:
    struct State;
    explicit RayScene(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace hearth::bricks
