// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/shadow_plan.h"

#include "formats/base/assert.h"
#include "runtime/frame/shadow_cull.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace hearth::gpu
{

namespace
{

bool hasType(const shared::Light& light, formats::LightType type)
{
    return light.type == static_cast<uint32_t>(type);
}

/// Assigns the layers of a frame, light by light.
class ShadowPlanner
{
public:
    ShadowPlanner(const ShadowOptions& options, ShadowPlan& plan) : options_(options), plan_(plan) {}

    void begin(uint32_t row, const ShadowCaster& light)
    {
        row_ = row;
        shared::ShadowLight& projection = plan_.block.lights[row];
        projection = light.projection;
        projection.first_map = plan_.map_count;
    }

    /// texel_m  metres per texel of the map
    void add(shared::ShadowMap map, float texel_m)
    {
        if (plan_.map_count == options_.max_maps)
        {
            ++plan_.dropped_maps;
            return;
        }
        float& finest = plan_.finest_m[row_];
        finest = plan_.block.lights[row_].map_count == 0 ? texel_m : std::min(finest, texel_m);
        map.layer = plan_.map_count;
        plan_.row_of[plan_.map_count] = row_;
        plan_.block.maps[plan_.map_count++] = map;
        ++plan_.block.lights[row_].map_count;
    }

    void end()
    {
        const shared::ShadowLight& light = plan_.block.lights[row_];
        shared::sortByDensity(std::span(plan_.block.maps).subspan(light.first_map, light.map_count));
    }

    shared::ShadowMapSize mapSize(const ShadowSphere& sphere) const
    {
        // a map that is smaller than its filter holds nothing
        const uint32_t min_texels = std::bit_ceil(4 * (options_.kernel + 1));
        const uint32_t texels = sphere.texels == 0 ? options_.texels : std::bit_floor(sphere.texels);
        return {.texels = std::clamp(texels, min_texels, options_.texels), .kernel = options_.kernel};
    }

private:
    const ShadowOptions& options_;
    ShadowPlan& plan_;
    uint32_t row_ = 0;
};

bool affects(const ShadowSphere& sphere, const ShadowCaster& light)
{
    HEARTH_ASSERT(sphere.radius > 0);
    return sphere.light == ShadowSphere::kAllLights || sphere.light == light.light;
}

void planSun(const ShadowCaster& light, const ShadowOptions& options, const shared::FrameView& view,
             std::span<const ShadowSphere> spheres, ShadowPlanner& planner)
{
    const auto add = [&](const Sphere& sphere, shared::ShadowMapSize size)
    {
        const shared::ShadowMap map = shared::fitSunMap(light.projection, sphere, size);
        planner.add(map, 1 / map.density);
    };
    for (const ShadowSphere& sphere : spheres)
        if (affects(sphere, light))
            add({sphere.center, sphere.radius}, planner.mapSize(sphere));
    std::array<Sphere, kMaxSplits> splits;
    const auto used = std::span(splits).first(options.splits);
    shared::computeSplitSpheres(view, options.split_range, used);
    for (const Sphere& split : used)
        add(split, {.texels = options.texels, .kernel = options.kernel});
}

void planSpot(const ShadowCaster& light, const ShadowOptions& options, std::span<const ShadowSphere> spheres,
              ShadowPlanner& planner)
{
    const shared::ShadowMap whole =
        shared::makeConeMap(light.cone_tangent, {.texels = options.texels, .kernel = options.kernel});
    planner.add(whole, 1 / whole.density); // at a distance of one metre from the light
    for (const ShadowSphere& sphere : spheres)
        if (affects(sphere, light))
            if (const auto map = shared::fitSpotMap(light.projection, light.cone_tangent,
                                                    {sphere.center, sphere.radius}, planner.mapSize(sphere)))
                planner.add(*map, length(sphere.center - light.projection.origin) / map->density);
}

} // namespace

std::vector<ShadowSphere> readShadowSpheres(const formats::PackView& pack)
{
    static_assert(kInvalidIndex == ShadowSphere::kAllLights);
    std::vector<ShadowSphere> spheres;
    for (const formats::ShadowSphereRecord& record : pack.shadowSpheres())
        spheres.push_back({.center = record.center,
                           .radius = record.radius,
                           .light = record.light,
                           .texels = record.texels});
    return spheres;
}

void assignShadowRows(shared::Lighting& lighting)
{
    uint32_t row = 0;
    const std::span lights(lighting.lights, lighting.light_count);
    for (shared::Light& light : lights)
        light.shadow_row = shared::kNoShadow;
    for (const formats::LightType type : {formats::LightType::directional, formats::LightType::spot})
        for (shared::Light& light : lights)
            if (hasType(light, type) && row < shared::kMaxShadowLights)
                light.shadow_row = row++;
}

ShadowCaster makeShadowCaster(const shared::Light& light, uint32_t number, const Box3& scene, float spot_near)
{
    if (hasType(light, formats::LightType::directional))
        return {.light = number, .projection = shared::makeSunShadow(light.direction, scene)};
    const float cos_outer = std::clamp(-light.cone_offset / light.cone_scale, 0.0f, 1.0f);
    return {.light = number,
            .projection = shared::makeSpotShadow(light.position, light.direction, spot_near),
            // a spot with an empty cone has a map all the same
            .cone_tangent = std::max(shared::coneTangent(std::acos(cos_outer)), 1e-3f)};
}

std::vector<ShadowCaster> makeShadowCasters(const shared::Lighting& lighting, const Box3& scene,
                                            float spot_near)
{
    std::vector<ShadowCaster> casting;
    if (scene.empty())
        return casting;
    for (uint32_t i = 0; i < lighting.light_count; ++i)
    {
        const shared::Light& light = lighting.lights[i];
        if (light.shadow_row == shared::kNoShadow)
            continue;
        casting.resize(std::max<size_t>(casting.size(), light.shadow_row + 1));
        casting[light.shadow_row] = makeShadowCaster(light, i, scene, spot_near);
    }
    return casting;
}

ShadowPlan planShadows(std::span<const ShadowCaster> lights, const ShadowOptions& options,
                       const shared::FrameView& view, std::span<const ShadowSphere> spheres)
{
    ShadowPlan plan;
    plan.block.error_bias = options.error_bias;
    plan.block.layer_size = static_cast<float>(options.texels);
    ShadowPlanner planner(options, plan);
    for (uint32_t row = 0; row < lights.size(); ++row)
    {
        const ShadowCaster& light = lights[row];
        planner.begin(row, light);
        if (light.cone_tangent == 0)
            planSun(light, options, view, spheres, planner);
        else
            planSpot(light, options, spheres, planner);
        planner.end();
        shared::ShadowLight& projection = plan.block.lights[row];
        if (projection.map_count > 0)
            projection.eye_shift = shared::findEyeCell(view, plan.finest_m[row], options.error_bias).shift;
    }
    return plan;
}

} // namespace hearth::gpu
