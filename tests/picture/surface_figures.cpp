// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/surface_figures.h"

#include "tests/reference/tracer/camera_rays.h"
#include "tests/reference/tracer/random_stream.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace hearth::picture
{

namespace
{

using namespace reference;
using Double3 = reference::Double3;

/// Luminance of a pixel before the tone curve.
double readLuminance(const Image& image, size_t x, size_t y)
{
    constexpr double kWeights[] = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (size_t channel = 0; channel < 3; ++channel)
        sum += kWeights[channel] * invertFilmic(linearFromSrgb(image.at(x, y)[channel] / 255.0));
    return sum;
}

bool isLitByLamps(const ShadedScene& scene, const ShadedPoint& point)
{
    for (const SceneLight& light : scene.lighting().lights)
    {
        const Incident incident = light.at(point.surface.position);
        if (dot(point.coating.normal, incident.to_light) > 0 && !scene.shadowed(lifted(point), incident))
            return true;
    }
    return false;
}

bool isWall(const ShadedScene& scene, const ShadedPoint& point)
{
    const auto opaque = static_cast<uint32_t>(formats::AlphaMode::opaque);
    return std::abs(point.surface.geometric_normal.y) < 0.5 && point.coating.metallic < 0.5 &&
           length(point.coating.emitted) == 0 && scene.getMaterial(point.hit).alpha_mode == opaque;
}

/// Share of the directions about the shading normal, weighted by the cosine, that nothing occludes.
double traceOcclusion(const ShadedScene& scene, const ShadedPoint& point, uint32_t rays, Random& random)
{
    uint32_t visible = 0;
    for (uint32_t i = 0; i < rays; ++i)
    {
        const double u = (i + random.next()) / rays, v = random.next();
        const Double3 direction = cosineDirection(point.coating.normal, u, v);
        visible += scene.occluded({lifted(point), direction, 0, 1e30}) ? 0 : 1;
    }
    return double{1} * visible / rays;
}

} // namespace

SeenSurfaces::SeenSurfaces(const ShadedScene& scene, const formats::PackView& pack,
                           const shared::Camera& camera, uint32_t width, uint32_t height)
    : scene_(scene), width_(width), height_(height), points_(size_t{width} * height)
{
    for (const formats::InstanceRecord& instance : pack.instances())
    {
        const formats::MeshRecord& mesh = pack.meshes()[instance.mesh];
        is_deformed_.push_back(mesh.skinned != 0 || mesh.morph_target_count != 0);
    }
    const CameraRays rays(camera, width, height);
    std::vector<std::optional<ShadedPoint>> all(points_.size());
    const auto forInner = [&](const auto& visit)
    {
        tbb::parallel_for(1u, height - 1,
                          [&](uint32_t y)
                          {
                              for (uint32_t x = 1; x + 1 < width; ++x)
                                  visit(size_t{y} * width + x, x, y);
                          });
    };
    forInner([&](size_t i, uint32_t x, uint32_t y)
             { all[i] = scene.nearest(rays.through(x + 0.5, y + 0.5), rays.pixelAngle()); });
    forInner(
        [&](size_t i, uint32_t, uint32_t)
        {
            if (!all[i] || all[i]->unlit)
                return;
            for (const size_t neighbour : {i - 1, i + 1, i - width, i + width})
                if (!all[neighbour] || all[neighbour]->hit.instance != all[i]->hit.instance)
                    return;
            points_[i] = all[i];
        });
}

std::optional<double> SeenSurfaces::compareWalls(const Image& picture, const Image& expected) const
{
    double shown = 0, wanted = 0;
    for (size_t i = 0; i < points_.size(); ++i)
        if (points_[i] && isWall(scene_, *points_[i]) && !isLitByLamps(scene_, *points_[i]))
        {
            shown += readLuminance(picture, i % width_, i / width_);
            wanted += readLuminance(expected, i % width_, i / width_);
        }
    return wanted > 0 ? std::optional(shown / wanted) : std::nullopt;
}

OcclusionError SeenSurfaces::measureOcclusion(const Image& picture, uint32_t rays) const
{
    OcclusionError error{.traced = Image(width_, height_)};
    std::vector<double> sums(height_), counts(height_); // of rows
    tbb::parallel_for(0u, height_,
                      [&](uint32_t y)
                      {
                          for (uint32_t x = 0; x < width_; ++x)
                          {
                              const size_t i = size_t{y} * width_ + x;
                              uint8_t* const grey = &error.traced.rgb[3 * i];
                              std::fill_n(grey, 3, uint8_t{255});
                              if (!points_[i] || is_deformed_[points_[i]->hit.instance])
                                  continue;
                              Random random(i);
                              const double drawn = picture.at(x, y)[0] / 255.0;
                              const double first = traceOcclusion(scene_, *points_[i], rays / 2, random);
                              const double second = traceOcclusion(scene_, *points_[i], rays / 2, random);
                              std::fill_n(grey, 3, static_cast<uint8_t>(127.5 * (first + second) + 0.5));
                              sums[y] += (drawn - first) * (drawn - second);
                              counts[y] += 1;
                          }
                      });
    double sum = 0, count = 0;
    for (uint32_t y = 0; y < height_; ++y)
    {
        sum += sums[y];
        count += counts[y];
    }
    error.rms = count > 0 ? std::sqrt(std::max(0.0, sum / count)) : 0;
    return error;
}

} // namespace hearth::picture
