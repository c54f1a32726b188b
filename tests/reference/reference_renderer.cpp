// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/reference_renderer.h"

#include "tests/reference/embree_scene.h"
#include "tests/reference/gltf_material.h"
#include "tests/reference/scene_lighting.h"
#include "tests/reference/texture_lookup.h"

#include <tbb/parallel_for.h>

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
        texture->image = kNone;
    return material;
}

/// The middle of the two-dimensional sequence R2 (M. Roberts, 2018), turned by the pixel: even over the hemisphere.
Double3 cosineDirection(Double3 normal, uint32_t index, uint32_t pixel)
{
    const double turn = std::fmod(pixel * 0.61803398875, 1.0);
    const double u = std::fmod(0.5 + turn + index * 0.7548776662466927, 1.0);
    const double v = std::fmod(0.5 + turn * 0.37 + index * 0.5698402909980532, 1.0);
    const Double3 tangent =
        normalize(cross(normal, std::abs(normal.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0}));
    const Double3 bitangent = cross(normal, tangent);
    const double radius = std::sqrt(u), angle = 2 * kPi * v;
    return tangent * (radius * std::cos(angle)) + bitangent * (radius * std::sin(angle)) +
           normal * std::sqrt(1 - u);
}

class ReferenceRenderer
{
public:
    ReferenceRenderer(const PackGeometry& geometry, const TextureSet& textures,
                      const ReferenceOptions& options)
        : geometry_(geometry),
          textures_(textures),
          options_(options),
          lighting_(lightingOf(geometry.view())),
          placement_(geometry, options.pose),
          scene_(
              placement_, [this](const SurfaceHit& hit) { return isThere(hit); },
              [this](const SurfaceHit& hit) { return blocks(hit); })
    {
        forward_ = normalize(Double3(options.camera.target) - Double3(options.camera.position));
        right_ = normalize(cross(forward_, Double3(options.camera.up)));
        up_ = cross(right_, forward_);
        slope_ = std::tan(double{options.camera.y_fov_rad} / 2);
        // the side of a sample at a distance of one metre
        sample_angle_ = 2 * slope_ / (options.height * options.samples_per_side);
    }

    /// Display-linear colour of a pixel: each sample is tone-mapped by itself, as in multisampled rendering.
    Double3 pixel(uint32_t x, uint32_t y) const
    {
        const uint32_t side = options_.samples_per_side;
        Double3 sum;
        for (uint32_t sy = 0; sy < side; ++sy)
            for (uint32_t sx = 0; sx < side; ++sx)
                sum += sample(x + (sx + 0.5) / side, y + (sy + 0.5) / side, y * options_.width + x);
        return sum / (double{1} * side * side);
    }

private:
    const MaterialRecord& materialOf(const SurfaceHit& hit) const
    {
        static const MaterialRecord otherwise = defaultMaterial();
        const uint32_t material = geometry_.view().clusters()[hit.cluster].material;
        return material == kNone ? otherwise : geometry_.view().materials()[material];
    }

    Rgba look(const TextureRef& texture, const SurfacePoint& point, double sample_size) const
    {
        return textures_.sample(texture, point.uv[texture.uv_set],
                                sample_size * point.uv_per_metre[texture.uv_set]);
    }

    /// Back faces of single-sided materials and holes of masks are not there.
    bool isThere(const SurfaceHit& hit) const
    {
        return (hit.front || (materialOf(hit).flags & kMaterialDoubleSided) != 0) && !isHole(hit);
    }

    /// Both faces hold light off; unlit surfaces, which are skies and signs, do not.
    bool blocks(const SurfaceHit& hit) const
    {
        return (materialOf(hit).flags & kMaterialUnlit) == 0 && !isHole(hit);
    }

    /// Blended surfaces are where alpha exceeds one half: they have no reference of their own.
    bool isHole(const SurfaceHit& hit) const
    {
        const MaterialRecord& material = materialOf(hit);
        if (material.alpha_mode == static_cast<uint32_t>(AlphaMode::opaque))
            return false;
        const SurfacePoint point = surfaceAt(placement_, hit, 0);
        const double alpha = double{material.base_color.w} * double{point.color.w} *
                             look(material.base_color_texture, point, 0).alpha;
        const bool mask = material.alpha_mode == static_cast<uint32_t>(AlphaMode::mask);
        return alpha < (mask ? double{material.alpha_cutoff} : 0.5);
    }

    Coating coatingAt(const SurfaceHit& hit, const SurfacePoint& point, double sample_size) const
    {
        const MaterialRecord& material = materialOf(hit);
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
        c.emitted = Double3(material.emissive) * look(material.emissive_texture, point, sample_size).rgb;
        c.normal = point.normal;
        if (material.normal_texture.image != kNone)
        {
            const Double3 n = look(material.normal_texture, point, sample_size).rgb * 2.0 - Double3{1, 1, 1};
            const double scale = double{material.normal_scale};
            c.normal = normalize(point.tangent * (n.x * scale) + point.bitangent * (n.y * scale) +
                                 point.normal * n.z);
        }
        if (!hit.front)
            c.normal = -c.normal;
        return c;
    }

    /// A place just off the surface on the side of its normal.
    Double3 lifted(const SurfacePoint& point, const SurfaceHit& hit) const
    {
        const double step = 1e-4 * (hit.distance + length(point.position));
        return point.position + point.geometric_normal * (hit.front ? step : -step);
    }

    Double3 lit(const SurfaceHit& hit, const SurfacePoint& point, const Coating& coating, Double3 view,
                uint32_t pixel) const
    {
        const Double3 start = lifted(point, hit);
        Double3 radiance = coating.emitted;
        for (const SceneLight& light : lighting_.lights)
        {
            const Incident incident = light.at(point.position);
            if (options_.shadows && light.type != LightType::point &&
                scene_.occluded({start, incident.to_light, 0, std::min(incident.distance, 1e30)}))
                continue;
            radiance += incident.irradiance * reflected(coating, view, incident.to_light);
        }
        double open = 1;
        for (uint32_t i = 0; i < options_.occlusion_rays; ++i)
            open -= scene_.occluded({start, cosineDirection(coating.normal, i, pixel), 0, 1e30})
                        ? 1.0 / options_.occlusion_rays
                        : 0;
        return radiance + underSky(coating, lighting_, view) * open;
    }

    Double3 sample(double x, double y, uint32_t pixel) const
    {
        const double aspect = double{1} * options_.width / options_.height;
        const Double3 across = right_ * ((2 * x / options_.width - 1) * slope_ * aspect);
        const Double3 upwards = up_ * ((1 - 2 * y / options_.height) * slope_);
        const Double3 ray = forward_ + across + upwards; // depth 1
        const Double3 direction = normalize(ray);
        const double near = double{options_.camera.z_near} * length(ray);
        const auto hit = scene_.nearest({Double3(options_.camera.position), direction, near, 1e30});
        Double3 radiance;
        if (!hit)
            radiance = lighting_.radiance(direction, 0.4);
        else
        {
            const MaterialRecord& material = materialOf(*hit);
            const SurfacePoint point = surfaceAt(placement_, *hit, material.normal_texture.uv_set);
            const Coating coating = coatingAt(*hit, point, hit->distance * sample_angle_);
            if (material.flags & kMaterialUnlit)
                return coating.base;
            radiance = lit(*hit, point, coating, -direction, pixel);
        }
        return {filmic(radiance.x), filmic(radiance.y), filmic(radiance.z)};
    }

    const PackGeometry& geometry_;
    const TextureSet& textures_;
    const ReferenceOptions& options_;
    SceneLighting lighting_;
    Placement placement_;
    EmbreeScene scene_;
    Double3 forward_, right_, up_;
    double slope_ = 1, sample_angle_ = 0;
};

} // namespace

Result<Picture> renderReference(const PackView& view, const ReferenceOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const PackGeometry geometry, PackGeometry::decode(view));
    HEARTH_ASSIGN_OR_RETURN(const TextureSet textures, TextureSet::load(view));
    const ReferenceRenderer renderer(geometry, textures, options);
    Picture picture(options.width, options.height);
    tbb::parallel_for(
        0u, options.height,
        [&](uint32_t y)
        {
            for (uint32_t x = 0; x < options.width; ++x)
            {
                const Double3 c = renderer.pixel(x, y);
                uint8_t* const out = picture.at(x, y);
                const double rgb[3] = {c.x, c.y, c.z};
                for (size_t i = 0; i < 3; ++i)
                    out[i] = static_cast<uint8_t>(
                        std::clamp(srgbFromLinear(std::clamp(rgb[i], 0.0, 1.0)), 0.0, 1.0) * 255 + 0.5);
            }
        });
    return picture;
}

} // namespace hearth::reference
