// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/direct_light.h"

#include "cook/receivers/bake/polygon_light.h"
#include "cook/sampling/maps.h"
#include "cook/sampling/owen_sobol.h"
#include "formats/gpu_shared/brick_lighting.h"
#include "formats/scene/scene_lighting.h"

namespace hearth::receivers
{

namespace
{

constexpr float kPi = 3.14159265f;

/// Share of the scene's diagonal by which rays keep off surfaces: some roundings of its coordinates.
constexpr float kOffsetShare = 0x1p-17f;

/// Metres within which a lamp lights nothing.
float nearestLit(const Lamp& lamp)
{
    return std::max(lamp.radius, shared::kBrickLampRadius);
}

/// True if a point is not behind the black back of a triangle.
bool shinesTo(const Triangle& triangle, Float3 point)
{
    return triangle.double_sided || dot(crossEdges(triangle), point - triangle.corners[0]) > 0;
}

} // namespace

BakeRays makeBakeRays(const BakeScene& scene)
{
    std::vector<Float3> corners;
    corners.reserve(3 * scene.triangles.size());
    Box3 box;
    for (const Triangle& triangle : scene.triangles)
        for (const Float3& corner : triangle.corners)
        {
            corners.push_back(corner);
            box.add(corner);
        }
    const float offset = box.empty() ? 0 : std::max(length(box.max - box.min) * kOffsetShare, 1e-6f);
    return {ray_scene::TriangleRays(std::move(corners)), offset};
}

Float3 unshadowedLight(const Lamp& lamp, const ReceivingPoint& at)
{
    const shared::Light& light = lamp.light;
    if (light.type == shared::kLightDirectional)
        return dot(at.side, light.direction) < 0
                   ? light.intensity * std::max(-dot(at.normal, light.direction), 0.0f)
                   : Float3{};
    const Float3 offset = light.position - at.position;
    const float distance = length(offset);
    if (distance < nearestLit(lamp) || dot(at.side, offset) <= 0)
        return {};
    const Float3 to_light = offset / distance;
    float share = std::max(dot(at.normal, to_light), 0.0f) / (distance * distance);
    if (light.range > 0)
    {
        const float ratio = distance / light.range;
        share *= std::clamp(1 - ratio * ratio * ratio * ratio, 0.0f, 1.0f);
    }
    if (light.type == shared::kLightSpot)
    {
        const float cone =
            std::clamp(light.cone_offset - dot(light.direction, to_light) * light.cone_scale, 0.0f, 1.0f);
        share *= cone * cone;
    }
    return light.intensity * share;
}

DirectLight::DirectLight(const BakeScene& scene, const BakeRays& rays, uint32_t mesh_light_rays)
    : scene_(scene), rays_(rays), mesh_light_rays_(mesh_light_rays)
{
    for (const MeshLight& light : scene.mesh_lights)
    {
        Source source;
        double power = 0;
        for (size_t i = 0; i < light.triangles.size(); ++i)
        {
            const float area = 0.5f * length(crossEdges(scene.triangles[light.triangles[i]]));
            source.powers.push_back(power += double{area * shared::luminance(light.radiance[i])});
        }
        sources_.push_back(std::move(source));
    }
}

Float3 DirectLight::at(size_t light, const ReceivingPoint& point, uint64_t seed, uint64_t& ray_count) const
{
    const uint64_t own_seed = sampling::deriveSeed(seed, light);
    if (light < scene_.lamps.size())
        return fromLamp(scene_.lamps[light], point, own_seed, ray_count);
    const size_t number = light - scene_.lamps.size();
    const MeshLight& mesh_light = scene_.mesh_lights[number];
    return mesh_light.triangles.size() <= mesh_light_rays_
               ? fromFewTriangles(mesh_light, point, own_seed, ray_count)
               : fromManyTriangles(mesh_light, sources_[number], point, own_seed, ray_count);
}

float DirectLight::missingShare(size_t number, Float3 radiance, float distance) const
{
    if (scene_.mesh_lights[number].triangles.size() <= mesh_light_rays_)
        return 0;
    const auto area =
        static_cast<float>(sources_[number].powers.back() / mesh_light_rays_) / shared::luminance(radiance);
    const float covered = kPi * distance * distance;
    return 1 - covered / std::max(covered, area);
}

bool DirectLight::sees(const ReceivingPoint& point, Float3 target) const
{
    return !rays_.triangles.occluded(point.position, target - point.position, 1);
}

bool DirectLight::sees(const ReceivingPoint& point, const Triangle& triangle, Float3 target) const
{
    const Float3 normal = normalizeOr(crossEdges(triangle), {});
    const float sign = dot(normal, point.position - target) < 0 ? -1.0f : 1.0f;
    return sees(point, target + normal * (sign * rays_.offset));
}

Float3 DirectLight::fromLamp(const Lamp& lamp, const ReceivingPoint& point, uint64_t seed,
                             uint64_t& ray_count) const
{
    const Float3 light = unshadowedLight(lamp, point);
    if (light == Float3{})
        return {};
    const bool is_sun = lamp.light.type == shared::kLightDirectional;
    const Float3 axis =
        is_sun ? -lamp.light.direction : normalizeOr(lamp.light.position - point.position, point.side);
    const auto is_free = [&](Float3 shift)
    {
        ++ray_count;
        return is_sun ? !rays_.triangles.occluded(point.position, axis + shift,
                                                  std::numeric_limits<float>::infinity())
                      : sees(point, lamp.light.position + shift);
    };
    if (!(lamp.radius > 0))
        return is_free({}) ? light : Float3{};
    const sampling::Frame frame = sampling::frameAround(axis);
    uint32_t free = 0;
    for (uint32_t i = 0; i < kSphereRays; ++i)
    {
        const Float2 u = sampling::unitPoint(sampling::owenSobol(i, seed));
        const sampling::SineCosine turn = sampling::sineCosine(u.y);
        const float radius = lamp.radius * std::sqrt(u.x);
        free += is_free(frame.x * (radius * turn.cosine) + frame.y * (radius * turn.sine)) ? 1u : 0u;
    }
    return light * (static_cast<float>(free) / kSphereRays);
}

/// Weigh the closed form of each triangle by the share of it that is seen: without obstacles the result is
/// exact.
Float3 DirectLight::fromFewTriangles(const MeshLight& light, const ReceivingPoint& point, uint64_t seed,
                                     uint64_t& ray_count) const
{
    const auto count = static_cast<uint32_t>(light.triangles.size());
    const uint32_t rays = (mesh_light_rays_ + count - 1) / std::max(count, 1u);
    Float3 sum;
    for (uint32_t t = 0; t < count; ++t)
    {
        const Triangle& triangle = scene_.triangles[light.triangles[t]];
        if (!shinesTo(triangle, point.position))
            continue;
        const float whole = triangleIrradiance(point.position, point.normal, triangle.corners);
        if (!(whole > 0))
            continue;
        const Float3 across = crossEdges(triangle);
        float all = 0, seen = 0;
        for (uint32_t i = 0; i < rays; ++i)
        {
            const Float2 weights =
                sampling::trianglePoint(sampling::unitPoint(sampling::owenSobol(t * rays + i, seed)));
            const Float3 target = interpolate(triangle.corners, weights), offset = target - point.position;
            const float distance2 = dot(offset, offset);
            if (dot(offset, point.side) <= 0 || !(distance2 > 0))
                continue;
            const float weight = std::max(dot(offset, point.normal), 0.0f) * std::abs(dot(offset, across)) /
                                 (distance2 * distance2);
            all += weight;
            ++ray_count;
            seen += sees(point, triangle, target) ? weight : 0;
        }
        if (all > 0)
            sum += light.radiance[t] * (whole * seen / all);
    }
    return sum;
}

/// Pick triangles by power, each for an equal share of it. The light of a share is at most that of a sky of
/// its radiance, which bounds the noise of points nearer to it than its size.
Float3 DirectLight::fromManyTriangles(const MeshLight& light, const Source& source,
                                      const ReceivingPoint& point, uint64_t seed, uint64_t& ray_count) const
{
    const double power = source.powers.back();
    if (!(power > 0))
        return {};
    Float3 sum;
    for (uint32_t i = 0; i < mesh_light_rays_; ++i)
    {
        const double choice =
            (i + double{sampling::unitFloat(sampling::owenSobol(i, sampling::deriveSeed(seed, 0)).x)}) /
            mesh_light_rays_;
        const auto found = std::ranges::upper_bound(source.powers, power * choice);
        const auto t =
            static_cast<size_t>(std::min(found, std::prev(source.powers.end())) - source.powers.begin());
        const Triangle& triangle = scene_.triangles[light.triangles[t]];
        const Float3 target = interpolate(
            triangle.corners, sampling::trianglePoint(sampling::unitPoint(sampling::owenSobol(i, seed))));
        const Float3 offset = target - point.position;
        const float distance2 = dot(offset, offset);
        const float facing = dot(offset, point.normal);
        if (!(facing > 0) || dot(offset, point.side) <= 0 || !shinesTo(triangle, point.position))
            continue;
        const float leaving = std::abs(dot(normalizeOr(crossEdges(triangle), {}), offset));
        const auto area = static_cast<float>(power / mesh_light_rays_) / shared::luminance(light.radiance[t]);
        ++ray_count;
        if (sees(point, triangle, target))
            sum += light.radiance[t] *
                   (kPi * area * facing * leaving / (distance2 * std::max(kPi * distance2, area)));
    }
    return sum;
}

} // namespace hearth::receivers
