// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/loaded_scene.h"

#include "runtime/viewer/frame_settings.h"
#include "runtime/viewer/page_reading.h"
#include "runtime/viewer/window/frame_ring.h"

namespace hearth::viewer
{

Result<std::unique_ptr<LoadedScene>> LoadedScene::load(VulkanHost& host, gpu::Renderer& renderer,
                                                       const formats::PackView& pack, uint64_t memory_budget,
                                                       const gpu::ShadowOptions& shadows)
{
    std::unique_ptr<LoadedScene> loaded(new LoadedScene);
    loaded->memory_budget_ = memory_budget;
    gpu::SceneOptions options{.frames_in_flight = kFramesInFlight,
                              .memory_budget = memory_budget,
                              .shadows = shadows,
                              .decode_textures = true};
    if (memory_budget > 0)
    {
        loaded->loader_ =
            std::make_unique<PageLoader>([&pack](uint32_t page, std::span<std::byte> destination)
                                         { return readPage(pack, page, destination); });
        options.stream = {.read = loaded->loader_->reader()};
    }
    HEARTH_TRY(host.run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(loaded->scene_, renderer.upload(pack, commands, options));
            return success();
        }));
    loaded->scene_->staging.reset();
    HEARTH_ASSIGN_OR_RETURN(loaded->statistics_,
                            gpu::CullStatisticsPass::create(renderer.device(), *loaded->scene_));
    return loaded;
}

VkDeviceSize LoadedScene::bytes() const
{
    return scene_->arena.allocatedBytes() +
           (scene_->stream == nullptr ? 0 : scene_->stream->allocatedBytes());
}

} // namespace hearth::viewer
