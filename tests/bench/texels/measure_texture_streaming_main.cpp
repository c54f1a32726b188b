// hearth_measure_texture_streaming: flies through a street whose textures take 2 GiB, with a budget of
// 128 MiB. Counts the bytes on the device in each frame, and the pixels that are blurrier than their UVs want
// once a view has settled. `./dev bench texture-streaming` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/tools/child_processes.h"
#include "formats/base/program.h"
#include "runtime/gpu/renderer.h"
#include "runtime/gpu/textures/streamed_textures.h"
#include "runtime/pack/pack.h"
#include "runtime/viewer/page_reading.h"
#include "runtime/viewer/vulkan_host.h"
#include "sample_assets/shapes/glb_writer.h"
#include "tests/bench/aims.h"
#include "tests/bench/texels/memory_meter.h"
#include "tests/bench/texels/street.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <random>

namespace
{

using namespace hearth;
namespace fs = std::filesystem;

constexpr double kMebi = 1 << 20, kGibi = 1 << 30;
constexpr uint64_t kBudget = uint64_t{128} << 20;
constexpr uint32_t kSide = 4096; ///< texels
constexpr uint32_t kFramesInFlight = 3;
constexpr uint32_t kMaxFrames = 600;   ///< for a view to settle
constexpr uint32_t kFlightFrames = 24; ///< from one view to the next

struct Arguments
{
    std::string work = "build/bench/texture-streaming";
    std::string pack;
    uint32_t width = 640, height = 360;
};

/// View at which the flight rests.
struct View
{
    const char* name;
    bool is_jump; ///< a cut leads to it, no flight
    shared::Camera camera;
};

const View kViews[] = {
    {"along the street", true, {.position = {0, 1.7f, 4}, .target = {0, 1.7f, -100}}},
    {"walking", false, {.position = {-2, 1.7f, -30}, .target = {0, 1.5f, -60}}},
    {"a house from 6 m", false, {.position = {-4, 2, -46}, .target = {-10, 3, -46}}},
    {"its wall from 0.8 m", false, {.position = {-9.2f, 2, -46}, .target = {-10, 2.2f, -46}}},
    {"the other end", true, {.position = {3, 1.7f, -158}, .target = {-2, 1.5f, -100}}},
    {"along a wall", false, {.position = {9.5f, 2, -120}, .target = {9.7f, 2, -100}}},
    {"from above", true, {.position = {0, 60, -60}, .target = {0, 0, -80}}},
    {"low over the ground", false, {.position = {1, 0.4f, -80}, .target = {0, 0.2f, -100}}},
    {"a wide view", true, {.position = {0, 1.7f, -75}, .target = {-1, 1, -80}, .y_fov_rad = 1.9f}},
    {"along the street again", true, {.position = {0, 1.7f, 4}, .target = {0, 1.7f, -100}}},
};

std::string findProgram(const char* name)
{
    return tools::programFolder() + "/" + name;
}

/// Cook the street without compressed textures, and print what that took.
Status cookStreet(const bench::Street& street, const std::string& work, const std::string& pack)
{
    const std::string source = work + "/street.glb";
    HEARTH_TRY(samples::writeFile(source, samples::encodeGlb(bench::makeDocument(street, kSide))));
    tools::ChildProcesses children;
    HEARTH_TRY(children.start({findProgram("hearth"), "cook", "-q", source, "-o", pack, "--no-cache",
                               "--visibility", "off", "--bricks", "off", "--set", "textures.families=[]"}));
    const std::optional<tools::ChildOutcome> end = children.wait();
    if (!end || end->exit_code != 0 || end->signal != 0)
        return Error{Issue::child_failed, "hearth cook", "", end ? end->messages : "interrupted"};
    fmt::print("cooked in {:.0f} s, processes of up to {:.2f} GiB; source {:.0f} MiB, pack {:.0f} MiB\n",
               end->seconds, static_cast<double>(end->peak_rss_bytes) / kGibi,
               static_cast<double>(fs::file_size(source)) / kMebi,
               static_cast<double>(fs::file_size(pack)) / kMebi);
    fs::remove(source);
    return success();
}

/// Bytes of texels of a pack, as the GPU has them.
uint64_t sumTexels(const formats::PackView& pack)
{
    uint64_t bytes = 0;
    for (const formats::ChunkEntry& entry : pack.container().chunks())
        bytes += entry.type == formats::kChunkImageData ? entry.size : 0;
    return bytes;
}

/// Frames of a settled view.
struct SettledView
{
    uint32_t frames = 0; ///< until it had settled
    uint64_t bytes_read = 0;
    uint64_t held = 0;   ///< bytes of images, also of those that only earlier views wanted
    uint64_t needed = 0; ///< bytes of images that begin with the finest mip that a pixel wants
    uint64_t pixels = 0, blurred = 0;
    double error_scale = 1;
};

/// Sums over all frames.
struct Totals
{
    uint32_t frames = 0;
    uint64_t statistics_peak = 0; ///< bytes of the budget, as the scene tells them
    uint64_t allocated_peak = 0;  ///< the same, as the meter counts images and the pool its slices
    uint64_t all_peak = 0;        ///< and of buffers
    uint32_t frames_beyond = 0;   ///< by either count
};

/// Scene within the budget, drawn frame by frame. The device ends frames late and at random, and reads take
/// frames, too.
class Flight
{
public:
    Flight(viewer::VulkanHost& host, gpu::Renderer& renderer, bench::MemoryMeter& meter,
           const formats::PackView& pack, const bench::Street& street)
        : host_(host), renderer_(renderer), meter_(meter), pack_(pack), street_(street)
    {
    }
    ~Flight()
    {
        for (const Read& read : reads_)
            read.done(false);
    }
    Flight(const Flight&) = delete;
    Flight& operator=(const Flight&) = delete;

    Status open(uint32_t width, uint32_t height)
    {
        HEARTH_ASSIGN_OR_RETURN(gpu::FrameTargets targets, renderer_.createTargets({width, height}));
        targets_.emplace(std::move(targets));
        before_ = meter_.live();
        HEARTH_TRY(host_.run(
            [&](VkCommandBuffer commands) -> Status
            {
                HEARTH_ASSIGN_OR_RETURN(
                    scene_, renderer_.upload(
                                pack_, commands,
                                {.frames_in_flight = kFramesInFlight,
                                 .memory_budget = kBudget,
                                 .stream = {.read = [this](uint32_t page, std::span<std::byte> destination,
                                                           pack::ReadDone done) {
                                     reads_.push_back({page, destination, done});
                                 }}}));
                return success();
            }));
        scene_->staging.reset();
        meter_.resetPeak();
        for (const gpu::Image* table : {&scene_->shading_tables, &scene_->specular_table})
            table_bytes_ += table->bytes;
        for (const gpu::Image& image : scene_->images)
            table_bytes_ += image.bytes;
        for (uint32_t image = 0; image < pack_.images().size(); ++image)
            images_by_name_[std::string(pack_.text(pack_.images()[image].name))] = image;
        HEARTH_ASSIGN_OR_RETURN(sizes_,
                                gpu::measureTextures(renderer_.device(), pack_,
                                                     std::vector<bool>(pack_.images().size(), true), false));
        return success();
    }

    Status draw(const shared::Camera& camera)
    {
        ++serial_;
        completed_ =
            std::max(completed_, serial_ - std::min<uint64_t>(serial_, 1 + random_() % kFramesInFlight));
        scene_->stream->beginFrame(serial_, completed_);
        const auto [width, height] = targets_->extent();
        HEARTH_TRY(host_.run(
            [&](VkCommandBuffer commands)
            {
                renderer_.record(
                    commands, *scene_, *targets_,
                    {.view = shared::makeFrameView(camera, width, height, 1, scene_->instance_count)});
                return success();
            }));
        endReads();
        count();
        return success();
    }

    Result<SettledView> settle(const shared::Camera& camera)
    {
        SettledView result;
        const uint64_t first = serial_ + 1, read_before = scene_->textures->statistics().bytes_streamed;
        for (; result.frames < kMaxFrames && scene_->stream->settledSerial() < first; ++result.frames)
            HEARTH_TRY(draw(camera));
        const gpu::TextureStatistics statistics = scene_->textures->statistics();
        result.bytes_read = statistics.bytes_streamed - read_before;
        result.held = statistics.bytes_on_device;
        result.error_scale = double{statistics.error_scale};
        judge(camera, result);
        return result;
    }

    const Totals& totals() const { return totals_; }
    uint64_t geometryBytes() const { return scene_->buffers.pool.bytes(); }
    uint64_t bytesRead() const { return scene_->textures->statistics().bytes_streamed; }

private:
    struct Read
    {
        uint32_t page;
        std::span<std::byte> destination;
        pack::ReadDone done;
    };

    /// End some of the reads, in any order.
    void endReads()
    {
        std::shuffle(reads_.begin(), reads_.end(), random_);
        for (size_t left = reads_.size() / 4; reads_.size() > left; reads_.pop_back())
            reads_.back().done(viewer::readPage(pack_, reads_.back().page, reads_.back().destination));
    }

    void count()
    {
        const uint64_t told =
            scene_->stream->statistics().budget_bytes + scene_->textures->statistics().bytes_in_use;
        const uint64_t images = meter_.peak().images - before_.images - table_bytes_;
        ++totals_.frames;
        totals_.statistics_peak = std::max(totals_.statistics_peak, told);
        totals_.allocated_peak = std::max(totals_.allocated_peak, images + geometryBytes());
        totals_.all_peak = std::max(totals_.all_peak, meter_.peak().all - before_.all);
        totals_.frames_beyond += told > kBudget || images + geometryBytes() > kBudget ? 1u : 0u;
        meter_.resetPeak();
    }

    void judge(const shared::Camera& camera, SettledView& result)
    {
        const auto [width, height] = targets_->extent();
        const bool is_anisotropic = host_.description().sampler_anisotropy;
        std::vector<uint32_t> finest(street_.textures, kSide);
        for (const bench::WantedMip& wanted :
             bench::findWantedMips(street_, kSide, camera, width, height, is_anisotropic ? 8 : 1))
        {
            if (wanted.texture == bench::WantedMip::kNothing)
                continue;
            const uint32_t image = images_by_name_.at(bench::textureName(wanted.texture));
            const uint32_t resident =
                pack_.images()[image].mip_count - scene_->textures->image(image).mip_count;
            ++result.pixels;
            result.blurred += wanted.mip < resident ? 1 : 0;
            finest[wanted.texture] = std::min(finest[wanted.texture], static_cast<uint32_t>(wanted.mip));
        }
        for (uint32_t texture = 0; texture < street_.textures; ++texture)
        {
            const std::vector<uint64_t>& sizes = sizes_[images_by_name_.at(bench::textureName(texture))];
            result.needed += sizes[std::min<size_t>(finest[texture], sizes.size() - 1)];
        }
    }

    viewer::VulkanHost& host_;
    gpu::Renderer& renderer_;
    bench::MemoryMeter& meter_;
    const formats::PackView& pack_;
    const bench::Street& street_;
    std::mt19937 random_{3};
    std::vector<Read> reads_;
    std::optional<gpu::FrameTargets> targets_;
    std::unique_ptr<gpu::Scene> scene_;
    bench::MemoryMeter::Bytes before_;
    uint64_t table_bytes_ = 0; ///< images that are not streamed
    std::map<std::string, uint32_t> images_by_name_;
    gpu::TextureSizes sizes_;
    uint64_t serial_ = 0, completed_ = 0;
    Totals totals_;
};

shared::Camera blend(const shared::Camera& from, const shared::Camera& to, float share)
{
    shared::Camera camera = to;
    camera.position = from.position + (to.position - from.position) * share;
    camera.target = from.target + (to.target - from.target) * share;
    camera.y_fov_rad = from.y_fov_rad + (to.y_fov_rad - from.y_fov_rad) * share;
    return camera;
}

/// Return the pixels that are no blurrier than wanted, in per cent.
double sharpShare(const SettledView& view)
{
    return 100 - 100 * static_cast<double>(view.blurred) / static_cast<double>(view.pixels);
}

void printView(const View& view, const SettledView& settled)
{
    fmt::print("{:24} {:>7} {:>9.1f} {:>9.1f} {:>9.1f} {:>9.2f} {:>8.2f} {:>10.3f} %\n", view.name,
               settled.frames, static_cast<double>(settled.bytes_read) / kMebi,
               static_cast<double>(settled.held) / kMebi, static_cast<double>(settled.needed) / kMebi,
               static_cast<double>(settled.held) / static_cast<double>(settled.needed), settled.error_scale,
               100 - sharpShare(settled));
    std::fflush(stdout);
}

Status fly(Flight& flight, bench::Judgement& judgement)
{
    fmt::print("\n{:24} {:>7} {:>9} {:>9} {:>9} {:>9} {:>8} {:>12}\n", "settled view", "frames", "read, MiB",
               "held", "needed", "ratio", "scale", "blurred");
    SettledView all;
    for (size_t i = 0; i < std::size(kViews); ++i)
    {
        const View& view = kViews[i];
        for (uint32_t frame = 1; !view.is_jump && frame < kFlightFrames; ++frame)
            HEARTH_TRY(flight.draw(
                blend(kViews[i - 1].camera, view.camera, static_cast<float>(frame) / float{kFlightFrames})));
        HEARTH_ASSIGN_OR_RETURN(const SettledView settled, flight.settle(view.camera));
        printView(view, settled);
        judgement.record("frames until a view has settled", settled.frames);
        judgement.record("pixels no blurrier than wanted, worst view, %", sharpShare(settled));
        all.pixels += settled.pixels;
        all.blurred += settled.blurred;
    }
    judgement.record("pixels no blurrier than wanted, all views, %", sharpShare(all));
    const Totals& totals = flight.totals();
    fmt::print(
        "\n{} frames, {:.0f} MiB of texels read; geometry {:.1f} MiB\n"
        "most bytes of the budget: {:.1f} MiB as told, {:.1f} MiB of images and geometry as allocated;\n"
        "{:.1f} MiB with tables, staging memory and work buffers\n",
        totals.frames, static_cast<double>(flight.bytesRead()) / kMebi,
        static_cast<double>(flight.geometryBytes()) / kMebi,
        static_cast<double>(totals.statistics_peak) / kMebi,
        static_cast<double>(totals.allocated_peak) / kMebi, static_cast<double>(totals.all_peak) / kMebi);
    judgement.record("frames beyond the budget", totals.frames_beyond);
    return success();
}

/// returns  exit code: 1 if an aim is missed
Result<int> measure(const Arguments& arguments)
{
    fs::create_directories(arguments.work);
    bench::Judgement judgement("texture-streaming");
    const bench::Street street = bench::makeStreet();
    const std::string path = arguments.pack.empty() ? arguments.work + "/street.hearth" : arguments.pack;
    if (arguments.pack.empty())
        HEARTH_TRY(cookStreet(street, arguments.work, path));
    HEARTH_ASSIGN_OR_RETURN(const pack::Pack pack, pack::Pack::open(path));
    const uint64_t texels = sumTexels(pack.view());
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<viewer::VulkanHost> host,
                            viewer::VulkanHost::create({.device_name = "", .validate = false}));
    fmt::print("{} textures of {:.3f} GiB, {} x {} pixels, {}\n", street.textures,
               static_cast<double>(texels) / kGibi, arguments.width, arguments.height, host->deviceName());
    judgement.record("GiB of texels", static_cast<double>(texels) / kGibi);

    gpu::DeviceDescription device = host->description();
    const auto load = [&]<typename T>(T& function, const char* name)
    { function = reinterpret_cast<T>(device.get_instance_proc_addr(device.instance, name)); };
    PFN_vkGetPhysicalDeviceMemoryProperties get_memory = nullptr;
    PFN_vkGetDeviceProcAddr get_device_proc_addr = nullptr;
    load(get_memory, "vkGetPhysicalDeviceMemoryProperties");
    load(get_device_proc_addr, "vkGetDeviceProcAddr");
    VkPhysicalDeviceMemoryProperties memory;
    get_memory(device.physical_device, &memory);
    bench::MemoryMeter meter(device.device, memory, get_device_proc_addr);
    device.memory_hooks = meter.hooks();
    HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<gpu::Renderer> renderer, gpu::Renderer::create(device));
    Flight flight(*host, *renderer, meter, pack.view(), street);
    HEARTH_TRY(flight.open(arguments.width, arguments.height));
    HEARTH_TRY(fly(flight, judgement));
    return judgement.finish();
}

int run(int argc, char** argv)
{
    cli::CommandLine app("Measures streamed textures far larger than their budget.");
    Arguments arguments;
    app.addOption("--work", arguments.work, "folder of all files that are made");
    app.addOption("--width", arguments.width, "pixels");
    app.addOption("--height", arguments.height, "pixels");
    app.addOption("--pack", arguments.pack, "pack of an earlier run, which is not cooked again");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> measured = measure(arguments);
    return measured.ok() ? *measured : reportFailure(measured.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_texture_streaming", [&] { return run(argc, argv); });
}
