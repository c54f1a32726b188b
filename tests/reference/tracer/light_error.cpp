// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/light_error.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <tbb/parallel_for.h>

namespace hearth::reference
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

/// Share of all light by which the last sweep may change it. Where a sweep leaves nine tenths of the
/// difference, a thousandth is missing.
constexpr double kSettledChange = 1e-4;

/// Limit for furnaces, whose light grows with every sweep.
constexpr uint32_t kMaxSweeps = 100;

Float3 narrowed(Double3 v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Point i of the sequence R3 (M. Roberts, 2018).
Double3 pointOfCube(uint32_t i)
{
    return {std::fmod(0.5 + i * 0.8191725133961645, 1.0), std::fmod(0.5 + i * 0.6710436067037893, 1.0),
            std::fmod(0.5 + i * 0.5497004779019703, 1.0)};
}

double mean(Double3 v)
{
    return (v.x + v.y + v.z) / 3;
}

double sumLight(const bricks::FaceLighting& faces)
{
    double sum = 0;
    for (const shared::BrickLight& face : faces.faces())
        sum += mean(Double3(shared::decodeBrickLight(face)));
    return sum;
}

bool isNearLamp(const ShadedScene& scene, const ShadedPoint& point)
{
    for (const SceneLight& light : scene.lighting().lights)
        if (light.type != formats::LightType::directional &&
            length(light.position - point.surface.position) < kNearLamp)
            return true;
    for (uint32_t i = 0; i < 256; ++i)
    {
        const Double3 u = pointOfCube(i);
        const auto met =
            scene.nearest({lifted(point), cosineDirection(litNormal(point), u.x, u.y), 0, kNearLamp}, 0);
        if (met && mean(met->coating.emitted) > 0)
            return true;
    }
    return mean(point.coating.emitted) > 0;
}

} // namespace

std::vector<SeenPoint> seenPoints(const ShadedScene& scene, const formats::PackView& pack, uint32_t count)
{
    Box3 box;
    for (const formats::InstanceRecord& instance : pack.instances())
    {
        const formats::MeshRecord& mesh = pack.meshes()[instance.mesh];
        for (int corner = 0; corner < 8; ++corner)
            box.add(
                transformPoint(instance.world_from_object, {corner & 1 ? mesh.box_max.x : mesh.box_min.x,
                                                            corner & 2 ? mesh.box_max.y : mesh.box_min.y,
                                                            corner & 4 ? mesh.box_max.z : mesh.box_min.z}));
    }
    const Double3 low(box.min), size = Double3(box.max) - low;
    std::vector<SeenPoint> points;
    for (uint32_t i = 0; points.size() < count && i < 4 * count; ++i)
    {
        const Double3 u = pointOfCube(i);
        Ray ray;
        if (pack.cameras().empty())
            ray = {{low.x + size.x * (0.05 + 0.9 * u.x), double{box.max.y} + 1,
                    low.z + size.z * (0.05 + 0.9 * u.y)},
                   {0, -1, 0}};
        else
        {
            const formats::CameraRecord& camera = pack.cameras()[i % pack.cameras().size()];
            const double z = 2 * u.x - 1, r = std::sqrt(1 - z * z), angle = 2 * kPi * u.y;
            ray = {Double3(transformPoint(camera.world_from_camera, {0, 0, 0})),
                   {r * std::cos(angle), z, r * std::sin(angle)}};
        }
        const auto point = scene.nearest(ray, 0);
        if (point && !point->unlit)
            points.push_back({*point, -ray.direction});
    }
    return points;
}

std::vector<LitPoint> litPoints(const ShadedScene& scene, const std::vector<SeenPoint>& points,
                                uint32_t paths)
{
    std::vector<LitPoint> lit(points.size());
    tbb::parallel_for(size_t{0}, points.size(),
                      [&](size_t i)
                      {
                          const SurfaceLight a = traceSurfaceLight(scene, points[i].point, paths / 2, 2 * i);
                          const SurfaceLight b =
                              traceSurfaceLight(scene, points[i].point, paths / 2, 2 * i + 1);
                          lit[i] = {points[i],
                                    {a.direct, (a.indirect + b.indirect) * 0.5},
                                    {a.indirect, b.indirect},
                                    isNearLamp(scene, points[i].point)};
                      });
    return lit;
}

shared::SceneLighting sharedLighting(const SceneLighting& lighting)
{
    HEARTH_ASSERT(lighting.sky_map == nullptr);
    shared::SceneLighting result{
        .sky = {narrowed(lighting.zenith), narrowed(lighting.horizon), narrowed(lighting.ground)},
        .exposure = static_cast<float>(lighting.exposure),
        .lights = {}};
    for (const SceneLight& light : lighting.lights)
    {
        shared::Light& l = result.lights.emplace_back();
        l.type = static_cast<uint32_t>(light.type);
        l.position = narrowed(light.position);
        l.direction = narrowed(light.direction);
        l.intensity = narrowed(light.intensity);
        l.range = static_cast<float>(light.range);
        l.cone_scale = static_cast<float>(1 / std::max(0.001, light.cos_inner - light.cos_outer));
        l.cone_offset = static_cast<float>(-light.cos_outer) * l.cone_scale;
    }
    return result;
}

BrickGather::BrickGather(const bricks::BrickView& bricks, const shared::SceneLighting& lighting,
                         uint32_t rays)
    : faces_(bricks), sky_(lighting.sky)
{
    double before = -1, light = 0;
    for (uint32_t i = 0; i < kMaxSweeps && std::abs(light - before) > kSettledChange * light; ++i)
    {
        before = light;
        faces_.sweep(lighting, rays, 1);
        light = sumLight(faces_);
    }
}

Double3 BrickGather::at(const SeenPoint& seen, uint32_t rays, uint32_t seed) const
{
    const shared::BrickScene scene = faces_.scene();
    const shared::BrickGrid& grid = scene.masks.grid;
    const Float3 place = (narrowed(seen.point.surface.position) - grid.origin) / grid.voxel_size;
    const shared::BrickStart start = shared::brickVisibleStart(
        scene, place, narrowed(litNormal(seen.point)),
        narrowed(seen.to_eye * (seen.point.hit.distance / double{grid.voxel_size})));
    return Double3(shared::brickGather(scene, sky_, start, rays, shared::brickHash(seed)));
}

double pathNoise(const std::vector<LitPoint>& points)
{
    double square = 0, whole = 0;
    for (const LitPoint& point : points)
    {
        const Double3 off = (point.halves[0] - point.halves[1]) * 0.5;
        square += dot(off, off) / 3;
        whole += mean(point.truth.direct + point.truth.indirect);
    }
    const auto n = static_cast<double>(std::max<size_t>(points.size(), 1));
    return std::sqrt(square / n) / (whole / n);
}

LightError lightError(const std::vector<LitPoint>& points, const std::vector<Double3>& gathered,
                      bool with_near_lamps)
{
    double whole = 0, indirect = 0, square = 0, fourth = 0, difference = 0;
    LightError error;
    for (size_t i = 0; i < points.size(); ++i)
    {
        if (points[i].near_lamp && !with_near_lamps)
            continue;
        const SurfaceLight& truth = points[i].truth;
        const Double3 off = gathered[i] - truth.indirect;
        const double product = dot(gathered[i] - points[i].halves[0], gathered[i] - points[i].halves[1]) / 3;
        square += product;
        fourth += product * product;
        difference += mean(off);
        indirect += mean(truth.indirect);
        whole += mean(truth.direct + truth.indirect);
        ++error.points;
    }
    const auto n = static_cast<double>(std::max<size_t>(error.points, 1));
    const double rms = std::sqrt(std::max(square, 0.0) / n);
    error.whole = rms / (whole / n);
    error.indirect = rms / (indirect / n);
    error.bias = difference / indirect;
    const double variance = std::max(fourth / n - square / n * (square / n), 0.0);
    error.uncertainty = rms > 0 ? std::sqrt(variance / n) / (2 * rms) / (whole / n) : 0;
    return error;
}

} // namespace hearth::reference
