// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/lights/method_figures.h"

#include "runtime/gpu/frame/frame_plan.h"
#include "runtime/gpu/statistics/light_statistics_pass.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <limits>

namespace hearth::bench
{

namespace
{

constexpr int kRepeats = 5;
constexpr double kNone = std::numeric_limits<double>::infinity();

/// Best milliseconds from the frame's begin to each timestamp, less those to the one before; [0] is the
/// frame.
using StageTimes = std::array<double, gpu::kTimestampCount>;

/// Return the time of the stages in which the device lists the lights of such areas. There is little else in
/// them without shadows and bricks: the frame's update, culling, and material tiles.
double listTime(const StageTimes& times, gpu::LightAreas areas)
{
    const double frame_list = times[gpu::kTimestampShadows];
    if (areas == gpu::LightAreas::slots)
        return frame_list + times[gpu::kTimestampCull];
    return needPixels(areas) ? frame_list + times[gpu::kTimestampMaterialTiles] : frame_list;
}

/// Return the best time of the CPU to list the lights of the cells of a view.
double timeCpu(const shared::FrameView& view, std::span<const shared::Light> lights)
{
    const shared::LightGridLayout layout = shared::makeLightGrid(shared::lightGridView(view));
    shared::LightListCounts counts;
    std::vector<uint32_t> frame(lights.size()), cells(shared::kMaxLightCells), indices(1u << 20);
    shared::LightLists lister;
    double best = kNone;
    for (int i = 0; i < 3 * kRepeats; ++i)
    {
        const auto start = std::chrono::steady_clock::now();
        lister.assign(layout, lights, {&counts, frame, cells, indices});
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        best = std::min(best, taken.count());
    }
    return best;
}

double join(uint32_t low, uint32_t high)
{
    return static_cast<double>(uint64_t{high} << 32 | low);
}

/// Draws the frames of a scene.
class SceneMeter
{
public:
    SceneMeter(viewer::VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene,
               gpu::FrameTargets& targets, const gpu::LightStatisticsPass& statistics, VkQueryPool timestamps)
        : host_(host),
          renderer_(renderer),
          scene_(scene),
          targets_(targets),
          statistics_(statistics),
          timestamps_(timestamps)
    {
    }

    gpu::FrameInput makeFrame(const shared::Camera& camera, gpu::LightMethod method,
                              gpu::LightLister lister) const
    {
        const auto [width, height] = targets_.extent();
        return {.view = shared::makeFrameView(camera, width, height, 1, scene_.instance_count,
                                              shared::kCullEverything & ~shared::kCullOcclusion),
                .shading = {.light_method = method, .light_lister = lister},
                .timestamps = timestamps_};
    }

    /// Draw a frame several times. Leaves the lists of the last one.
    Result<StageTimes> time(const gpu::FrameInput& frame)
    {
        StageTimes best;
        best.fill(kNone);
        for (int i = 0; i < kRepeats; ++i)
        {
            HEARTH_TRY(host_.run(
                [&](VkCommandBuffer commands)
                {
                    renderer_.record(commands, scene_, targets_, frame);
                    return success();
                }));
            HEARTH_ASSIGN_OR_RETURN(const std::vector<double> times,
                                    host_.readTimestamps(timestamps_, gpu::kTimestampCount));
            best[0] = std::min(best[0], times.back());
            for (size_t stage = 1; stage < times.size(); ++stage)
                best[stage] = std::min(best[stage], times[stage] - times[stage - 1]);
        }
        return best;
    }

    /// Return the counts of the last frame.
    Result<shared::LightListCounts> count(gpu::LightMethod method)
    {
        HEARTH_TRY(host_.run(
            [&](VkCommandBuffer commands)
            {
                statistics_.record(renderer_.device(), commands, scene_, targets_, method);
                return success();
            }));
        return gpu::readLightCounts(scene_);
    }

    /// Return the bytes of a frame of which nothing is kept but the image.
    gpu::Traffic traffic(const gpu::FrameInput& frame) const
    {
        gpu::FrameConfiguration configuration = renderer_.describe(scene_, targets_, frame).configuration;
        configuration.keeps_visibility = false;
        return gpu::measureTraffic(gpu::describeFrame(configuration));
    }

private:
    viewer::VulkanHost& host_;
    const gpu::Renderer& renderer_;
    const gpu::Scene& scene_;
    gpu::FrameTargets& targets_;
    const gpu::LightStatisticsPass& statistics_;
    VkQueryPool timestamps_;
};

} // namespace

Result<MethodMeter> MethodMeter::create()
{
    MethodMeter meter;
    HEARTH_ASSIGN_OR_RETURN(meter.host_, viewer::VulkanHost::create({}));
    HEARTH_ASSIGN_OR_RETURN(meter.renderer_,
                            gpu::Renderer::create(meter.host_->description(), {.deferred = true}));
    HEARTH_ASSIGN_OR_RETURN(meter.timestamps_, meter.host_->createTimestamps(gpu::kTimestampCount));
    return meter;
}

Result<std::vector<MethodFigures>>
MethodMeter::measure(const formats::PackView& pack, std::span<const shared::Camera> views, VkExtent2D extent)
{
    std::unique_ptr<gpu::Scene> scene;
    HEARTH_TRY(host_->run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(scene, renderer_->upload(pack, commands));
            return success();
        }));
    scene->staging.reset();
    for (size_t method = 0; method < gpu::kLightMethodCount; ++method)
        HEARTH_TRY(renderer_->prepareLightMethod(*scene, static_cast<gpu::LightMethod>(method)));
    HEARTH_ASSIGN_OR_RETURN(
        gpu::FrameTargets targets,
        renderer_->createTargets(extent, {.keeps_visibility = true, .light_paths = gpu::kAllLightPaths}));
    HEARTH_ASSIGN_OR_RETURN(
        const gpu::LightStatisticsPass statistics,
        gpu::LightStatisticsPass::create(renderer_->device(), renderer_->layouts(), *scene, targets));
    SceneMeter meter(*host_, *renderer_, *scene, targets, statistics, timestamps_);

    std::vector<MethodFigures> methods(gpu::kLightMethodCount);
    std::vector<double> pixels(gpu::kLightMethodCount);
    const auto share = 1 / static_cast<double>(views.size());
    for (const shared::Camera& view : views)
    {
        const gpu::FrameInput listed_by_cpu =
            meter.makeFrame(view, gpu::LightMethod::practical, gpu::LightLister::cpu);
        HEARTH_ASSIGN_OR_RETURN(const StageTimes without_lists, meter.time(listed_by_cpu));
        const double cpu_ms = timeCpu(listed_by_cpu.view, scene->lights->lights());
        for (size_t i = 0; i < methods.size(); ++i)
        {
            const auto method = static_cast<gpu::LightMethod>(i);
            const gpu::LightAreas areas = gpu::kLightMethods[i].areas;
            MethodFigures& sum = methods[i];
            const gpu::FrameInput frame = meter.makeFrame(view, method, gpu::LightLister::gpu);
            HEARTH_ASSIGN_OR_RETURN(const StageTimes times, meter.time(frame));
            HEARTH_ASSIGN_OR_RETURN(const shared::LightListCounts counts, meter.count(method));
            pixels[i] += counts.pixels;
            sum.evaluated += join(counts.evaluated_low, counts.evaluated_high);
            sum.reaching += join(counts.reaching_low, counts.reaching_high);
            sum.cells += share * counts.cells;
            sum.indices += share * counts.indices;
            sum.longest = std::max(sum.longest, static_cast<double>(counts.longest));
            sum.overflows += share * counts.overflows;
            sum.device_ms += share * std::max(listTime(times, areas) - listTime(without_lists, areas), 0.0);
            sum.frame_ms += share * times[0];
            if (areas == gpu::LightAreas::cells)
                sum.cpu_ms = sum.cpu_ms.value_or(0) + share * cpu_ms;
            sum.traffic = meter.traffic(frame);
        }
    }
    for (size_t i = 0; i < methods.size(); ++i)
    {
        methods[i].evaluated /= pixels[i];
        methods[i].reaching /= pixels[i];
    }
    return methods;
}

void printMethods(std::span<const MethodFigures> methods)
{
    std::printf("  %-18s %8s %9s %6s %7s %7s %8s %8s %8s %9s %9s %7s %7s\n", "", "reaching", "evaluated",
                "ratio", "longest", "areas", "indices", "no room", "CPU, ms", "lists, ms", "frame, ms",
                "low, B", "high, B");
    for (size_t i = 0; i < methods.size(); ++i)
    {
        const MethodFigures& m = methods[i];
        char cpu[16] = "-";
        if (m.cpu_ms)
            std::snprintf(cpu, sizeof(cpu), "%.2f", *m.cpu_ms);
        std::printf("  %-18s %8.2f %9.2f %6.2f %7.0f %7.0f %8.0f %8.0f %8s %9.1f %9.0f %7.1f %7.1f\n",
                    gpu::kLightMethods[i].name, m.reaching, m.evaluated, m.evaluated / m.reaching, m.longest,
                    m.cells, m.indices, m.overflows, cpu, m.device_ms, m.frame_ms, m.traffic.low,
                    m.traffic.high);
    }
}

} // namespace hearth::bench
