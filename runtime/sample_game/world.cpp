// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "world.h"

namespace game
{

PageReader::PageReader(const hearth::Pack& pack, bool at_once) : pack_(pack)
{
    if (!at_once)
        thread_ = std::thread([this] { work(); });
}

PageReader::~PageReader()
{
    {
        const std::scoped_lock lock(mutex_);
        is_ending_ = true;
    }
    changed_.notify_one();
    if (thread_.joinable())
        thread_.join();
}

void PageReader::read(void* user, uint32_t page, void* destination, size_t size, hearth_page_read read)
{
    auto& reader = *static_cast<PageReader*>(user);
    const Request request{page, destination, size, read};
    if (!reader.thread_.joinable())
        return reader.decode(request);
    {
        const std::scoped_lock lock(reader.mutex_);
        reader.requests_.push_back(request);
    }
    reader.changed_.notify_one();
}

void PageReader::decode(const Request& request) const
{
    const hearth_result result = pack_.readPage(request.page, request.destination, request.size);
    hearth_read_done(request.read, result == HEARTH_OK);
}

void PageReader::work()
{
    for (std::unique_lock lock(mutex_);;)
    {
        changed_.wait(lock, [this] { return is_ending_ || !requests_.empty(); });
        if (requests_.empty())
            return;
        const Request request = requests_.front();
        requests_.pop_front();
        lock.unlock();
        decode(request);
        lock.lock();
    }
}

World::World(Gpu& gpu, const hearth::Pack& pack, uint32_t width, uint32_t height, bool is_replay)
    : gpu_(gpu), reader_(pack, is_replay)
{
    hearth_renderer_description description = HEARTH_RENDERER_DESCRIPTION_INIT;
    description.get_instance_proc_addr = vkGetInstanceProcAddr;
    description.instance = gpu.instance;
    description.physical_device = gpu.physical;
    description.device = gpu.device;
    description.features = HEARTH_FEATURE_GRADING | HEARTH_FEATURE_DEPTH;
    std::string why;
    game::check(hearth::Renderer::create(description, renderer_, &why), why);

    hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    options.memory_budget = 48 << 20;
    options.read = PageReader::read;
    options.read_user = &reader_;
    options.frames_in_flight = kFramesInFlight;
    options.flags = HEARTH_SCENE_DECODE_TEXTURES; // the pack is for phones
    options.shadows.max_maps = 16;
    options.shadows.texels = 1024;
    options.shadows.splits = 3;
    options.shadows.split_far = 30;
    check(hearth::Scene::upload(renderer_, pack, gpu.begin(), options, scene_));
    gpu.submit();
    gpu.waitForAll();
    check(scene_.releaseStaging());

    hearth_targets_description size = HEARTH_TARGETS_DESCRIPTION_INIT;
    size.width = width;
    size.height = height;
    size.scene = scene_.get();
    check(hearth::Targets::create(renderer_, size, targets_));
    check(targets_.getInfo(images_));
}

void World::record(VkCommandBuffer commands, const hearth_frame& frame)
{
    check(scene_.beginFrame(gpu_.serial(), gpu_.completed()));
    check(scene_.record(targets_, commands, frame));
}

void World::prefetch(const hearth_frame& frame)
{
    const uint64_t first = gpu_.serial() + 1;
    constexpr uint64_t kMaxFrames = 500; // of reads that fail again and again
    while (counters().settled_serial < first && gpu_.serial() < first + kMaxFrames)
    {
        const VkCommandBuffer commands = gpu_.begin();
        check(scene_.beginFrame(gpu_.serial(), gpu_.completed()));
        check(scene_.recordPrefetch(targets_, commands, frame));
        gpu_.submit();
        gpu_.waitForAll();
    }
}

hearth_stream_counters World::counters() const
{
    hearth_stream_counters counters = HEARTH_STREAM_COUNTERS_INIT;
    check(scene_.getStreamCounters(counters));
    return counters;
}

} // namespace game
