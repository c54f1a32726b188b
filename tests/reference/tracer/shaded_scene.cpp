// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/shaded_scene.h"

#include <algorithm>

namespace hearth::reference
{

using namespace formats;

namespace
{

constexpr double kPi = 3.14159265358979323846;

/// glTF's default material.
MaterialRecord defaultMaterial()
{
    MaterialRecord material{};
    material.base_color = {1, 1, 1, 1};
    material.metallic = material.roughness = material.normal_scale = 1;
    for (TextureRef* texture :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture})
        texture->image = kInvalidIndex;
    return material;
}

} // namespace

ShadedScene::ShadedScene(const PackGeometry& geometry, const TextureSet& textures, const ScenePose* pose)
    : geometry_(geometry),
      textures_(textures),
      lighting_(readLighting(geometry.view())),
      placement_(geometry, pose),
      rays_(
          placement_, [this](const SurfaceHit& hit) { return isThere(hit); },
          [this](const SurfaceHit& hit) { return blocks(hit); })
{
}

std::optional<ShadedPoint> ShadedScene::nearest(const Ray& ray, double sample_angle,
                                                TextureFilter filter) const
{
    const auto hit = rays_.nearest(ray);
    if (!hit)
        return std::nullopt;
    const MaterialRecord& material = getMaterial(*hit);
    const MaterialLayersRecord layers = getLayers(*hit);
    const TextureRef& normals = material.normal_texture.image != kInvalidIndex
                                    ? material.normal_texture
                                    : layers.clearcoat_normal_texture;
    ShadedPoint point{*hit, surfaceAt(placement_, *hit, normals.uv_set), {}, false};
    const double slant = std::abs(dot(point.surface.geometric_normal, ray.direction));
    const double sample_size =
        hit->distance * sample_angle / (filter == TextureFilter::isotropic ? std::max(slant, 1e-3) : 1);
    point.coating = coatingAt(*hit, point.surface, sample_size);
    point.unlit = (material.flags & kMaterialUnlit) != 0;
    return point;
}

const MaterialRecord& ShadedScene::getMaterial(const SurfaceHit& hit) const
{
    static const MaterialRecord otherwise = defaultMaterial();
    const uint32_t material = geometry_.view().clusters()[hit.cluster].material;
    return material == kInvalidIndex ? otherwise : geometry_.view().materials()[material];
}

MaterialLayersRecord ShadedScene::getLayers(const SurfaceHit& hit) const
{
    const uint32_t material = geometry_.view().clusters()[hit.cluster].material;
    for (const MaterialLayersRecord& layers : geometry_.view().materialLayers())
        if (layers.material == material)
            return layers;
    return neutralLayers(material);
}

bool ShadedScene::shadowed(Double3 start, const Incident& light) const
{
    constexpr double kLampRadius = 0.05;
    constexpr double kFar = 1e30;
    return light.casts_shadows && light.distance > kLampRadius &&
           occluded({start, light.to_light, 0, std::min(light.distance - kLampRadius, kFar)});
}

Rgba ShadedScene::look(const TextureRef& texture, const SurfacePoint& point, double sample_size) const
{
    return textures_.sample(texture, point.uv[texture.uv_set],
                            sample_size * point.uv_per_metre[texture.uv_set]);
}

/// True unless the hit is a back face of a single-sided material or a hole of a mask.
bool ShadedScene::isThere(const SurfaceHit& hit) const
{
    return (hit.front || (getMaterial(hit).flags & kMaterialDoubleSided) != 0) && !isHole(hit);
}

bool ShadedScene::blocks(const SurfaceHit& hit) const
{
    return (getMaterial(hit).flags & kMaterialUnlit) == 0 && !isHole(hit);
}

/// True in holes. A blended surface exists where its alpha exceeds one half: blending has no reference of its
/// own.
bool ShadedScene::isHole(const SurfaceHit& hit) const
{
    const MaterialRecord& material = getMaterial(hit);
    if (material.alpha_mode == static_cast<uint32_t>(AlphaMode::opaque))
        return false;
    const SurfacePoint point = surfaceAt(placement_, hit, 0);
    const double alpha = double{material.base_color.w} * double{point.color.w} *
                         look(material.base_color_texture, point, 0).alpha;
    const bool mask = material.alpha_mode == static_cast<uint32_t>(AlphaMode::mask);
    return alpha < (mask ? double{material.alpha_cutoff} : 0.5);
}

Coating ShadedScene::coatingAt(const SurfaceHit& hit, const SurfacePoint& point, double sample_size) const
{
    const MaterialRecord& material = getMaterial(hit);
    Coating c;
    const Double3 factor{double{material.base_color.x}, double{material.base_color.y},
                         double{material.base_color.z}};
    const Double3 vertex{double{point.color.x}, double{point.color.y}, double{point.color.z}};
    c.base = factor * vertex * look(material.base_color_texture, point, sample_size).rgb;
    const Double3 metallic_roughness = look(material.metallic_roughness_texture, point, sample_size).rgb;
    c.metallic = std::clamp(double{material.metallic} * metallic_roughness.z, 0.0, 1.0);
    c.roughness = std::clamp(double{material.roughness} * metallic_roughness.y, 0.045, 1.0);
    const double occlusion = look(material.occlusion_texture, point, sample_size).rgb.x;
    c.occlusion = 1 + double{material.occlusion_strength} * (occlusion - 1);
    c.emitted = Double3(material.emissive) * look(material.emissive_texture, point, sample_size).rgb *
                lighting_.exposure;
    c.normal = mappedNormal(material.normal_texture, material.normal_scale, point, sample_size);
    addLayers(hit, point, sample_size, c);
    if (!hit.front)
    {
        c.normal = -c.normal;
        c.clearcoat_normal = -c.clearcoat_normal;
    }
    return c;
}

Double3 ShadedScene::mappedNormal(const TextureRef& map, float scale, const SurfacePoint& point,
                                  double sample_size) const
{
    if (map.image == kInvalidIndex)
        return point.normal;
    Double3 n = look(map, point, sample_size).rgb * 2.0 - Double3{1, 1, 1};
    n.z = std::sqrt(std::max(0.0, 1 - n.x * n.x - n.y * n.y)); // maps give x and y
    return normalize(point.tangent * (n.x * double{scale}) + point.bitangent * (n.y * double{scale}) +
                     point.normal * n.z);
}

void ShadedScene::addLayers(const SurfaceHit& hit, const SurfacePoint& point, double sample_size,
                            Coating& c) const
{
    const MaterialLayersRecord layers = getLayers(hit);
    const Rgba specular = look(layers.specular_texture, point, sample_size);
    const double ior = double{layers.ior};
    const Double3 f0 = Double3(layers.specular_color) * specular.rgb * std::pow((ior - 1) / (ior + 1), 2);
    c.dielectric_f90 = double{layers.specular} * specular.alpha;
    c.dielectric_f0 =
        Double3{std::min(f0.x, 1.0), std::min(f0.y, 1.0), std::min(f0.z, 1.0)} * c.dielectric_f90;
    const Rgba sheen = look(layers.sheen_texture, point, sample_size);
    c.sheen = Double3(layers.sheen_color) * sheen.rgb;
    c.sheen_roughness = std::clamp(double{layers.sheen_roughness} * sheen.alpha, 0.07, 1.0);
    const Double3 coat = look(layers.clearcoat_texture, point, sample_size).rgb;
    c.clearcoat = double{layers.clearcoat} * coat.x;
    c.clearcoat_roughness = std::clamp(double{layers.clearcoat_roughness} * coat.y, 0.045, 1.0);
    c.clearcoat_normal =
        mappedNormal(layers.clearcoat_normal_texture, layers.clearcoat_normal_scale, point, sample_size);
}

Double3 lifted(const ShadedPoint& point)
{
    const double step = 1e-4 * (point.hit.distance + length(point.surface.position));
    return point.surface.position + point.surface.geometric_normal * (point.hit.front ? step : -step);
}

Double3 cosineDirection(Double3 normal, double u, double v)
{
    const Double3 tangent =
        normalize(cross(normal, std::abs(normal.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0}));
    const Double3 bitangent = cross(normal, tangent);
    const double radius = std::sqrt(u), angle = 2 * kPi * v;
    return tangent * (radius * std::cos(angle)) + bitangent * (radius * std::sin(angle)) +
           normal * std::sqrt(1 - u);
}

} // namespace hearth::reference
