// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/imgui_layer.h"

#include "runtime/gpu/vulkan/pipelines.h"
#include "runtime/viewer/window/frame_ring.h"

#include <backends/imgui_impl_sdl.h>
#include <backends/imgui_impl_vulkan.h>
#include <cmath>
#include <imgui.h>

namespace hearth::viewer
{

namespace
{

/// Convert the colours: Dear ImGui's are sRGB codes, and the window's images are linear.
void linearizeColors(ImGuiStyle& style)
{
    const auto linear = [](float code)
    { return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f); };
    for (ImVec4& color : style.Colors)
        color = {linear(color.x), linear(color.y), linear(color.z), color.w};
}

ImGui_ImplVulkan_InitInfo initInfo(const VulkanHost& host, VkDescriptorPool descriptors)
{
    const gpu::DeviceDescription description = host.description();
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = description.instance;
    info.PhysicalDevice = description.physical_device;
    info.Device = description.device;
    info.QueueFamily = host.queueFamily();
    info.Queue = host.queue();
    info.DescriptorPool = descriptors;
    // sets of vertex buffers, used in turn: one per frame in flight
    info.MinImageCount = kFramesInFlight;
    info.ImageCount = kFramesInFlight;
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    return info;
}

} // namespace

Result<std::unique_ptr<ImguiLayer>> ImguiLayer::create(const SdlWindow& window, VulkanHost& host,
                                                       const gpu::Device& device, const Swapchain& swapchain)
{
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    std::unique_ptr<ImguiLayer> layer(new ImguiLayer(device));
    ImGui::GetIO().IniFilename = nullptr; // no settings file in the working directory
    ImGui::StyleColorsDark();
    linearizeColors(ImGui::GetStyle());
    layer->on_window_ = ImGui_ImplSDL2_InitForVulkan(window.handle());
    HEARTH_ASSIGN_OR_RETURN(layer->descriptors_, gpu::createDescriptorPool(device, 1, {.textures = 1}));
    ImGui_ImplVulkan_InitInfo info = initInfo(host, layer->descriptors_.get());
    layer->on_device_ = ImGui_ImplVulkan_Init(&info, swapchain.overlayPass());
    HEARTH_TRY(layer->uploadFonts(host));
    return layer;
}

ImguiLayer::~ImguiLayer()
{
    if (on_device_)
        ImGui_ImplVulkan_Shutdown();
    if (on_window_)
        ImGui_ImplSDL2_Shutdown();
    ImGui::DestroyContext();
}

Status ImguiLayer::uploadFonts(VulkanHost& host)
{
    HEARTH_TRY(host.run(
        [](VkCommandBuffer commands)
        {
            ImGui_ImplVulkan_CreateFontsTexture(commands);
            return success();
        }));
    ImGui_ImplVulkan_DestroyFontUploadObjects();
    return success();
}

void ImguiLayer::handle(const SDL_Event& event)
{
    ImGui_ImplSDL2_ProcessEvent(&event);
}

FlyControls::CapturedInput ImguiLayer::capturedInput() const
{
    const ImGuiIO& io = ImGui::GetIO();
    return {io.WantCaptureKeyboard, io.WantCaptureMouse};
}

void ImguiLayer::beginFrame()
{
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplSDL2_NewFrame();
    ImGui::NewFrame();
}

void ImguiLayer::endFrame()
{
    ImGui::Render();
}

void ImguiLayer::record(VkCommandBuffer commands, const Swapchain& swapchain, uint32_t image) const
{
    VkRenderPassBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = swapchain.overlayPass();
    begin.framebuffer = swapchain.overlay(image);
    begin.renderArea = {{0, 0}, swapchain.extent()};
    device_.vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
    device_.vk.vkCmdEndRenderPass(commands);
}

} // namespace hearth::viewer
