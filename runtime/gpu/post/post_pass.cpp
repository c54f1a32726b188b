// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/post/post_pass.h"

#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

namespace
{

constexpr VkShaderStageFlags kPushStages = VK_SHADER_STAGE_FRAGMENT_BIT;

} // namespace

Result<PostPass> PostPass::create(const Device& device, const DrawLayouts& layouts, const FramePasses& passes,
                                  const StoredColor& shown)
{
    const StoredColor between{
        passes.radianceFormat() == kPackedRadiance ? shared::kStoredPacked : shared::kStoredHalf, 0};
    const auto createAt = [&](const DrawPlace& place, VkDescriptorSetLayout set,
                              std::span<const uint32_t> fragment, uint32_t push_bytes,
                              const StoredColor& color) -> Result<Pipeline>
    {
        DrawConstants constants{}; // these shaders have no others
        setStoredColor(constants, color);
        const NumberedSet sets[] = {{shared::kSetPost, set}};
        Pipeline pipeline;
        HEARTH_ASSIGN_OR_RETURN(pipeline.layout, createPipelineLayout(device, sets, kPushStages, push_bytes));
        HEARTH_ASSIGN_OR_RETURN(pipeline.pipeline,
                                createGraphicsPipeline(device, {.vertex = shaders::post_vert,
                                                                .fragment = fragment,
                                                                .layout = pipeline.layout.get(),
                                                                .render_pass = place.render_pass,
                                                                .subpass = place.subpass,
                                                                .depth_compare = VK_COMPARE_OP_ALWAYS,
                                                                .depth_write = false,
                                                                .colors = 1,
                                                                .constants = constants}));
        return pipeline;
    };
    const auto create = [&](FrameStep step, std::span<const uint32_t> fragment, uint32_t push_bytes)
    { return createAt(passes.filterPlace(step), layouts.post.get(), fragment, push_bytes, between); };
    PostPass pass;
    if (passes.has(ShadedOutput::surfaces_on_tile) && hasSubpasses(passes.way()))
    {
        const DrawPlace place = passes.place(ShadedOutput::surfaces_on_tile, FrameStep::final_pass);
        HEARTH_ASSIGN_OR_RETURN(pass.final_on_tile_,
                                createAt(place, layouts.post_input.get(), shaders::final_tile_frag,
                                         sizeof(shared::FinalPush), shown));
    }
    HEARTH_ASSIGN_OR_RETURN(
        pass.exposure_, create(FrameStep::exposure, shaders::exposure_frag, sizeof(shared::ExposurePush)));
    HEARTH_ASSIGN_OR_RETURN(
        pass.down_, create(FrameStep::bloom_down, shaders::bloom_down_frag, sizeof(shared::BloomDownPush)));
    HEARTH_ASSIGN_OR_RETURN(pass.up_,
                            create(FrameStep::bloom_up, shaders::bloom_up_frag, sizeof(shared::BloomUpPush)));
    const std::span<const uint32_t> finals[2][2] = {
        {shaders::final_frag, shaders::final_exposure_frag},
        {shaders::final_bloom_frag, shaders::final_bloom_exposure_frag}};
    for (const size_t bloom : {size_t{0}, size_t{1}})
        for (const size_t exposure : {size_t{0}, size_t{1}})
        {
            HEARTH_ASSIGN_OR_RETURN(pass.final_[bloom][exposure],
                                    createAt(passes.filterPlace(FrameStep::final_pass), layouts.post.get(),
                                             finals[bloom][exposure], sizeof(shared::FinalPush), shown));
        }
    return pass;
}

template <typename Push>
void PostPass::draw(const Device& device, VkCommandBuffer commands, const Pipeline& pipeline,
                    VkDescriptorSet set, const Push& push)
{
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.pipeline.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout.get(),
                                      shared::kSetPost, 1, &set, 0, nullptr);
    device.vk.vkCmdPushConstants(commands, pipeline.layout.get(), kPushStages, 0, sizeof(push), &push);
    device.vk.vkCmdDraw(commands, 3, 1, 0, 0);
}

void PostPass::recordExposure(const Device& device, VkCommandBuffer commands, const PostTargets& targets,
                              const AutomaticExposure& exposure) const
{
    const shared::ExposurePush push{.key = exposure.key,
                                    .share = targets.hasExposure() ? exposureShare(exposure) : 1,
                                    .has_light = targets.hasLight() ? 1u : 0u,
                                    .has_history = targets.hasExposure() ? 1u : 0u};
    draw(device, commands, exposure_, targets.set(FrameResource::exposure), push);
}

void PostPass::recordDown(const Device& device, VkCommandBuffer commands, const PostTargets& targets,
                          uint32_t level) const
{
    draw(device, commands, down_, targets.set(bloomLevel(level)),
         shared::BloomDownPush{.dims_fireflies = level == 1 ? 1u : 0u});
}

void PostPass::recordUp(const Device& device, VkCommandBuffer commands, const PostTargets& targets,
                        uint32_t level) const
{
    // all levels have the same weight in the first sum: of n levels, those behind the first have (n - 1) / n
    const auto coarser = static_cast<float>(shared::kBloomLevels - level);
    draw(device, commands, up_, targets.set(bloomSum(level)),
         shared::BloomUpPush{.share = coarser / (coarser + 1)});
}

void PostPass::recordFinal(const Device& device, VkCommandBuffer commands, const PostTargets& targets,
                           const PostSettings& settings, VkExtent2D output, bool shows_data,
                           bool on_tile) const
{
    const PhotoFilter& filter = settings.photo_filter;
    const shared::FinalPush push{.width = static_cast<float>(output.width),
                                 .height = static_cast<float>(output.height),
                                 .exposure = std::exp2(settings.exposure_stops),
                                 .filter_red = filter.color.x,
                                 .filter_green = filter.color.y,
                                 .filter_blue = filter.color.z,
                                 .filter_density = filter.density,
                                 .bloom_strength = settings.bloom.strength,
                                 .adds_bloom = settings.bloom.mode == BloomMode::add ? 1u : 0u,
                                 .shows_data = shows_data ? 1u : 0u};
    if (on_tile)
        return draw(device, commands, final_on_tile_, targets.inputSet(), push);
    const bool blooms = !shows_data && settings.bloom.strength > 0;
    const bool adapts = !shows_data && settings.automatic_exposure.has_value();
    draw(device, commands, final_[blooms ? 1 : 0][adapts ? 1 : 0], targets.set(FrameResource::color), push);
}

} // namespace hearth::gpu
