// Surfaces of a scene as rays meet them, with their textures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "cook/receivers/bake/direct_light.h"

#include <optional>

namespace hearth::reflections
{

struct SurfaceHit
{
    Float3 position; ///< off the surface by BakeRays::offset, on the side of the ray
    Float3 side;     ///< unit, of the triangle, on the side of the ray
    Float3 normal;   ///< unit, of the smooth surface, on the same side
    uint32_t triangle = 0;
    Float2 weights; ///< of corners 1 and 2
    float distance = 0;
    bool is_black = false; ///< the back of a surface that has none
};

/// Finest triangles of a scene. Those with holes are left out: they neither block nor reflect light.
/// Use from many threads. The scene must outlive it.
class Surfaces
{
public:
    /// errors: errors of decoding pages
    static Result<Surfaces> read(const bricks::StaticScene& scene);

    /// direction  unit
    std::optional<SurfaceHit> nearest(Float3 position, Float3 direction) const;

    /// Return albedo and emission, before exposure, of a hit.
    /// footprint  metres, for the mip of textures
    bricks::SurfaceSample sample(const SurfaceHit& hit, float footprint) const;

    const receivers::BakeRays& rays() const { return rays_; }
    size_t triangleCount() const { return attributes_.size(); }
    Box3 box() const;

    /// Return the triangles that shine, as one light of a bake's scene, with radiance times `exposure`.
    /// triangles  are appended
    receivers::MeshLight listEmission(float exposure, std::vector<receivers::Triangle>& triangles) const;

    /// Return the first error of the textures that were read.
    Status status() const;

private:
    struct Attributes
    {
        const bricks::SurfaceMaterial* material;
        bricks::TriangleAttributes values;
        std::array<Float3, 3> normals;
    };

    std::vector<Attributes> attributes_;
    receivers::BakeRays rays_{ray_scene::TriangleRays({}), 0};
};

} // namespace hearth::reflections
