// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/frame_meter.h"

#include "runtime/gpu/vulkan/pipelines.h"

#include <cstring>

namespace hearth::viewer
{

namespace
{

constexpr size_t kTimedFrames = 16; // a quarter of a second: steady enough to read, quick enough to follow

template <typename T>
T readMapped(const gpu::Buffer& buffer)
{
    T value;
    std::memcpy(&value, buffer.mapped, sizeof(value));
    return value;
}

} // namespace

Result<std::unique_ptr<FrameMeter>> FrameMeter::create(VulkanHost& host, const gpu::Device& device)
{
    std::unique_ptr<FrameMeter> meter(new FrameMeter(host, device));
    const auto readback = [&](VkDeviceSize bytes) {
        return meter->arena_.createBuffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryKind::readback);
    };
    for (Slot& slot : meter->slots_)
    {
        HEARTH_ASSIGN_OR_RETURN(slot.timestamps, host.createTimestamps(gpu::kTimestampCount));
        HEARTH_ASSIGN_OR_RETURN(slot.counters, readback(sizeof(shared::FrameCounters)));
        HEARTH_ASSIGN_OR_RETURN(slot.statistics, readback(sizeof(shared::CullStatistics)));
    }
    return meter;
}

void FrameMeter::record(VkCommandBuffer commands, const LoadedScene& scene, uint32_t index,
                        bool count_culling)
{
    Slot& slot = slots_[index];
    slot.recorded = true;
    slot.has_statistics = count_culling;
    const auto copy = [&](const gpu::Buffer& from, const gpu::Buffer& to)
    {
        const VkBufferCopy region{0, 0, to.size};
        device_.vk.vkCmdCopyBuffer(commands, from.handle.get(), to.handle.get(), 1, &region);
    };
    gpu::barrier(device_, commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                 VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT);
    copy(scene.scene().frame().main.counters, slot.counters);
    if (count_culling)
    {
        scene.statistics().record(device_, commands, scene.scene());
        copy(scene.statistics().statistics(), slot.statistics);
    }
    gpu::barrier(device_, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                 VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

Status FrameMeter::readSlot(uint32_t index)
{
    const Slot& slot = slots_[index];
    if (!slot.recorded)
        return success();
    HEARTH_ASSIGN_OR_RETURN(std::vector<double> times,
                            host_.readTimestamps(slot.timestamps, gpu::kTimestampCount));
    if (times_.size() < kTimedFrames)
        times_.emplace_back();
    times_[frame_count_++ % times_.size()] = std::move(times);
    figures_.milliseconds = medianPassTimes(times_);
    figures_.counters = readMapped<shared::FrameCounters>(slot.counters);
    figures_.culling.reset();
    if (slot.has_statistics)
        figures_.culling =
            makeCullReport(readMapped<shared::CullStatistics>(slot.statistics), figures_.counters, 0, 0);
    return success();
}

} // namespace hearth::viewer
