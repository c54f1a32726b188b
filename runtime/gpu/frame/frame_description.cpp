// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/frame/frame_description.h"

#include "formats/base/assert.h"

#include <iterator>
#include <string>

namespace hearth::gpu
{

namespace
{

// a pyramid is 1/4 + 1/16 + ... of the pixels; two texels of 16 bytes and 112 bytes of points per 64 pixels,
// twice; 64 words per 4096 pixels; a quarter of the pixels from level to level of bloom
constexpr ResourceFacts kResources[] = {
    {"visibility", ResourceKind::attachment, 4},
    {"depth", ResourceKind::attachment, 4},
    {"color", ResourceKind::attachment, 4},
    {"surfaces", ResourceKind::attachment, 16},
    {"normals", ResourceKind::attachment, 8},
    {"joint normals", ResourceKind::attachment, 4},
    {"encoded normals", ResourceKind::attachment, 8},
    {"diffuse light", ResourceKind::attachment, 8},
    {"specular light", ResourceKind::attachment, 8},
    {"grazing light", ResourceKind::attachment, 8},
    {"low light bits", ResourceKind::attachment, 4},
    {"high light bits", ResourceKind::attachment, 4},
    {"pyramid", ResourceKind::image, 4.0f / 3},
    {"gathered light", ResourceKind::image, 0.5f},
    {"gather points", ResourceKind::buffer, 1.75f},
    {"tile lists", ResourceKind::buffer, 0.0625f},
    {"shadow map", ResourceKind::shadow_map, 4},
    {"scene tables", ResourceKind::buffer, 0},
    {"pages", ResourceKind::buffer, 0, true},
    {"work lists", ResourceKind::buffer, 0},
    {"visible list", ResourceKind::buffer, 0, true},
    {"caster lists", ResourceKind::buffer, 0, true},
    {"brick light", ResourceKind::buffer, 0},
    {"light lists", ResourceKind::buffer, 0, true},
    {"radiance", ResourceKind::attachment, 4},
    {"bloom level 1", ResourceKind::attachment, 1},
    {"bloom level 2", ResourceKind::attachment, 1.0f / 4},
    {"bloom level 3", ResourceKind::attachment, 1.0f / 16},
    {"bloom level 4", ResourceKind::attachment, 1.0f / 64},
    {"bloom level 5", ResourceKind::attachment, 1.0f / 256},
    {"bloom sum 1", ResourceKind::attachment, 1},
    {"bloom sum 2", ResourceKind::attachment, 1.0f / 4},
    {"bloom sum 3", ResourceKind::attachment, 1.0f / 16},
    {"bloom sum 4", ResourceKind::attachment, 1.0f / 64},
    {"exposure", ResourceKind::attachment, 0},
    {"last exposure", ResourceKind::attachment, 0},
};
static_assert(std::size(kResources) == static_cast<size_t>(FrameResource::count));

constexpr const char* kSteps[] = {
    "update",         "list lights",       "light bricks", "shadow cull",  "shadow map",
    "shadow copy",    "moving shadow map", "cull",         "last pyramid", "early visibility",
    "early pyramid",  "late cull",         "slot lights",  "visibility",   "pyramid",
    "visible lights", "material tiles",    "gather light", "normals",      "add lights",
    "mark lights",    "shading",           "exposure",     "bloom down",   "bloom up",
    "final",
};
static_assert(std::size(kSteps) == static_cast<size_t>(FrameStep::count));

struct AccessFacts
{
    VkPipelineStageFlags stages;
    VkAccessFlags flags;
    VkImageLayout layout;
    bool writes;
};

constexpr VkPipelineStageFlags kDepthStages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;

constexpr AccessFacts accessFacts(Access access)
{
    switch (access)
    {
    case Access::color_write:
        return {VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true};
    case Access::depth_write:
    case Access::depth_keep: // load and store operations count as writes
        return {kDepthStages,
                VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, true};
    case Access::input:
        return {VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_INPUT_ATTACHMENT_READ_BIT,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, false};
    case Access::depth_input:
        return {kDepthStages | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
                    VK_ACCESS_INPUT_ATTACHMENT_READ_BIT | VK_ACCESS_SHADER_READ_BIT,
                VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL, true};
    case Access::sampled:
        return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, false};
    case Access::compute_read:
        return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
                false};
    case Access::compute_write:
        return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT,
                VK_IMAGE_LAYOUT_UNDEFINED, true};
    case Access::vertex_read:
        return {VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT,
                VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_SHADER_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
                false};
    case Access::fragment_read:
        return {VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, false};
    case Access::copy_read:
        return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT,
                VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, false};
    case Access::copy_write:
        return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true};
    }
    return {};
}

} // namespace

const ResourceFacts& resourceFacts(FrameResource resource)
{
    return kResources[static_cast<size_t>(resource)];
}

const char* stepName(FrameStep step)
{
    return kSteps[static_cast<size_t>(step)];
}

VkPipelineStageFlags accessStages(Access access)
{
    return accessFacts(access).stages;
}

VkAccessFlags accessFlags(Access access)
{
    return accessFacts(access).flags;
}

bool isWrite(Access access)
{
    return accessFacts(access).writes;
}

VkImageLayout accessLayout(Access access)
{
    return accessFacts(access).layout;
}

const char* userName(const Pass& pass, FrameResource resource)
{
    for (const Subpass& subpass : pass.subpasses)
        for (const ResourceUse& use : subpass.attachments)
            if (!subpass.is_empty && use.resource == resource)
                return stepName(subpass.step);
    return stepName(pass.steps.back()); // of a joined pass, shading reads images
}

std::string passName(const Pass& pass)
{
    std::string name;
    for (const FrameStep step : pass.steps)
        name += (name.empty() ? "" : " + ") + std::string(stepName(step));
    return name;
}

} // namespace hearth::gpu
