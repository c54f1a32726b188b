// game PACK OUT.ppm: renders one frame of a pack with its own Vulkan device, as a game would, and writes it
// as PPM.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include <cstdio>
#include <cstdlib>
#include <hearth.hpp>
#include <materials_material_shaders.h>
#include <string>
#include <vulkan/vulkan.h>

namespace
{

constexpr uint32_t kSize = 128; // pixels each way
constexpr VkDeviceSize kBytes = VkDeviceSize{kSize} * kSize * 4;
constexpr int kNoDevice = 77; // exit code of a skipped test, as in Automake

[[noreturn]] void end(const std::string& why, int exit_code = 1)
{
    std::fprintf(stderr, "game: %s\n", why.c_str());
    std::exit(exit_code);
}

void check(VkResult result)
{
    if (result != VK_SUCCESS)
        end("Vulkan says " + std::to_string(result));
}

void check(hearth_result result, const std::string& why)
{
    if (result != HEARTH_OK)
        end(why);
}

/// Device with one queue and one command buffer. The system frees them when the process ends.
struct Device
{
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;

    Device()
    {
        VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
        application.apiVersion = VK_API_VERSION_1_1;
        VkInstanceCreateInfo instance_info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
        instance_info.pApplicationInfo = &application;
        uint32_t count = 1;
        if (vkCreateInstance(&instance_info, nullptr, &instance) != VK_SUCCESS ||
            vkEnumeratePhysicalDevices(instance, &count, &physical) < 0 || count == 0)
            end("there is no Vulkan device", kNoDevice);

        // its first queue family supports graphics and compute on all tested devices
        const float priority = 1;
        VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
        queue_info.queueCount = 1;
        queue_info.pQueuePriorities = &priority;
        VkDeviceCreateInfo device_info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
        device_info.queueCreateInfoCount = 1;
        device_info.pQueueCreateInfos = &queue_info;
        check(vkCreateDevice(physical, &device_info, nullptr, &device));
        vkGetDeviceQueue(device, 0, 0, &queue);

        VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        VkCommandPool pool = VK_NULL_HANDLE;
        check(vkCreateCommandPool(device, &pool_info, nullptr, &pool));
        VkCommandBufferAllocateInfo commands_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        commands_info.commandPool = pool;
        commands_info.commandBufferCount = 1;
        check(vkAllocateCommandBuffers(device, &commands_info, &commands));
    }

    void begin() const
    {
        VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        check(vkBeginCommandBuffer(commands, &info));
    }

    void submitAndWait() const
    {
        VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands;
        check(vkEndCommandBuffer(commands));
        check(vkQueueSubmit(queue, 1, &info, VK_NULL_HANDLE));
        check(vkQueueWaitIdle(queue));
    }
};

/// Buffer of kBytes that the device writes and the CPU reads.
struct Readback
{
    VkBuffer buffer = VK_NULL_HANDLE;
    const unsigned char* bytes = nullptr;

    explicit Readback(const Device& device)
    {
        VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
        info.size = kBytes;
        info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
        check(vkCreateBuffer(device.device, &info, nullptr, &buffer));
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(device.device, buffer, &needs);
        VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
        allocate.allocationSize = needs.size;
        allocate.memoryTypeIndex = mappedType(device, needs.memoryTypeBits);
        VkDeviceMemory memory = VK_NULL_HANDLE;
        check(vkAllocateMemory(device.device, &allocate, nullptr, &memory));
        check(vkBindBufferMemory(device.device, buffer, memory, 0));
        void* mapped = nullptr;
        check(vkMapMemory(device.device, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
        bytes = static_cast<const unsigned char*>(mapped);
    }

    static uint32_t mappedType(const Device& device, uint32_t allowed)
    {
        constexpr VkMemoryPropertyFlags kMapped =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        VkPhysicalDeviceMemoryProperties memory;
        vkGetPhysicalDeviceMemoryProperties(device.physical, &memory);
        for (uint32_t type = 0; type < memory.memoryTypeCount; ++type)
            if ((allowed >> type & 1) != 0 && (memory.memoryTypes[type].propertyFlags & kMapped) == kMapped)
                return type;
        end("the device has no memory that can be read");
    }
};

void recordCopy(VkCommandBuffer commands, const hearth_image& image, VkBuffer buffer)
{
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.srcAccessMask = image.after.access;
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    barrier.oldLayout = image.after.layout;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(commands, image.after.stages, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                         nullptr, 1, &barrier);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {kSize, kSize, 1};
    vkCmdCopyImageToBuffer(commands, image.image, barrier.newLayout, buffer, 1, &region);
    VkMemoryBarrier shown{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    shown.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    shown.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &shown,
                         0, nullptr, 0, nullptr);
}

/// Render one frame of the pack, from three metres in front of it.
void draw(const std::string& path, const Device& device, const Readback& readback)
{
    std::string why;
    hearth::Pack pack;
    check(hearth::Pack::open(path, pack, &why), why);

    hearth_renderer_description description = HEARTH_RENDERER_DESCRIPTION_INIT;
    description.get_instance_proc_addr = vkGetInstanceProcAddr;
    description.instance = device.instance;
    description.physical_device = device.physical;
    description.device = device.device;
    description.material_shaders = &materials_material_shaders;
    hearth::Renderer renderer;
    check(hearth::Renderer::create(description, renderer, &why), why);
    const auto checkCall = [&](hearth_result result) { check(result, renderer.lastError()); };

    hearth_scene_options options = HEARTH_SCENE_OPTIONS_INIT;
    options.flags = HEARTH_SCENE_DECODE_TEXTURES; // the pack is for phones
    hearth::Scene scene;
    device.begin();
    checkCall(hearth::Scene::upload(renderer, pack, device.commands, options, scene));
    device.submitAndWait();
    checkCall(scene.releaseStaging());

    hearth::Targets targets;
    hearth_targets_description size = HEARTH_TARGETS_DESCRIPTION_INIT;
    size.width = size.height = kSize;
    size.scene = scene.get();
    checkCall(hearth::Targets::create(renderer, size, targets));
    hearth_targets_info images = HEARTH_TARGETS_INFO_INIT;
    checkCall(targets.getInfo(images));

    hearth_frame frame = HEARTH_FRAME_INIT;
    frame.camera.position[2] = 3;
    device.begin();
    checkCall(scene.record(targets, device.commands, frame));
    recordCopy(device.commands, images.color, readback.buffer);
    device.submitAndWait();
}

void writeImage(const unsigned char* rgba, const char* path)
{
    std::string ppm = "P6 " + std::to_string(kSize) + " " + std::to_string(kSize) + " 255\n";
    for (size_t pixel = 0; pixel < size_t{kSize} * kSize; ++pixel)
        ppm.append(reinterpret_cast<const char*>(rgba) + pixel * 4, 3);
    std::FILE* file = std::fopen(path, "wb");
    if (file == nullptr || std::fwrite(ppm.data(), 1, ppm.size(), file) != ppm.size() ||
        std::fclose(file) != 0)
        end(std::string("cannot write ") + path);
}

} // namespace

int main(int argument_count, char** arguments)
{
    if (argument_count != 3)
        end("needs PACK OUT.ppm", 2);
    const Device device;
    const Readback readback(device);
    draw(arguments[1], device, readback);
    writeImage(readback.bytes, arguments[2]);
    return 0;
}
