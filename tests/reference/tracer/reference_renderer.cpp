// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/reference_renderer.h"

#include "tests/reference/tracer/camera_rays.h"
#include "tests/reference/tracer/path_tracer.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace hearth::reference
{

using namespace formats;

namespace
{

class ReferenceRenderer
{
public:
    ReferenceRenderer(const PackGeometry& geometry, const TextureSet& textures,
                      const ReferenceOptions& options)
        : options_(options),
          scene_(geometry, textures, options.pose),
          rays_(options.camera, options.width, options.height)
    {
        options_.sky.shadows = options.shadows;
    }

    /// Display-linear colour of a pixel. Samples are tone-mapped one by one, as in multisampled rendering.
    Double3 pixel(uint32_t x, uint32_t y) const
    {
        const uint32_t side = options_.samples_per_side;
        Double3 sum;
        for (uint32_t sy = 0; sy < side; ++sy)
            for (uint32_t sx = 0; sx < side; ++sx)
                sum += sample(x + (sx + 0.5) / side, y + (sy + 0.5) / side,
                              ((uint64_t{y} * options_.width + x) * side + sy) * side + sx);
        return sum / (double{1} * side * side);
    }

private:
    Double3 sample(double x, double y, uint64_t seed) const
    {
        const Ray ray = rays_.through(x, y);
        const Double3 direction = ray.direction;
        const auto point = scene_.nearest(ray, rays_.pixelAngle() / options_.samples_per_side);
        if (point && point->unlit)
            return point->coating.base;
        const Double3 radiance = !point ? scene_.lighting().radiance(direction)
                                        : emitted(point->coating, -direction) +
                                              underLights(scene_, *point, -direction, options_.shadows) +
                                              tracedSky(scene_, *point, -direction, options_.sky, seed);
        return {filmic(radiance.x), filmic(radiance.y), filmic(radiance.z)};
    }

    ReferenceOptions options_;
    ShadedScene scene_;
    CameraRays rays_;
};

} // namespace

namespace
{

/// Trace an image by paths. Returns display-linear colours.
std::vector<Double3> tracePathColors(const PackGeometry& geometry, const TextureSet& textures,
                                     const ReferenceOptions& options)
{
    ShadedScene scene(geometry, textures, options.pose);
    if (options.sky_map != nullptr)
    {
        SceneLighting lighting = scene.lighting();
        lighting.sky_map = options.sky_map;
        scene.setLighting(std::move(lighting));
    }
    std::vector<Double3> colors = tracePaths(scene, {.camera = options.camera,
                                                     .width = options.width,
                                                     .height = options.height,
                                                     .samples = options.paths});
    for (Double3& color : colors)
        color = {filmic(color.x), filmic(color.y), filmic(color.z)};
    return colors;
}

} // namespace

Result<Image> renderReference(const PackView& view, const ReferenceOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const PackGeometry geometry, PackGeometry::decode(view));
    HEARTH_ASSIGN_OR_RETURN(const TextureSet textures, TextureSet::load(view));
    const ReferenceRenderer renderer(geometry, textures, options);
    std::vector<Double3> traced;
    if (options.paths > 0)
        traced = tracePathColors(geometry, textures, options);
    Image image(options.width, options.height);
    tbb::parallel_for(
        0u, options.height,
        [&](uint32_t y)
        {
            for (uint32_t x = 0; x < options.width; ++x)
            {
                const Double3 c =
                    traced.empty() ? renderer.pixel(x, y) : traced[size_t{y} * options.width + x];
                uint8_t* const out = image.at(x, y);
                const double rgb[3] = {c.x, c.y, c.z};
                for (size_t i = 0; i < 3; ++i)
                    out[i] = static_cast<uint8_t>(
                        std::clamp(srgbFromLinear(std::clamp(rgb[i], 0.0, 1.0)), 0.0, 1.0) * 255 + 0.5);
            }
        });
    return image;
}

} // namespace hearth::reference
