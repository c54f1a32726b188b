// Culling statistics: counts the reasons why instances and clusters were drawn or culled. A separate pass
// after a frame repeats the tests, so the culling of frames without statistics runs no extra instruction.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/cull_statistics.h"
#include "runtime/gpu/scene/scene.h"

#include <optional>

namespace hearth::gpu
{

/// Statistics pass for one scene, which outlives it.
class CullStatisticsPass
{
public:
    /// errors: device_failed.
    static Result<CullStatisticsPass> create(const Device& device, const Scene& scene);

    /// Record after the frame that is counted (Renderer::record), before the next frame of the scene. Writes
    /// statistics(), visible to transfers. Clobbers the compute state.
    void record(const Device& device, VkCommandBuffer commands, const Scene& scene) const;

    /// Buffer of one shared::CullStatistics.
    const Buffer& statistics() const { return statistics_; }

private:
    explicit CullStatisticsPass(const Device& device) : arena_(device, 0) {}

    MemoryArena arena_;
    Buffer statistics_;
    struct StatisticsPipeline
    {
        ComputePipeline pipeline;
        std::vector<VkDescriptorSet> sets; ///< for each frame in flight
    };
    Result<StatisticsPipeline> createPipeline(const Device& device, const Scene& scene,
                                              std::span<const uint32_t> shader,
                                              std::span<const uint32_t> tables) const;

    UniqueDescriptorPool pool_;
    StatisticsPipeline rigid_;
    std::optional<StatisticsPipeline> deformed_;
};

} // namespace hearth::gpu
