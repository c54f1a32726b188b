// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "particles.h"

#include <cstring>

namespace game
{

namespace
{

constexpr uint32_t kMaxParticles = 256;
constexpr uint32_t kVertexCode[] =
#include "particle.vert.inc"
    ;
constexpr uint32_t kFragmentCode[] =
#include "particle.frag.inc"
    ;

struct View
{
    float clip_from_world[4][4]; ///< columns
    float right[4], up[4];
};

/// Make the view of Hearth's own projection: depth is z_near over the distance along the axis.
View makeView(const hearth_camera& camera, float aspect)
{
    const auto vec = [](const float v[3]) { return Vec{v[0], v[1], v[2]}; };
    const Vec eye = vec(camera.position), ahead = unit(vec(camera.target) - eye);
    const Vec right = unit(cross(ahead, vec(camera.up))), up = cross(right, ahead);
    const float scale = 1 / std::tan(camera.y_fov_rad / 2);
    const Vec rows[4] = {right * (scale / aspect), up * -scale, {}, ahead};
    View view{.right = {right.x, right.y, right.z}, .up = {up.x, up.y, up.z}};
    for (int row = 0; row < 4; ++row)
    {
        const float columns[4] = {rows[row].x, rows[row].y, rows[row].z, -dot(rows[row], eye)};
        for (int column = 0; column < 4; ++column)
            view.clip_from_world[column][row] = columns[column];
    }
    view.clip_from_world[3][2] = camera.z_near;
    return view;
}

} // namespace

Particles::Particles(Gpu& gpu, const hearth_targets_info& images) : gpu_(gpu), images_(images)
{
    createPass();
    createPipeline();
    for (uint32_t slot = 0; slot < kFramesInFlight; ++slot)
        instances_.push_back(
            gpu.createBuffer(sizeof(Instance) * kMaxParticles, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT));
}

void Particles::createPass()
{
    const hearth_image &color = images_.color, &depth = images_.depth;
    // loads what Hearth has drawn, and gives the depth back in the state that the next frame expects
    const VkAttachmentDescription attachments[] = {
        {0, color.format, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_STORE_OP_STORE,
         VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_DONT_CARE, color.after.layout,
         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL},
        {0, depth.format, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_STORE_OP_STORE,
         VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_STORE_OP_STORE, depth.after.layout, depth.before.layout}};
    const VkAttachmentReference color_use{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth_use{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL};
    const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &color_use,
                                       .pDepthStencilAttachment = &depth_use};
    constexpr VkPipelineStageFlags kStages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                             VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                             VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
    constexpr VkAccessFlags kAccess =
        VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
        VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    const VkSubpassDependency dependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, color.after.stages | depth.after.stages, kStages,
         color.after.access | depth.after.access, kAccess, 0},
        {0, VK_SUBPASS_EXTERNAL, kStages, VK_PIPELINE_STAGE_TRANSFER_BIT | depth.before.stages, kAccess,
         VK_ACCESS_TRANSFER_READ_BIT | depth.before.access, 0}};
    const VkRenderPassCreateInfo pass_info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                           .attachmentCount = 2,
                                           .pAttachments = attachments,
                                           .subpassCount = 1,
                                           .pSubpasses = &subpass,
                                           .dependencyCount = 2,
                                           .pDependencies = dependencies};
    check(vkCreateRenderPass(gpu_.device, &pass_info, nullptr, &pass_));

    VkImageView views[2];
    const hearth_image* const images[] = {&color, &depth};
    constexpr VkImageAspectFlags kAspects[] = {VK_IMAGE_ASPECT_COLOR_BIT,
                                               VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT};
    for (int i = 0; i < 2; ++i)
    {
        const VkImageViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                         .image = images[i]->image,
                                         .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                         .format = images[i]->format,
                                         .subresourceRange = {kAspects[i], 0, 1, 0, 1}};
        check(vkCreateImageView(gpu_.device, &info, nullptr, &views[i]));
    }
    const VkFramebufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                       .renderPass = pass_,
                                       .attachmentCount = 2,
                                       .pAttachments = views,
                                       .width = images_.width,
                                       .height = images_.height,
                                       .layers = 1};
    check(vkCreateFramebuffer(gpu_.device, &info, nullptr, &framebuffer_));
}

void Particles::createPipeline()
{
    const VkPushConstantRange range{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(View)};
    const VkPipelineLayoutCreateInfo layout_info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                 .pushConstantRangeCount = 1,
                                                 .pPushConstantRanges = &range};
    check(vkCreatePipelineLayout(gpu_.device, &layout_info, nullptr, &layout_));
    VkShaderModule modules[2];
    const VkShaderModuleCreateInfo codes[] = {
        {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, sizeof(kVertexCode), kVertexCode},
        {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, sizeof(kFragmentCode), kFragmentCode}};
    for (int i = 0; i < 2; ++i)
        check(vkCreateShaderModule(gpu_.device, &codes[i], nullptr, &modules[i]));
    const VkPipelineShaderStageCreateInfo stages[] = {
        {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_VERTEX_BIT,
         modules[0], "main", nullptr},
        {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_FRAGMENT_BIT,
         modules[1], "main", nullptr}};
    const VkVertexInputBindingDescription binding{0, sizeof(Instance), VK_VERTEX_INPUT_RATE_INSTANCE};
    const VkVertexInputAttributeDescription attributes[] = {
        {0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Instance, center)},
        {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Instance, color)}};
    const VkPipelineVertexInputStateCreateInfo input{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = 1,
        .pVertexBindingDescriptions = &binding,
        .vertexAttributeDescriptionCount = 2,
        .pVertexAttributeDescriptions = attributes};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP};
    const auto width = static_cast<float>(images_.width), height = static_cast<float>(images_.height);
    const VkViewport viewport{0, 0, width, height, 0, 1};
    const VkRect2D scissor{{0, 0}, {images_.width, images_.height}};
    const VkPipelineViewportStateCreateInfo view{.sType =
                                                     VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                                                 .viewportCount = 1,
                                                 .pViewports = &viewport,
                                                 .scissorCount = 1,
                                                 .pScissors = &scissor};
    const VkPipelineRasterizationStateCreateInfo raster{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo samples{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineDepthStencilStateCreateInfo depth{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = VK_TRUE,
        .depthCompareOp = VK_COMPARE_OP_GREATER}; // nearer is greater
    const VkPipelineColorBlendAttachmentState blend{VK_TRUE,
                                                    VK_BLEND_FACTOR_ONE,
                                                    VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                                    VK_BLEND_OP_ADD,
                                                    VK_BLEND_FACTOR_ZERO,
                                                    VK_BLEND_FACTOR_ONE,
                                                    VK_BLEND_OP_ADD,
                                                    0xf};
    const VkPipelineColorBlendStateCreateInfo blending{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &blend};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .stageCount = 2,
                                            .pStages = stages,
                                            .pVertexInputState = &input,
                                            .pInputAssemblyState = &assembly,
                                            .pViewportState = &view,
                                            .pRasterizationState = &raster,
                                            .pMultisampleState = &samples,
                                            .pDepthStencilState = &depth,
                                            .pColorBlendState = &blending,
                                            .layout = layout_,
                                            .renderPass = pass_};
    check(vkCreateGraphicsPipelines(gpu_.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_));
}

void Particles::emit(Kind kind)
{
    const float angle = 2 * kPi * random(), away = random();
    const Vec side = headingToDirection(angle) * away;
    if (kind == kFlame)
        particles_.push_back({kind, side * 0.3f + Vec{0, 0.15f, 0}, side * -0.35f + Vec{0, 0.9f, 0}, 0,
                              0.6f + 0.5f * random()});
    else if (kind == kSpark)
        particles_.push_back({kind, side * 0.3f + Vec{0, 0.4f, 0}, side * 0.7f + Vec{0, 1.2f + random(), 0},
                              0, 1 + 1.5f * random()});
    else
        particles_.push_back({kind, side * 0.2f + Vec{0, 1.3f, 0}, side * 0.15f + Vec{0.12f, 0.6f, 0}, 0, 4});
}

void Particles::step(float seconds)
{
    for (Particle& particle : particles_)
    {
        particle.age += seconds;
        // swirls sideways
        const float swirl = 7 * particle.age + 9 * particle.life;
        const Vec wind =
            Vec{std::sin(swirl), 0, std::cos(1.3f * swirl)} * (particle.kind == kSpark ? 0.5f : 0.12f);
        particle.position = particle.position + (particle.velocity + wind) * seconds;
    }
    std::erase_if(particles_, [](const Particle& particle) { return particle.age >= particle.life; });
    constexpr float kPeriod = 0.0125f; // of emission, seconds
    for (due_ += seconds; due_ > 0 && particles_.size() < kMaxParticles; due_ -= kPeriod)
    {
        const float kind = random();
        emit(kind < 0.78f ? kFlame : kind < 0.94f ? kSpark : kSmoke);
    }
}

Particles::Instance Particles::draw(const Particle& particle)
{
    const float age = particle.age / particle.life, fade = smooth(0, 0.15f, age) * (1 - age);
    if (particle.kind == kFlame)
        return {particle.position,
                mix(0.2f, 0.07f, age),
                {0.55f * fade, 0.55f * fade * mix(0.5f, 0.16f, age), 0.09f * fade * (1 - age), 0}};
    if (particle.kind == kSpark)
        return {particle.position, 0.014f, {2.2f * fade, 0.9f * fade, 0.2f * fade, 0}};
    return {
        particle.position, mix(0.2f, 0.8f, age), {0.02f * fade, 0.02f * fade, 0.02f * fade, 0.18f * fade}};
}

void Particles::record(VkCommandBuffer commands, const hearth_camera& camera)
{
    std::vector<Instance> instances;
    for (const Kind kind : {kSmoke, kFlame, kSpark}) // smoke covers, the others add: smoke first
        for (const Particle& particle : particles_)
            if (particle.kind == kind)
                instances.push_back(draw(particle));
    const Buffer& buffer = instances_[gpu_.slot()];
    std::memcpy(buffer.mapped, instances.data(), instances.size() * sizeof(Instance));

    const VkRenderPassBeginInfo begin{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                      .renderPass = pass_,
                                      .framebuffer = framebuffer_,
                                      .renderArea = {{0, 0}, {images_.width, images_.height}}};
    const View view =
        makeView(camera, static_cast<float>(images_.width) / static_cast<float>(images_.height));
    const VkDeviceSize start = 0;
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(View), &view);
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer.buffer, &start);
    vkCmdDraw(commands, 4, static_cast<uint32_t>(instances.size()), 0, 0);
    vkCmdEndRenderPass(commands);
}

} // namespace game
