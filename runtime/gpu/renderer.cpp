// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/renderer.h"

#include "runtime/gpu/frame/frame_plan.h"
#include "runtime/gpu/frame/frame_way.h"
#include "runtime/gpu/passes/frame_rollback.h"
#include "runtime/gpu/passes/frame_update.h"
#include "runtime/gpu/passes/visibility_reading.h"
#include "runtime/gpu/vulkan/debug_label.h"
#include "runtime/gpu/vulkan/pipelines.h"

#include <algorithm>
#include <cstring>

namespace hearth::gpu
{

namespace
{

void writeTimestamp(const Device& device, VkCommandBuffer commands, VkQueryPool pool, FrameTimestamp which)
{
    if (pool != VK_NULL_HANDLE)
        device.vk.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, which);
}

constexpr RequiredFormat kStencilFormat = {
    depthFormat(MaterialTest::id),
    VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
    "D32_SFLOAT_S8_UINT", "materials by id; by depth (--materials depth) they need no stencil"};

constexpr VkFormatFeatureFlags kDrawnAndFiltered = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT |
                                                   VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT |
                                                   VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
constexpr RequiredFormat kHalfFormat = {VK_FORMAT_R16G16B16A16_SFLOAT,
                                        kDrawnAndFiltered | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT,
                                        "R16G16B16A16_SFLOAT", "linear colours of frames with a final pass"};
constexpr RequiredFormat kSurfaceFormat = {
    kSurfacesFormat, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT,
    "R32G32B32A32_UINT", "surfaces that light methods store (--lights deferred and the like)"};
constexpr RequiredFormat kStopsFormat = {
    kExposureFormat, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT,
    "R32_SFLOAT", "automatic exposure"};

/// Require that frames can be drawn to a format.
RequiredFormat requireColor(const ColorFormat& format)
{
    return {format.format, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, format.name, "images that frames show"};
}

OcclusionCulling occlusionCulling(const FrameInput& input)
{
    if ((input.view.flags & shared::kCullOcclusion) == 0)
        return OcclusionCulling::off;
    return input.occludes_by_last_frame ? OcclusionCulling::last_frame : OcclusionCulling::two_phase;
}

/// True if the frame is culled and drawn in two phases.
bool hasTwoPhases(const FrameInput& input)
{
    return occlusionCulling(input) == OcclusionCulling::two_phase;
}

/// First or only culling phase of a frame. Without a second one, what the last frame occludes is left out.
uint32_t firstPhase(const FrameInput& input)
{
    return occlusionCulling(input) == OcclusionCulling::off ? shared::kPhaseWhole : shared::kPhaseEarly;
}

/// Areas for which the device lists the lights of a frame; none: the CPU lists them at once.
std::optional<LightAreas> listedAreas(const Scene& scene, const ShadingSettings& shading)
{
    const LightAreas areas = lightMethodFacts(lightMethod(shading)).areas;
    return scene.lights->listsOnDevice(shading.light_lister, areas) ? std::optional(areas) : std::nullopt;
}

FrameConfiguration configure(const Scene& scene, const FrameTargets& targets, const FrameInput& input,
                             bool in_parts)
{
    const std::optional<LightAreas> areas = listedAreas(scene, input.shading);
    const LightPath path = neededLightPath(targets, input.shading);
    return {.occlusion = occlusionCulling(input),
            .material_tiles = shadesTiles(scene, input.shading.area),
            .gathers_light = usesGi(scene, input.shading),
            .in_parts = in_parts,
            .keeps_visibility = targets.options().keeps_visibility,
            .shows_overdraw = input.shading.debug_view == shared::kViewOverdraw,
            .has_shadows = scene.shadows != nullptr,
            .shadow_format = scene.shadows == nullptr ? FrameConfiguration{}.shadow_format
                                                      : shadowFormat(scene.shadows->depth().depth),
            .lists_lights = areas.has_value(),
            .lists_slots = areas == LightAreas::slots,
            // by the method alone: the frame may be the one that adds the first light
            .lists_visible = needPixels(lightMethodFacts(lightMethod(input.shading)).areas),
            .lights_bricks = scene.bricks != nullptr,
            .has_final_pass = alwaysHasFinalPass(targets.options(), targets.extent()) ||
                              usesBloom(input.shading) || adaptsExposure(input.shading) ||
                              storesSurfaces(path),
            .adapts_exposure = adaptsExposure(input.shading),
            .blooms = usesBloom(input.shading),
            .light_path = path};
}

shared::FrameView scaledView(const Scene& scene, const shared::FrameView& view)
{
    return scene.stream == nullptr ? view : scene.stream->scaled(view);
}

/// Pass the moves and changes of the frame to the shadow cache, before the frame is recorded.
void trackShadows(const Scene& scene, std::span<const InstanceMove> moves, const Float4& material_inputs)
{
    if (scene.shadows == nullptr)
        return;
    scene.shadows->trackInputs(material_inputs);
    scene.shadows->track(moves, scene.stream == nullptr ? std::span<const pack::ResidentGroups::Change>()
                                                        : scene.stream->changedGroups());
}

/// True if the frame shows the light of bricks.
bool showsBricks(const FrameInput& input)
{
    return input.shading.gi || shared::viewNeedsBricks(input.shading.debug_view);
}

} // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(const DeviceDescription& description,
                                                   const RendererOptions& options)
{
    std::unique_ptr<Renderer> renderer(new Renderer);
    Renderer& r = *renderer;
    const ColorFormat* color_format = findColorFormat(options.color_format);
    HEARTH_ASSERT(color_format != nullptr);
    std::vector<RequiredFormat> formats{requireColor(*color_format)};
    const MaterialTest materials =
        options.deferred || options.keeps_depth ? MaterialTest::id : options.materials;
    r.receiver_update_ = options.receiver_update;
    r.material_shaders_ = options.material_shaders;
    if (r.material_shaders_ != nullptr)
        HEARTH_TRY(checkMaterialShaders(*r.material_shaders_));
    r.post_support_ = options.deferred ? PostSupport::half : options.post;
    if (materials == MaterialTest::id)
        formats.push_back(kStencilFormat);
    if (options.deferred)
        formats.push_back(kSurfaceFormat);
    const bool has_final_passes = r.post_support_ >= PostSupport::packed;
    if (has_final_passes)
        formats.insert(formats.end(), {kHalfFormat, kStopsFormat});
    HEARTH_ASSIGN_OR_RETURN(r.device_, makeDevice(description, formats));
    const FrameWay way = options.way.value_or(chooseFrameWay(r.device_.identity));
    HEARTH_ASSIGN_OR_RETURN(r.layouts_,
                            DrawLayouts::create(r.device_, shadingDescriptors(way, options.deferred)));
    std::optional<VkFormat> radiance_format;
    if (has_final_passes)
        radiance_format = r.post_support_ == PostSupport::packed && r.device_.draws_packed_floats
                              ? kPackedRadiance
                              : kHalfFormat.format;
    HEARTH_ASSIGN_OR_RETURN(r.passes_,
                            FramePasses::create(r.device_, {.way = way,
                                                            .materials = materials,
                                                            .radiance_format = radiance_format,
                                                            .deferred = options.deferred,
                                                            .keeps_depth = options.keeps_depth,
                                                            .color_format = options.color_format}));
    HEARTH_ASSIGN_OR_RETURN(r.light_lists_, LightListsPass::create(r.device_, r.layouts_));
    HEARTH_ASSIGN_OR_RETURN(r.cull_, CullPass::create(r.device_, r.layouts_));
    HEARTH_ASSIGN_OR_RETURN(r.copy_words_, WordCopyPass::create(r.device_));
    HEARTH_ASSIGN_OR_RETURN(r.page_requests_, PageRequestPass::create(r.device_));
    HEARTH_ASSIGN_OR_RETURN(r.pyramid_, PyramidPass::create(r.device_, r.layouts_));
    HEARTH_ASSIGN_OR_RETURN(r.material_tiles_, MaterialTilesPass::create(r.device_, r.layouts_));
    HEARTH_TRY(r.prepareDraws(LightPath::materials));
    if (r.passes_.hasFinalPasses())
    {
        HEARTH_ASSIGN_OR_RETURN(
            r.post_, PostPass::create(r.device_, r.layouts_, r.passes_, r.storedColor(ShadedOutput::color)));
    }
    return renderer;
}

Result<Renderer::DrawPasses> Renderer::createDrawPasses(ShadedOutput output) const
{
    DrawPasses draws;
    HEARTH_ASSIGN_OR_RETURN(
        draws.visibility,
        BinPass::createVisibility(device_, layouts_, passes_.place(output, FrameStep::visibility)));
    HEARTH_ASSIGN_OR_RETURN(draws.material_marks, MaterialMarksPass::create(device_, layouts_, passes_,
                                                                            output, FrameStep::shading));
    HEARTH_ASSIGN_OR_RETURN(draws.shading, ShadingPass::create(device_, layouts_, passes_, output,
                                                               storedColor(output), material_shaders_));
    const LightPath path = lightPath(output);
    if (sumsLights(path))
    {
        HEARTH_ASSIGN_OR_RETURN(draws.normal_marks, MaterialMarksPass::create(device_, layouts_, passes_,
                                                                              output, FrameStep::normals));
    }
    if (storesSurfaces(path) || sumsLights(path))
    {
        HEARTH_ASSIGN_OR_RETURN(draws.add_lights, AddLightsPass::create(device_, layouts_, passes_, output));
    }
    if (path == LightPath::light_bits)
    {
        HEARTH_ASSIGN_OR_RETURN(draws.mark_lights,
                                MarkLightsPass::create(device_, layouts_, passes_, output));
    }
    if (skinning_)
        HEARTH_TRY(draws.visibility.prepareDeformed(device_));
    for (const uint32_t motion : motions_)
        HEARTH_TRY(draws.visibility.prepareMotion(device_, *material_shaders_, motion));
    return draws;
}

Status Renderer::prepareDraws(LightPath path)
{
    for (size_t i = 0; i < kShadedOutputCount; ++i)
    {
        const auto output = static_cast<ShadedOutput>(i);
        if (!passes_.has(output) || !mayShade(path, output) || draws_[i])
            continue;
        HEARTH_ASSIGN_OR_RETURN(draws_[i], createDrawPasses(output));
    }
    return success();
}

StoredColor Renderer::storedColor(ShadedOutput output) const
{
    if (isRadiance(output))
        return {passes_.radianceFormat() == kPackedRadiance ? shared::kStoredPacked : shared::kStoredHalf, 0};
    const ColorFormat& format = colorFormat();
    if (format.content == ColorContent::radiance)
        return {format.format == kPackedRadiance ? shared::kStoredExposedPacked : shared::kStoredExposedHalf,
                0};
    return {post_support_ == PostSupport::none ? shared::kStoredDisplay : shared::kStoredGraded,
            format.content == ColorContent::codes ? 1u : 0u};
}

const Renderer::DrawPasses& Renderer::drawPasses(const PassRecorder& passes) const
{
    return *draws_[static_cast<size_t>(passes.shadedOutput())];
}

Result<FrameTargets> Renderer::createTargets(VkExtent2D extent, const TargetOptions& options) const
{
    return FrameTargets::create(device_, passes_, layouts_, extent, options);
}

FrameDescription Renderer::describe(const Scene& scene, const FrameTargets& targets, const FrameInput& input,
                                    bool in_parts) const
{
    FrameConfiguration configuration = configure(scene, targets, input, in_parts);
    configuration.way = passes_.way();
    configuration.radiance_format = passes_.radianceFormat();
    configuration.color_format = passes_.colorFormat();
    configuration.materials = passes_.materials();
    configuration.keeps_depth = passes_.keepsDepth();
    if (scene.shadows != nullptr)
    {
        configuration.maps_at_once = static_cast<uint32_t>(scene.frame().casters.size());
        for (const ShadowCache::LayerUpdate& map : scene.shadows->findStale(
                 scaledView(scene, input.view), scene.lights->lights(), input.shadow_spheres, input.moves))
            configuration.maps.push_back(map.copy_from ? MapContent::moving : MapContent::fresh);
    }
    return describeFrame(configuration);
}

const FramePlan& Renderer::plan(const Scene& scene, const FrameTargets& targets, const FrameInput& input,
                                bool in_parts) const
{
    const FrameConfiguration configuration = configure(scene, targets, input, in_parts);
    HEARTH_ASSERT(targets.allows(configuration));
    HEARTH_ASSERT(post_support_ != PostSupport::none || isNeutral(input.shading.post));
    return passes_.plan(configuration);
}

Result<std::unique_ptr<Scene>> Renderer::upload(const formats::PackView& pack, VkCommandBuffer commands,
                                                const SceneOptions& options)
{
    SceneOptions own = options;
    own.material_shaders = material_shaders_;
    HEARTH_ASSIGN_OR_RETURN(std::unique_ptr<Scene> scene,
                            uploadScene(device_, layouts_, pack, commands, own));
    if (scene->deformation != nullptr)
    {
        HEARTH_TRY(prepareDeformed());
        HEARTH_TRY(skinning_->createSets(device_, *scene));
    }
    if (scene->proxies_cast)
        HEARTH_TRY(cull_.prepareProxies(device_));
    HEARTH_TRY(cull_.createSets(device_, *scene));
    HEARTH_TRY(material_tiles_.createSets(device_, *scene));
    HEARTH_TRY(copy_words_.createSets(device_, *scene));
    if (scene->stream != nullptr)
        HEARTH_TRY(page_requests_.createSets(device_, *scene));
    if (options.shadows.max_maps > 0)
        HEARTH_TRY(createShadows(pack, options.shadows, commands, *scene));
    for (const SceneBin& bin : scene->bins)
        if (bin.motion != 0)
            HEARTH_TRY(prepareMotion(bin.motion));
    if (scene->bricks != nullptr && !gather_)
    {
        HEARTH_ASSIGN_OR_RETURN(brick_light_, BrickLightPass::create(device_, layouts_));
        HEARTH_ASSIGN_OR_RETURN(gather_, GatherPass::create(device_, layouts_));
    }
    if (scene->receivers != nullptr)
        HEARTH_TRY(createReceivers(pack, *scene));
    for (SceneMaterial& material : scene->materials)
    {
        material.variant.bricks = scene->bricks != nullptr ? 1 : 0;
        material.variant.receivers = scene->receivers != nullptr ? 1 : 0;
        material.variant.shadows = scene->shadows != nullptr ? 1 : 0;
        material.variant.filters_shadows = scene->shadows != nullptr && scene->shadows->filters() ? 1 : 0;
    }
    HEARTH_TRY(prepareLightMethod(*scene, LightMethod::practical));
    if (layouts_.joinsSets())
    {
        HEARTH_ASSIGN_OR_RETURN(scene->joined_sets, JoinedSets::create(device_, layouts_, *scene));
    }
    if (scene->dropped_lights > 0)
        warn(device_, pack.name(), "",
             std::to_string(scene->dropped_lights) + " lights are more than the " +
                 std::to_string(shared::kMaxLights) + " that are drawn");
    return scene;
}

/// Create the pipelines for scenes with deformed meshes.
Status Renderer::prepareDeformed()
{
    if (!skinning_)
    {
        HEARTH_ASSIGN_OR_RETURN(skinning_, SkinningPass::create(device_, layouts_));
    }
    HEARTH_TRY(cull_.prepareDeformed(device_, layouts_));
    HEARTH_TRY(page_requests_.prepareDeformed(device_));
    for (std::optional<DrawPasses>& draws : draws_)
    {
        if (draws && draws->overdraw)
            HEARTH_TRY(draws->overdraw->prepareDeformed(device_));
        if (draws)
            HEARTH_TRY(draws->visibility.prepareDeformed(device_));
    }
    return success();
}

/// Create the pipelines that draw materials with a motion.
Status Renderer::prepareMotion(uint32_t motion)
{
    motions_.insert(motion);
    for (std::optional<DrawPasses>& draws : draws_)
    {
        if (draws && draws->overdraw)
            HEARTH_TRY(draws->overdraw->prepareMotion(device_, *material_shaders_, motion));
        if (draws)
            HEARTH_TRY(draws->visibility.prepareMotion(device_, *material_shaders_, motion));
    }
    for (std::optional<ShadowPass>& pass : shadows_)
        if (pass)
            HEARTH_TRY(pass->prepareMotion(device_, *material_shaders_, motion));
    return success();
}

/// Create the shadow maps of a scene, and the pipelines that draw depths of their format.
Status Renderer::createShadows(const formats::PackView& pack, const ShadowOptions& options,
                               VkCommandBuffer commands, Scene& scene)
{
    const ShadowDepthChoice depth = SceneShadows::chooseDepth(pack, scene.bounds, options);
    std::optional<ShadowPass>& pass = shadows_[static_cast<size_t>(depth.depth)];
    if (!pass)
    {
        const VkRenderPass map_pass = passes_.shadowMapPass(shadowFormat(depth.depth));
        HEARTH_ASSIGN_OR_RETURN(pass, ShadowPass::create(device_, layouts_, map_pass));
    }
    if (scene.deformation != nullptr)
        HEARTH_TRY(pass->prepareDeformed(device_));
    if (scene.proxies_cast)
        HEARTH_TRY(pass->prepareProxies(device_));
    return pass->createMaps(device_, pack, options, depth, commands, scene);
}

/// Upload the receivers of a scene, and bind the atlas of texels.
Status Renderer::createReceivers(const formats::PackView& pack, Scene& scene)
{
    if (!receivers_)
    {
        HEARTH_ASSIGN_OR_RETURN(receivers_, ReceiverPass::create(device_, receiver_update_));
    }
    const auto frames = static_cast<uint32_t>(scene.frames.size());
    if (!pack.faceAtlases().empty())
    {
        HEARTH_TRY(receivers_->prepareFaces(device_));
        HEARTH_ASSIGN_OR_RETURN(scene.receivers->faces,
                                receivers_->upload(device_, pack.faceReceivers(), frames,
                                                   scene.bricks->lighting, scene.bricks->firstBakedWord(),
                                                   *scene.staging));
        scene.bricks->baked_scale = pack.faceReceivers().atlas.scale;
    }
    if (pack.receiverAtlases().empty())
    {
        scene.staging->finish();
        return success();
    }
    HEARTH_ASSIGN_OR_RETURN(scene.receivers->atlas,
                            receivers_->upload(device_, pack.receivers(), frames, *scene.staging));
    scene.staging->finish();
    const ReceiverAtlas& atlas = *scene.receivers->atlas;
    forEachView(scene,
                [&](const SceneView& view)
                {
                    DescriptorWriter(view.draw_set)
                        .texture(shared::kSceneReceivers, atlas.colors.get(), atlas.sampler.get())
                        .write(device_);
                });
    return success();
}

Status Renderer::prepareLightMethod(Scene& scene, LightMethod method)
{
    HEARTH_ASSERT(supports(method));
    const LightMethodFacts& facts = lightMethodFacts(method);
    // lights of what a pixel shows are listed from vertices at rest
    if (needPixels(facts.areas) && !scene.motions.instances.empty())
        return Error{
            Issue::usage, "", "",
            "materials of the scene have the extra hearth_motion: light methods that list lights for tiles "
            "or visible cells do not draw them; use another one"};
    HEARTH_TRY(prepareDraws(facts.path));
    HEARTH_TRY(light_lists_.prepare(device_, layouts_, scene, facts.areas));
    for (SceneMaterial& material : scene.materials)
    {
        // materials with layers are lit where they are shaded, whatever the method
        material.variant.light_list =
            facts.light_list == shared::kLightListVolumes ? shared::kLightListCells : facts.light_list;
        for (size_t i = 0; i < draws_.size(); ++i)
        {
            if (!draws_[i] || !mayShade(facts.path, static_cast<ShadedOutput>(i)))
                continue;
            HEARTH_ASSIGN_OR_RETURN(material.pipelines[static_cast<size_t>(method)][i],
                                    draws_[i]->shading.prepare(device_, layouts_, material.variant));
        }
    }
    if (facts.path != LightPath::materials && scene.lit_sets == nullptr)
    {
        HEARTH_ASSIGN_OR_RETURN(scene.lit_sets, LitSets::create(device_, layouts_, scene));
    }
    for (size_t i = 0; i < draws_.size(); ++i)
        if (draws_[i] && draws_[i]->add_lights && mayShade(facts.path, static_cast<ShadedOutput>(i)))
            HEARTH_TRY(draws_[i]->add_lights->prepare(device_, layouts_, method, scene));
    return success();
}

bool Renderer::supports(LightMethod method) const
{
    return lightMethodFacts(method).path == LightPath::materials ||
           passes_.features() == FrameFeatures::deferred;
}

Status Renderer::prepareOverdraw()
{
    for (const ShadedOutput output : {ShadedOutput::color, ShadedOutput::radiance})
    {
        if (!passes_.has(output))
            continue;
        std::optional<BinPass>& overdraw = draws_[static_cast<size_t>(output)]->overdraw;
        if (!overdraw)
        {
            HEARTH_ASSIGN_OR_RETURN(
                overdraw,
                BinPass::createOverdraw(device_, layouts_, passes_.place(output, FrameStep::shading)));
        }
        if (skinning_)
            HEARTH_TRY(overdraw->prepareDeformed(device_));
        for (const uint32_t motion : motions_)
            HEARTH_TRY(overdraw->prepareMotion(device_, *material_shaders_, motion));
    }
    return success();
}

void Renderer::record(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                      const FrameInput& input) const
{
    FrameRollback rollback(scene, targets);
    PassRecorder passes(device_, commands, plan(scene, targets, input, false), targets);
    recordCulled(commands, scene, targets, input, passes);
    recordVisible(commands, scene, targets, input, passes);
    recordShaded(commands, scene, targets, input, passes);
    rollback.keep();
}

void Renderer::recordCull(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                          const FrameInput& input) const
{
    FrameRollback rollback(scene, targets);
    PassRecorder passes(device_, commands, plan(scene, targets, input, true), targets);
    recordCulled(commands, scene, targets, input, passes);
    rollback.keep();
}

/// Record up to the clusters that are drawn first.
void Renderer::recordCulled(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                            const FrameInput& input, PassRecorder& passes) const
{
    HEARTH_ASSERT(input.view.instance_count == scene.instance_count);
    if (input.timestamps != VK_NULL_HANDLE)
        device_.vk.vkCmdResetQueryPool(commands, input.timestamps, 0, kTimestampCount);
    writeTimestamp(device_, commands, input.timestamps, kTimestampBegin);
    const shared::FrameView view = scaledView(scene, input.view);
    targets.chooseColor(input.color_image);
    trackShadows(scene, input.moves, view.material_inputs);
    passes.begin(FrameStep::update);
    WordCopies copies = recordFrameUpdate(device_, commands, scene, targets, copy_words_, view,
                                          {.moves = input.moves,
                                           .poses = input.poses,
                                           .daylight = input.daylight,
                                           .lights = input.lights,
                                           .lamp_weights = input.lamp_weights});
    if (scene.receivers != nullptr)
        recordReceivers(commands, scene, input);
    recordLightLists(commands, scene, view, input.shading, passes);
    if (scene.bricks != nullptr)
        recordBrickLight(commands, scene, copies, input, passes);
    if (scene.shadows != nullptr)
        recordShadows(commands, scene, targets, view, input.shadow_spheres, passes);
    writeTimestamp(device_, commands, input.timestamps, kTimestampShadows);
    const DebugLabel label(device_, commands, "cull");
    passes.begin(FrameStep::cull);
    cull_.record(device_, commands, scene, scene.frame().main, targets.occlusionSet(), firstPhase(input));
    recordSkinning(commands, scene, firstPhase(input));
    if (scene.stream != nullptr)
        page_requests_.record(device_, commands, scene);
    if (!hasTwoPhases(input))
        recordSlotLights(commands, scene, input.shading, passes);
    passes.end();
    writeTimestamp(device_, commands, input.timestamps, kTimestampCull);
}

void Renderer::recordVisibility(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                                const FrameInput& input) const
{
    PassRecorder passes(device_, commands, plan(scene, targets, input, true), targets);
    recordVisible(commands, scene, targets, input, passes);
}

void Renderer::recordMaterials(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                               const FrameInput& input) const
{
    PassRecorder passes(device_, commands, plan(scene, targets, input, true), targets);
    recordShaded(commands, scene, targets, input, passes);
}

void Renderer::recordMissing(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets) const
{
    HEARTH_ASSERT(targets.options().counts_missing);
    const DebugLabel label(device_, commands, "missing clusters");
    // the frame's draws and shading have read the list that grows here, and have written the depth
    barrier(device_, commands,
            VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT |
                VK_PIPELINE_STAGE_TRANSFER_BIT,
            VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
            VK_ACCESS_SHADER_READ_BIT);
    // the next frame makes the same pyramid again, and until then tests the one before
    const bool leaves_depth = targets.depthView().level_count != 0;
    const VkDescriptorSet set = leaves_depth ? targets.nextOcclusionSet() : targets.occlusionSet();
    if (leaves_depth)
        pyramid_.record(device_, commands, targets, set);
    cull_.record(device_, commands, scene, scene.frame().main, set, shared::kPhaseLate);
}

void Renderer::recordPrefetch(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                              const shared::FrameView& view, std::span<const InstanceMove> moves,
                              std::span<const InstancePose> poses) const
{
    HEARTH_ASSERT(scene.stream != nullptr && view.instance_count == scene.instance_count);
    FrameRollback rollback(scene, targets);
    trackShadows(scene, moves, view.material_inputs);
    PassRecorder passes(device_, commands, passes_.plan({.occlusion = OcclusionCulling::off}), targets);
    passes.begin(FrameStep::update);
    recordFrameUpdate(device_, commands, scene, targets, copy_words_, scene.stream->scaled(view),
                      {.moves = moves, .poses = poses, .draws = false});
    passes.begin(FrameStep::cull);
    cull_.record(device_, commands, scene, scene.frame().main, targets.occlusionSet(), shared::kPhaseWhole);
    page_requests_.record(device_, commands, scene);
    rollback.keep();
}

const ShadowPass& Renderer::shadowPass(const Scene& scene) const
{
    return *shadows_[static_cast<size_t>(scene.shadows->depth().depth)];
}

/// List the lights of the frame and of its cells, on the device or right away.
void Renderer::recordLightLists(VkCommandBuffer commands, const Scene& scene, const shared::FrameView& view,
                                const ShadingSettings& shading, PassRecorder& passes) const
{
    scene.lights->beginFrame(scene.tables->lighting, scene.tables->frame, view, shading.light_lister,
                             lightMethodFacts(lightMethod(shading)).areas);
    const std::optional<LightAreas> areas = listedAreas(scene, shading);
    if (!areas)
        return;
    const DebugLabel label(device_, commands, "list lights");
    passes.begin(FrameStep::light_lists);
    light_lists_.record(device_, commands, scene, *areas);
}

/// List the lights of the slots of the visible list, behind the last culling phase of the frame.
void Renderer::recordSlotLights(VkCommandBuffer commands, const Scene& scene, const ShadingSettings& shading,
                                PassRecorder& passes) const
{
    if (listedAreas(scene, shading) != LightAreas::slots)
        return;
    const DebugLabel label(device_, commands, "slot lights");
    passes.begin(FrameStep::slot_lights);
    light_lists_.recordSlots(device_, commands, scene);
}

/// List the lights of tiles or cells by what pixels show, behind the visibility buffer.
void Renderer::recordVisibleLights(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                                   const ShadingSettings& shading, PassRecorder& passes) const
{
    const std::optional<LightAreas> areas = listedAreas(scene, shading);
    if (!areas || !needPixels(*areas))
        return;
    const DebugLabel label(device_, commands, "visible lights");
    passes.begin(FrameStep::visible_lights);
    light_lists_.recordVisible(device_, commands, scene, targets, *areas);
}

/// Draw the shadow maps that are stale: find the casters of as many as there are views, then draw these.
void Renderer::recordShadows(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                             const shared::FrameView& view, std::span<const ShadowSphere> spheres,
                             PassRecorder& passes) const
{
    const DebugLabel label(device_, commands, "shadows");
    const std::span<const ShadowCache::LayerUpdate> stale =
        scene.shadows->planFrame(view, scene.lights->lights(), spheres);
    const SceneFrame& frame = scene.frame();
    const shared::ShadowBlock& block = scene.shadows->plan().block;
    std::memcpy(frame.shadow_block.mapped, &block, sizeof(block));
    for (size_t first = 0; first < stale.size(); first += frame.casters.size())
    {
        const auto maps = stale.subspan(first, std::min(frame.casters.size(), stale.size() - first));
        passes.begin(FrameStep::shadow_cull);
        for (size_t i = 0; i < maps.size(); ++i)
        {
            if (first == 0)
                writeView(frame.casters[i], maps[i].casters);
            else
                recordViewChange(device_, commands, frame.casters[i], maps[i].casters);
            cull_.record(device_, commands, scene, frame.casters[i], targets.occlusionSet(),
                         shared::kPhaseWhole);
        }
        shadowPass(scene).recordCounters(device_, commands, scene, frame.casters, maps);
        for (size_t i = 0; i < maps.size(); ++i)
            recordShadowMap(commands, scene, frame.casters[i], maps[i], passes);
    }
    passes.end();
}

void Renderer::recordShadowMap(VkCommandBuffer commands, const Scene& scene, const SceneView& view,
                               const ShadowCache::LayerUpdate& map, PassRecorder& passes) const
{
    if (map.copy_from)
    {
        passes.begin(FrameStep::shadow_copy);
        shadowPass(scene).recordCopy(device_, commands, scene, map);
    }
    const auto side = static_cast<uint32_t>(scene.shadows->plan().block.maps[map.map].size);
    passes.begin(map.copy_from ? FrameStep::moving_shadow_map : FrameStep::shadow_map,
                 scene.shadows->framebuffer(map.layer), {side, side});
    shadowPass(scene).recordMap(device_, commands, layouts_, scene, view, map);
}

/// Update the texels of baked light that are due, if any are, and faces if the frame shows them. The table of
/// the frame leaves out both, so that no other frame waits for them.
void Renderer::recordReceivers(VkCommandBuffer commands, const Scene& scene, const FrameInput& input) const
{
    SceneReceivers& receivers = *scene.receivers;
    const bool shows_drops = input.shading.debug_view == shared::kViewReceivers;
    const uint32_t groups = receivers.beginUpdate(shows_drops);
    const uint32_t face_groups = showsBricks(input) ? receivers.beginFaceUpdate() : 0;
    if ((groups | face_groups) == 0)
        return;
    const DebugLabel label(device_, commands, "update receivers");
    const uint32_t frame = scene.tables->frame;
    if (receivers.atlas)
        receivers_->record(device_, commands, *receivers.atlas, frame, receivers.weights(), groups,
                           shows_drops);
    if (receivers.faces)
        receivers_->record(device_, commands, *receivers.faces, frame, receivers.weights(), face_groups,
                           scene.bricks->is_shown);
}

/// Update a share of the brick faces, if the frame shows their light.
void Renderer::recordBrickLight(VkCommandBuffer commands, const Scene& scene, WordCopies& copies,
                                const FrameInput& input, PassRecorder& passes) const
{
    if (showsBricks(input))
    {
        const DebugLabel label(device_, commands, "light bricks");
        passes.begin(FrameStep::brick_light);
        brick_light_->record(device_, commands, scene, copy_words_, copies,
                             !input.lights.empty() || !input.lamp_weights.empty(), input.emission);
    }
    scene.bricks->is_shown = shared::viewNeedsBricks(input.shading.debug_view);
}

/// Record after each culling phase of the frame.
void Renderer::recordSkinning(VkCommandBuffer commands, const Scene& scene, uint32_t phase) const
{
    if (scene.deformation == nullptr)
        return;
    const DebugLabel label(device_, commands, "skinning");
    skinning_->record(device_, commands, scene, phase);
}

/// Record the early phase: draw the clusters that the last frame's depth does not occlude, build the pyramid,
/// then cull the rest against it. Does nothing if the frame has one phase.
void Renderer::recordEarly(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                           const FrameInput& input, PassRecorder& passes) const
{
    const bool has_two_phases = hasTwoPhases(input);
    if (has_two_phases)
    {
        const DebugLabel label(device_, commands, "early visibility");
        passes.begin(FrameStep::early_visibility);
        drawPasses(passes).visibility.record(device_, commands, layouts_, scene, scene.frame().main,
                                             shared::kPhaseEarly);
        passes.end();
    }
    writeTimestamp(device_, commands, input.timestamps, kTimestampEarlyVisibility);
    if (has_two_phases)
    {
        passes.begin(FrameStep::early_pyramid);
        recordPyramid(commands, targets, input);
    }
    if (passes.has(FrameStep::last_pyramid))
        recordLastPyramid(commands, targets, passes);
    writeTimestamp(device_, commands, input.timestamps, kTimestampPyramid);
    if (has_two_phases)
    {
        const DebugLabel label(device_, commands, "late cull");
        passes.begin(FrameStep::late_cull);
        cull_.record(device_, commands, scene, scene.frame().main, targets.occlusionSet(),
                     shared::kPhaseLate);
        recordSkinning(commands, scene, shared::kPhaseLate);
        recordSlotLights(commands, scene, input.shading, passes);
        passes.end();
    }
    writeTimestamp(device_, commands, input.timestamps, kTimestampLateCull);
}

void Renderer::recordPyramid(VkCommandBuffer commands, FrameTargets& targets, const FrameInput& input) const
{
    const DebugLabel label(device_, commands, "pyramid");
    pyramid_.record(device_, commands, targets, targets.occlusionSet());
    targets.setPyramidView(shared::makeOcclusionView(input.view));
}

/// Make the pyramid that the next frame's culling tests, of the depth of the frame before, if that left one.
void Renderer::recordLastPyramid(VkCommandBuffer commands, FrameTargets& targets, PassRecorder& passes) const
{
    const shared::OcclusionView view = targets.depthView();
    if (view.level_count == 0)
        return;
    const DebugLabel label(device_, commands, "pyramid");
    passes.begin(FrameStep::last_pyramid);
    pyramid_.record(device_, commands, targets, targets.nextOcclusionSet());
    passes.end();
    targets.takeNextPyramid(view);
}

/// Record up to the visibility buffer. Leaves its render pass open if shading follows there.
void Renderer::recordVisible(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                             const FrameInput& input, PassRecorder& passes) const
{
    recordEarly(commands, scene, targets, input, passes);
    const bool is_open = passes.sharesPass(FrameStep::visibility, FrameStep::shading);
    // no timestamps within a render pass
    if (is_open)
        writeTimestamp(device_, commands, input.timestamps, kTimestampVisibility);
    if (is_open)
        writeTimestamp(device_, commands, input.timestamps, kTimestampMaterialTiles);
    {
        const DebugLabel label(device_, commands, "visibility");
        passes.begin(FrameStep::visibility);
        drawPasses(passes).visibility.record(device_, commands, layouts_, scene, scene.frame().main,
                                             hasTwoPhases(input) ? shared::kPhaseLate : firstPhase(input));
    }
    if (is_open)
        return;
    passes.end();
    if (passes.has(FrameStep::pyramid))
    {
        passes.begin(FrameStep::pyramid);
        recordPyramid(commands, targets, input);
    }
    writeTimestamp(device_, commands, input.timestamps, kTimestampVisibility);
}

/// Sum the lights of pixels, or mark those that may reach them, if the frame does so.
void Renderer::recordAheadOfShading(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                                    const FrameInput& input, PassRecorder& passes) const
{
    const DrawPasses& draws = drawPasses(passes);
    if (passes.has(FrameStep::normals))
    {
        {
            const DebugLabel label(device_, commands, "normals");
            passes.begin(FrameStep::normals);
            draws.normal_marks->record(device_, commands, layouts_, scene, targets);
            draws.shading.recordNormals(device_, commands, layouts_, scene, targets, input.shading);
        }
        const DebugLabel label(device_, commands, "add lights");
        passes.begin(FrameStep::add_lights);
        draws.add_lights->record(device_, commands, layouts_, scene, targets, input.shading);
    }
    if (passes.has(FrameStep::mark_lights))
    {
        const DebugLabel label(device_, commands, "mark lights");
        passes.begin(FrameStep::mark_lights);
        draws.mark_lights->record(device_, commands, layouts_, scene, targets);
    }
}

/// Record from the visibility buffer to the end of the frame.
void Renderer::recordShaded(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                            const FrameInput& input, PassRecorder& passes) const
{
    const bool is_open = passes.sharesPass(FrameStep::visibility, FrameStep::shading);
    const DrawPasses& draws = drawPasses(passes);
    recordVisibleLights(commands, scene, targets, input.shading, passes);
    if (passes.has(FrameStep::material_tiles))
    {
        const DebugLabel label(device_, commands, "material tiles");
        passes.begin(FrameStep::material_tiles);
        material_tiles_.record(device_, commands, scene, targets);
    }
    if (passes.has(FrameStep::gather))
    {
        const DebugLabel label(device_, commands, "gather light");
        passes.begin(FrameStep::gather);
        for (uint32_t i = 0; i < input.gathers; ++i)
            gather_->record(device_, commands, scene, targets, input.view, scene.bricks->quick_frames > 0);
    }
    if (!is_open)
        writeTimestamp(device_, commands, input.timestamps, kTimestampMaterialTiles);
    recordAheadOfShading(commands, scene, targets, input, passes);
    passes.begin(FrameStep::shading);
    const bool shows_overdraw = input.shading.debug_view == shared::kViewOverdraw;
    if (!shows_overdraw)
    {
        const DebugLabel label(device_, commands, "material marks");
        draws.material_marks.record(device_, commands, layouts_, scene, targets);
    }
    {
        const DebugLabel label(device_, commands, "shading");
        HEARTH_ASSERT(!shows_overdraw || draws.overdraw);
        if (shows_overdraw)
            recordOverdraw(commands, scene, *draws.overdraw);
        else
            draws.shading.record(device_, commands, layouts_, scene, targets, input.shading);
    }
    if (passes.has(FrameStep::add_lights) && !passes.has(FrameStep::normals))
    {
        const DebugLabel label(device_, commands, "add lights");
        passes.begin(FrameStep::add_lights);
        draws.add_lights->record(device_, commands, layouts_, scene, targets, input.shading);
    }
    if (!passes.sharesPass(FrameStep::shading, FrameStep::final_pass))
        passes.end();
    if (targets.hasPost())
        recordFinal(commands, targets, input.shading, passes);
    targets.setDepthView(passes.has(FrameStep::last_pyramid) ? shared::makeOcclusionView(input.view)
                                                             : shared::OcclusionView{});
    writeTimestamp(device_, commands, input.timestamps, kTimestampShading);
}

/// Record what follows shading, if the frame has a final pass.
void Renderer::recordFinal(VkCommandBuffer commands, FrameTargets& targets, const ShadingSettings& shading,
                           PassRecorder& passes) const
{
    PostTargets& post = targets.post();
    post.beginFrame(device_, commands, passes.has(FrameStep::bloom_up), passes.has(FrameStep::exposure));
    if (passes.has(FrameStep::exposure))
    {
        const DebugLabel label(device_, commands, "exposure");
        passes.begin(FrameStep::exposure);
        post_->recordExposure(device_, commands, post, *shading.post.automatic_exposure);
        passes.end();
    }
    if (passes.has(FrameStep::bloom_down))
    {
        const DebugLabel label(device_, commands, "bloom");
        for (uint32_t level = 1; level <= shared::kBloomLevels; ++level)
        {
            passes.begin(FrameStep::bloom_down);
            post_->recordDown(device_, commands, post, level);
        }
        for (uint32_t level = shared::kBloomLevels - 1; level >= 1 && passes.has(FrameStep::bloom_up);
             --level)
        {
            passes.begin(FrameStep::bloom_up);
            post_->recordUp(device_, commands, post, level);
        }
        passes.end();
    }
    if (passes.has(FrameStep::final_pass))
    {
        const DebugLabel label(device_, commands, "final pass");
        passes.begin(FrameStep::final_pass);
        post_->recordFinal(device_, commands, post, shading.post, targets.outputExtent(),
                           shading.debug_view != shared::kViewFinal,
                           passes.sharesPass(FrameStep::shading, FrameStep::final_pass));
        passes.end();
    }
}

/// Draw the clusters of both phases; the late draws are empty if culling had one phase.
void Renderer::recordOverdraw(VkCommandBuffer commands, const Scene& scene, const BinPass& overdraw) const
{
    for (const uint32_t phase : {shared::kPhaseEarly, shared::kPhaseLate})
        overdraw.record(device_, commands, layouts_, scene, scene.frame().main, phase);
}

} // namespace hearth::gpu
