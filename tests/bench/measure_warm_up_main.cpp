// Measures what a renderer compiles before its first frame, for each way through a frame: pipelines, the time
// that the driver takes for them with an empty and with a filled pipeline cache, and the first frame beside
// the second, since some drivers compile at the first draw. `./dev bench runtime` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "formats/base/assert.h"
#include "formats/base/program.h"
#include "runtime/frame/frame.h"
#include "runtime/gpu/renderer.h"
#include "runtime/pack/pack.h"
#include "runtime/viewer/frame_settings.h"
#include "runtime/viewer/vulkan_host.h"
#include "tests/runtime/gpu/replace_function.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace
{

using namespace hearth;

constexpr VkExtent2D kExtent{1280, 720};
constexpr shared::Camera kCamera{.position = {4, 2, 7}, .target = {}};

double measureMilliseconds(const auto& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Pipelines that were created, and the real functions.
struct PipelineMeter
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    PFN_vkGetDeviceProcAddr get_device_proc_addr = nullptr;
    PFN_vkCreateGraphicsPipelines create_graphics = nullptr;
    PFN_vkCreateComputePipelines create_compute = nullptr;
    uint32_t count = 0;
    double milliseconds = 0;
};
PipelineMeter meter;

/// Create pipelines by a real function, and add them and their time.
template <typename Function, typename... Arguments>
VkResult createMeasured(Function create, uint32_t count, Arguments... arguments)
{
    VkResult result = VK_SUCCESS;
    meter.milliseconds += measureMilliseconds([&] { result = create(arguments...); });
    meter.count += count;
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createGraphicsPipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                       const VkGraphicsPipelineCreateInfo* infos,
                                                       const VkAllocationCallbacks* allocator,
                                                       VkPipeline* pipelines)
{
    return createMeasured(meter.create_graphics, count, device, cache, count, infos, allocator, pipelines);
}

VKAPI_ATTR VkResult VKAPI_CALL createComputePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* allocator,
                                                      VkPipeline* pipelines)
{
    return createMeasured(meter.create_compute, count, device, cache, count, infos, allocator, pipelines);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction function = meter.get_device_proc_addr(device, name);
    if (std::string_view(name) == "vkCreateGraphicsPipelines")
        return test::replaceFunction(function, meter.create_graphics, createGraphicsPipelines);
    if (std::string_view(name) == "vkCreateComputePipelines")
        return test::replaceFunction(function, meter.create_compute, createComputePipelines);
    return function;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction function = meter.get_instance_proc_addr(instance, name);
    if (std::string_view(name) == "vkGetDeviceProcAddr")
        return test::replaceFunction(function, meter.get_device_proc_addr, getDeviceProcAddr);
    return function;
}

/// Pipeline cache of a game, empty at first.
class Cache
{
public:
    explicit Cache(const gpu::DeviceDescription& device) : device_(device.device)
    {
        const auto load = [&]<typename T>(T& function, const char* name)
        { function = reinterpret_cast<T>(device.get_instance_proc_addr(device.instance, name)); };
        PFN_vkCreatePipelineCache create = nullptr;
        load(create, "vkCreatePipelineCache");
        load(destroy_, "vkDestroyPipelineCache");
        load(get_data_, "vkGetPipelineCacheData");
        const VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO, nullptr, 0, 0,
                                             nullptr};
        HEARTH_ASSERT(create(device_, &info, nullptr, &cache_) == VK_SUCCESS);
    }
    ~Cache() { destroy_(device_, cache_, nullptr); }
    Cache(const Cache&) = delete;
    Cache& operator=(const Cache&) = delete;

    VkPipelineCache handle() const { return cache_; }
    size_t bytes() const
    {
        size_t size = 0;
        return get_data_(device_, cache_, &size, nullptr) == VK_SUCCESS ? size : 0;
    }

private:
    VkDevice device_;
    PFN_vkDestroyPipelineCache destroy_ = nullptr;
    PFN_vkGetPipelineCacheData get_data_ = nullptr;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
};

struct WarmUp
{
    uint32_t pipelines = 0;
    double milliseconds = 0; ///< in the driver, for the pipelines
    double first_frame = 0, second_frame = 0;
};

/// Create a renderer and a scene, and draw two frames.
Result<WarmUp> warmUp(viewer::VulkanHost& host, const gpu::DeviceDescription& device, gpu::FrameWay way,
                      const formats::PackView& pack)
{
    meter.count = 0;
    meter.milliseconds = 0;
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<gpu::Renderer> renderer,
                            gpu::Renderer::create(device, {.way = way}));
    std::unique_ptr<gpu::Scene> scene;
    HEARTH_TRY(host.run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(scene, renderer->upload(pack, commands, {.shadows = {.max_maps = 4}}));
            return success();
        }));
    WarmUp result{.pipelines = meter.count, .milliseconds = meter.milliseconds};
    HEARTH_ASSIGN_OR_RETURN(gpu::FrameTargets targets, renderer->createTargets(kExtent));
    const gpu::FrameInput input{
        .view = shared::makeFrameView(kCamera, kExtent.width, kExtent.height, 1, scene->instance_count)};
    for (double* milliseconds : {&result.first_frame, &result.second_frame})
    {
        Status drawn = success();
        *milliseconds = measureMilliseconds(
            [&]
            {
                drawn = host.run(
                    [&](VkCommandBuffer commands) -> Status
                    {
                        renderer->record(commands, *scene, targets, input);
                        return success();
                    });
            });
        HEARTH_TRY(std::move(drawn));
    }
    return result;
}

Status measure(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(const pack::Pack pack, pack::Pack::open(path));
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<viewer::VulkanHost> host,
                            viewer::VulkanHost::create({.device_name = "", .validate = false}));
    gpu::DeviceDescription device = host->description();
    meter.get_instance_proc_addr = device.get_instance_proc_addr;
    device.get_instance_proc_addr = getInstanceProcAddr;
    std::printf("Warm-up on %s, milliseconds\n", host->deviceName().c_str());
    std::printf("  way         pipelines   no cache   cached   cache KiB   first frame   second frame\n");
    for (const viewer::Named<std::optional<gpu::FrameWay>>& way : viewer::frameWayNames())
    {
        if (!way.value)
            continue;
        const Cache cache(host->description());
        device.pipeline_cache = cache.handle();
        HEARTH_ASSIGN_OR_RETURN(const WarmUp cold, warmUp(*host, device, *way.value, pack.view()));
        HEARTH_ASSIGN_OR_RETURN(const WarmUp warm, warmUp(*host, device, *way.value, pack.view()));
        std::printf("  %-10s %10u %10.0f %8.0f %11.0f %13.0f %14.0f\n", way.name, cold.pipelines,
                    cold.milliseconds, warm.milliseconds, static_cast<double>(cache.bytes()) / 1024,
                    cold.first_frame, cold.second_frame);
    }
    return success();
}

int program(int argc, char** argv)
{
    cli::CommandLine app(
        "Measures the pipelines that a renderer creates for a pack, for each way through a frame.",
        "hearth_measure_warm_up");
    std::string path;
    app.addOption("PACK", path, "the pack").required();
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    // Mesa's cache on the disk would answer for an empty pipeline cache
    ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    const Status measured = measure(path);
    return measured.ok() ? 0 : reportFailure(measured.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_warm_up", [&] { return program(argc, argv); });
}
