// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/draw_layouts.h"

#include "formats/gpu_shared/shading.h"

namespace hearth::gpu
{

Result<DrawLayouts> DrawLayouts::create(const Device& device)
{
    constexpr VkShaderStageFlags kBoth = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    // the skinning pass and the pass that chooses gather points read the scene like vertex shaders
    std::vector<SetBinding> scene(kSceneBindingCount,
                                  {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kBoth | VK_SHADER_STAGE_COMPUTE_BIT});
    scene[kSceneFrame] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kBoth | VK_SHADER_STAGE_COMPUTE_BIT};
    scene[kSceneLighting].stages = VK_SHADER_STAGE_FRAGMENT_BIT;
    scene[kSceneShadows] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kBoth};
    for (const SceneBinding texture : {kSceneShadowMaps, kSceneSpecularTable})
        scene[texture] = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT};

    std::vector<SetBinding> material(
        1 + shared::kTextureCount, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT});
    material[0] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kBoth};

    const SetBinding bins[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT}};
    const SetBinding attachments[] = {
        {VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, VK_SHADER_STAGE_FRAGMENT_BIT},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}};

    const SetBinding occlusion[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT},
                                    {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT},
                                    {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_COMPUTE_BIT}};

    const SetBinding tiles[] = {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_COMPUTE_BIT},
                                {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT},
                                {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT}};

    std::vector<SetBinding> cluster_view(5,
                                         {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT});
    cluster_view[kClusterViewFrame].type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;

    std::vector<SetBinding> bricks(
        kBrickBindingCount,
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT});
    bricks[kBrickFrame].type = bricks[kBrickView].type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    const SetBinding fresh_light[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT},
                                      {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT}};
    const SetBinding gather_point[] = {
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_COMPUTE_BIT},
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT}};
    const SetBinding gather[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT},
                                 {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT},
                                 {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT},
                                 {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_SHADER_STAGE_COMPUTE_BIT}};

    DrawLayouts layouts;
    HEARTH_ASSIGN_OR_RETURN(layouts.scene, createSetLayout(device, scene));
    HEARTH_ASSIGN_OR_RETURN(layouts.material, createSetLayout(device, material));
    HEARTH_ASSIGN_OR_RETURN(layouts.bins, createSetLayout(device, bins));
    HEARTH_ASSIGN_OR_RETURN(layouts.attachments, createSetLayout(device, attachments));
    HEARTH_ASSIGN_OR_RETURN(layouts.occlusion, createSetLayout(device, occlusion));
    HEARTH_ASSIGN_OR_RETURN(layouts.tiles, createSetLayout(device, tiles));
    HEARTH_ASSIGN_OR_RETURN(layouts.cluster_view, createSetLayout(device, cluster_view));
    HEARTH_ASSIGN_OR_RETURN(layouts.bricks, createSetLayout(device, bricks));
    HEARTH_ASSIGN_OR_RETURN(layouts.fresh_light, createSetLayout(device, fresh_light));
    HEARTH_ASSIGN_OR_RETURN(layouts.gather_point, createSetLayout(device, gather_point));
    HEARTH_ASSIGN_OR_RETURN(layouts.gather, createSetLayout(device, gather));
    const VkDescriptorSetLayout visibility_sets[] = {layouts.scene.get(), layouts.material.get(),
                                                     layouts.bins.get()};
    const VkDescriptorSetLayout picture_sets[] = {layouts.scene.get(), layouts.material.get(),
                                                  layouts.attachments.get()};
    HEARTH_ASSIGN_OR_RETURN(layouts.visibility,
                            createPipelineLayout(device, visibility_sets, kDrawPushStages, sizeof(DrawPush)));
    HEARTH_ASSIGN_OR_RETURN(layouts.picture,
                            createPipelineLayout(device, picture_sets, kDrawPushStages, sizeof(DrawPush)));
    const VkDescriptorSetLayout cluster_sets[] = {layouts.cluster_view.get(), layouts.attachments.get()};
    HEARTH_ASSIGN_OR_RETURN(layouts.clusters,
                            createPipelineLayout(device, cluster_sets, kDrawPushStages, sizeof(DrawPush)));
    const VkDescriptorSetLayout brick_sets[] = {layouts.bricks.get()};
    HEARTH_ASSIGN_OR_RETURN(layouts.brick_views,
                            createPipelineLayout(device, brick_sets, kDrawPushStages, sizeof(DrawPush)));
    return layouts;
}

} // namespace hearth::gpu
