// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_plan.h"

#include "formats/base/assert.h"

#include <algorithm>
#include <array>

namespace hearth::gpu
{

namespace
{

using Resource = FrameResource;

constexpr size_t kResourceCount = static_cast<size_t>(Resource::count);

/// Pixels of a gather tile that are looked at: one, and eight in every other tile.
constexpr float kGatheredShare = 0.5f * (1 + 8) / 64;

/// A step before it is part of a pass.
struct Step
{
    FrameStep step;
    PassKind kind;
    std::vector<ResourceUse> attachments{};
    std::vector<ResourceUse> uses{};
    DrawFacts draws{};
    HostWrite host_write = HostWrite::none;
    std::optional<uint32_t> map{};
};

/// Reads of clusters and their vertices by draws.
void addDrawnLists(Step& step, Resource lists)
{
    step.uses.push_back({lists, Access::vertex_read});
    step.uses.push_back({Resource::pages, Access::vertex_read});
}

/// Draw clusters into the visibility buffer; `content` of what is there before.
Step visibilityStep(FrameStep step, Content content)
{
    Step draws{.step = step,
               .kind = PassKind::render,
               .attachments = {{Resource::visibility, Access::color_write, content},
                               {Resource::depth, Access::depth_write, content}}};
    addDrawnLists(draws, Resource::visible_list);
    return draws;
}

/// Find clusters, of the frame or of shadow maps.
Step cullStep(FrameStep step, Resource lists)
{
    return {.step = step,
            .kind = PassKind::compute,
            .uses = {{Resource::scene_tables, Access::compute_read},
                     {Resource::pages, Access::compute_read},
                     {Resource::work_lists, Access::compute_write, Content::overwrite},
                     {lists, Access::compute_write,
                      step == FrameStep::late_cull ? Content::keep : Content::overwrite}}};
}

/// Draw shadow maps, in rounds: find the casters of some, then draw these.
void addShadowSteps(const FrameConfiguration& c, std::vector<Step>& steps)
{
    for (uint32_t map = 0; map < c.maps.size(); ++map)
    {
        if (map % c.maps_at_once == 0)
            steps.push_back(cullStep(FrameStep::shadow_cull, Resource::caster_lists));
        const bool is_fresh = c.maps[map] == MapContent::fresh;
        if (!is_fresh)
            steps.push_back({.step = FrameStep::shadow_copy,
                             .kind = PassKind::transfer,
                             .uses = {{Resource::shadow_map, Access::copy_read},
                                      {Resource::shadow_map, Access::copy_write, Content::overwrite}},
                             .map = map});
        Step draws{.step = is_fresh ? FrameStep::shadow_map : FrameStep::moving_shadow_map,
                   .kind = PassKind::render,
                   .attachments = {{Resource::shadow_map, Access::depth_write,
                                    is_fresh ? Content::begin : Content::keep}},
                   .map = map};
        addDrawnLists(draws, Resource::caster_lists);
        steps.push_back(std::move(draws));
    }
}

Step pyramidStep(FrameStep step)
{
    return {.step = step,
            .kind = PassKind::compute,
            .uses = {{Resource::depth, Access::sampled},
                     {Resource::pyramid, Access::compute_write, Content::overwrite}}};
}

/// Images that lights are added to, or marked in, ahead of shading.
std::vector<Resource> listLightImages(LightPath path)
{
    switch (path)
    {
    case LightPath::light_sums:
        return {Resource::diffuse_light, Resource::specular_light, Resource::grazing_light};
    case LightPath::joint_sums:
    case LightPath::encoded_joint_sums:
        return {Resource::diffuse_light};
    case LightPath::light_bits:
        return {Resource::low_light_bits, Resource::high_light_bits};
    default:
        return {};
    }
}

/// Reads of fragments that are lit.
void addLightReads(const FrameConfiguration& c, Step& step)
{
    if (c.has_shadows)
        step.uses.push_back({Resource::shadow_map, Access::fragment_read, Content::keep, 0});
    if (c.lists_lights)
        step.uses.push_back({Resource::light_lists, Access::fragment_read});
}

/// Reads of steps that draw the pixels of materials.
void addMaterialReads(const FrameConfiguration& c, Step& step)
{
    addDrawnLists(step, Resource::visible_list);
    for (const Resource lists : {Resource::visible_list, Resource::pages})
        step.uses.push_back({lists, Access::fragment_read});
    if (hasSubpasses(c.way))
        step.attachments.push_back({Resource::visibility, Access::input});
    else
        step.uses.push_back({Resource::visibility, Access::fragment_read});
    if (c.material_tiles)
        step.uses.push_back({Resource::tile_lists, Access::vertex_read});
}

/// Return what shading draws to.
Resource shadedResource(const FrameConfiguration& c)
{
    return c.has_final_pass ? Resource::radiance : Resource::color;
}

Step shadingStep(const FrameConfiguration& c)
{
    const bool by_depth = c.materials == MaterialTest::depth;
    Step step{.step = FrameStep::shading,
              .kind = PassKind::render,
              .attachments = {{Resource::depth, by_depth ? Access::depth_write : Access::depth_keep,
                               by_depth ? Content::overwrite : Content::keep},
                              {shadedResource(c), Access::color_write,
                               c.shows_overdraw ? Content::begin : Content::overwrite}},
              .draws = {.cover = c.material_tiles ? Cover::tiles : Cover::triangle,
                        .discards = !by_depth,
                        .writes_fragment_depth = by_depth}};
    if (storesSurfaces(c.light_path))
        step.attachments.push_back({Resource::surfaces, Access::color_write, Content::begin});
    addMaterialReads(c, step);
    // an input attachment by each way: its render pass needs no other subpass
    for (const Resource image : listLightImages(c.light_path))
        step.attachments.push_back({image, Access::input});
    if (c.gathers_light)
        step.uses.push_back({Resource::gathered_light, Access::fragment_read});
    addLightReads(c, step);
    return step;
}

/// Store what lights need of surfaces, ahead of shading.
Step normalsStep(const FrameConfiguration& c)
{
    Step step{.step = FrameStep::normals,
              .kind = PassKind::render,
              .attachments = {{Resource::depth, Access::depth_keep},
                              {normalsImage(c.light_path), Access::color_write, Content::begin}},
              .draws = {.cover = c.material_tiles ? Cover::tiles : Cover::triangle, .discards = true}};
    addMaterialReads(c, step);
    return step;
}

/// Reads of steps that draw volumes of lights.
void addVolumeReads(const FrameConfiguration& c, Step& step)
{
    addLightReads(c, step);
    if (c.lists_lights)
        step.uses.push_back({Resource::light_lists, Access::vertex_read});
}

/// Add the light of lamps and suns to the surfaces that are stored.
Step lightStep(const FrameConfiguration& c)
{
    Step step{.step = FrameStep::add_lights,
              .kind = PassKind::render,
              .attachments = {{Resource::depth, Access::depth_input}},
              .draws = {.cover = Cover::triangle}};
    if (storesSurfaces(c.light_path))
        step.attachments.push_back({Resource::radiance, Access::color_write, Content::keep});
    for (const Resource image : listLightImages(c.light_path))
        step.attachments.push_back({image, Access::color_write, Content::begin});
    const Resource lit = storesSurfaces(c.light_path) ? Resource::surfaces : normalsImage(c.light_path);
    if (hasSubpasses(c.way))
        step.attachments.push_back({lit, Access::input});
    else
        step.uses.push_back({lit, Access::fragment_read});
    addVolumeReads(c, step);
    return step;
}

/// Mark the lights that reach a pixel in its bits.
Step marksStep(const FrameConfiguration& c)
{
    Step step{.step = FrameStep::mark_lights,
              .kind = PassKind::render,
              .attachments = {{Resource::depth, Access::depth_input}}};
    for (const Resource image : listLightImages(c.light_path))
        step.attachments.push_back({image, Access::color_write, Content::begin});
    addVolumeReads(c, step);
    return step;
}

/// Draw a triangle to a whole image, from others.
Step filterStep(FrameStep step, Resource target, std::initializer_list<Resource> sources)
{
    Step filter{.step = step,
                .kind = PassKind::render,
                .attachments = {{target, Access::color_write, Content::overwrite}},
                .draws = {.cover = Cover::triangle}};
    for (const Resource source : sources)
        filter.uses.push_back({source, Access::fragment_read});
    return filter;
}

/// True if the final pass reads the pixel's own value.
bool finishesOnTile(const FrameConfiguration& c)
{
    return hasSubpasses(c.way) && c.light_path == LightPath::surfaces_on_tile;
}

/// Finish the image behind the lights. The depth is bound because all subpasses share it.
Step tileFinalStep()
{
    return {.step = FrameStep::final_pass,
            .kind = PassKind::render,
            .attachments = {{Resource::depth, Access::depth_keep},
                            {Resource::color, Access::color_write, Content::overwrite},
                            {Resource::radiance, Access::input}},
            .draws = {.cover = Cover::triangle}};
}

/// List shading, and the steps about it that have to do with lights.
void addShadingSteps(const FrameConfiguration& c, std::vector<Step>& steps)
{
    if (sumsLights(c.light_path))
        steps.insert(steps.end(), {normalsStep(c), lightStep(c)});
    if (c.light_path == LightPath::light_bits)
        steps.push_back(marksStep(c));
    steps.push_back(shadingStep(c));
    if (storesSurfaces(c.light_path))
        steps.push_back(lightStep(c));
}

/// List the steps behind shading: automatic exposure, bloom, and the final pass.
void addFinalSteps(const FrameConfiguration& c, std::vector<Step>& steps)
{
    if (!c.has_final_pass)
        return;
    if (finishesOnTile(c))
        return steps.push_back(tileFinalStep());
    if (c.adapts_exposure)
        steps.push_back(filterStep(FrameStep::exposure, Resource::exposure,
                                   {bloomLevel(shared::kBloomLevels), Resource::last_exposure}));
    for (uint32_t level = 1; level <= shared::kBloomLevels && (c.blooms || c.adapts_exposure); ++level)
        steps.push_back(filterStep(FrameStep::bloom_down, bloomLevel(level),
                                   {level == 1 ? Resource::radiance : bloomLevel(level - 1)}));
    for (uint32_t level = shared::kBloomLevels - 1; level >= 1 && c.blooms; --level)
        steps.push_back(
            filterStep(FrameStep::bloom_up, bloomSum(level), {bloomLevel(level), bloomSum(level + 1)}));
    Step last = filterStep(FrameStep::final_pass, Resource::color, {Resource::radiance});
    if (c.blooms)
        last.uses.push_back({bloomSum(1), Access::fragment_read});
    if (c.adapts_exposure)
        last.uses.push_back({Resource::exposure, Access::fragment_read});
    steps.push_back(std::move(last));
}

/// True if shading cannot follow the visibility buffer in one render pass.
bool splitsAtVisibility(const FrameConfiguration& c)
{
    // the pyramid needs the scene's depth, which the numbers of materials overwrite
    const bool loses_depth =
        c.occlusion == OcclusionCulling::last_frame && c.materials == MaterialTest::depth;
    return !hasSubpasses(c.way) || c.material_tiles || c.gathers_light || c.lists_visible || c.in_parts ||
           loses_depth;
}

/// True if the depth of a frame becomes a pyramid in the next one, behind its culling. Made in its own frame,
/// behind shading, it would have the next frame's culling wait for shading.
bool defersPyramid(const FrameConfiguration& c)
{
    return c.occlusion == OcclusionCulling::last_frame && !splitsAtVisibility(c);
}

/// Add the lights of slots behind the culling that ends the visible list.
void addSlotLights(const FrameConfiguration& c, std::vector<Step>& steps)
{
    if (c.lists_slots)
        steps.push_back({.step = FrameStep::slot_lights,
                         .kind = PassKind::compute,
                         .uses = {{Resource::scene_tables, Access::compute_read},
                                  {Resource::pages, Access::compute_read},
                                  {Resource::work_lists, Access::compute_read},
                                  {Resource::visible_list, Access::compute_read},
                                  {Resource::light_lists, Access::compute_write}}});
}

std::vector<Step> listSteps(const FrameConfiguration& c)
{
    const bool two_phases = c.occlusion == OcclusionCulling::two_phase;
    std::vector<Step> steps;
    steps.push_back(
        {.step = FrameStep::update,
         .kind = PassKind::compute,
         .uses = {{Resource::scene_tables, Access::compute_write}, {Resource::pages, Access::compute_write}},
         .host_write = HostWrite::ring});
    if (c.lists_lights)
        steps.push_back({.step = FrameStep::light_lists,
                         .kind = PassKind::compute,
                         .uses = {{Resource::light_lists, Access::compute_write, Content::overwrite}}});
    if (c.lights_bricks)
        steps.push_back({.step = FrameStep::brick_light,
                         .kind = PassKind::compute,
                         .uses = {{Resource::brick_light, Access::compute_write}}});
    addShadowSteps(c, steps);

    // culling reads texels of the pyramid by cluster, not by pixel
    constexpr ResourceUse kPyramidTexels{Resource::pyramid, Access::compute_read, Content::keep, 0};
    steps.push_back(cullStep(FrameStep::cull, Resource::visible_list));
    if (c.occlusion != OcclusionCulling::off)
        steps.back().uses.push_back(kPyramidTexels);
    if (!two_phases)
        addSlotLights(c, steps);
    if (defersPyramid(c))
        steps.push_back(pyramidStep(FrameStep::last_pyramid));
    if (two_phases)
    {
        steps.push_back(visibilityStep(FrameStep::early_visibility, Content::begin));
        steps.push_back(pyramidStep(FrameStep::early_pyramid));
        steps.push_back(cullStep(FrameStep::late_cull, Resource::visible_list));
        steps.back().uses.push_back(kPyramidTexels);
        addSlotLights(c, steps);
    }
    steps.push_back(visibilityStep(FrameStep::visibility, two_phases ? Content::keep : Content::begin));
    if (c.occlusion == OcclusionCulling::last_frame && !defersPyramid(c))
        steps.push_back(pyramidStep(FrameStep::pyramid));
    if (c.lists_visible)
        steps.push_back({.step = FrameStep::visible_lights,
                         .kind = PassKind::compute,
                         .uses = {{Resource::visible_list, Access::compute_read},
                                  {Resource::pages, Access::compute_read},
                                  {Resource::visibility, Access::sampled},
                                  {Resource::light_lists, Access::compute_write}}});
    if (c.material_tiles)
        steps.push_back({.step = FrameStep::material_tiles,
                         .kind = PassKind::compute,
                         .uses = {{Resource::visible_list, Access::compute_read},
                                  {Resource::visibility, Access::sampled},
                                  {Resource::tile_lists, Access::compute_write, Content::overwrite}}});
    if (c.gathers_light)
        steps.push_back({.step = FrameStep::gather,
                         .kind = PassKind::compute,
                         .uses = {{Resource::visible_list, Access::compute_read},
                                  {Resource::pages, Access::compute_read},
                                  {Resource::brick_light, Access::compute_read},
                                  {Resource::visibility, Access::sampled, Content::keep, kGatheredShare},
                                  {Resource::gather_points, Access::compute_write, Content::keep},
                                  {Resource::gathered_light, Access::compute_write, Content::overwrite}}});
    addShadingSteps(c, steps);
    addFinalSteps(c, steps);
    return steps;
}

Subpass makeSubpass(const Step& step)
{
    return {.step = step.step, .attachments = step.attachments, .draws = step.draws};
}

/// Return the subpass of a step that is drawn elsewhere: all merged render passes have the same ones.
Subpass makeEmptySubpass(const Step& step)
{
    return {.step = step.step, .is_empty = true, .attachments = step.attachments};
}

/// List the steps that one render pass of the ways with subpasses can have, one behind the other.
std::vector<Step> listMergedSteps(const FrameConfiguration& c)
{
    std::vector<Step> steps = {visibilityStep(FrameStep::visibility, Content::keep)};
    addShadingSteps(c, steps);
    if (c.light_path == LightPath::surfaces)
        steps.pop_back(); // its lights have a render pass of their own
    if (c.light_path == LightPath::surfaces_on_tile)
        steps.push_back(tileFinalStep());
    return steps;
}

/// Return the number of a step among the merged ones; their count if it is none of them.
size_t findMerged(const std::vector<Step>& merged, FrameStep step)
{
    const FrameStep sought = step == FrameStep::early_visibility ? FrameStep::visibility : step;
    return static_cast<size_t>(
        std::find_if(merged.begin(), merged.end(), [&](const Step& other) { return other.step == sought; }) -
        merged.begin());
}

/// Join steps into passes: neighbours that draw share a render pass if nothing lies between.
std::vector<Pass> joinSteps(const FrameConfiguration& c, const std::vector<Step>& steps)
{
    const std::vector<Step> merged = hasSubpasses(c.way) ? listMergedSteps(c) : std::vector<Step>();
    std::vector<Pass> passes;
    for (const Step& step : steps)
    {
        const size_t number = findMerged(merged, step.step);
        const bool is_merged = number < merged.size();
        const bool splits = number == 1 && splitsAtVisibility(c);
        if (is_merged && number > 0 && !splits && passes.back().steps.back() == merged[number - 1].step)
        {
            Pass& pass = passes.back();
            pass.steps.push_back(step.step);
            pass.subpasses[number] = makeSubpass(step);
            pass.uses.insert(pass.uses.end(), step.uses.begin(), step.uses.end());
            continue;
        }
        Pass pass{.kind = step.kind,
                  .steps = {step.step},
                  .uses = step.uses,
                  .host_write = step.host_write,
                  .map = step.map,
                  .map_format = step.map ? c.shadow_format : VK_FORMAT_UNDEFINED,
                  .radiance_format = c.has_final_pass ? c.radiance_format : kPackedRadiance,
                  .color_format = c.color_format};
        for (const Step& other : is_merged ? merged : std::vector<Step>())
            pass.subpasses.push_back(makeEmptySubpass(other));
        if (is_merged)
            pass.subpasses[number] = makeSubpass(step);
        else if (step.kind == PassKind::render)
            pass.subpasses = {makeSubpass(step)};
        passes.push_back(std::move(pass));
    }
    return passes;
}

/// First use of a resource by a pass, which is more than to bind it if there is such a use; null if it has
/// none.
const ResourceUse* firstUse(const Pass& pass, Resource resource)
{
    const auto find = [&](const std::vector<ResourceUse>& uses) -> const ResourceUse*
    {
        const auto found = std::find_if(uses.begin(), uses.end(),
                                        [&](const ResourceUse& use) { return use.resource == resource; });
        return found == uses.end() ? nullptr : &*found;
    };
    const ResourceUse* bound = nullptr;
    for (const Subpass& subpass : pass.subpasses)
        if (const ResourceUse* use = subpass.is_empty ? nullptr : find(subpass.attachments))
        {
            if (use->access != Access::depth_keep)
                return use;
            bound = use;
        }
    return bound != nullptr ? bound : find(pass.uses);
}

/// The depth that is merely bound needs no content.
bool needsContent(const ResourceUse& use)
{
    return use.content == Content::keep && use.access != Access::depth_keep;
}

/// True if two passes do not use the same image: shadow maps lie in layers of their own.
bool areApart(const Pass& pass, const Pass& other, Resource resource)
{
    return resource == Resource::shadow_map && pass.map && other.map && *pass.map != *other.map;
}

/// Pass after `from` that needs the content of a resource before another pass replaces it.
/// is_handed_out  a pass that only binds the resource needs it, too: it hands it on
const Pass* findReader(std::span<const Pass> passes, size_t from, Resource resource, bool is_handed_out)
{
    for (size_t i = from + 1; i < passes.size(); ++i)
        if (const ResourceUse* use =
                areApart(passes[from], passes[i], resource) ? nullptr : firstUse(passes[i], resource))
        {
            const bool is_bound_alone = use->access == Access::depth_keep;
            if (needsContent(*use) || (is_handed_out && is_bound_alone))
                return &passes[i];
            if (!is_bound_alone)
                return nullptr;
        }
    return nullptr;
}

/// First pass after `from` that uses a resource; null if there is none.
const Pass* findUser(std::span<const Pass> passes, size_t from, Resource resource)
{
    for (size_t i = from + 1; i < passes.size(); ++i)
        if (!areApart(passes[from], passes[i], resource) && firstUse(passes[i], resource) != nullptr)
            return &passes[i];
    return nullptr;
}

bool isHandedOut(const FrameConfiguration& c, Resource resource)
{
    return resource == Resource::color || (resource == Resource::visibility && c.keeps_visibility) ||
           (resource == Resource::depth && c.keeps_depth);
}

/// Return the layout in which the caller gets an image: the depth in the one that the next frame may expect.
VkImageLayout handedOutLayout(Resource resource)
{
    return resource == Resource::depth ? accessLayout(Access::sampled) : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
}

/// Return the access by which the next frame reads an attachment that this one is to leave to it.
std::optional<Access> readByNextFrame(const FrameConfiguration& c, Resource resource)
{
    if (resource == Resource::depth && defersPyramid(c))
        return Access::sampled;
    if (resource == bloomLevel(shared::kBloomLevels) && c.adapts_exposure)
        return Access::fragment_read;
    return std::nullopt;
}

/// Return the attachment in the layout of its last use in a pass.
VkImageLayout lastLayout(const Pass& pass, Resource resource)
{
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    for (const Subpass& subpass : pass.subpasses)
        for (const ResourceUse& use : subpass.attachments)
            if (use.resource == resource)
                layout = accessLayout(use.access);
    return layout;
}

/// Derive load and store operations and layouts of a render pass. `stored` has the layout of each attachment
/// that an earlier pass has stored.
void setAttachments(const FrameConfiguration& c, std::span<Pass> passes, size_t number,
                    std::array<VkImageLayout, kResourceCount>& stored)
{
    Pass& pass = passes[number];
    for (size_t i = 0; i < kResourceCount; ++i)
    {
        const auto resource = static_cast<Resource>(i);
        VkImageLayout& before = stored[static_cast<size_t>(resource)];
        const VkImageLayout own = lastLayout(pass, resource);
        if (own == VK_IMAGE_LAYOUT_UNDEFINED)
            continue;
        AttachmentUse attachment{.resource = resource, .final_layout = own};
        const ResourceUse* first = firstUse(pass, resource);
        const Pass* reader = findReader(passes, number, resource, isHandedOut(c, resource));
        // the layout of an image that was stored stands for its content
        const bool is_needed_later =
            before != VK_IMAGE_LAYOUT_UNDEFINED && (reader != nullptr || isHandedOut(c, resource));
        // an empty subpass would load and store what it does not use
        HEARTH_ASSERT(first != nullptr || !is_needed_later);
        const bool passes_through =
            first != nullptr && first->access == Access::depth_keep && is_needed_later;
        if (first != nullptr && first->content == Content::begin)
            attachment.load = LoadOperation::clear;
        else if (first != nullptr && (needsContent(*first) || passes_through))
        {
            HEARTH_ASSERT(before != VK_IMAGE_LAYOUT_UNDEFINED);
            attachment.load = LoadOperation::load;
            attachment.initial_layout = before;
        }
        const bool has_content = first != nullptr;
        if (has_content && reader != nullptr)
        {
            attachment.store = true;
            // a pass may lie between that only binds it
            const Pass& user = *findUser(passes, number, resource);
            attachment.reader = userName(user, resource);
            attachment.final_layout = accessLayout(firstUse(user, resource)->access);
        }
        else if (has_content && isHandedOut(c, resource))
        {
            attachment.store = true;
            attachment.reader = kCaller;
            attachment.final_layout = handedOutLayout(resource);
        }
        else if (const auto access = readByNextFrame(c, resource); has_content && access)
        {
            attachment.store = true;
            attachment.reader = kNextFrame;
            attachment.final_layout = accessLayout(*access);
        }
        before = attachment.store ? attachment.final_layout : VK_IMAGE_LAYOUT_UNDEFINED;
        pass.attachments.push_back(attachment);
    }
    for (const ResourceUse& use : pass.uses)
        if (use.access == Access::copy_write)
            stored[static_cast<size_t>(use.resource)] = accessLayout(use.access);
}

/// Hand out what the caller needs and no render pass can: an image that the frame reads last.
void setHandedOut(const FrameConfiguration& c, std::span<Pass> passes,
                  const std::array<VkImageLayout, kResourceCount>& stored)
{
    HEARTH_ASSERT(!c.keeps_depth ||
                  stored[static_cast<size_t>(Resource::depth)] == handedOutLayout(Resource::depth));
    const VkImageLayout layout = stored[static_cast<size_t>(Resource::visibility)];
    if (!isHandedOut(c, Resource::visibility) || layout == handedOutLayout(Resource::visibility))
        return;
    const auto last =
        std::find_if(passes.rbegin(), passes.rend(),
                     [](const Pass& pass) { return firstUse(pass, Resource::visibility) != nullptr; });
    HEARTH_ASSERT(last != passes.rend() && layout != VK_IMAGE_LAYOUT_UNDEFINED);
    last->handed_out.push_back({Resource::visibility, layout, handedOutLayout(Resource::visibility)});
}

/// Uses of a resource.
struct Touch
{
    VkPipelineStageFlags stages = 0;
    VkPipelineStageFlags writers = 0; ///< of these, those that write
    VkAccessFlags written = 0;

    void add(Access access)
    {
        stages |= accessStages(access);
        if (!isWrite(access))
            return;
        writers |= accessStages(access);
        written |= accessFlags(access);
    }
};

using Touches = std::array<Touch, kResourceCount>;

/// Return what any frame may do with each resource: frames before may have had other configurations.
Touches touchesOfEarlierFrames(FrameWay way, MaterialTest materials, bool keeps_depth)
{
    Touches touches;
    std::vector<FrameConfiguration> all = allConfigurations(way, materials);
    for (size_t i = 0; i < kLightPathCount; ++i)
    {
        const auto path = static_cast<LightPath>(i);
        const bool on_tile = path == LightPath::surfaces_on_tile;
        all.push_back({.way = way,
                       .materials = materials,
                       .has_final_pass = true,
                       .adapts_exposure = !on_tile,
                       .blooms = !on_tile,
                       .light_path = path});
    }
    for (FrameConfiguration c : all)
    {
        addLightLists(c);
        c.lights_bricks = true;
        addMapsOfAllKinds(c);
        for (const Step& step : listSteps(c))
            for (const auto* uses : {&step.attachments, &step.uses})
                for (const ResourceUse& use : *uses)
                    if (!resourceFacts(use.resource).has_parts)
                        touches[static_cast<size_t>(use.resource)].add(use.access);
    }
    for (const Resource resource : {Resource::color, Resource::visibility, Resource::radiance})
        touches[static_cast<size_t>(resource)].stages |= kCallerStages;
    if (keeps_depth)
        touches[static_cast<size_t>(Resource::depth)].stages |= kCallerDepthStages;
    // an image has been the one in a frame and the other in the next
    Touch& exposure = touches[static_cast<size_t>(Resource::exposure)];
    exposure.add(Access::fragment_read);
    touches[static_cast<size_t>(Resource::last_exposure)] = exposure;
    // tools copy maps
    touches[static_cast<size_t>(Resource::shadow_map)].add(Access::copy_read);
    return touches;
}

/// Uses of a resource by a pass, of empty subpasses too: their attachments change their layout.
std::vector<Access> listAccesses(const Pass& pass, Resource resource)
{
    std::vector<Access> accesses;
    const auto add = [&](const std::vector<ResourceUse>& uses)
    {
        for (const ResourceUse& use : uses)
            if (use.resource == resource)
                accesses.push_back(use.access);
    };
    for (const Subpass& subpass : pass.subpasses)
        add(subpass.attachments);
    add(pass.uses);
    return accesses;
}

/// Return what the passes before did with a resource since it was last written, and that write.
Touch touchBefore(const FrameConfiguration& c, std::span<const Pass> passes, size_t number, Resource resource,
                  const Touches& earlier_frames)
{
    Touch touch;
    if (c.in_parts && resource == Resource::visibility) // the caller may have read it between two parts
        touch.stages |= kCallerStages;
    for (size_t i = number; i-- > 0;)
    {
        for (const Access access : listAccesses(passes[i], resource))
            touch.add(access);
        // what wrote a shadow map may have written another layer
        if (touch.written != 0 && resource != Resource::shadow_map)
            return touch;
    }
    const Touch& earlier = earlier_frames[static_cast<size_t>(resource)];
    touch.stages |= earlier.stages;
    touch.writers |= earlier.writers;
    touch.written |= earlier.written;
    return touch;
}

/// True if an access is by fragments or their attachments.
bool isByFragments(Access access)
{
    constexpr VkPipelineStageFlags kFragments =
        VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
        VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    return (accessStages(access) & ~kFragments) == 0;
}

/// Last pass before `number` that writes a resource; null if an earlier frame did.
Pass* findWriter(std::span<Pass> passes, size_t number, Resource resource)
{
    while (number-- > 0)
    {
        const std::vector<Access> accesses = listAccesses(passes[number], resource);
        if (std::any_of(accesses.begin(), accesses.end(), isWrite))
            return &passes[number];
    }
    return nullptr;
}

/// Derive the barriers of a pass: writes wait for all uses since the last write, reads for that write.
void setBarriers(const FrameConfiguration& c, std::span<Pass> passes, size_t number,
                 const Touches& earlier_frames)
{
    Pass& pass = passes[number];
    for (size_t i = 0; i < kResourceCount; ++i)
    {
        const auto resource = static_cast<Resource>(i);
        const std::vector<Access> accesses = listAccesses(pass, resource);
        if (accesses.empty())
            continue;
        const Touch before = touchBefore(c, passes, number, resource, earlier_frames);
        for (const Access access : accesses)
        {
            // layouts of inputs change with the pass
            const bool changes = isWrite(access) || access == Access::input;
            const VkPipelineStageFlags from = changes ? before.stages : before.writers;
            if (from == 0)
                continue;
            Pass* writer = access == Access::vertex_read ? findWriter(passes, number, resource) : nullptr;
            PassBarrier& barrier = writer != nullptr       ? writer->vertex_barrier
                                   : isByFragments(access) ? pass.fragment_barrier
                                                           : pass.barrier;
            barrier.from |= from;
            barrier.written |= before.written;
            barrier.to |= accessStages(access);
            barrier.accessed |= accessFlags(access);
        }
    }
}

/// List the attachments that no pass loads or stores.
std::vector<Resource> findTransient(std::span<const Pass> passes)
{
    std::vector<Resource> transient;
    for (const Resource resource : kTileAttachments)
    {
        bool leaves_tile = false;
        for (const Pass& pass : passes)
            for (const AttachmentUse& use : pass.attachments)
                leaves_tile = leaves_tile ||
                              (use.resource == resource && (use.store || use.load == LoadOperation::load));
        if (!leaves_tile)
            transient.push_back(resource);
    }
    return transient;
}

} // namespace

FrameDescription describeFrame(const FrameConfiguration& configuration)
{
    return describeFrames({&configuration, 1}).front();
}

std::vector<FrameDescription> describeFrames(std::span<const FrameConfiguration> configurations)
{
    const FrameConfiguration& first = configurations.front();
    const Touches earlier_frames = touchesOfEarlierFrames(first.way, first.materials, first.keeps_depth);
    std::vector<FrameDescription> frames;
    for (const FrameConfiguration& configuration : configurations)
    {
        HEARTH_ASSERT(configuration.way == first.way && configuration.materials == first.materials &&
                      configuration.keeps_depth == first.keeps_depth);
        HEARTH_ASSERT(!configuration.keeps_depth || configuration.materials == MaterialTest::id);
        FrameDescription& frame = frames.emplace_back();
        frame.configuration = configuration;
        frame.passes = joinSteps(configuration, listSteps(configuration));
        std::array<VkImageLayout, kResourceCount> stored{};
        for (size_t i = 0; i < frame.passes.size(); ++i)
        {
            setAttachments(configuration, frame.passes, i, stored);
            setBarriers(configuration, frame.passes, i, earlier_frames);
        }
        setHandedOut(configuration, frame.passes, stored);
        frame.transient = findTransient(frame.passes);
    }
    return frames;
}

void addMapsOfAllKinds(FrameConfiguration& configuration)
{
    configuration.has_shadows = true;
    configuration.maps = {MapContent::fresh, MapContent::moving, MapContent::fresh};
    configuration.maps_at_once = 2;
}

void addLightLists(FrameConfiguration& configuration)
{
    configuration.lists_lights = configuration.lists_slots = true;
    configuration.lists_visible = configuration.in_parts;
}

std::vector<FrameConfiguration> allConfigurations(FrameWay way, MaterialTest materials,
                                                  FrameFeatures features)
{
    std::vector<FrameConfiguration> all;
    for (const OcclusionCulling occlusion :
         {OcclusionCulling::off, OcclusionCulling::last_frame, OcclusionCulling::two_phase})
        for (uint32_t bits = 0; bits < 32; ++bits)
            all.push_back({.way = way,
                           .occlusion = occlusion,
                           .materials = materials,
                           .material_tiles = (bits & 1) != 0,
                           .gathers_light = (bits & 2) != 0,
                           .in_parts = (bits & 4) != 0,
                           .keeps_visibility = (bits & 8) != 0,
                           .shows_overdraw = (bits & 16) != 0});
    HEARTH_ASSERT(all.size() == kConfigurationCount);
    const auto add = [&](LightPath path, uint32_t first, uint32_t count)
    {
        for (uint32_t finals = first; finals < count; ++finals)
            for (uint32_t i = 0; i < kConfigurationCount; ++i)
            {
                FrameConfiguration c = all[i];
                c.has_final_pass = finals > 0;
                c.adapts_exposure = finals > 0 && ((finals - 1) & 1) != 0;
                c.blooms = finals > 0 && ((finals - 1) & 2) != 0;
                c.light_path = path;
                all.push_back(c);
            }
    };
    if (features >= FrameFeatures::finished)
        add(LightPath::materials, 1, kFinalPassCount);
    if (features >= FrameFeatures::deferred)
    {
        add(LightPath::surfaces_on_tile, 1, 2);
        add(LightPath::surfaces, 1, kFinalPassCount);
        for (const LightPath path : {LightPath::light_sums, LightPath::joint_sums,
                                     LightPath::encoded_joint_sums, LightPath::light_bits})
            add(path, 0, kFinalPassCount);
    }
    return all;
}

uint32_t configurationIndex(const FrameConfiguration& c)
{
    const auto bit = [](bool set, uint32_t number) { return (set ? 1u : 0u) << number; };
    // of kConfigurationCount: those of the paths before, as allConfigurations lists them
    constexpr uint32_t kFirstBlocks[] = {0,
                                         kFinalPassCount - 1,
                                         kFinalPassCount,
                                         2 * kFinalPassCount,
                                         3 * kFinalPassCount,
                                         4 * kFinalPassCount,
                                         5 * kFinalPassCount};
    static_assert(std::size(kFirstBlocks) == kLightPathCount);
    const uint32_t finals = c.has_final_pass ? 1 + bit(c.adapts_exposure, 0) + bit(c.blooms, 1) : 0;
    const uint32_t block = kFirstBlocks[static_cast<size_t>(c.light_path)] + finals;
    return kConfigurationCount * block + 32 * static_cast<uint32_t>(c.occlusion) + bit(c.material_tiles, 0) +
           bit(c.gathers_light, 1) + bit(c.in_parts || c.lists_visible, 2) + bit(c.keeps_visibility, 3) +
           bit(c.shows_overdraw, 4);
}

const Pass* findPass(const FrameDescription& frame, FrameStep step)
{
    for (const Pass& pass : frame.passes)
        if (std::find(pass.steps.begin(), pass.steps.end(), step) != pass.steps.end())
            return &pass;
    return nullptr;
}

} // namespace hearth::gpu
