// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_shadows.h"

#include "runtime/frame/shadow_faces.h"
#include "runtime/gpu/scene/scene_shading.h"

#include <algorithm>
#include <string>

namespace hearth::gpu
{

namespace
{

/// Create a compare sampler: 1 where the reference is no deeper than the texel, the mean of texels if it
/// filters.
Result<UniqueSampler> createCompareSampler(const Device& device, bool filters)
{
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = filters ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.compareEnable = VK_TRUE;
    info.compareOp = VK_COMPARE_OP_GREATER_OR_EQUAL; // reversed depth
    VkSampler sampler;
    HEARTH_TRY_VK(device.vk.vkCreateSampler(device.handle, &info, device.allocator, &sampler),
                  "create a sampler");
    return UniqueSampler(device, sampler);
}

Status checkLimits(const Device& device, const ShadowOptions& options)
{
    const uint32_t layers = options.moving_layers ? 2 * options.max_maps : options.max_maps;
    if (options.texels > device.limits.maxImageDimension2D ||
        options.texels > device.limits.maxFramebufferWidth ||
        options.texels > device.limits.maxFramebufferHeight || layers > device.limits.maxImageArrayLayers)
        return Error{Issue::device_limit, "", "",
                     "the device cannot render " + std::to_string(options.max_maps) + " shadow maps of " +
                         std::to_string(options.texels) + " texels each way"};
    return success();
}

} // namespace

ShadowDepthChoice SceneShadows::chooseDepth(const formats::PackView& pack, const Box3& bounds,
                                            const ShadowOptions& options)
{
    return chooseShadowDepth(makeLighting(pack), options, bounds, readShadowSpheres(pack));
}

Result<std::unique_ptr<SceneShadows>> SceneShadows::create(const Device& device, VkRenderPass render_pass,
                                                           const formats::PackView& pack, const Box3& bounds,
                                                           const VertexMotions& motions, uint32_t max_lights,
                                                           const ShadowOptions& options,
                                                           const ShadowDepthChoice& depth)
{
    HEARTH_ASSERT(options.max_maps <= shared::kMaxShadowMaps && options.splits <= kMaxSplits &&
                  options.error_bias >= 1 && options.spot_near > 0);
    HEARTH_TRY(checkLimits(device, options));
    std::unique_ptr<SceneShadows> shadows(
        new SceneShadows(device, pack, motions, max_lights, options, depth));
    SceneShadows& s = *shadows;
    s.bounds_ = bounds;
    for (const shared::Light& light : makeLighting(pack).lights)
        s.luminances_.push_back(shared::luminance(light.intensity));
    s.spheres_ = readShadowSpheres(pack);
    s.pack_sphere_count_ = s.spheres_.size();
    HEARTH_TRY(s.createImage());
    s.layers_.resize(s.layerCount());
    for (uint32_t layer = 0; layer < s.layerCount(); ++layer)
        HEARTH_TRY(s.createLayer(device, render_pass, s.layers_[layer], layer));
    HEARTH_ASSIGN_OR_RETURN(s.sampler_, createCompareSampler(device, s.filters_));
    HEARTH_ASSIGN_OR_RETURN(
        s.casters_, s.arena_.createBuffer(s.layerCount() * sizeof(shared::FrameCounters),
                                          VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                          MemoryKind::device));
    HEARTH_ASSIGN_OR_RETURN(s.proxy_triangles_, s.arena_.createBuffer(s.layerCount() * sizeof(uint32_t),
                                                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                                                          VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                                      MemoryKind::device));
    return shadows;
}

Status SceneShadows::createImage()
{
    // tests and tools copy it out
    constexpr VkImageUsageFlags kUsage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                         VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                         VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    HEARTH_ASSIGN_OR_RETURN(image_, arena_.createImage({.format = shadowFormat(depth_.depth),
                                                        .extent = {options_.texels, options_.texels},
                                                        .usage = kUsage,
                                                        .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                                                        .array_layers = layerCount()}));
    return success();
}

Status SceneShadows::createLayer(const Device& device, VkRenderPass render_pass, Layer& layer,
                                 uint32_t number) const
{
    VkImageViewCreateInfo view_info{};
    view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view_info.image = image_.handle.get();
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = image_.format;
    view_info.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, number, 1};
    VkImageView view;
    HEARTH_TRY_VK(device.vk.vkCreateImageView(device.handle, &view_info, device.allocator, &view),
                  "create an image view");
    layer.view = UniqueImageView(device, view);

    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass;
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = info.height = options_.texels;
    info.layers = 1;
    VkFramebuffer framebuffer;
    HEARTH_TRY_VK(device.vk.vkCreateFramebuffer(device.handle, &info, device.allocator, &framebuffer),
                  "create a framebuffer");
    layer.framebuffer = UniqueFramebuffer(device, framebuffer);
    return success();
}

void SceneShadows::track(std::span<const InstanceMove> moves,
                         std::span<const pack::ResidentGroups::Change> groups)
{
    cache_.move(moves);
    cache_.publish(groups);
}

void SceneShadows::trackInputs(const Float4& inputs)
{
    const bool same = inputs_ && inputs_->x == inputs.x && inputs_->y == inputs.y && inputs_->z == inputs.z &&
                      inputs_->w == inputs.w;
    if (!same)
        cache_.disturb(motions_.instances);
    inputs_ = inputs;
}

void SceneShadows::change(uint32_t slot, float luminance)
{
    if (slot >= luminances_.size())
        luminances_.resize(slot + 1);
    luminances_[slot] = luminance;
}

void SceneShadows::choose(const shared::FrameView& view, std::span<const shared::Light> lights,
                          shared::ShadowLights& chosen) const
{
    const uint32_t maps = bounds_.empty() ? 0 : options_.max_maps; // nothing is there to cast
    chosen.choose(lights, luminances_, view.eye,
                  {.maps = maps, .maps_of_a_sun = std::max(options_.splits, 1u)});
}

/// Set the projections of the chosen lights, by rank.
void SceneShadows::makeCasters(const shared::FrameView& view, const shared::ShadowLights& chosen,
                               std::span<const shared::Light> lights,
                               std::vector<ShadowCaster>& casters) const
{
    casters.clear();
    for (const shared::ShadowLights::Holder& holder : chosen.holders())
        addShadowCasters(lights[holder.slot], holder.slot, holder.row, bounds_, options_.spot_near, casters);
    for (ShadowCaster& caster : casters)
        caster.is_unseen = lights[caster.light].type == shared::kLightPoint &&
                           !shared::mayShowFace(view, caster.projection, caster.range);
}

void SceneShadows::chooseLights(const shared::FrameView& view, SceneLights& lights, MirroredTable& table)
{
    choose(view, lights.lights(), chosen_);
    for (const shared::ShadowRowChange& change : chosen_.changes())
        lights.setShadowRow(table, change.slot, change.row);
}

std::vector<ShadowCache::LayerUpdate> SceneShadows::findStale(const shared::FrameView& view,
                                                              std::span<const shared::Light> lights,
                                                              std::span<const ShadowSphere> spheres,
                                                              std::span<const InstanceMove> moves) const
{
    std::vector<ShadowSphere> all(spheres_.begin(),
                                  spheres_.begin() + static_cast<std::ptrdiff_t>(pack_sphere_count_));
    all.insert(all.end(), spheres.begin(), spheres.end());
    shared::ShadowLights chosen = chosen_;
    choose(view, lights, chosen);
    std::vector<ShadowCaster> casters;
    makeCasters(view, chosen, lights, casters);
    ShadowPlan plan = planShadows(casters, options_, view, all);
    ShadowCache cache = cache_;
    cache.move(moves);
    const std::span<const ShadowCache::LayerUpdate> stale = cache.plan(plan, view);
    return {stale.begin(), stale.end()};
}

std::span<const ShadowCache::LayerUpdate> SceneShadows::planFrame(const shared::FrameView& view,
                                                                  std::span<const shared::Light> lights,
                                                                  std::span<const ShadowSphere> spheres)
{
    spheres_.resize(pack_sphere_count_);
    spheres_.insert(spheres_.end(), spheres.begin(), spheres.end());
    makeCasters(view, chosen_, lights, projections_);
    plan_ = planShadows(projections_, options_, view, spheres_);
    const std::span<const ShadowCache::LayerUpdate> stale = cache_.plan(plan_, view);
    statistics_ = {.maps = plan_.map_count,
                   .unseen_maps = plan_.unseen_maps,
                   .dropped_maps = plan_.dropped_maps + chosen_.droppedMaps(),
                   .shadowed_lights = plan_.shadowed_lights,
                   .unshadowed_lights = chosen_.lightsOn() - plan_.shadowed_lights};
    for (const ShadowCache::LayerUpdate& map : stale)
        ++(map.copy_from ? statistics_.moved_maps : statistics_.drawn_maps);
    return stale;
}

} // namespace hearth::gpu
