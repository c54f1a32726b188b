// Costs and counts of frames, read after they have completed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/report/frame_report.h"
#include "runtime/viewer/window/frame_ring.h"
#include "runtime/viewer/window/loaded_scene.h"

namespace hearth::viewer
{

struct FrameStatistics
{
    std::array<double, gpu::kTimestampCount> milliseconds{}; ///< as FrameReport, medians of the last frames
    shared::FrameCounters counters{};
    std::optional<CullReport> culling; ///< if culling statistics were requested; without triangles
};

class FrameMeter
{
public:
    /// The arguments outlive the meter. errors: device_failed.
    static Result<std::unique_ptr<FrameMeter>> create(VulkanHost& host, const gpu::Device& device);

    /// Return the queries for gpu::FrameInput of the frame in this slot.
    VkQueryPool timestamps(uint32_t slot) const { return slots_[slot].timestamps; }

    /// Record after Renderer::record of the frame in this slot.
    /// count_culling  also count the outcomes of the culling tests, which costs about as much as the culling
    void record(VkCommandBuffer commands, const LoadedScene& scene, uint32_t slot, bool count_culling);

    /// Read the results of the completed frame that was in this slot; nothing if there was none. errors:
    /// device_failed.
    Status readSlot(uint32_t slot);

    const FrameStatistics& figures() const { return figures_; }

private:
    struct Slot
    {
        VkQueryPool timestamps = VK_NULL_HANDLE;
        gpu::Buffer counters;   ///< FrameCounters
        gpu::Buffer statistics; ///< CullStatistics
        bool recorded = false;
        bool has_statistics = false;
    };

    FrameMeter(VulkanHost& host, const gpu::Device& device) : host_(host), device_(device), arena_(device, 0)
    {
    }

    VulkanHost& host_;
    const gpu::Device& device_;
    gpu::MemoryArena arena_;
    std::array<Slot, kFramesInFlight> slots_;
    std::vector<std::vector<double>> times_; ///< of the last frames, a ring
    size_t frame_count_ = 0;
    FrameStatistics figures_;
};

} // namespace hearth::viewer
