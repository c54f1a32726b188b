// hearth-render: draws a pack into a PNG file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/program.h"
#include "runtime/pack/pack.h"
#include "runtime/viewer/camera_fit.h"
#include "runtime/viewer/file_output.h"
#include "runtime/viewer/frame_report.h"
#include "runtime/viewer/options.h"
#include "runtime/viewer/pyramid_start.h"

#include <cstdio>
#include <memory>

namespace hearth::viewer
{

namespace
{

void print(const Error& error)
{
    std::fprintf(stderr, "%s\n", formatMessage(error).c_str());
}

/// The texels of the finished picture, at the size that was asked for.
Result<std::vector<std::byte>> readPicture(VulkanHost& host, const gpu::Renderer& renderer,
                                           const gpu::FrameTargets& targets, uint32_t samples)
{
    HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> pixels, host.read(renderer.device(), targets.color(), 4));
    if (samples == 1)
        return pixels;
    return downsampleSrgb(pixels, targets.extent().width, targets.extent().height);
}

Result<shared::Camera> chooseCamera(const RenderOptions& options, const formats::PackView& pack)
{
    if (options.camera)
        return *options.camera;
    if (!options.scene_camera)
        return fitCamera(pack, static_cast<float>(options.width) / static_cast<float>(options.height));
    const std::span<const formats::CameraRecord> cameras = pack.cameras();
    if (*options.scene_camera >= cameras.size())
        return Error{Issue::usage, pack.name(), "",
                     "--scene-camera " + std::to_string(*options.scene_camera) + ": the pack has " +
                         std::to_string(cameras.size()) + " cameras"};
    if (cameras[*options.scene_camera].type != static_cast<uint32_t>(formats::CameraType::perspective))
        return Error{Issue::usage, pack.name(), "", "--scene-camera: only perspective cameras can be drawn"};
    return sceneCamera(pack, *options.scene_camera);
}

/// Where the eye is, and what is decided and shown.
gpu::FrameInput makeFrame(const RenderOptions& options, const shared::Camera& camera,
                          const formats::PackView& pack, VkExtent2D extent)
{
    // the error is meant in pixels of the picture, not of its samples
    const float error =
        options.error_pixels * static_cast<float>(extent.width) / static_cast<float>(options.width);
    shared::FrameView view =
        shared::makeFrameView(camera, extent.width, extent.height, error,
                              static_cast<uint32_t>(pack.instances().size()), options.cull_flags);
    const Status curve = shared::setLodCurve(view, options.lod_curve);
    HEARTH_ASSERT(curve.ok()); // the options have been checked
    return {.view = view,
            .shading = {.shown = options.view, .depth_scale = length(camera.target - camera.position)}};
}

void warnAboutLimits(const gpu::Scene& scene, const VisibleList& list, const std::string& name)
{
    if (list.counters.dropped_clusters > 0)
        print({Issue::degraded, name, "",
               std::to_string(list.counters.dropped_clusters) +
                   " clusters are more than the visible list holds and are not drawn"});
    if (scene.dropped_lights > 0)
        print({Issue::degraded, name, "",
               std::to_string(scene.dropped_lights) + " lights are more than the " +
                   std::to_string(shared::kMaxLights) + " that are drawn"});
}

Status drawPack(const RenderOptions& options, const formats::PackView& pack, VulkanHost& host)
{
    HEARTH_ASSIGN_OR_RETURN(const shared::Camera camera, chooseCamera(options, pack));
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<gpu::Renderer> renderer,
                            gpu::Renderer::create(host.description()));
    std::unique_ptr<gpu::Scene> scene;
    HEARTH_TRY(host.run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(scene, renderer->upload(pack, commands));
            return success();
        }));
    scene->staging.reset();

    const uint32_t scale = options.samples == 4 ? 2 : 1;
    const VkExtent2D extent{options.width * scale, options.height * scale};
    HEARTH_ASSIGN_OR_RETURN(gpu::FrameTargets targets, renderer->createTargets(extent));
    gpu::FrameInput frame = makeFrame(options, camera, pack, extent);
    HEARTH_ASSIGN_OR_RETURN(frame.timestamps, host.createTimestamps(gpu::kTimestampCount));
    std::vector<std::vector<double>> times;
    for (uint32_t i = 0; i < options.frames; ++i)
    {
        if (options.pyramid == PyramidStart::none)
            targets.setPyramidView({});
        if (options.pyramid == PyramidStart::noise)
            HEARTH_TRY(writeNoise(host, renderer->device(), targets, shared::makeOcclusionView(frame.view),
                                  options.noise_seed + i));
        HEARTH_TRY(host.run(
            [&](VkCommandBuffer commands)
            {
                renderer->record(commands, *scene, targets, frame);
                return success();
            }));
        HEARTH_ASSIGN_OR_RETURN(std::vector<double> stamps,
                                host.readTimestamps(frame.timestamps, gpu::kTimestampCount));
        times.push_back(std::move(stamps));
    }

    HEARTH_ASSIGN_OR_RETURN(const VisibleList list, readVisibleList(host, *renderer, *scene));
    warnAboutLimits(*scene, list, pack.name());
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> picture,
                            readPicture(host, *renderer, targets, options.samples));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> png,
                            encodePng(picture, options.width, options.height));
    HEARTH_TRY(writeFile(options.output, png));
    if (!options.visibility.empty())
    {
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> pixels,
                                host.read(renderer->device(), targets.visibility(), 4));
        HEARTH_TRY(
            writeFile(options.visibility, formatVisibility(list, pixels, extent.width, extent.height)));
    }
    if (!options.stats.empty())
    {
        const FrameReport report{.device = host.deviceName(),
                                 .width = extent.width,
                                 .height = extent.height,
                                 .error_pixels = options.error_pixels,
                                 .drawn_clusters = list.slots.size(),
                                 .early_clusters = list.counters.early_clusters,
                                 .dropped_clusters = list.counters.dropped_clusters,
                                 .drawn_triangles = countTriangles(pack, list),
                                 .scene_bytes = scene->arena.allocatedBytes(),
                                 .target_bytes = targets.allocatedBytes(),
                                 .dropped_lights = scene->dropped_lights,
                                 .milliseconds = medianPassTimes(times)};
        const std::string text = formatReport(report, pack);
        HEARTH_TRY(writeFile(options.stats, std::as_bytes(std::span(text))));
    }
    return success();
}

Status render(const RenderOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const pack::Pack pack, pack::Pack::open(options.pack));
    HEARTH_ASSIGN_OR_RETURN(
        const std::unique_ptr<VulkanHost> host,
        VulkanHost::create({.device_name = options.device, .validate = options.validate}));
    if (options.verbose)
        std::fprintf(stderr, "drawing with %s%s\n", host->deviceName().c_str(),
                     host->software() ? " (software)" : "");
    const Status drawn = drawPack(options, pack.view(), *host);
    for (const std::string& message : host->messages())
        std::fprintf(stderr, "validation: %s\n", message.c_str());
    HEARTH_TRY(drawn);
    if (!host->messages().empty())
        return Error{Issue::internal, options.pack, "",
                     "the validation layer has " + std::to_string(host->messages().size()) + " messages"};
    return success();
}

} // namespace

int runRender(std::span<const char* const> arguments)
{
    const Result<RenderOptions> options = parseOptions(arguments);
    if (options.ok() && options->help)
    {
        std::fputs(kRenderHelp, stdout);
        return 0;
    }
    const Status status = options.ok() ? render(*options) : Status(options.error());
    if (status.ok())
        return 0;
    print(status.error());
    return exitCode(status.error());
}

} // namespace hearth::viewer

int main(int argc, char** argv)
{
    return hearth::runProgram(
        "hearth-render",
        [&] {
            return hearth::viewer::runRender({argv + 1, static_cast<size_t>(argc > 0 ? argc - 1 : 0)});
        });
}
