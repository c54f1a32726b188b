// Pack on the device, with its stream and page loader.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/statistics/cull_statistics_pass.h"
#include "runtime/viewer/vulkan_host.h"
#include "runtime/viewer/window/page_loader.h"

#include <memory>
#include <optional>

namespace hearth::viewer
{

class LoadedScene
{
public:
    /// pack             outlives the scene
    /// memory_budget  bytes; 0: all geometry is resident
    /// errors: same as gpu::Renderer::upload.
    static Result<std::unique_ptr<LoadedScene>> load(VulkanHost& host, gpu::Renderer& renderer,
                                                     const formats::PackView& pack, uint64_t memory_budget,
                                                     const gpu::ShadowOptions& shadows);

    gpu::Scene& scene() { return *scene_; }
    const gpu::Scene& scene() const { return *scene_; }
    const gpu::CullStatisticsPass& statistics() const { return *statistics_; }
    uint64_t memoryBudget() const { return memory_budget_; } ///< as requested
    VkDeviceSize bytes() const;                              ///< on the device

private:
    LoadedScene() = default;

    uint64_t memory_budget_ = 0;
    std::unique_ptr<gpu::Scene> scene_;
    std::optional<gpu::CullStatisticsPass> statistics_;
    /// destroyed before the scene, since it writes to the scene's memory
    std::unique_ptr<PageLoader> loader_;
};

} // namespace hearth::viewer
