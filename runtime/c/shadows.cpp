// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/shadows.h"

#include "runtime/gpu/scene/scene_shadows.h"

#include <bit>
#include <cmath>

namespace hearth::c
{

namespace
{

constexpr uint32_t kMaxTexels = 8192;
constexpr uint32_t kMaxKernel = 3;

bool isLength(float value)
{
    return value > 0 && std::isfinite(value);
}

Status check(const hearth_shadow_options& options)
{
    if (options.max_maps > shared::kMaxShadowMaps)
        return usage("shadows.max_maps is above " + std::to_string(shared::kMaxShadowMaps));
    if (options.kernel > kMaxKernel)
        return usage("shadows.kernel is above " + std::to_string(kMaxKernel));
    if (!std::has_single_bit(options.texels) || options.texels < 4 * (options.kernel + 1) ||
        options.texels > kMaxTexels)
        return usage("shadows.texels is not a power of two from 4 * (kernel + 1) to " +
                     std::to_string(kMaxTexels));
    if (options.splits > gpu::kMaxSplits)
        return usage("shadows.splits is above " + std::to_string(gpu::kMaxSplits));
    if (!(options.error_bias >= 1) || !std::isfinite(options.error_bias))
        return usage("shadows.error_bias is not 1 or more");
    if (!isLength(options.split_near) || !isLength(options.split_far) ||
        options.split_near >= options.split_far)
        return usage("shadows.split_near and split_far are not above 0, one after the other");
    if (!(options.split_blend >= 0 && options.split_blend <= 1))
        return usage("shadows.split_blend is not from 0 to 1");
    if (!isLength(options.spot_near))
        return usage("shadows.spot_near is not above 0");
    if (options.depth_bits != 16 && options.depth_bits != 32)
        return usage("shadows.depth_bits is neither 16 nor 32");
    if (options.casters > HEARTH_CASTERS_PROXIES)
        return usage("shadows.casters is none of HEARTH_CASTERS_*");
    if (options.moving_layers > 1)
        return usage("shadows.moving_layers is neither 0 nor 1");
    return success();
}

} // namespace

Result<gpu::ShadowOptions> shadowOptions(const hearth_shadow_options& options)
{
    if (options.max_maps == 0)
        return gpu::ShadowOptions{};
    HEARTH_TRY(check(options));
    return gpu::ShadowOptions{
        .max_maps = options.max_maps,
        .texels = options.texels,
        .kernel = options.kernel,
        .error_bias = options.error_bias,
        .splits = options.splits,
        .split_range = {.near = options.split_near, .far = options.split_far, .blend = options.split_blend},
        .moving_layers = options.moving_layers != 0,
        .spot_near = options.spot_near,
        .depth = options.depth_bits == 16 ? gpu::ShadowDepth::d16 : gpu::ShadowDepth::d32,
        .casters = static_cast<gpu::Casters>(options.casters)};
}

Status makeShadowSpheres(hearth_scene& scene, const hearth_frame& frame)
{
    static_assert(HEARTH_ALL_LIGHTS == gpu::ShadowSphere::kAllLights);
    scene.shadow_spheres.clear();
    for (uint32_t i = 0; i < frame.shadow_sphere_count; ++i)
    {
        const hearth_shadow_sphere& sphere = frame.shadow_spheres[i];
        const Float3 center{sphere.center[0], sphere.center[1], sphere.center[2]};
        if (!isFinite(center) || !isLength(sphere.radius))
            return usage("shadow sphere " + std::to_string(i) + " is not finite with a radius above 0");
        scene.shadow_spheres.push_back(
            {.center = center, .radius = sphere.radius, .light = sphere.light, .texels = sphere.texels});
    }
    if (scene.scene->shadows != nullptr)
        scene.scene->shadows->reserveSpheres(scene.shadow_spheres.size());
    return success();
}

} // namespace hearth::c

using namespace hearth;
using namespace hearth::c;

hearth_result hearth_scene_get_shadow_counters(const hearth_scene* scene, hearth_shadow_counters* counters)
{
    if (scene == nullptr)
        return HEARTH_ERROR_USAGE;
    return call(scene->renderer->message(), __func__,
                [&]() -> Status
                {
                    HEARTH_TRY(checkStruct("counters", counters));
                    if (scene->scene->shadows == nullptr)
                        return usage("the scene has no shadows");
                    const gpu::ShadowStatistics& last = scene->scene->shadows->statistics();
                    *counters = {.struct_size = sizeof(*counters),
                                 .maps = last.maps,
                                 .drawn_maps = last.drawn_maps,
                                 .moved_maps = last.moved_maps,
                                 .dropped_maps = last.dropped_maps,
                                 .unshadowed_lights = last.unshadowed_lights,
                                 .depth_bits = gpu::depthBits(scene->scene->shadows->depth().depth),
                                 .shadowed_lights = last.shadowed_lights,
                                 .unseen_maps = last.unseen_maps};
                    return success();
                });
}
