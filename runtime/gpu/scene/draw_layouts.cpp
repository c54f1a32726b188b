// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/draw_layouts.h"

#include "formats/gpu_shared/deformation.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/gpu/scene/scene_tables.h"

namespace hearth::gpu
{

namespace
{

constexpr VkShaderStageFlags kVertexStage = VK_SHADER_STAGE_VERTEX_BIT;
constexpr VkShaderStageFlags kFragmentStage = VK_SHADER_STAGE_FRAGMENT_BIT;
constexpr VkShaderStageFlags kComputeStage = VK_SHADER_STAGE_COMPUTE_BIT;

static_assert(shared::kSceneDeformation == shared::kScenePool + shared::kDeformationSlice);
static_assert(shared::kSceneLighting == shared::kScenePool + shared::kPoolSlices);

std::vector<SetBinding> join(std::initializer_list<std::span<const SetBinding>> sets)
{
    std::vector<SetBinding> joined;
    for (const std::span<const SetBinding> set : sets)
        joined.insert(joined.end(), set.begin(), set.end());
    return joined;
}

} // namespace

ShadingBindings shadingBindings(const ShadingDescriptors& descriptors)
{
    // the skinning pass and the pass that chooses gather points read the scene like vertex shaders
    constexpr VkShaderStageFlags kAll = kVertexStage | kFragmentStage | kComputeStage;
    ShadingBindings bindings;
    bindings.scene = {
        uniformBinding(shared::kSceneFrame, kAll),
        storageBinding(shared::kSceneInstances, kAll),
        storageBinding(shared::kSceneVisible, kAll),
        storageBinding(shared::kSceneDraws, kAll),
        storageBinding(shared::kSceneLighting, kFragmentStage),
        uniformBinding(shared::kSceneShadows, kVertexStage | kFragmentStage),
        textureBinding(shared::kSceneShadowMaps, kFragmentStage),
        textureBinding(shared::kSceneSpecularTable, kFragmentStage),
        textureBinding(shared::kSceneShadingTables, kFragmentStage),
        textureBinding(shared::kSceneReceivers, kFragmentStage),
        textureBinding(shared::kSceneSkyCube, kFragmentStage),
    };
    for (uint32_t slice = 0; slice < shared::kPoolSlices; ++slice)
        bindings.scene.push_back(storageBinding(shared::kScenePool + slice, kAll));

    bindings.material = {uniformBinding(shared::kMaterialBlock, kVertexStage | kFragmentStage),
                         uniformBinding(shared::kMaterialLayers, kFragmentStage)};
    static_assert(shared::kMaterialLayers == shared::kMaterialTextures + shared::kTextureCount);
    for (uint32_t slot = 0; slot < shared::kTextureCount; ++slot)
        bindings.material.push_back(textureBinding(shared::kMaterialTextures + slot, kFragmentStage));

    bindings.visibility = {{shared::kAttachmentVisibility, descriptors.visibility, kFragmentStage}};
    bindings.attachments = {bindings.visibility.front(),
                            storageBinding(shared::kAttachmentTileLists, kVertexStage),
                            textureBinding(shared::kAttachmentGi, kFragmentStage)};
    for (uint32_t i = 0; i < shared::kLightImages && descriptors.has_light_images; ++i)
        bindings.attachments.push_back(
            {shared::kAttachmentLight + i, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, kFragmentStage});
    bindings.cluster_views = tableBindings(kClusterViewTables, kFragmentStage);
    return bindings;
}

std::vector<SetBinding> litBindings(VkDescriptorType image)
{
    // volumes of lights read them too
    return {uniformBinding(shared::kSceneFrame, kVertexStage | kFragmentStage),
            storageBinding(shared::kSceneLighting, kVertexStage | kFragmentStage),
            uniformBinding(shared::kSceneShadows, kFragmentStage),
            textureBinding(shared::kSceneShadowMaps, kFragmentStage),
            textureBinding(shared::kSceneShadingTables, kFragmentStage),
            {shared::kAttachmentSurfaces, image, kFragmentStage},
            {shared::kAttachmentDepth, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, kFragmentStage}};
}

Status DrawLayouts::createShadingSets(const Device& device)
{
    const ShadingBindings bindings = shadingBindings(descriptors);
    HEARTH_ASSIGN_OR_RETURN(scene, createSetLayout(device, bindings.scene));
    HEARTH_ASSIGN_OR_RETURN(material, createSetLayout(device, bindings.material));
    HEARTH_ASSIGN_OR_RETURN(attachments, createSetLayout(device, bindings.attachments));
    HEARTH_ASSIGN_OR_RETURN(cluster_view, createSetLayout(device, bindings.cluster_views));
    HEARTH_ASSIGN_OR_RETURN(lit, createSetLayout(device, litBindings(descriptors.visibility)));
    const SetBinding bin_bindings[] = {storageBinding(shared::kBinsDraws, kVertexStage)};
    HEARTH_ASSIGN_OR_RETURN(bins, createSetLayout(device, bin_bindings));
    if (!descriptors.one_set)
        return success();
    HEARTH_ASSIGN_OR_RETURN(joined_shading, createSetLayout(device, join({bindings.scene, bindings.material,
                                                                          bindings.attachments})));
    HEARTH_ASSIGN_OR_RETURN(joined_clusters,
                            createSetLayout(device, join({bindings.cluster_views, bindings.visibility})));
    return success();
}

Status DrawLayouts::createFrameSets(const Device& device)
{
    const SetBinding occlusion_bindings[] = {uniformBinding(shared::kOcclusionViews, kComputeStage),
                                             storageBinding(shared::kOcclusionPyramid, kComputeStage),
                                             textureBinding(shared::kOcclusionDepth, kComputeStage)};
    HEARTH_ASSIGN_OR_RETURN(occlusion, createSetLayout(device, occlusion_bindings));

    const SetBinding tile_bindings[] = {textureBinding(shared::kTilesVisibility, kComputeStage),
                                        storageBinding(shared::kTilesMaterials, kComputeStage),
                                        storageBinding(shared::kTilesLists, kComputeStage)};
    HEARTH_ASSIGN_OR_RETURN(tiles, createSetLayout(device, tile_bindings));

    const SetBinding light_bindings[] = {storageBinding(shared::kLightsBuffer, kComputeStage)};
    HEARTH_ASSIGN_OR_RETURN(lights, createSetLayout(device, light_bindings));

    const SetBinding pixel_bindings[] = {
        textureBinding(shared::kPixelsVisibility, kComputeStage | kFragmentStage)};
    HEARTH_ASSIGN_OR_RETURN(pixels, createSetLayout(device, pixel_bindings));

    const SetBinding temporal_bindings[] = {textureBinding(shared::kTemporalColor, kFragmentStage),
                                            textureBinding(shared::kTemporalMotion, kFragmentStage),
                                            textureBinding(shared::kTemporalDistances, kFragmentStage),
                                            textureBinding(shared::kTemporalEarlierDistances, kFragmentStage),
                                            textureBinding(shared::kTemporalHistory, kFragmentStage)};
    HEARTH_ASSIGN_OR_RETURN(temporal, createSetLayout(device, temporal_bindings));

    const SetBinding post_bindings[] = {textureBinding(shared::kPostRadiance, kFragmentStage),
                                        textureBinding(shared::kPostBloom, kFragmentStage),
                                        textureBinding(shared::kPostExposure, kFragmentStage)};
    HEARTH_ASSIGN_OR_RETURN(post, createSetLayout(device, post_bindings));
    const SetBinding post_inputs[] = {
        {shared::kPostRadiance, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, kFragmentStage}};
    HEARTH_ASSIGN_OR_RETURN(post_input, createSetLayout(device, post_inputs));
    return success();
}

Status DrawLayouts::createBrickSets(const Device& device)
{
    constexpr VkShaderStageFlags kBoth = kComputeStage | kFragmentStage;
    const SetBinding brick_bindings[] = {
        uniformBinding(shared::kBricksFrame, kBoth),   uniformBinding(shared::kBricksView, kBoth),
        storageBinding(shared::kBricksGroups, kBoth),  storageBinding(shared::kBricksBricks, kBoth),
        storageBinding(shared::kBricksOpacity, kBoth), storageBinding(shared::kBricksSurfaces, kBoth),
        storageBinding(shared::kBricksLight, kBoth),   storageBinding(shared::kBricksLighting, kBoth)};
    HEARTH_ASSIGN_OR_RETURN(bricks, createSetLayout(device, brick_bindings));

    const SetBinding fresh_bindings[] = {storageBinding(shared::kFreshLightFaces, kComputeStage),
                                         storageBinding(shared::kFreshLightLocations, kComputeStage)};
    HEARTH_ASSIGN_OR_RETURN(fresh_light, createSetLayout(device, fresh_bindings));

    const SetBinding point_bindings[] = {textureBinding(shared::kGatherPointVisibility, kComputeStage),
                                         storageBinding(shared::kGatherPointPoints, kComputeStage)};
    HEARTH_ASSIGN_OR_RETURN(gather_point, createSetLayout(device, point_bindings));

    const SetBinding gather_bindings[] = {
        uniformBinding(shared::kGatherView, kComputeStage),
        storageBinding(shared::kGatherPoints, kComputeStage),
        storageBinding(shared::kGatherHistory, kComputeStage),
        {shared::kGatherTexels, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kComputeStage}};
    HEARTH_ASSIGN_OR_RETURN(gather, createSetLayout(device, gather_bindings));
    return success();
}

Status DrawLayouts::createPipelineLayouts(const Device& device)
{
    const NumberedSet visibility_sets[] = {{shared::kSetScene, scene.get()},
                                           {shared::kSetMaterial, material.get()},
                                           {shared::kSetBins, bins.get()}};
    HEARTH_ASSIGN_OR_RETURN(
        visibility, createPipelineLayout(device, visibility_sets, kBinPushStages, sizeof(shared::BinPush)));
    const auto createShading = [&](const std::vector<NumberedSet>& sets)
    { return createPipelineLayout(device, sets, kShadingPushStages, sizeof(shared::ShadingPush)); };
    std::vector<NumberedSet> shading_sets = {{shared::kSetScene, scene.get()},
                                             {shared::kSetMaterial, material.get()},
                                             {shared::kSetAttachments, attachments.get()}};
    std::vector<NumberedSet> cluster_sets = {{shared::kSetTables, cluster_view.get()},
                                             {shared::kSetClusterAttachments, attachments.get()}};
    if (joinsSets())
    {
        shading_sets = {{kJoinedSet, joined_shading.get()}};
        cluster_sets = {{kJoinedSet, joined_clusters.get()}};
    }
    HEARTH_ASSIGN_OR_RETURN(shading, createShading(shading_sets));
    HEARTH_ASSIGN_OR_RETURN(clusters, createShading(cluster_sets));
    const NumberedSet lit_sets[] = {{shared::kSetScene, lit.get()}};
    HEARTH_ASSIGN_OR_RETURN(lit_surfaces, createPipelineLayout(device, lit_sets, 0, 0));
    HEARTH_ASSIGN_OR_RETURN(brick_views, createShading({{shared::kSetBricks, bricks.get()}}));
    return success();
}

Result<DrawLayouts> DrawLayouts::create(const Device& device, const ShadingDescriptors& descriptors)
{
    DrawLayouts layouts;
    layouts.descriptors = descriptors;
    HEARTH_TRY(layouts.createShadingSets(device));
    HEARTH_TRY(layouts.createFrameSets(device));
    HEARTH_TRY(layouts.createBrickSets(device));
    HEARTH_TRY(layouts.createPipelineLayouts(device));
    return layouts;
}

} // namespace hearth::gpu
