// Finest level of a pack with materials, lights and sky, as rays see it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/embree_scene.h"
#include "tests/reference/tracer/gltf_material.h"
#include "tests/reference/tracer/scene_lighting.h"
#include "tests/reference/tracer/texture_lookup.h"

namespace hearth::reference
{

/// Side of what a sample covers on a slanted surface by which mips are chosen.
enum class TextureFilter
{
    anisotropic, ///< the shorter one; what lies along the longer one is left to more rays
    isotropic,   ///< the longer one, as devices do without anisotropic filtering
};

/// Ray hit on a surface, ready for shading.
struct ShadedPoint
{
    SurfaceHit hit;
    SurfacePoint surface;
    Coating coating;
    bool unlit = false; ///< the colour is coating.base
};

class ShadedScene
{
public:
    /// All arguments must outlive the scene, except the pose.
    ShadedScene(const PackGeometry& geometry, const TextureSet& textures, const formats::ScenePose* pose);

    const SceneLighting& lighting() const { return lighting_; }
    /// Replace the lights, exposure and sky of the pack.
    void setLighting(SceneLighting lighting) { lighting_ = std::move(lighting); }
    const Placement& placement() const { return placement_; }
    const formats::MaterialRecord& getMaterial(const SurfaceHit& hit) const;

    /// sample_angle  side of the ray's footprint at a distance of one metre, for texture filtering
    std::optional<ShadedPoint> nearest(const Ray& ray, double sample_angle,
                                       TextureFilter filter = TextureFilter::anisotropic) const;

    /// True if light is blocked along the ray. Both faces block; unlit surfaces (skies and signs) do not.
    bool occluded(const Ray& ray) const { return rays_.occluded(ray); }

    /// True if something shadows a light. Surfaces within 5 cm of a lamp count as a part of it, as in the
    /// renderer's maps: flames and bulbs hold their lamp.
    bool shadowed(Double3 start, const Incident& light) const;

private:
    formats::MaterialLayersRecord getLayers(const SurfaceHit& hit) const;
    Rgba look(const formats::TextureRef& texture, const SurfacePoint& point, double sample_size) const;
    bool isThere(const SurfaceHit& hit) const;
    bool blocks(const SurfaceHit& hit) const;
    bool isHole(const SurfaceHit& hit) const;
    Coating coatingAt(const SurfaceHit& hit, const SurfacePoint& point, double sample_size) const;
    Double3 mappedNormal(const formats::TextureRef& map, float scale, const SurfacePoint& point,
                         double sample_size) const;
    void addLayers(const SurfaceHit& hit, const SurfacePoint& point, double sample_size, Coating& c) const;

    const PackGeometry& geometry_;
    const TextureSet& textures_;
    SceneLighting lighting_;
    Placement placement_;
    EmbreeScene rays_;
};

/// Point just off the surface on the visible side.
Double3 lifted(const ShadedPoint& point);

/// Direction in the hemisphere about a normal, cosine-distributed; (u, v) in [0, 1)^2.
Double3 cosineDirection(Double3 normal, double u, double v);

} // namespace hearth::reference
