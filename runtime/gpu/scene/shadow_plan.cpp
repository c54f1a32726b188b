// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/shadow_plan.h"

#include "formats/base/assert.h"
#include "runtime/frame/shadow_cull.h"
#include "runtime/frame/shadow_lights.h"

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

/// Return the step between depths that are stored. Floats round by 2^-24 of a depth, which is within
/// ShadowLight::rounding.
constexpr float depthStep(ShadowDepth depth)
{
    return depth == ShadowDepth::d16 ? 1.0f / 65535 : 0.0f;
}

/// Return the largest distance along a light's axis at which it reaches anything.
float reachAlongAxis(const ShadowCaster& caster, const Box3& scene)
{
    const Float3 axis = caster.projection.direction;
    const Float3 farthest{axis.x > 0 ? scene.max.x : scene.min.x, axis.y > 0 ? scene.max.y : scene.min.y,
                          axis.z > 0 ? scene.max.z : scene.min.z};
    const float reach = std::max(dot(axis, farthest - caster.projection.origin), 0.0f);
    return caster.range > 0 ? std::min(reach, caster.range) : reach;
}

/// Takes the maps of a frame, row by row.
class ShadowPlanner
{
public:
    ShadowPlanner(const ShadowOptions& options, ShadowPlan& plan) : options_(options), plan_(plan) {}

    /// reserved  layers that are left for the rows that follow
    void begin(const ShadowCaster& caster, uint32_t reserved)
    {
        row_ = caster.row;
        is_unseen_ = caster.is_unseen;
        is_empty_ = true;
        reserved_ = reserved;
        shared::ShadowLight& projection = plan_.block.lights[row_];
        projection = caster.projection;
        projection.first_map = plan_.map_count;
        projection.depth_quantum = depthStep(options_.depth);
        plan_.range_m[row_] = caster.range;
    }

    /// Unseen maps count: what others have shall not depend on the direction of the view.
    bool hasLayers(uint32_t count) const
    {
        return plan_.map_count + plan_.unseen_maps + count <= options_.max_maps;
    }

    /// texel_m  metres per texel of the map
    void add(shared::ShadowMap map, float texel_m)
    {
        if (!hasLayers(reserved_ + 1))
        {
            ++plan_.dropped_maps;
            return;
        }
        float& finest = plan_.finest_m[row_];
        finest = is_empty_ ? texel_m : std::min(finest, texel_m);
        is_empty_ = false;
        if (is_unseen_)
        {
            ++plan_.unseen_maps;
            return;
        }
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
    uint32_t reserved_ = 0;
    bool is_unseen_ = false;
    bool is_empty_ = true; ///< the row has no map yet
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

/// Plan the maps of a spot or of a face of a point light.
void planPerspective(const ShadowCaster& light, const ShadowOptions& options,
                     std::span<const ShadowSphere> spheres, ShadowPlanner& planner)
{
    const shared::ShadowMap whole =
        shared::makeConeMap(light.tangent, {.texels = options.texels, .kernel = options.kernel});
    planner.add(whole, 1 / whole.density); // at a distance of one metre from the light
    for (const ShadowSphere& sphere : spheres)
        if (affects(sphere, light))
            if (const auto map = shared::fitSpotMap(light.projection, light.tangent,
                                                    {sphere.center, sphere.radius}, planner.mapSize(sphere)))
            {
                const float distance = length(sphere.center - light.projection.origin);
                planner.add(*map, std::max(distance, sphere.radius) / map->density);
            }
}

/// Return the number of rows of the light that the first caster belongs to.
size_t countRowsOfLight(std::span<const ShadowCaster> casters)
{
    const auto end =
        std::find_if(casters.begin(), casters.end(),
                     [&](const ShadowCaster& caster) { return caster.light != casters.front().light; });
    return static_cast<size_t>(end - casters.begin());
}

/// Plan the maps of one light.
///
/// casters  of the light
void planLight(std::span<const ShadowCaster> casters, const ShadowOptions& options,
               const shared::FrameView& view, std::span<const ShadowSphere> spheres, ShadowPlan& plan)
{
    ShadowPlanner planner(options, plan);
    const auto count = static_cast<uint32_t>(casters.size());
    // a point light with shadows in some directions only would show the seams
    const bool fits = count == 1 || planner.hasLayers(count);
    if (!fits)
        plan.dropped_maps += count;
    for (uint32_t i = 0; i < count; ++i)
    {
        planner.begin(casters[i], count - 1 - i);
        if (fits && casters[i].tangent == 0)
            planSun(casters[i], options, view, spheres, planner);
        else if (fits)
            planPerspective(casters[i], options, spheres, planner);
        planner.end();
    }
    const std::span finest = std::span(plan.finest_m).subspan(casters.front().row, count);
    // one eye for all faces: on both sides of a seam the casters are the same
    std::fill(finest.begin(), finest.end(), *std::min_element(finest.begin(), finest.end()));
    plan.shadowed_lights += finest.front() > 0 ? 1u : 0u;
}

/// Return the largest step of 16-bit depths in the maps of a light, in texels.
///
/// casters  of the light, from row 0 on
float findDepthStep(std::span<const ShadowCaster> casters, const ShadowOptions& options, const Box3& scene,
                    const shared::FrameView& view, std::span<const ShadowSphere> spheres)
{
    float step = 0;
    const ShadowPlan plan = planShadows(casters, options, view, spheres);
    for (uint32_t i = 0; i < plan.map_count; ++i)
    {
        const ShadowCaster& caster = casters[plan.row_of[i]];
        const shared::ShadowLight& light = caster.projection;
        // texels of a spot grow with the distance, steps with its square
        const float distance = light.perspective != 0 ? reachAlongAxis(caster, scene) : 1;
        step = std::max(step,
                        depthStep(options.depth) * distance * plan.block.maps[i].density / light.depth_step);
    }
    return step;
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

void addShadowCasters(const shared::Light& light, uint32_t slot, uint32_t row, const Box3& scene, float near,
                      std::vector<ShadowCaster>& casters)
{
    if (hasType(light, formats::LightType::directional))
    {
        casters.push_back(
            {.light = slot, .row = row, .projection = shared::makeSunShadow(light.direction, scene)});
        return;
    }
    if (hasType(light, formats::LightType::spot))
    {
        const float cos_outer = std::clamp(-light.cone_offset / light.cone_scale, 0.0f, 1.0f);
        casters.push_back({.light = slot,
                           .row = row,
                           .projection = shared::makeSpotShadow(light.position, light.direction, near),
                           // a spot with an empty cone has a map all the same
                           .tangent = std::max(shared::coneTangent(std::acos(cos_outer)), 1e-3f),
                           .range = light.range});
        return;
    }
    for (uint32_t face = 0; face < shared::kPointFaces; ++face)
        casters.push_back({.light = slot,
                           .row = row + face,
                           .face = face,
                           .projection = shared::makePointShadow(light.position, face, near),
                           .tangent = shared::kFaceTangent,
                           .range = light.range});
}

uint32_t countShadowMaps(const shared::SceneLighting& lighting, uint32_t splits, size_t spheres)
{
    size_t count = 0;
    for (const shared::Light& light : lighting.lights)
        count += hasType(light, formats::LightType::directional)
                     ? splits + spheres
                     : shared::countShadowRows(light) * (1 + spheres);
    return static_cast<uint32_t>(std::min<size_t>(count, shared::kMaxShadowMaps));
}

ShadowDepthChoice chooseShadowDepth(const shared::SceneLighting& lighting, const ShadowOptions& options,
                                    const Box3& scene, std::span<const ShadowSphere> spheres)
{
    constexpr float kLensRad = 1.0472f;
    ShadowDepthChoice choice{.depth = options.depth};
    if (scene.empty() || options.depth == ShadowDepth::d32)
        return choice;
    const Float3 eye = scene.center();
    const shared::FrameView view = shared::makeFrameView(
        {.position = eye, .target = eye + Float3{0, 0, -1}, .y_fov_rad = kLensRad}, 1280, 720, 1, 0);
    std::vector<ShadowCaster> casters;
    for (uint32_t light = 0; light < lighting.lights.size(); ++light)
    {
        casters.clear();
        addShadowCasters(lighting.lights[light], light, 0, scene, options.spot_near, casters);
        const float texels = findDepthStep(casters, options, scene, view, spheres);
        if (texels > choice.step_texels)
        {
            choice.light = light;
            choice.step_texels = texels;
        }
    }
    if (choice.step_texels > kMaxDepthStepTexels)
        choice.depth = ShadowDepth::d32;
    return choice;
}

ShadowPlan planShadows(std::span<const ShadowCaster> casters, const ShadowOptions& options,
                       const shared::FrameView& view, std::span<const ShadowSphere> spheres)
{
    ShadowPlan plan;
    plan.block.error_bias = options.error_bias;
    plan.block.texel_size = 1 / static_cast<float>(options.texels);
    while (!casters.empty())
    {
        const size_t count = countRowsOfLight(casters);
        planLight(casters.first(count), options, view, spheres, plan);
        casters = casters.subspan(count);
    }
    return plan;
}

} // namespace hearth::gpu
