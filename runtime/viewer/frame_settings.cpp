// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/frame_settings.h"

#include "formats/gpu_shared/debug_views.h"
#include "formats/gpu_shared/shading.h"

#include <array>

namespace hearth::viewer
{

std::span<const Named<uint32_t>> viewNames()
{
    static constexpr auto kViews = []
    {
        std::array<Named<uint32_t>, shared::kDebugViews.size()> views{};
        for (size_t i = 0; i < views.size(); ++i)
            views[i] = {shared::kDebugViews[i].name, shared::kDebugViews[i].number};
        return views;
    }();
    return kViews;
}

std::span<const Named<gpu::ShadedArea>> shadedAreaNames()
{
    static constexpr Named<gpu::ShadedArea> kAreas[] = {
        {"automatic", gpu::ShadedArea::automatic},
        {"frame", gpu::ShadedArea::wholeFrame},
        {"tiles", gpu::ShadedArea::tiles},
    };
    return kAreas;
}

std::span<const Named<std::optional<gpu::FrameWay>>> frameWayNames()
{
    static constexpr Named<std::optional<gpu::FrameWay>> kWays[] = {{"automatic", {}},
                                                                    {"merged", gpu::FrameWay::merged},
                                                                    {"separate", gpu::FrameWay::separate},
                                                                    {"one-set", gpu::FrameWay::one_set}};
    return kWays;
}

std::span<const Named<gpu::MaterialTest>> materialTestNames()
{
    static constexpr Named<gpu::MaterialTest> kTests[] = {{"depth", gpu::MaterialTest::depth},
                                                          {"id", gpu::MaterialTest::id}};
    return kTests;
}

std::span<const Named<gpu::LightMethod>> lightMethodNames()
{
    static constexpr auto kMethods = []
    {
        std::array<Named<gpu::LightMethod>, gpu::kLightMethodCount> methods{};
        for (size_t i = 0; i < methods.size(); ++i)
            methods[i] = {gpu::kLightMethods[i].name, static_cast<gpu::LightMethod>(i)};
        return methods;
    }();
    return kMethods;
}

std::span<const Named<gpu::LightLister>> lightListerNames()
{
    static constexpr Named<gpu::LightLister> kListers[] = {{"gpu", gpu::LightLister::gpu},
                                                           {"cpu", gpu::LightLister::cpu}};
    return kListers;
}

std::span<const Named<gpu::ReceiverUpdate>> receiverUpdateNames()
{
    static constexpr Named<gpu::ReceiverUpdate> kUpdates[] = {{"compute", gpu::ReceiverUpdate::compute},
                                                              {"points", gpu::ReceiverUpdate::points}};
    return kUpdates;
}

std::span<const Named<uint32_t>> ambientOcclusionNames()
{
    static constexpr Named<uint32_t> kModes[] = {{"exact", shared::kAmbientOcclusionExact},
                                                 {"smoothstep", shared::kAmbientOcclusionSmoothstep},
                                                 {"quadratic", shared::kAmbientOcclusionQuadratic},
                                                 {"off", shared::kAmbientOcclusionOff}};
    return kModes;
}

std::span<const Named<uint32_t>> specularOcclusionNames()
{
    static constexpr Named<uint32_t> kModes[] = {{"fit", shared::kSpecularOcclusionFit},
                                                 {"table", shared::kSpecularOcclusionTable},
                                                 {"off", shared::kSpecularOcclusionOff}};
    return kModes;
}

std::span<const Named<uint32_t>> cullTestNames()
{
    static constexpr Named<uint32_t> kTests[] = {{"instances", shared::kCullInstances},
                                                 {"frustum", shared::kCullFrustum},
                                                 {"cone", shared::kCullCone},
                                                 {"occlusion", shared::kCullOcclusion}};
    return kTests;
}

bool needsBloomLevels(const FrameSettings& settings)
{
    return settings.post.bloom.strength > 0 || settings.post.automatic_exposure.has_value();
}

namespace
{

gpu::PostSupport postSupport(const FrameSettings& settings)
{
    if (settings.keeps_radiance)
        return gpu::PostSupport::half;
    if (needsBloomLevels(settings) || settings.render_size)
        return gpu::PostSupport::packed;
    return isNeutral(settings.post) ? gpu::PostSupport::none : gpu::PostSupport::in_tile;
}

} // namespace

uint32_t lightPaths(const FrameSettings& settings)
{
    const gpu::LightMethodFacts& facts = gpu::lightMethodFacts(settings.light_method);
    const gpu::LightPath path = facts.path;
    if (path == gpu::LightPath::materials)
        return 0;
    if (facts.approximates)
        return gpu::lightPathBit(path) | gpu::lightPathBit(gpu::lightMethodFacts(kExactMethod).path);
    const bool leaves_tile = needsBloomLevels(settings) || settings.keeps_radiance || settings.render_size;
    return gpu::lightPathBit(
        path == gpu::LightPath::surfaces_on_tile && leaves_tile ? gpu::LightPath::surfaces : path);
}

gpu::RendererOptions rendererOptions(const FrameSettings& settings)
{
    // the pyramid for the next frame is made of the depth
    return {.way = settings.way,
            .materials = settings.material_test.value_or(
                settings.occludes_by_last_frame ? gpu::MaterialTest::id : gpu::MaterialTest::depth),
            .post = postSupport(settings),
            .deferred = gpu::lightMethodFacts(settings.light_method).path != gpu::LightPath::materials,
            .receiver_update = settings.receiver_update};
}

gpu::TargetOptions targetOptions(const FrameSettings& settings, const gpu::Scene& scene, VkExtent2D output,
                                 bool keeps_visibility)
{
    const bool gathers = scene.bricks != nullptr;
    return {.occlusion = (settings.cull_flags & shared::kCullOcclusion) == 0 ? gpu::OcclusionCulling::off
                         : settings.occludes_by_last_frame ? gpu::OcclusionCulling::last_frame
                                                           : gpu::OcclusionCulling::two_phase,
            .keeps_visibility = keeps_visibility,
            .gathers_light = gathers,
            .may_split = gathers || gpu::shadesTiles(scene, settings.shaded_area) ||
                         needPixels(gpu::lightMethodFacts(settings.light_method).areas),
            .counts_missing = settings.occludes_by_last_frame,
            .may_bloom = needsBloomLevels(settings),
            .output = output,
            .keeps_radiance = settings.keeps_radiance,
            .light_paths = lightPaths(settings),
            .has_temporal_filter = settings.is_filtered};
}

gpu::FrameInput makeFrame(const FrameSettings& settings, const shared::Camera& camera,
                          uint32_t instance_count, VkExtent2D extent)
{
    shared::FrameView view = shared::makeFrameView(camera, extent.width, extent.height, settings.error_pixels,
                                                   instance_count, settings.cull_flags);
    if (!shared::isOrthographic(view)) // errors of others count equally at all distances
    {
        const Status curve = shared::setLodCurve(view, settings.lod_curve);
        HEARTH_ASSERT(curve.ok()); // settings are checked when they are parsed
    }
    return {.view = view,
            .shading = {.debug_view = settings.view,
                        .depth_scale = length(camera.target - camera.position),
                        .area = settings.shaded_area,
                        .ambient_occlusion = settings.ambient_occlusion,
                        .specular_occlusion = settings.specular_occlusion,
                        .gi = settings.gi,
                        .light_method = settings.light_method,
                        .light_lister = settings.light_lister,
                        .post = settings.post},
            .occludes_by_last_frame = settings.occludes_by_last_frame};
}

} // namespace hearth::viewer
