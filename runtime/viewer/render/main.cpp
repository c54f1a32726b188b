// hearth-render: draws a pack into a PNG file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/program.h"
#include "runtime/gpu/frame/frame_text.h"
#include "runtime/gpu/statistics/cull_statistics_pass.h"
#include "runtime/gpu/statistics/light_statistics_pass.h"
#include "runtime/gpu/temporal/motion_pass.h"
#include "runtime/gpu/temporal/temporal_pass.h"
#include "runtime/pack/pack.h"
#include "runtime/viewer/animation.h"
#include "runtime/viewer/camera_path.h"
#include "runtime/viewer/contact_sheet.h"
#include "runtime/viewer/exr_output.h"
#include "runtime/viewer/file_output.h"
#include "runtime/viewer/page_reading.h"
#include "runtime/viewer/pyramid_start.h"
#include "runtime/viewer/render/options.h"
#include "runtime/viewer/report/frame_report.h"
#include "runtime/viewer/report/memory_report.h"
#include "runtime/viewer/sample_sum.h"
#include "runtime/viewer/stage.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <utility>

namespace hearth::viewer
{

namespace
{

Result<std::vector<std::byte>> encodeImage(const RenderOptions& options, std::span<const std::byte> pixels)
{
    return options.output.ends_with(".jpg") ? encodeJpeg(pixels, options.width, options.height)
                                            : encodePng(pixels, options.width, options.height);
}

/// Return one camera per frame.
Result<std::vector<shared::Camera>> chooseCameras(const RenderOptions& options, const formats::PackView& pack,
                                                  const pack::PosePlayer& player)
{
    if (!options.camera_path.empty())
        return readCameraPath(options.camera_path);
    HEARTH_ASSIGN_OR_RETURN(const shared::Camera camera, chooseCamera(options, pack, player));
    return std::vector<shared::Camera>(options.frames, camera);
}

/// Return the settings of the frame. The error is in pixels of the output, not of its samples. On a sheet GI
/// is off: the bricks belong to all assets at once.
FrameSettings frameSettings(const RenderOptions& options, bool on_sheet)
{
    FrameSettings settings = options.settings;
    settings.error_pixels *= static_cast<float>(makeSampleGrid(options.samples).scale);
    settings.gi = settings.gi && !on_sheet;
    return settings;
}

/// Return the sheet to draw; none if the scene is drawn.
Result<std::optional<Sheet>> chooseSheet(const RenderOptions& options, const formats::PackView& pack)
{
    const bool automatic = options.sheet == SheetChoice::automatic;
    if (options.sheet == SheetChoice::off || (automatic && !(fitsWholeScene(options) && areUnplaced(pack))))
        return std::optional<Sheet>();
    Result<Sheet> sheet = makeSheet(pack, options.width, options.height);
    if (sheet.ok())
        return std::optional<Sheet>(std::move(sheet).value());
    return automatic ? Result<std::optional<Sheet>>(std::optional<Sheet>()) : sheet.error();
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

void warnAboutMissing(uint64_t clusters, const std::string& name)
{
    if (clusters > 0)
        printError(
            {Issue::degraded, name, "",
             std::to_string(clusters) + " clusters come into view and are drawn late (--cull last-frame)"});
}

/// Times that the first frame gathers indirect light; later frames have its result as their history.
constexpr uint32_t kStillGathers = 6;

/// Seconds between the images of a sequence without --time-step, for automatic exposure.
constexpr float kFrameSeconds = 1.0f / 30;

/// Draws the requested frames, and writes the requested files.
class FrameRecorder
{
public:
    /// stage  null: the whole scene is shown
    FrameRecorder(const RenderOptions& options, const FrameSettings& settings, const formats::PackView& pack,
                  Animation& animation, Stage* stage, VulkanHost& host, const gpu::Renderer& renderer,
                  const gpu::Scene& scene, gpu::FrameTargets& targets, VkQueryPool timestamps)
        : options_(options),
          pack_(pack),
          animation_(animation),
          stage_(stage),
          host_(host),
          renderer_(renderer),
          scene_(scene),
          targets_(targets),
          timestamps_(timestamps),
          settings_(settings)
    {
    }

    /// Set weights of lamps, which the next frame takes. The span must live until then.
    void setLampWeights(std::span<const gpu::LampWeight> weights) { lamp_weights_ = weights; }

    /// Set the sky and the sun, which the next frame takes.
    void setDaylight(const gpu::DaylightChange& daylight) { daylight_ = daylight; }

    /// Set the view of later frames.
    void setView(uint32_t view) { settings_.view = view; }

    /// Stream until a frame of this camera has everything it needs, if geometry is streamed.
    Status prefetch(const shared::Camera& camera, size_t number)
    {
        if (scene_.stream == nullptr)
            return success();
        // 256 frames fill the largest pool, 60 raise the error scale to its maximum, and memory moves
        // some times between geometry and textures, once in so many: more frames mean it never settles
        constexpr uint64_t kMaxFrames = 2000;
        const shared::FrameView view = makeFrameInput(camera).view;
        const uint64_t first = serial_ + 1;
        HEARTH_TRY(goTo(number));
        while (scene_.stream->settledSerial() < first && serial_ < first + kMaxFrames)
        {
            beginFrame();
            HEARTH_TRY(host_.run(
                [&](VkCommandBuffer commands)
                {
                    renderer_.recordPrefetch(commands, scene_, targets_, view, moves_, poses_);
                    return success();
                }));
        }
        return success();
    }

    Status draw(const shared::Camera& camera, size_t number)
    {
        gpu::FrameInput frame = makeFrameInput(camera);
        frame.timestamps = timestamps_;
        if (frame.shading.post.automatic_exposure)
            frame.shading.post.automatic_exposure->time_step = timeStep(number);
        HEARTH_TRY(goTo(number));
        frame.moves = moves_;
        frame.poses = poses_;
        frame.lights = lights_.changes();
        frame.lamp_weights = std::exchange(lamp_weights_, {}); // weights stay
        const std::optional<gpu::DaylightChange> daylight = std::exchange(daylight_, std::nullopt);
        frame.daylight = daylight ? &*daylight : nullptr;
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
        lights_.clear();
        HEARTH_ASSIGN_OR_RETURN(std::vector<double> stamps,
                                host_.readTimestamps(timestamps_, gpu::kTimestampCount));
        times_.push_back(std::move(stamps));
        return success();
    }

    /// Create the passes of the temporal filter, if images are filtered.
    Status prepareFilter()
    {
        if (!options_.is_filtered)
            return success();
        const gpu::Device& device = renderer_.device();
        HEARTH_ASSIGN_OR_RETURN(gpu::MotionPass motion,
                                gpu::MotionPass::create(device, renderer_.layouts(), scene_));
        HEARTH_ASSIGN_OR_RETURN(gpu::TemporalPass filter,
                                gpu::TemporalPass::create(device, renderer_.layouts()));
        motion_.emplace(std::move(motion));
        filter_.emplace(std::move(filter));
        return success();
    }

    /// Draw all samples of an image, at the requested size.
    Result<SampleSum> drawImage(const shared::Camera& camera, size_t number)
    {
        if (filter_)
            return drawFiltered(camera, number);
        const SampleGrid samples = makeSampleGrid(options_.samples);
        const VkExtent2D extent = targets_.outputExtent();
        SampleSum sum(extent.width / samples.scale, extent.height / samples.scale, samples.scale);
        // automatic exposure has no light before the first frame
        if (settings_.post.automatic_exposure && times_.empty())
            HEARTH_TRY(draw(camera, number));
        for (uint32_t frame = 0; frame < samples.frames; ++frame)
        {
            HEARTH_TRY(draw(shiftCamera(camera, frame, samples.frames, extent.width, extent.height), number));
            if (writesLinear(options_))
            {
                HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> pixels,
                                        host_.readSampled(renderer_.device(), targets_.post().radiance(), 8));
                sum.addLinear(pixels);
                continue;
            }
            HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> pixels,
                                    host_.read(renderer_.device(), targets_.color(), 4));
            sum.add(pixels);
        }
        return sum;
    }

    /// Print how far the image is off that was drawn last, if its light method approximates.
    Status printDifference(const shared::Camera& camera, size_t number)
    {
        const gpu::LightMethodFacts& facts = gpu::lightMethodFacts(settings_.light_method);
        if (!facts.approximates || settings_.view != shared::kViewFinal)
            return success();
        const gpu::Device& device = renderer_.device();
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> own, host_.read(device, targets_.color(), 4));
        const gpu::LightMethod method = std::exchange(settings_.light_method, kExactMethod);
        const Status drawn = draw(camera, number);
        settings_.light_method = method;
        HEARTH_TRY(drawn);
        times_.pop_back();
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> exact, host_.read(device, targets_.color(), 4));
        uint64_t sum = 0;
        int most = 0;
        for (size_t i = 0; i < own.size(); ++i)
        {
            const int difference = std::abs(std::to_integer<int>(own[i]) - std::to_integer<int>(exact[i]));
            sum += i % 4 != 3 ? static_cast<uint64_t>(difference) : 0;
            most = std::max(most, difference);
        }
        std::printf("--lights %s is off by %.2f of 255 on average, by %d at most (--lights %s is exact)\n",
                    facts.name, static_cast<double>(sum) / (0.75 * static_cast<double>(own.size())), most,
                    gpu::lightMethodFacts(kExactMethod).name);
        return success();
    }

    /// Warn about objects that the last frame left out, and count them for the statistics.
    Status checkDropped()
    {
        HEARTH_ASSIGN_OR_RETURN(const VisibleList list, readVisibleList(host_, renderer_, scene_));
        warnAboutLimits(scene_, list, pack_.name());
        if (!options_.stats.empty())
            HEARTH_TRY(count(list));
        if (settings_.occludes_by_last_frame)
            HEARTH_TRY(countMissing());
        if (scene_.stream != nullptr)
        {
            HEARTH_ASSIGN_OR_RETURN(const StreamCounts counts,
                                    countStreaming(host_, renderer_, scene_, serial_));
            streaming_.push_back(counts);
        }
        if (!options_.stats.empty())
            HEARTH_TRY(countLights());
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
        return success();
    }

    /// Write the visible triangle of each pixel of the last frame.
    Status writeVisibility(const std::string& file)
    {
        HEARTH_ASSIGN_OR_RETURN(const VisibleList list, readVisibleList(host_, renderer_, scene_));
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> pixels,
                                host_.read(renderer_.device(), targets_.visibility(), 4));
        return writeFile(file,
                         formatVisibility(list, pixels, targets_.extent().width, targets_.extent().height));
    }

    Status writeStats(const std::optional<Sheet>& sheet) const
    {
        if (options_.stats.empty())
            return success();
        const FrameReport report{
            .device = host_.deviceName(),
            .width = targets_.extent().width,
            .height = targets_.extent().height,
            .sheet = sheet,
            .error_pixels = options_.settings.error_pixels,
            .scene_bytes = scene_.arena.allocatedBytes() +
                           (scene_.stream == nullptr ? 0 : scene_.stream->allocatedBytes()),
            .target_bytes = targets_.allocatedBytes(),
            .memory = countMemory(scene_, targets_),
            .dropped_lights = scene_.dropped_lights,
            .frames = frames_,
            .streaming = streaming_,
            .shadows = shadows_,
            .skinning = skinning_,
            .bricks = scene_.bricks == nullptr ? std::nullopt : std::optional(countBricks(scene_, targets_)),
            .receivers = scene_.receivers == nullptr ? std::nullopt : std::optional(countReceivers(scene_)),
            .lights = light_counts_,
            .milliseconds = medianPassTimes(times_)};
        const std::string text = formatReport(report, pack_);
        return writeFile(options_.stats, std::as_bytes(std::span(text)));
    }

private:
    /// Draw the frames of an image, and filter them. Images of a camera path follow one another, as in a
    /// game; before others is a cut.
    Result<SampleSum> drawFiltered(const shared::Camera& camera, size_t number)
    {
        const VkExtent2D extent = targets_.extent();
        const bool follows = number > 0 && !options_.camera_path.empty() && options_.views.empty();
        for (uint32_t frame = 0; frame < (follows ? 1 : gpu::kJitterFrames); ++frame)
        {
            const Float2 shift = gpu::jitterShift(jitter_++, extent);
            shared::Camera shifted = camera;
            shifted.shift = {camera.shift.x + shift.x, camera.shift.y + shift.y};
            HEARTH_TRY(draw(shifted, number));
            HEARTH_TRY(host_.run(
                [&](VkCommandBuffer commands)
                {
                    motion_->record(renderer_.device(), commands, scene_, targets_);
                    filter_->record(renderer_.device(), commands, targets_, !follows && frame == 0);
                    return success();
                }));
        }
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> pixels,
                                host_.read(renderer_.device(), targets_.temporal().filtered(), 4));
        SampleSum image(extent.width, extent.height, 1);
        image.add(pixels);
        return image;
    }

    /// Go to the moves, poses and lights of that image of the clip or the stage.
    Status goTo(size_t number)
    {
        animation_.goTo(number);
        HEARTH_TRY(animation_.update(scene_));
        HEARTH_TRY(lights_.add(animation_.lights(), scene_));
        moves_.assign(animation_.moves().begin(), animation_.moves().end());
        poses_ = animation_.poses();
        if (stage_ == nullptr)
            return success();
        HEARTH_ASSIGN_OR_RETURN(moves_, stage_->show(scene_, number));
        poses_ = stage_->poses(animation_.player(), number);
        return success();
    }

    gpu::FrameInput makeFrameInput(const shared::Camera& camera) const
    {
        gpu::FrameInput frame = makeFrame(settings_, camera, scene_.instance_count, targets_.extent());
        frame.shadow_spheres = options_.shadows.spheres;
        frame.gathers = times_.empty() ? kStillGathers : 1;
        return frame;
    }

    /// Return the seconds since the last frame: none between the samples of an image.
    float timeStep(size_t number)
    {
        const bool is_next = number != last_number_;
        last_number_ = number;
        const auto step = static_cast<float>(options_.animation.step_seconds);
        return is_next ? (step > 0 ? step : kFrameSeconds) : 0;
    }

    /// Add the counts of the last frame to the statistics.
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

    /// Count the lights of the last frame.
    Status countLights()
    {
        const gpu::Device& device = renderer_.device();
        HEARTH_ASSIGN_OR_RETURN(
            const gpu::LightStatisticsPass pass,
            gpu::LightStatisticsPass::create(device, renderer_.layouts(), scene_, targets_));
        HEARTH_TRY(host_.run(
            [&](VkCommandBuffer commands)
            {
                pass.record(device, commands, scene_, targets_, settings_.light_method);
                return success();
            }));
        light_counts_ = viewer::countLights(scene_, settings_.light_method);
        return success();
    }

    /// Count what the last frame left out because an earlier one hid it.
    Status countMissing()
    {
        HEARTH_TRY(host_.run(
            [&](VkCommandBuffer commands)
            {
                renderer_.recordMissing(commands, scene_, targets_);
                return success();
            }));
        HEARTH_ASSIGN_OR_RETURN(const VisibleList list, readVisibleList(host_, renderer_, scene_));
        const uint64_t missing = list.slots.size() - list.counters.early_clusters;
        warnAboutMissing(missing, pack_.name());
        if (!frames_.empty())
            frames_.back().missing_clusters = missing;
        return success();
    }

    /// Begin a frame; each frame is waited for before the next begins.
    void beginFrame()
    {
        if (scene_.stream != nullptr)
            scene_.stream->beginFrame(serial_ + 1, serial_);
        ++serial_;
    }

    const RenderOptions& options_;
    const formats::PackView& pack_;
    Animation& animation_;
    Stage* stage_;
    VulkanHost& host_;
    const gpu::Renderer& renderer_;
    const gpu::Scene& scene_;
    gpu::FrameTargets& targets_;
    VkQueryPool timestamps_;
    FrameSettings settings_;
    std::vector<gpu::InstanceMove> moves_;            ///< of the next frame
    std::span<const gpu::InstancePose> poses_{};      ///< of the next frame
    FrameLights lights_;                              ///< changes since the last frame
    std::span<const gpu::LampWeight> lamp_weights_{}; ///< of the next frame
    std::optional<gpu::DaylightChange> daylight_{};   ///< the same
    std::vector<std::vector<double>> times_;
    std::vector<FrameCounts> frames_; ///< frames that were written
    std::vector<StreamCounts> streaming_;
    std::vector<ShadowCounts> shadows_;
    std::optional<SkinningCounts> skinning_;
    LightCounts light_counts_;
    std::optional<gpu::MotionPass> motion_; ///< where images are filtered, as the next one
    std::optional<gpu::TemporalPass> filter_;
    uint32_t jitter_ = 0;    ///< number of the next frame's shift
    uint64_t serial_ = 0;    ///< of the last frame
    size_t last_number_ = 0; ///< of its image
};

/// File name for a view: "a.png" becomes "a-lod.png"; unchanged without a view name.
std::string viewFile(const std::string& path, std::string_view view)
{
    const size_t name = path.rfind('/') + 1; // npos + 1 is 0
    const size_t dot = std::max(path.rfind('.'), name);
    const size_t at = path.rfind('.') == std::string::npos || dot == name ? path.size() : dot;
    return view.empty() ? path : path.substr(0, at) + "-" + std::string(view) + path.substr(at);
}

/// Return a reader that reads synchronously.
pack::PageReader pageReader(const formats::PackView& pack)
{
    return [&pack](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
    { done(readPage(pack, page, destination)); };
}

gpu::SceneOptions sceneOptions(const RenderOptions& options, const formats::PackView& pack,
                               std::span<const shared::Camera> cameras)
{
    gpu::SceneOptions scene;
    scene.memory_budget = options.memory_budget;
    scene.stream = {.read = pageReader(pack)};
    scene.frames_in_flight = 1;
    scene.decode_textures = true;
    scene.shadows = fitShadows(options.shadows, pack, cameras);
    scene.keeps_motion = options.is_filtered;
    return scene;
}

/// Cameras of the output images; with a stage each of them shows one part of the scene alone.
struct OutputCameras
{
    std::optional<Stage> stage;
    std::vector<shared::Camera> cameras;
};

float aspectRatio(uint32_t width, uint32_t height)
{
    return static_cast<float>(width) / static_cast<float>(height);
}

Result<OutputCameras> chooseImages(const RenderOptions& options, const formats::PackView& pack,
                                   const pack::PosePlayer& player, const std::optional<Sheet>& sheet)
{
    OutputCameras images;
    if (sheet)
    {
        std::vector<formats::Range> parts;
        for (const uint32_t asset : sheet->assets)
            parts.push_back(pack.assets()[asset].instances);
        images.stage = Stage::fromInstances(pack, player, parts,
                                            aspectRatio(sheet->layout.cell_width, sheet->layout.cell_height));
    }
    else if (!options.meshes.empty())
    {
        HEARTH_ASSIGN_OR_RETURN(images.stage, Stage::fromMeshes(pack, player, options.meshes,
                                                                aspectRatio(options.width, options.height)));
    }
    if (images.stage)
        images.cameras = images.stage->cameras();
    else
    {
        HEARTH_ASSIGN_OR_RETURN(images.cameras, chooseCameras(options, pack, player));
    }
    return images;
}

std::vector<Named<uint32_t>> chooseViews(const RenderOptions& options)
{
    return options.views.empty() ? std::vector<Named<uint32_t>>{{"", options.settings.view}} : options.views;
}

/// Write an image with linear colours.
Status writeLinear(const RenderOptions& options, const std::string& file, std::span<const float> rgb)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> encoded,
                            encodeExr(rgb, options.width, options.height));
    return writeFile(file, encoded);
}

Status writeImage(const RenderOptions& options, const std::string& file, std::span<const std::byte> pixels)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> encoded, encodeImage(options, pixels));
    return writeFile(file, encoded);
}

/// Write a file per camera and view; of --frames only the last frame.
Status drawImages(const RenderOptions& options, const OutputCameras& images, FrameRecorder& run)
{
    const std::vector<shared::Camera>& cameras = images.cameras;
    const bool is_sequence = !options.camera_path.empty() || images.stage;
    if (!is_sequence)
        HEARTH_TRY(run.prefetch(cameras.front(), 0));
    for (size_t i = 0; i < cameras.size(); ++i)
        for (const Named<uint32_t>& view : chooseViews(options))
        {
            run.setView(view.value);
            if (!is_sequence && i + 1 < cameras.size())
            {
                HEARTH_TRY(run.draw(cameras[i], i));
                continue;
            }
            const auto file = [&](const std::string& name)
            {
                const std::string of_view = viewFile(name, view.name);
                return is_sequence ? numberedFile(of_view, i) : of_view;
            };
            HEARTH_ASSIGN_OR_RETURN(const SampleSum image, run.drawImage(cameras[i], i));
            HEARTH_TRY(writesLinear(options)
                           ? writeLinear(options, file(options.output), image.averageLinear())
                           : writeImage(options, file(options.output), image.average()));
            HEARTH_TRY(run.checkDropped());
            if (!options.visibility.empty())
                HEARTH_TRY(run.writeVisibility(file(options.visibility)));
            HEARTH_TRY(run.printDifference(cameras[i], i));
        }
    return success();
}

/// Write a file per view, once all cells are drawn.
Status drawSheet(const RenderOptions& options, const OutputCameras& images, const Sheet& sheet,
                 FrameRecorder& run)
{
    const std::vector<Named<uint32_t>> views = chooseViews(options);
    std::vector<SheetImage> sheets(views.size(), SheetImage(sheet));
    for (size_t cell = 0; cell < images.cameras.size(); ++cell)
    {
        HEARTH_TRY(run.prefetch(images.cameras[cell], cell));
        for (size_t view = 0; view < views.size(); ++view)
        {
            run.setView(views[view].value);
            HEARTH_ASSIGN_OR_RETURN(const SampleSum image, run.drawImage(images.cameras[cell], cell));
            sheets[view].place(cell, image.average());
            HEARTH_TRY(run.checkDropped());
        }
    }
    for (size_t view = 0; view < views.size(); ++view)
        HEARTH_TRY(writeImage(options, viewFile(options.output, views[view].name), sheets[view].pixels()));
    std::printf("contact sheet of %zu assets%s\n", sheet.assets.size(),
                options.sheet == SheetChoice::on ? "" : ", which overlap (--sheet off draws the scene)");
    return success();
}

/// Print what the frames of the options consist of.
void printPasses(const RenderOptions& options, const gpu::Renderer& renderer, const gpu::Scene& scene,
                 const gpu::FrameTargets& targets, const shared::Camera& camera)
{
    const gpu::FrameInput frame = makeFrame(options.settings, camera, scene.instance_count, targets.extent());
    const gpu::FrameDescription description = renderer.describe(scene, targets, frame);
    const MemoryCounts memory = countMemory(scene, targets);
    const auto [width, height] = targets.extent();
    if (options.passes == PassesFormat::json)
        std::printf("%s", gpu::formatFrameJson(description, "\"width\":" + std::to_string(width) +
                                                                ",\"height\":" + std::to_string(height) +
                                                                ",\"memory\":" + formatMemoryJson(memory))
                              .c_str());
    else
        std::printf("%s\n%ux%u\n%s", gpu::formatFrameText(description).c_str(), width, height,
                    formatMemoryText(memory).c_str());
}

Status drawPack(const RenderOptions& options, const formats::PackView& pack, VulkanHost& host)
{
    HEARTH_TRY(checkPack(options, pack));
    HEARTH_ASSIGN_OR_RETURN(Animation animation, Animation::create(options.animation, pack));
    animation.goTo(0);
    HEARTH_ASSIGN_OR_RETURN(const std::optional<Sheet> sheet, chooseSheet(options, pack));
    HEARTH_ASSIGN_OR_RETURN(OutputCameras images, chooseImages(options, pack, animation.player(), sheet));
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<gpu::Renderer> renderer,
                            gpu::Renderer::create(host.description(), rendererOptions(options.settings)));
    if (options.settings.view == shared::kViewOverdraw)
        HEARTH_TRY(renderer->prepareOverdraw());
    std::unique_ptr<gpu::Scene> scene;
    HEARTH_TRY(host.run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(
                scene, renderer->upload(pack, commands, sceneOptions(options, pack, images.cameras)));
            return success();
        }));
    scene->staging.reset();
    HEARTH_TRY(renderer->prepareLightMethod(*scene, options.settings.light_method));
    if (gpu::lightMethodFacts(options.settings.light_method).approximates)
        HEARTH_TRY(renderer->prepareLightMethod(*scene, kExactMethod));

    const uint32_t scale = makeSampleGrid(options.samples).scale;
    const VkExtent2D size = sheet ? VkExtent2D{sheet->layout.cell_width, sheet->layout.cell_height}
                                  : VkExtent2D{options.width, options.height};
    const VkExtent2D drawn = sheet ? size : options.settings.render_size.value_or(size);
    HEARTH_ASSIGN_OR_RETURN(
        gpu::FrameTargets targets,
        renderer->createTargets({drawn.width * scale, drawn.height * scale},
                                targetOptions(options.settings, *scene,
                                              {size.width * scale, size.height * scale},
                                              !options.visibility.empty() || !options.stats.empty())));
    if (options.passes != PassesFormat::none)
    {
        printPasses(options, *renderer, *scene, targets, images.cameras.front());
        return success();
    }
    HEARTH_ASSIGN_OR_RETURN(const VkQueryPool timestamps, host.createTimestamps(gpu::kTimestampCount));
    FrameRecorder run(options, frameSettings(options, sheet.has_value()), pack, animation,
                      images.stage ? &*images.stage : nullptr, host, *renderer, *scene, targets, timestamps);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<gpu::LampWeight> lamp_weights,
                            findLampWeights(options.lamps, pack, *scene));
    run.setLampWeights(lamp_weights);
    HEARTH_TRY(run.prepareFilter());
    if (options.daylight)
    {
        HEARTH_ASSIGN_OR_RETURN(const gpu::DaylightChange daylight,
                                gpu::changeDaylight(*scene, options.daylight));
        run.setDaylight(daylight);
    }
    HEARTH_TRY(sheet ? drawSheet(options, images, *sheet, run) : drawImages(options, images, run));
    return run.writeStats(sheet);
}

Status nameDevice(const RenderOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(
        const std::unique_ptr<VulkanHost> host,
        VulkanHost::create({.device_name = options.device, .validate = options.validate}));
    // the renderer reports missing features
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<gpu::Renderer> renderer,
                            gpu::Renderer::create(host->description()));
    std::printf("%s%s\n", host->deviceName().c_str(), host->software() ? " (software)" : "");
    return success();
}

Status render(const RenderOptions& options)
{
    if (options.print_device_name)
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
