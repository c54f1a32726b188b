// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/shading_pass.h"

#include "runtime/gpu/passes/material_marks_pass.h"
#include "runtime/gpu/passes/shading_binder.h"
#include "runtime/gpu/passes/visibility_reading.h"
#include "runtime/gpu/scene/scene_shadows.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hearth::gpu
{

namespace
{

/// Return the push constants of the area of a material; only materials need the sky occlusion.
shared::ShadingPush shadingPush(const ShadingSettings& view, uint32_t material, uint32_t sky_occlusion = 0)
{
    // views of all surfaces are drawn at the depth of the sky
    const uint32_t level = material == shared::kEverySurface ? 0 : material;
    const PhotoFilter& filter = view.post.photo_filter;
    return {.depth = static_cast<float>(level) * shared::kMaterialDepthStep,
            .material = material,
            .debug_view = view.debug_view,
            .depth_scale = view.depth_scale,
            .sky_occlusion = sky_occlusion,
            .exposure = std::exp2(view.post.exposure_stops),
            .filter_red = filter.color.x,
            .filter_green = filter.color.y,
            .filter_blue = filter.color.z,
            .filter_density = filter.density};
}

bool showsDeformed(const Scene& scene)
{
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const SceneMaterial& m) { return m.variant.deformed != 0; });
}

uint32_t skyOcclusion(const Scene& scene, const ShadingSettings& view)
{
    const bool no_table = view.specular_occlusion == shared::kSpecularOcclusionTable &&
                          scene.specular_table.view.get() == VK_NULL_HANDLE;
    return shared::skyOcclusionBits(view.ambient_occlusion,
                                    no_table ? shared::kSpecularOcclusionFit : view.specular_occlusion,
                                    scene.specular_spacing);
}

} // namespace

/// Return the shader that shades materials.
const shaders::VariedShader& ShadingPass::materialShader(bool shadowed, bool gi) const
{
    using namespace shaders;
    struct Shaders
    {
        const VariedShader *plain, *shadowed, *gi, *shadowed_gi;
    };
    static constexpr Shaders kShading{&shading_frag, &shading_shadowed_frag, &shading_gi_frag,
                                      &shading_shadowed_gi_frag};
    static constexpr Shaders kSurfaces{&surfaces_frag, &surfaces_shadowed_frag, &surfaces_gi_frag,
                                       &surfaces_shadowed_gi_frag};
    static constexpr Shaders kSummed{&summed_frag, &summed_shadowed_frag, &summed_gi_frag,
                                     &summed_shadowed_gi_frag};
    static constexpr Shaders kJoint{&joint_frag, &joint_shadowed_frag, &joint_gi_frag,
                                    &joint_shadowed_gi_frag};
    static constexpr Shaders kMarked{&marked_frag, &marked_shadowed_frag, &marked_gi_frag,
                                     &marked_shadowed_gi_frag};
    static constexpr const Shaders* kByPath[] = {&kShading, &kSurfaces, &kSurfaces, &kSummed,
                                                 &kJoint,   &kJoint,    &kMarked};
    static_assert(std::size(kByPath) == kLightPathCount);
    const Shaders& own = *kByPath[static_cast<size_t>(lightPath(output_))];
    return gi ? (shadowed ? *own.shadowed_gi : *own.gi) : (shadowed ? *own.shadowed : *own.plain);
}

/// Return the words of a shader that reads materials: with the game's functions where the material has one.
Result<std::span<const uint32_t>> ShadingPass::findWords(const shaders::VariedShader& shader,
                                                         const ShadingVariant& variant) const
{
    const shaders::Variant reading = shaderVariant(way_);
    if (variant.function == 0 && variant.motion == 0)
        return shader[reading];
    HEARTH_ASSERT(functions_ != nullptr);
    return findModule(*functions_, shaders::fileName(shader, reading));
}

/// Describe a pipeline that shades the pixels of one material.
GraphicsDescription ShadingPass::describe(std::span<const uint32_t> fragment, VkPipelineLayout layout) const
{
    const bool by_depth = material_test_ == MaterialTest::depth;
    return {.vertex = shaders::shaded_area_vert[shaderVariant(way_)],
            .fragment = fragment,
            .layout = layout,
            .one_set = way_ == FrameWay::one_set,
            .render_pass = place_.render_pass,
            .subpass = place_.subpass,
            .depth_compare = by_depth ? VK_COMPARE_OP_EQUAL : VK_COMPARE_OP_ALWAYS,
            .depth_write = false,
            .colors = shadedColors(output_),
            .stencil = by_depth ? Stencil::none : Stencil::test};
}

/// Describe a pipeline that shows all surfaces in one triangle at the depth of the sky, which it leaves out.
GraphicsDescription ShadingPass::describeSurfaceView(std::span<const uint32_t> fragment,
                                                     VkPipelineLayout layout) const
{
    GraphicsDescription description = describe(fragment, layout);
    description.vertex = shaders::fullscreen_vert;
    description.stencil = Stencil::none; // the shader leaves out the sky
    if (material_test_ == MaterialTest::depth)
        description.depth_compare = VK_COMPARE_OP_LESS;
    return description;
}

/// Return the constants of a variant; with `resolves_only` those that reconstructing a surface needs, for
/// scenes of any size.
DrawConstants ShadingPass::drawConstants(const ShadingVariant& variant, bool resolves_only) const
{
    DrawConstants constants = view_constants_;
    constants[shared::kConstantUsedSlices] = resolves_only ? shared::kPoolSlices : variant.used_slices;
    constants[shared::kConstantDeformed] =
        variant.deformed != 0 ? shared::kDeformedPreSkinned : shared::kDeformedNone;
    constants[shared::kConstantFiltersShadows] = variant.filters_shadows;
    if (resolves_only)
        return constants;
    constants[shared::kConstantTextures] = variant.textures;
    constants[shared::kConstantUvSets] = variant.uv_sets;
    constants[shared::kConstantUnlit] = variant.unlit;
    constants[shared::kConstantSkyVisibility] = variant.sky_visibility;
    constants[shared::kConstantLayers] = variant.layers;
    constants[shared::kConstantLocalProbes] = variant.local_probes;
    constants[shared::kConstantLightList] = variant.light_list;
    constants[shared::kConstantReceivers] = variant.receivers;
    constants[shared::kConstantMaterialFunction] = variant.function;
    constants[shared::kConstantMaterialMotion] = variant.motion;
    return constants;
}

/// Set the stencil of the pixels that the next draw shades.
void ShadingPass::setStencil(const Device& device, VkCommandBuffer commands, uint32_t material) const
{
    if (material_test_ == MaterialTest::id)
        device.vk.vkCmdSetStencilReference(commands, VK_STENCIL_FACE_FRONT_AND_BACK,
                                           material & ((1u << kStencilBits) - 1));
}

Result<ShadingPass> ShadingPass::create(const Device& device, const DrawLayouts& layouts,
                                        const FramePasses& passes, ShadedOutput output,
                                        const StoredColor& color, const MaterialShaders* functions)
{
    ShadingPass pass;
    pass.functions_ = functions;
    pass.output_ = output;
    pass.place_ = passes.place(output, FrameStep::shading);
    pass.way_ = passes.way();
    const shaders::Variant reading = shaderVariant(pass.way_);
    pass.material_test_ = passes.materials();
    pass.view_constants_[shared::kConstantComparesMaterial] = pass.material_test_ == MaterialTest::id ? 1 : 0;
    setStoredColor(pass.view_constants_, color);
    if (sumsLights(lightPath(output)))
        pass.normals_place_ = passes.place(output, FrameStep::normals);
    const bool stores_surfaces = storesSurfaces(lightPath(output));
    GraphicsDescription sky = pass.describe(
        (stores_surfaces ? shaders::surfaces_sky_frag : shaders::sky_frag)[reading], layouts.shading.get());
    sky.constants = pass.view_constants_;
    HEARTH_ASSIGN_OR_RETURN(pass.sky_, createGraphicsPipeline(device, sky));
    if (lightPath(output) != LightPath::materials)
        return pass;
    GraphicsDescription clusters =
        pass.describeSurfaceView(shaders::view_clusters_frag[reading], layouts.clusters.get());
    clusters.constants = pass.view_constants_;
    HEARTH_ASSIGN_OR_RETURN(pass.cluster_views_, createGraphicsPipeline(device, clusters));
    return pass;
}

/// Create the pipelines of the debug views that a scene with this variant may show.
Status ShadingPass::prepareViews(const Device& device, const DrawLayouts& layouts,
                                 const ShadingVariant& variant)
{
    UniquePipeline& shadow_maps = shadow_map_views_[variant.deformed][variant.filters_shadows];
    if (variant.shadows != 0 && shadow_maps.get() == VK_NULL_HANDLE)
    {
        const DrawConstants constants = drawConstants(variant, true);
        GraphicsDescription maps =
            describeSurfaceView(shaders::view_shadow_maps_frag[shaderVariant(way_)], layouts.shading.get());
        maps.constants = constants;
        HEARTH_ASSIGN_OR_RETURN(shadow_maps, createGraphicsPipeline(device, maps));
    }
    return variant.bricks != 0 ? prepareBrickViews(device, layouts, variant) : success();
}

Result<ShadingPipelines> ShadingPass::prepare(const Device& device, const DrawLayouts& layouts,
                                              const ShadingVariant& variant)
{
    const bool has_views = lightPath(output_) == LightPath::materials;
    if (has_views)
        HEARTH_TRY(prepareViews(device, layouts, variant));
    const bool shadowed = variant.shadows != 0;
    auto entry = variants_.find(variant);
    if (entry == variants_.end())
    {
        Variant pipelines; // an entry is whole: what fails half way is made again
        const DrawConstants constants = drawConstants(variant, false);
        HEARTH_ASSIGN_OR_RETURN(const std::span<const uint32_t> own,
                                findWords(materialShader(shadowed, false), variant));
        GraphicsDescription description = describe(own, layouts.shading.get());
        description.constants = constants;
        HEARTH_ASSIGN_OR_RETURN(pipelines.final_pipeline, createGraphicsPipeline(device, description));
        if (variant.bricks != 0)
        {
            HEARTH_ASSIGN_OR_RETURN(description.fragment, findWords(materialShader(shadowed, true), variant));
            HEARTH_ASSIGN_OR_RETURN(pipelines.final_gi_pipeline, createGraphicsPipeline(device, description));
        }
        // layers fit into no sums: they are lit where they are shaded
        if (sumsLights(lightPath(output_)) && variant.unlit == 0 && variant.layers == 0)
            HEARTH_TRY(createNormals(device, layouts, variant, pipelines.normals_pipeline));
        if (has_views)
        {
            HEARTH_ASSIGN_OR_RETURN(description.fragment, findWords(shaders::view_surface_frag, variant));
            HEARTH_ASSIGN_OR_RETURN(pipelines.debug_view_pipeline,
                                    createGraphicsPipeline(device, description));
        }
        entry = variants_.emplace(variant, std::move(pipelines)).first;
    }
    const Variant& pipelines = entry->second;
    return ShadingPipelines{pipelines.normals_pipeline.get(), pipelines.final_pipeline.get(),
                            pipelines.final_gi_pipeline.get(), pipelines.debug_view_pipeline.get()};
}

/// Create the pipeline that stores what lights need of a material's surfaces, ahead of shading.
Status ShadingPass::createNormals(const Device& device, const DrawLayouts& layouts,
                                  const ShadingVariant& variant, UniquePipeline& pipeline) const
{
    const LightPath path = lightPath(output_);
    const shaders::VariedShader& shader = path == LightPath::light_sums   ? shaders::normals_frag
                                          : path == LightPath::joint_sums ? shaders::joint_normals_frag
                                                                          : shaders::encoded_normals_frag;
    const DrawConstants constants = drawConstants(variant, false);
    HEARTH_ASSIGN_OR_RETURN(const std::span<const uint32_t> words, findWords(shader, variant));
    GraphicsDescription description = describe(words, layouts.shading.get());
    description.render_pass = normals_place_.render_pass;
    description.subpass = normals_place_.subpass;
    description.constants = constants;
    HEARTH_ASSIGN_OR_RETURN(pipeline, createGraphicsPipeline(device, description));
    return success();
}

/// Create the pipelines of the debug views of bricks and GI.
Status ShadingPass::prepareBrickViews(const Device& device, const DrawLayouts& layouts,
                                      const ShadingVariant& variant)
{
    if (brick_views_.get() == VK_NULL_HANDLE)
    {
        GraphicsDescription bricks =
            describeSurfaceView(shaders::view_bricks_frag, layouts.brick_views.get());
        bricks.depth_compare = VK_COMPARE_OP_ALWAYS;
        bricks.one_set = false;
        bricks.constants = view_constants_;
        HEARTH_ASSIGN_OR_RETURN(brick_views_, createGraphicsPipeline(device, bricks));
    }
    UniquePipeline& gathered = gi_views_[variant.deformed];
    if (gathered.get() == VK_NULL_HANDLE)
    {
        const DrawConstants constants = drawConstants(variant, true);
        GraphicsDescription light =
            describeSurfaceView(shaders::view_gi_frag[shaderVariant(way_)], layouts.shading.get());
        light.constants = constants;
        HEARTH_ASSIGN_OR_RETURN(gathered, createGraphicsPipeline(device, light));
    }
    return success();
}

void ShadingPass::record(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                         const Scene& scene, const FrameTargets& targets, const ShadingSettings& view) const
{
    using shared::ViewShader;
    recordSky(device, commands, layouts, scene, targets, view);
    switch (shared::viewShader(view.debug_view))
    {
    case ViewShader::materials:
    case ViewShader::surface:
        return recordMaterials(device, commands, layouts, scene, targets, view,
                               view.debug_view != shared::kViewFinal ? &ShadingPipelines::debug_view_pipeline
                               : usesGi(scene, view)                 ? &ShadingPipelines::final_gi_pipeline
                                                                     : &ShadingPipelines::final_pipeline);
    case ViewShader::clusters:
        return recordClusterView(device, commands, layouts, scene, targets, view);
    case ViewShader::shadow_maps:
        return recordShadowMapView(device, commands, layouts, scene, view);
    case ViewShader::bricks:
        return recordBrickView(device, commands, layouts, scene, view);
    case ViewShader::gi:
        return recordGiView(device, commands, layouts, scene, view);
    case ViewShader::overdraw: // a pass of its own
        return;
    }
}

void ShadingPass::recordNormals(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                                const Scene& scene, const FrameTargets& targets,
                                const ShadingSettings& view) const
{
    ShadingBinder(device, commands, layouts, scene, targets, lightPath(output_)).bindSurfaces();
    recordMaterials(device, commands, layouts, scene, targets, view, &ShadingPipelines::normals_pipeline);
}

void ShadingPass::recordSky(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                            const Scene& scene, const FrameTargets& targets,
                            const ShadingSettings& view) const
{
    const ShadingBinder binder(device, commands, layouts, scene, targets, lightPath(output_));
    binder.bindSurfaces();
    const shared::ShadingPush push = shadingPush(view, 0);
    device.vk.vkCmdPushConstants(commands, binder.layout(), kShadingPushStages, 0, sizeof(push), &push);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, sky_.get());
    setStencil(device, commands, 0);
    if (shadesTiles(scene, view.area))
        device.vk.vkCmdDrawIndirect(commands, scene.frame().tile_draws.handle.get(), 0, 1,
                                    sizeof(VkDrawIndirectCommand));
    else
        device.vk.vkCmdDraw(commands, 3, 1, 0, 0);
}

void ShadingPass::recordClusterView(const Device& device, VkCommandBuffer commands,
                                    const DrawLayouts& layouts, const Scene& scene,
                                    const FrameTargets& targets, const ShadingSettings& view) const
{
    const VkPipelineLayout layout = layouts.clusters.get();
    const shared::ShadingPush push = shadingPush(view, shared::kEverySurface);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, cluster_views_.get());
    ShadingBinder(device, commands, layouts, scene, targets, lightPath(output_)).bindClusters();
    device.vk.vkCmdPushConstants(commands, layout, kShadingPushStages, 0, sizeof(push), &push);
    device.vk.vkCmdDraw(commands, 3, 1, 0, 0);
}

/// Uses the sets that recordSky has bound.
void ShadingPass::recordShadowMapView(const Device& device, VkCommandBuffer commands,
                                      const DrawLayouts& layouts, const Scene& scene,
                                      const ShadingSettings& view) const
{
    HEARTH_ASSERT(scene.shadows != nullptr);
    const shared::ShadingPush push = shadingPush(view, shared::kEverySurface);
    device.vk.vkCmdPushConstants(commands, layouts.shading.get(), kShadingPushStages, 0, sizeof(push), &push);
    device.vk.vkCmdBindPipeline(
        commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
        shadow_map_views_[showsDeformed(scene) ? 1 : 0][scene.shadows->filters() ? 1 : 0].get());
    device.vk.vkCmdDraw(commands, 3, 1, 0, 0);
}

/// Replaces the sky as well.
void ShadingPass::recordBrickView(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                                  const Scene& scene, const ShadingSettings& view) const
{
    HEARTH_ASSERT(scene.bricks != nullptr);
    const VkPipelineLayout layout = layouts.brick_views.get();
    const shared::ShadingPush push = shadingPush(view, shared::kEverySurface);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, brick_views_.get());
    device.vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, shared::kSetBricks,
                                      1, &scene.frame().brick_set, 0, nullptr);
    device.vk.vkCmdPushConstants(commands, layout, kShadingPushStages, 0, sizeof(push), &push);
    device.vk.vkCmdDraw(commands, 3, 1, 0, 0);
}

/// Uses the sets that recordSky has bound.
void ShadingPass::recordGiView(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                               const Scene& scene, const ShadingSettings& view) const
{
    HEARTH_ASSERT(scene.bricks != nullptr);
    const shared::ShadingPush push = shadingPush(view, shared::kEverySurface);
    device.vk.vkCmdPushConstants(commands, layouts.shading.get(), kShadingPushStages, 0, sizeof(push), &push);
    device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                                gi_views_[showsDeformed(scene) ? 1 : 0].get());
    device.vk.vkCmdDraw(commands, 3, 1, 0, 0);
}

/// Uses the sets of all surfaces, which are bound.
void ShadingPass::recordMaterials(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                                  const Scene& scene, const FrameTargets& targets,
                                  const ShadingSettings& view, MaterialPipeline pipeline) const
{
    const ShadingBinder binder(device, commands, layouts, scene, targets, lightPath(output_));
    const VkBuffer draws =
        (shadesTiles(scene, view.area) ? scene.frame().tile_draws : scene.frame().main.material_draws)
            .handle.get();
    const uint32_t sky_occlusion = skyOcclusion(scene, view);
    for (uint32_t row = 0; row < scene.materials.size(); ++row)
    {
        const SceneMaterial& material = scene.materials[row];
        const ShadingPipelines& pipelines =
            material.pipelines[static_cast<size_t>(lightMethod(view))][static_cast<size_t>(output_)];
        if (pipelines.*pipeline == VK_NULL_HANDLE) // it stores no normals
            continue;
        device.vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.*pipeline);
        const uint32_t number = row + 1; // 0 is the sky
        const shared::ShadingPush push = shadingPush(view, number, sky_occlusion);
        setStencil(device, commands, number);
        binder.bindMaterial(row);
        device.vk.vkCmdPushConstants(commands, binder.layout(), kShadingPushStages, 0, sizeof(push), &push);
        // draws nothing where the material is not visible
        device.vk.vkCmdDrawIndirect(commands, draws, number * sizeof(VkDrawIndirectCommand), 1,
                                    sizeof(VkDrawIndirectCommand));
    }
}

} // namespace hearth::gpu
