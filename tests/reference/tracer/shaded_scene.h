// The finest level of a pack with its materials, lights and sky, as rays see it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/embree_scene.h"
#include "tests/reference/tracer/gltf_material.h"
#include "tests/reference/tracer/scene_lighting.h"
#include "tests/reference/tracer/texture_lookup.h"

namespace hearth::reference
{

/// Where a ray meets a surface, ready to be shaded.
struct ShadedPoint
{
    SurfaceHit hit;
    SurfacePoint surface;
    Coating coating;
    bool unlit = false; ///< its colour is coating.base
};

class ShadedScene
{
public:
    /// What is named must outlive the scene; the pose need not.
    ShadedScene(const PackGeometry& geometry, const TextureSet& textures, const formats::ScenePose* pose);

    const SceneLighting& lighting() const { return lighting_; }

    /// sample_angle  side of what the ray stands for at a distance of one metre: textures are filtered so far
    std::optional<ShadedPoint> nearest(const Ray& ray, double sample_angle) const;

    /// Whether light is held off along the ray: both faces do, unlit surfaces, which are skies and signs, do not.
    bool occluded(const Ray& ray) const { return rays_.occluded(ray); }

private:
    const formats::MaterialRecord& materialOf(const SurfaceHit& hit) const;
    Rgba look(const formats::TextureRef& texture, const SurfacePoint& point, double sample_size) const;
    bool isThere(const SurfaceHit& hit) const;
    bool blocks(const SurfaceHit& hit) const;
    bool isHole(const SurfaceHit& hit) const;
    Coating coatingAt(const SurfaceHit& hit, const SurfacePoint& point, double sample_size) const;

    const PackGeometry& geometry_;
    const TextureSet& textures_;
    SceneLighting lighting_;
    Placement placement_;
    EmbreeScene rays_;
};

/// A place just off the surface on the side that is seen.
Double3 lifted(const ShadedPoint& point);

/// A direction of the hemisphere about a normal, in proportion to the cosine; (u, v) in [0, 1)^2.
Double3 cosineDirection(Double3 normal, double u, double v);

} // namespace hearth::reference
