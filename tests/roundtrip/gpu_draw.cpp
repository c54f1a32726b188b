// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/roundtrip/gpu_draw.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace hearth::roundtrip
{

namespace
{

template <typename T>
T must(Result<T> result)
{
    if (!result.ok())
    {
        std::fprintf(stderr, "%s\n", formatMessage(result.error()).c_str());
        std::abort();
    }
    return std::move(result).value();
}

} // namespace

std::vector<reference::DrawnCluster> DrawnFrame::sortedSlots() const
{
    std::vector<reference::DrawnCluster> sorted = slots;
    std::sort(sorted.begin(), sorted.end());
    return sorted;
}

std::unique_ptr<TestDevice> TestDevice::create(std::string& reason)
{
    auto device = std::make_unique<TestDevice>();
    // the references implement the rules of this rasteriser
    auto host = viewer::VulkanHost::create({.device_name = "llvmpipe", .validate = true});
    if (!host.ok())
    {
        reason = formatMessage(host.error());
        return nullptr;
    }
    device->host_ = std::move(host).value();
    device->renderer_ = must(gpu::Renderer::create(device->host_->description()));
    return device;
}

GpuScene TestDevice::upload(const formats::PackView& pack)
{
    GpuScene scene;
    scene.device_ = this;
    must(host_->run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(scene.scene_, renderer_->upload(pack, commands));
            return success();
        }));
    scene.scene_->staging.reset();
    return scene;
}

std::vector<std::string> TestDevice::takeMessages()
{
    std::vector<std::string> messages = host_->messages();
    host_->clearMessages();
    return messages;
}

DrawnFrame GpuScene::draw(const shared::FrameView& frame, uint32_t debug_view) const
{
    const gpu::Renderer& renderer = *device_->renderer_;
    viewer::VulkanHost& host = *device_->host_;
    const VkExtent2D extent{static_cast<uint32_t>(frame.width), static_cast<uint32_t>(frame.height)};
    gpu::FrameTargets targets = must(renderer.createTargets(extent, {.keeps_visibility = true}));
    const gpu::FrameInput input{.view = frame, .shading = {.debug_view = debug_view, .depth_scale = 2}};
    must(host.run(
        [&](VkCommandBuffer commands)
        {
            renderer.record(commands, *scene_, targets, input);
            return success();
        }));

    DrawnFrame drawn;
    const viewer::VisibleList list = must(viewer::readVisibleList(host, renderer, *scene_));
    for (const shared::VisibleCluster& slot : list.slots)
        drawn.slots.push_back({slot.instance, slot.cluster});
    const std::vector<std::byte> ids = must(host.read(renderer.device(), targets.visibility(), 4));
    drawn.ids.resize(ids.size() / 4);
    std::memcpy(drawn.ids.data(), ids.data(), ids.size());
    const std::vector<std::byte> color = must(host.read(renderer.device(), targets.color(), 4));
    drawn.image = reference::Image(extent.width, extent.height);
    for (size_t i = 0; i < color.size() / 4; ++i)
        for (size_t channel = 0; channel < 3; ++channel)
            drawn.image.rgb[i * 3 + channel] = std::to_integer<uint8_t>(color[i * 4 + channel]);
    return drawn;
}

} // namespace hearth::roundtrip
