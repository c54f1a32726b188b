// Counts why instances and clusters were drawn or not. A pass of its own behind a frame, which asks the tests once more: the
// culling of frames that nobody counts stays as it is.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/cull_statistics.h"
#include "runtime/gpu/scene/scene.h"

#include <optional>

namespace hearth::gpu
{

/// For one scene, which outlives it.
class CullStatisticsPass
{
public:
    /// errors: device_failed.
    static Result<CullStatisticsPass> create(const Device& device, const Scene& scene);

    /// Behind the frame that it counts (Renderer::record), before the next of this scene. Writes statistics(), visible to
    /// transfers. Clobbers the compute state.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene) const;

    const Buffer& statistics() const { return statistics_; } ///< one shared::CullStatistics

private:
    explicit CullStatisticsPass(const Device& device) : arena_(device, 0) {}

    MemoryArena arena_;
    Buffer statistics_;
    struct Counting
    {
        ComputePipeline pipeline;
        VkDescriptorSet set = VK_NULL_HANDLE;
    };
    Result<Counting> createCounting(const Device& device, const Scene& scene,
                                    std::span<const uint32_t> shader, const Buffer& clusters) const;

    UniqueDescriptorPool pool_;
    Counting rigid_;
    std::optional<Counting> deformed_;
};

} // namespace hearth::gpu
