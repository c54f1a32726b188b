// Computes the light of lamps and shining triangles that arrives at a point without a bounce.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/ray_scene/triangle_rays.h"
#include "cook/receivers/bake/bake_scene.h"

namespace hearth::receivers
{

inline constexpr uint32_t kSphereRays = 16;    ///< shadow rays to a lamp with a radius
inline constexpr uint32_t kMeshLightRays = 32; ///< of a bake: shadow rays to a mesh light, at least

/// Place from which a surface receives light.
struct ReceivingPoint
{
    Float3 position; ///< off the surface by the length of BakeRays::offset
    Float3 normal;   ///< unit, of the smooth surface
    Float3 side;     ///< unit, of the triangle: only light from this side arrives
};

/// Rays of a scene, and the length by which they keep off its surfaces.
struct BakeRays
{
    ray_scene::TriangleRays triangles;
    float offset = 0; ///< metres
};

/// Build the rays of a scene.
BakeRays makeBakeRays(const BakeScene& scene);

/// Return the irradiance of a lamp without shadows: I cos / d^2 by its range and cone as glTF has them, or
/// lux times cos. A lamp does not light what is nearer than shared::kBrickLampRadius, or than its radius.
Float3 unshadowedLight(const Lamp& lamp, const ReceivingPoint& at);

/// Lights of a scene, prepared for sampling. The scene and its rays must outlive it. Use from many threads.
class DirectLight
{
public:
    /// mesh_light_rays  shadow rays to a mesh light, at least; 1 or more
    DirectLight(const BakeScene& scene, const BakeRays& rays, uint32_t mesh_light_rays = kMeshLightRays);

    /// Return the irradiance that a light of the scene causes.
    /// seed       of the point
    /// ray_count  is increased by the shadow rays
    Float3 at(size_t light, const ReceivingPoint& point, uint64_t seed, uint64_t& ray_count) const;

    /// Return the share of the light of a mesh light that `at` leaves out, for paths that meet its triangles:
    /// near ones would be noise where few rays stand for many triangles.
    /// number    of the mesh light
    /// radiance  of a triangle, not black
    /// distance  from the triangle to the point
    float missingShare(size_t number, Float3 radiance, float distance) const;

private:
    struct Source
    {
        std::vector<double> powers; ///< area times luminance of the triangles up to each
    };

    Float3 fromLamp(const Lamp& lamp, const ReceivingPoint& point, uint64_t seed, uint64_t& ray_count) const;
    Float3 fromFewTriangles(const MeshLight& light, const ReceivingPoint& point, uint64_t seed,
                            uint64_t& ray_count) const;
    Float3 fromManyTriangles(const MeshLight& light, const Source& source, const ReceivingPoint& point,
                             uint64_t seed, uint64_t& ray_count) const;
    bool sees(const ReceivingPoint& point, Float3 target) const;
    /// The same of a point of a triangle: the ray ends off it.
    bool sees(const ReceivingPoint& point, const Triangle& triangle, Float3 target) const;

    const BakeScene& scene_;
    const BakeRays& rays_;
    uint32_t mesh_light_rays_;
    std::vector<Source> sources_; ///< of mesh lights
};

} // namespace hearth::receivers
