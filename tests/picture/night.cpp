// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/night.h"

#include "formats/base/assert.h"
#include "runtime/gpu/scene/scene_shadows.h"
#include "runtime/viewer/animation.h"
#include "runtime/viewer/frame_settings.h"
#include "runtime/viewer/sample_sum.h"
#include "tests/picture/radiance_image.h"
#include "tests/picture/scenes.h"
#include "tests/reference/tracer/path_tracer.h"

#include <algorithm>
#include <cstring>

namespace hearth::picture
{

namespace
{

/// Error of the geometry in pixels of the image, a tenth of the default: it adds 0.011 to the FLIP of the
/// market by itself, and has benches of its own.
constexpr float kErrorPixels = 0.1f;

/// Make the sky of a scene black, before its first frame: the scene has no bricks and nothing baked.
void blackenSky(gpu::Scene& scene)
{
    HEARTH_ASSERT(scene.bricks == nullptr && !gpu::hasSkyVisibility(scene));
    const gpu::LightBufferLayout layout = scene.lights->layout();
    const std::span<const shared::Light> lights = scene.lights->lights();
    *scene.lights = gpu::SceneLights(
        layout, {.exposure = scene.lights->exposure(), .lights = {lights.begin(), lights.end()}});
    scene.lights->fill(scene.tables->lighting, {}, 0, false);
}

Result<std::unique_ptr<gpu::Scene>> uploadNight(viewer::VulkanHost& host, gpu::Renderer& renderer,
                                                const formats::PackView& pack,
                                                const gpu::ShadowOptions& shadows)
{
    std::unique_ptr<gpu::Scene> scene;
    HEARTH_TRY(host.run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(
                scene, renderer.upload(
                           pack, commands,
                           {.max_lights = static_cast<uint32_t>(pack.lights().size()), .shadows = shadows}));
            return success();
        }));
    scene->staging.reset();
    blackenSky(*scene);
    return scene;
}

/// Average blocks of pixels as hearth-render averages samples.
reference::Image averageSamples(std::span<const std::byte> rgba, uint32_t width, uint32_t height)
{
    viewer::SampleSum sum(width, height, kOversampling);
    sum.add(rgba);
    const std::vector<std::byte> average = sum.average();
    reference::Image image(width, height);
    for (size_t i = 0; i < size_t{width} * height; ++i)
        std::memcpy(&image.rgb[3 * i], &average[4 * i], 3);
    return image;
}

} // namespace

Result<DrawnNight> drawNight(viewer::VulkanHost& host, gpu::Renderer& renderer, const formats::PackView& pack,
                             const NightView& view, const gpu::ShadowOptions& shadows)
{
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<gpu::Scene> scene,
                            uploadNight(host, renderer, pack, shadows));
    const VkExtent2D extent{view.width * kOversampling, view.height * kOversampling};
    viewer::FrameSettings settings;
    settings.error_pixels = kErrorPixels * float{kOversampling};
    HEARTH_ASSIGN_OR_RETURN(gpu::FrameTargets targets,
                            renderer.createTargets(extent, viewer::targetOptions(settings, *scene, extent)));
    HEARTH_ASSIGN_OR_RETURN(viewer::Animation animation,
                            viewer::Animation::create({.seconds = view.seconds}, pack));
    animation.goTo(0);
    viewer::FrameLights lights;
    HEARTH_TRY(lights.add(animation.lights(), *scene));
    gpu::FrameInput input = viewer::makeFrame(settings, view.camera, scene->instance_count, extent);
    input.lights = lights.changes();
    HEARTH_TRY(host.run(
        [&](VkCommandBuffer commands)
        {
            renderer.record(commands, *scene, targets, input);
            return success();
        }));
    HEARTH_TRY(host.printMessages());
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> color,
                            host.read(renderer.device(), targets.color(), 4));
    DrawnNight night{averageSamples(color, view.width, view.height), {}};
    if (scene->shadows != nullptr)
        for (const shared::ShadowLights::Holder& holder : scene->shadows->holders())
            night.casting.push_back(holder.slot);
    return night;
}

Result<reference::Image> traceNight(const formats::PackView& pack, const NightView& view,
                                    const std::vector<uint32_t>& casting)
{
    HEARTH_ASSIGN_OR_RETURN(const reference::PackGeometry geometry, reference::PackGeometry::decode(pack));
    HEARTH_ASSIGN_OR_RETURN(const reference::TextureSet textures, reference::TextureSet::load(pack));
    reference::ShadedScene scene(geometry, textures, nullptr);
    reference::SceneLighting lighting = reference::readLighting(pack, view.seconds);
    for (size_t i = 0; i < lighting.lights.size(); ++i)
        lighting.lights[i].casts_shadows = std::find(casting.begin(), casting.end(), i) != casting.end();
    scene.setLighting(std::move(lighting));
    const uint32_t width = view.width * kOversampling, height = view.height * kOversampling;
    // VulkanHost leaves anisotropic filtering out on software devices
    const auto filter = reference::TextureFilter::isotropic;
    const RadianceImage radiance{width, height,
                                 reference::tracePaths(scene, {.camera = view.camera,
                                                               .width = width,
                                                               .height = height,
                                                               .samples = 1,
                                                               .through_centers = true,
                                                               .filter = filter,
                                                               .occlusion = reference::Occlusion::lights})};
    return develop(radiance, kOversampling);
}

} // namespace hearth::picture
