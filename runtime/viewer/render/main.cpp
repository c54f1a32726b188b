// hearth-render: draws a pack into a PNG file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/program.h"
#include "runtime/gpu/cull_statistics_pass.h"
#include "runtime/pack/pack.h"
#include "runtime/viewer/animation.h"
#include "runtime/viewer/camera_path.h"
#include "runtime/viewer/file_output.h"
#include "runtime/viewer/frame_report.h"
#include "runtime/viewer/page_reading.h"
#include "runtime/viewer/pyramid_start.h"
#include "runtime/viewer/render/options.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>

namespace hearth::viewer
{

namespace
{

/// The texels of the finished picture, at the size that was asked for.
Result<std::vector<std::byte>> readPicture(VulkanHost& host, const gpu::Renderer& renderer,
                                           const gpu::FrameTargets& targets, uint32_t samples)
{
    HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> pixels, host.read(renderer.device(), targets.color(), 4));
    if (samples == 1)
        return pixels;
    return downsampleSrgb(pixels, targets.extent().width, targets.extent().height);
}

/// One for each frame.
Result<std::vector<shared::Camera>> chooseCameras(const RenderOptions& options, const formats::PackView& pack,
                                                  const pack::PosePlayer& player)
{
    if (!options.camera_path.empty())
        return readCameraPath(options.camera_path);
    HEARTH_ASSIGN_OR_RETURN(const shared::Camera camera, chooseCamera(options, pack, player));
    return std::vector<shared::Camera>(options.frames, camera);
}

/// The error is meant in pixels of the picture, not of its samples.
FrameSettings settingsOfSamples(const RenderOptions& options, VkExtent2D extent)
{
    FrameSettings settings = options.settings;
    settings.error_pixels *= static_cast<float>(extent.width) / static_cast<float>(options.width);
    return settings;
}

void warnAboutLimits(const gpu::Scene& scene, const VisibleList& list, const std::string& name)
{
    if (list.counters.dropped_clusters > 0)
        printError({Issue::degraded, name, "",
                    std::to_string(list.counters.dropped_clusters) +
                        " clusters are more than the visible list holds and are not drawn"});
    if (scene.dropped_lights > 0)
        printError({Issue::degraded, name, "",
                    std::to_string(scene.dropped_lights) + " lights are more than the " +
                        std::to_string(shared::kMaxLights) + " that are drawn"});
}

void warnAboutShadows(const ShadowCounts& counts, const std::string& name)
{
    const auto warn = [&](uint64_t count, const char* what)
    {
        if (count > 0)
            printError({Issue::degraded, name, "", std::to_string(count) + what});
    };
    warn(counts.maps.dropped_maps, " shadow maps are more than there is room for (--shadows maps=N)");
    warn(counts.maps.unshadowed_lights, " lights cast no shadow: they are more than there are maps for");
    warn(counts.dropped_clusters, " clusters are more than the visible list holds and cast no shadow");
}

/// Draws the frames of one run, and writes what was asked for.
class Run
{
public:
    Run(const RenderOptions& options, const formats::PackView& pack, Animation& animation, VulkanHost& host,
        const gpu::Renderer& renderer, const gpu::Scene& scene, gpu::FrameTargets& targets,
        VkQueryPool timestamps)
        : options_(options),
          pack_(pack),
          animation_(animation),
          host_(host),
          renderer_(renderer),
          scene_(scene),
          targets_(targets),
          timestamps_(timestamps),
          settings_(settingsOfSamples(options, targets.extent()))
    {
    }

    /// Streams until a frame of this camera has all that it wants.
    Status prefetch(const shared::Camera& camera)
    {
        // 256 frames fill the largest pool, 60 raise the error scale to its most: what takes longer does not rest
        constexpr uint64_t kMostFrames = 1000;
        const shared::FrameView view = frameOf(camera).view;
        const uint64_t first = serial_ + 1;
        HEARTH_TRY(animation_.update(scene_));
        while (scene_.stream->settledSerial() < first && serial_ < first + kMostFrames)
        {
            beginFrame();
            HEARTH_TRY(host_.run(
                [&](VkCommandBuffer commands)
                {
                    renderer_.recordPrefetch(commands, scene_, targets_, view, animation_.moves(),
                                             animation_.poses());
                    return success();
                }));
        }
        return success();
    }

    /// Lets the light of bricks settle, where the picture shows it.
    Status settle(const shared::Camera& camera)
    {
        if (scene_.bricks == nullptr || !(settings_.bricks_light || gpu::showsBricks(settings_.view)))
            return success();
        for (uint32_t i = 0; i < options_.gi_frames; ++i)
            HEARTH_TRY(draw(camera, 0));
        times_.clear();
        return success();
    }

    Status draw(const shared::Camera& camera, size_t number)
    {
        gpu::FrameInput frame = frameOf(camera);
        frame.timestamps = timestamps_;
        animation_.goTo(number);
        HEARTH_TRY(animation_.update(scene_));
        frame.moves = animation_.moves();
        frame.poses = animation_.poses();
        beginFrame();
        if (options_.pyramid == PyramidStart::none)
            targets_.setPyramidView({});
        if (options_.pyramid == PyramidStart::noise)
            HEARTH_TRY(writeNoise(host_, renderer_.device(), targets_, shared::makeOcclusionView(frame.view),
                                  options_.noise_seed + static_cast<uint32_t>(number)));
        HEARTH_TRY(host_.run(
            [&](VkCommandBuffer commands)
            {
                renderer_.record(commands, scene_, targets_, frame);
                return success();
            }));
        HEARTH_ASSIGN_OR_RETURN(std::vector<double> stamps,
                                host_.readTimestamps(timestamps_, gpu::kTimestampCount));
        times_.push_back(std::move(stamps));
        return success();
    }

    /// The last frame that was drawn, into `picture` and `visibility` where they are named.
    Status write(const std::string& picture_file, const std::string& visibility_file)
    {
        HEARTH_ASSIGN_OR_RETURN(const VisibleList list, readVisibleList(host_, renderer_, scene_));
        warnAboutLimits(scene_, list, pack_.name());
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> picture,
                                readPicture(host_, renderer_, targets_, options_.samples));
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> png,
                                encodePng(picture, options_.width, options_.height));
        HEARTH_TRY(writeFile(picture_file, png));
        if (!options_.stats.empty())
            HEARTH_TRY(count(list));
        if (scene_.stream != nullptr)
        {
            HEARTH_ASSIGN_OR_RETURN(const StreamCounts counts,
                                    countStreaming(host_, renderer_, scene_, serial_));
            streaming_.push_back(counts);
        }
        if (!options_.stats.empty() && scene_.deformation != nullptr)
        {
            HEARTH_ASSIGN_OR_RETURN(skinning_, readSkinning(host_, renderer_, scene_));
        }
        if (scene_.shadows != nullptr)
        {
            HEARTH_ASSIGN_OR_RETURN(const ShadowCounts counts, countShadows(host_, renderer_, scene_));
            warnAboutShadows(counts, pack_.name());
            shadows_.push_back(counts);
        }
        if (visibility_file.empty())
            return success();
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> pixels,
                                host_.read(renderer_.device(), targets_.visibility(), 4));
        return writeFile(visibility_file,
                         formatVisibility(list, pixels, targets_.extent().width, targets_.extent().height));
    }

    Status writeStats() const
    {
        if (options_.stats.empty())
            return success();
        const FrameReport report{
            .device = host_.deviceName(),
            .width = targets_.extent().width,
            .height = targets_.extent().height,
            .error_pixels = options_.settings.error_pixels,
            .scene_bytes = scene_.arena.allocatedBytes() +
                           (scene_.stream == nullptr ? 0 : scene_.stream->allocatedBytes()),
            .target_bytes = targets_.allocatedBytes(),
            .dropped_lights = scene_.dropped_lights,
            .frames = frames_,
            .streaming = streaming_,
            .shadows = shadows_,
            .skinning = skinning_,
            .bricks = scene_.bricks == nullptr ? std::nullopt : std::optional(countBricks(scene_, targets_)),
            .milliseconds = medianPassTimes(times_)};
        const std::string text = formatReport(report, pack_);
        return writeFile(options_.stats, std::as_bytes(std::span(text)));
    }

private:
    gpu::FrameInput frameOf(const shared::Camera& camera) const
    {
        gpu::FrameInput frame = makeFrame(settings_, camera, scene_.instance_count, targets_.extent());
        frame.shadow_spheres = options_.shadows.spheres;
        return frame;
    }

    /// Add what the last frame drew, and what it did not, to the statistics.
    Status count(const VisibleList& list)
    {
        const gpu::Device& device = renderer_.device();
        HEARTH_ASSIGN_OR_RETURN(const gpu::CullStatisticsPass pass,
                                gpu::CullStatisticsPass::create(device, scene_));
        HEARTH_TRY(host_.run(
            [&](VkCommandBuffer commands)
            {
                pass.record(device, commands, scene_);
                return success();
            }));
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, host_.read(device, pass.statistics()));
        shared::CullStatistics statistics;
        std::memcpy(&statistics, bytes.data(), sizeof(statistics));
        HEARTH_ASSIGN_OR_RETURN(
            const uint64_t shaded_area,
            readShadedArea(host_, renderer_, scene_, targets_.extent(), options_.settings.shaded_area));
        const std::span slots(list.slots);
        const uint64_t early =
            countTriangles(pack_, slots.first(std::min<size_t>(slots.size(), list.counters.early_clusters)));
        const uint64_t drawn = countTriangles(pack_, slots);
        frames_.push_back({.drawn_clusters = slots.size(),
                           .early_clusters = list.counters.early_clusters,
                           .dropped_clusters = list.counters.dropped_clusters,
                           .drawn_triangles = drawn,
                           .shaded_area = shaded_area,
                           .culling = makeCullReport(statistics, list.counters, early, drawn)});
        return success();
    }

    /// Each frame is waited for before the next begins.
    void beginFrame()
    {
        if (scene_.stream != nullptr)
            scene_.stream->beginFrame(serial_ + 1, serial_);
        ++serial_;
    }

    const RenderOptions& options_;
    const formats::PackView& pack_;
    Animation& animation_;
    VulkanHost& host_;
    const gpu::Renderer& renderer_;
    const gpu::Scene& scene_;
    gpu::FrameTargets& targets_;
    VkQueryPool timestamps_;
    FrameSettings settings_;
    std::vector<std::vector<double>> times_;
    std::vector<FrameCounts> frames_; ///< of those that were written
    std::vector<StreamCounts> streaming_;
    std::vector<ShadowCounts> shadows_;
    std::optional<SkinningCounts> skinning_;
    uint64_t serial_ = 0; ///< of the last frame
};

/// Reads at once.
pack::PageReader pageReader(const formats::PackView& pack)
{
    return [&pack](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
    { done(readPage(pack, page, destination)); };
}

gpu::SceneOptions sceneOptions(const RenderOptions& options, const formats::PackView& pack,
                               std::span<const shared::Camera> cameras)
{
    gpu::SceneOptions scene;
    scene.geometry_budget = options.geometry_budget;
    scene.stream = {.read = pageReader(pack), .frames_in_flight = 1};
    scene.shadows = fitShadows(options.shadows, pack, cameras);
    return scene;
}

Status drawPack(const RenderOptions& options, const formats::PackView& pack, VulkanHost& host)
{
    HEARTH_TRY(checkPack(options, pack));
    HEARTH_ASSIGN_OR_RETURN(Animation animation, Animation::create(options.animation, pack));
    animation.goTo(0);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<shared::Camera> cameras,
                            chooseCameras(options, pack, animation.player()));
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<gpu::Renderer> renderer,
                            gpu::Renderer::create(host.description()));
    if (options.settings.view == shared::kViewOverdraw)
        HEARTH_TRY(renderer->prepareOverdraw());
    std::unique_ptr<gpu::Scene> scene;
    HEARTH_TRY(host.run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(scene,
                                    renderer->upload(pack, commands, sceneOptions(options, pack, cameras)));
            return success();
        }));
    scene->staging.reset();

    const uint32_t scale = options.samples == 4 ? 2 : 1;
    HEARTH_ASSIGN_OR_RETURN(gpu::FrameTargets targets,
                            renderer->createTargets({options.width * scale, options.height * scale}));
    HEARTH_ASSIGN_OR_RETURN(const VkQueryPool timestamps, host.createTimestamps(gpu::kTimestampCount));
    Run run(options, pack, animation, host, *renderer, *scene, targets, timestamps);
    if (scene->stream != nullptr && options.camera_path.empty())
        HEARTH_TRY(run.prefetch(cameras.front()));
    HEARTH_TRY(run.settle(cameras.front()));
    for (size_t i = 0; i < cameras.size(); ++i)
    {
        HEARTH_TRY(run.draw(cameras[i], i));
        const auto file = [&](const std::string& name)
        { return options.camera_path.empty() || name.empty() ? name : numberedFile(name, i); };
        if (!options.camera_path.empty() || i + 1 == cameras.size())
            HEARTH_TRY(run.write(file(options.output), file(options.visibility)));
    }
    return run.writeStats();
}

Status nameDevice(const RenderOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(
        const std::unique_ptr<VulkanHost> host,
        VulkanHost::create({.device_name = options.device, .validate = options.validate}));
    // what a device lacks, the renderer says
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<gpu::Renderer> renderer,
                            gpu::Renderer::create(host->description()));
    std::printf("%s%s\n", host->deviceName().c_str(), host->software() ? " (software)" : "");
    return success();
}

Status render(const RenderOptions& options)
{
    if (options.names_device)
        return nameDevice(options);
    HEARTH_ASSIGN_OR_RETURN(const pack::Pack pack, pack::Pack::open(options.pack));
    HEARTH_ASSIGN_OR_RETURN(
        const std::unique_ptr<VulkanHost> host,
        VulkanHost::create({.device_name = options.device, .validate = options.validate}));
    if (options.verbose)
        std::fprintf(stderr, "drawing with %s%s\n", host->deviceName().c_str(),
                     host->software() ? " (software)" : "");
    const Status drawn = drawPack(options, pack.view(), *host);
    const Status validated = host->printMessages();
    return drawn.ok() ? validated : drawn;
}

} // namespace

int runRender(std::span<const char* const> arguments)
{
    return runCommand(parseRenderOptions(arguments), renderHelp(), render);
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
