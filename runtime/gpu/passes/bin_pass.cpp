// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/bin_pass.h"

#include "runtime/gpu/passes/frame_targets.h"
#include "runtime/shaders/shaders.h"

namespace hearth::gpu
{

Result<BinPass> BinPass::createVisibility(const Device& device, const DrawLayouts& layouts,
                                          const DrawPlace& place)
{
    BinPass pass;
    pass.description_ = {.vertex = shaders::visibility_vert,
                         .fragment = shaders::visibility_frag,
                         .layout = layouts.visibility.get(),
                         .render_pass = place.render_pass,
                         .subpass = place.subpass,
                         .depth_compare =
                             VK_COMPARE_OP_GREATER, // reversed depth: 1 at the near plane, 0 at infinity
                         .depth_write = true,
                         .colors = 1};
    pass.alpha_tested_ = {shaders::visibility_masked_vert, shaders::visibility_masked_frag};
    HEARTH_TRY(pass.createPipelines(device, shared::kDeformedNone, pass.rigid_));
    return pass;
}

Result<BinPass> BinPass::createOverdraw(const Device& device, const DrawLayouts& layouts,
                                        const DrawPlace& place)
{
    BinPass pass;
    pass.description_ = {.vertex = shaders::visibility_vert,
                         .fragment = shaders::overdraw_frag,
                         .layout = layouts.visibility.get(),
                         .render_pass = place.render_pass,
                         .subpass = place.subpass,
                         .depth_compare = VK_COMPARE_OP_ALWAYS,
                         .depth_write = false,
                         .colors = 1,
                         .add = true};
    pass.alpha_tested_ = {shaders::visibility_masked_vert, shaders::overdraw_masked_frag};
    HEARTH_TRY(pass.createPipelines(device, shared::kDeformedNone, pass.rigid_));
    return pass;
}

/// Culls no faces: triangles that face away from the light cast as well, since a surface without thickness
/// has no other side.
Result<BinPass> BinPass::createCasters(const Device& device, const DrawLayouts& layouts,
                                       VkRenderPass render_pass)
{
    BinPass pass;
    pass.casters_ = true;
    pass.description_ = {.vertex = shaders::caster_vert,
                         .fragment = shaders::caster_frag,
                         .layout = layouts.visibility.get(),
                         .render_pass = render_pass,
                         .subpass = 0,
                         .depth_compare = VK_COMPARE_OP_GREATER, // reversed depth, as in the frame
                         .depth_write = true,
                         .colors = 0};
    pass.alpha_tested_ = {shaders::caster_masked_vert, shaders::caster_masked_frag};
    HEARTH_TRY(pass.createPipelines(device, shared::kDeformedNone, pass.rigid_));
    return pass;
}

/// Never reads pre-skinned vertices of casters: a map sees other clusters than the frame, and each is drawn
/// once.
Status BinPass::prepareDeformed(const Device& device)
{
    if (!deformed_)
    {
        Variants variants;
        HEARTH_TRY(createPipelines(device, casters_ ? shared::kDeformedOnDemand : shared::kDeformedPreSkinned,
                                   variants));
        deformed_ = std::move(variants);
    }
    return success();
}

Status BinPass::prepareMotion(const Device& device, const MaterialShaders& shaders, uint32_t motion)
{
    if (motions_.contains(motion))
        return success();
    HEARTH_ASSIGN_OR_RETURN(const auto vertex,
                            findModule(shaders, casters_ ? "caster.vert" : "visibility.vert"));
    HEARTH_ASSIGN_OR_RETURN(const auto tested_vertex,
                            findModule(shaders, casters_ ? "caster_masked.vert" : "visibility_masked.vert"));
    DrawConstants constants{};
    constants[shared::kConstantMaterialMotion] = motion;
    Variants variants;
    HEARTH_TRY(createPipelines(device, constants, vertex, tested_vertex, variants));
    motions_.emplace(motion, std::move(variants));
    return success();
}

Status BinPass::createPipelines(const Device& device, uint32_t deformed, Variants& variants) const
{
    DrawConstants constants{}; // these shaders have no others
    constants[shared::kConstantDeformed] = deformed;
    return createPipelines(device, constants, description_.vertex, alpha_tested_.vertex, variants);
}

/// constants  but for the slices of the pool
Status BinPass::createPipelines(const Device& device, DrawConstants constants,
                                std::span<const uint32_t> vertex, std::span<const uint32_t> tested_vertex,
                                Variants& variants) const
{
    GraphicsDescription opaque = description_;
    opaque.vertex = vertex;
    for (const size_t slices : {size_t{0}, size_t{1}})
        for (const Facing facing : {Facing::culled, Facing::mirrored, Facing::doubleSided})
        {
            if (casters_ && facing != Facing::doubleSided)
                continue;
            constants[shared::kConstantUsedSlices] = slices == 0 ? 1 : shared::kPoolSlices;
            opaque.constants = constants;
            opaque.cull =
                VkCullModeFlags(facing == Facing::doubleSided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT);
            opaque.front_face =
                facing == Facing::mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
            GraphicsDescription tested = opaque;
            tested.vertex = tested_vertex;
            tested.fragment = alpha_tested_.fragment;
            const auto index = static_cast<size_t>(facing);
            HEARTH_ASSIGN_OR_RETURN(variants.opaque[slices][index], createGraphicsPipeline(device, opaque));
            HEARTH_ASSIGN_OR_RETURN(variants.alpha_tested[slices][index],
                                    createGraphicsPipeline(device, tested));
        }
    return success();
}

const BinPass::Variants& BinPass::findVariants(const SceneBin& bin) const
{
    if (bin.motion != 0)
        return motions_.at(bin.motion);
    return bin.deformed ? *deformed_ : rigid_;
}

void BinPass::record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                     const Scene& scene, const SceneView& view, uint32_t phase, shared::BinPush push) const
{
    const VkPipelineLayout layout = layouts.visibility.get();
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, shared::kSetScene, 1,
                                      &view.draw_set, 0, nullptr);
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, shared::kSetBins, 1,
                                      &view.bins_set, 0, nullptr);
    const size_t slices = scene.used_slices == 1 ? 0 : 1;
    const auto bin_count = static_cast<uint32_t>(scene.bins.size());
    for (uint32_t i = 0; i < bin_count; ++i)
    {
        const SceneBin& bin = scene.bins[i];
        if (casters_ && bin.unlit)
            continue;
        const Variants& variants = findVariants(bin);
        const Pipelines& pipelines = (bin.alpha_tested ? variants.alpha_tested : variants.opaque)[slices];
        const Facing facing = casters_ ? Facing::doubleSided : bin.facing;
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                    pipelines[static_cast<size_t>(facing)].get());
        if (bin.alpha_tested || bin.motion != 0)
        {
            const VkDescriptorSet set = materialSet(scene, bin.material_row);
            device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout,
                                              shared::kSetMaterial, 1, &set, 0, nullptr);
        }
        push.facing = bin.facing == Facing::doubleSided ? shared::kCasterDoubleSided
                      : bin.facing == Facing::mirrored  ? shared::kCasterClockwise
                                                        : shared::kCasterCounterclockwise;
        push.bin = phase == shared::kPhaseLate ? bin_count + i : i;
        device.vk.vkCmdPushConstants(commands, layout, kBinPushStages, 0, sizeof(push), &push);
        device.vk.vkCmdDrawIndirect(commands, view.bin_draws.handle.get(), push.bin * sizeof(shared::BinDraw),
                                    1, sizeof(shared::BinDraw));
    }
}

} // namespace hearth::gpu
