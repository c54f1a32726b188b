/* SPDX-License-Identifier: LicenseRef-Hearth-Undecided */
#define VK_NO_PROTOTYPES
#include "hearth_helpers.h"

#include <ctype.h>
#include <dlfcn.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define INSTANCE_FUNCTIONS(X)                                                                                \
    X(vkCreateDevice)                                                                                        \
    X(vkDestroyInstance)                                                                                     \
    X(vkEnumerateDeviceExtensionProperties)                                                                  \
    X(vkEnumeratePhysicalDevices)                                                                            \
    X(vkGetDeviceProcAddr)                                                                                   \
    X(vkGetPhysicalDeviceFeatures)                                                                           \
    X(vkGetPhysicalDeviceMemoryProperties)                                                                   \
    X(vkGetPhysicalDeviceProperties)                                                                         \
    X(vkGetPhysicalDeviceQueueFamilyProperties)

#define DEVICE_FUNCTIONS(X)                                                                                  \
    X(vkAllocateCommandBuffers)                                                                              \
    X(vkAllocateMemory)                                                                                      \
    X(vkBeginCommandBuffer)                                                                                  \
    X(vkBindBufferMemory)                                                                                    \
    X(vkCmdCopyImageToBuffer)                                                                                \
    X(vkCmdPipelineBarrier)                                                                                  \
    X(vkCreateBuffer)                                                                                        \
    X(vkCreateCommandPool)                                                                                   \
    X(vkDestroyBuffer)                                                                                       \
    X(vkDestroyCommandPool)                                                                                  \
    X(vkDestroyDevice)                                                                                       \
    X(vkEndCommandBuffer)                                                                                    \
    X(vkFreeMemory)                                                                                          \
    X(vkGetBufferMemoryRequirements)                                                                         \
    X(vkGetDeviceQueue)                                                                                      \
    X(vkMapMemory)                                                                                           \
    X(vkQueueSubmit)                                                                                         \
    X(vkQueueWaitIdle)                                                                                       \
    X(vkResetCommandBuffer)

enum
{
    MAX_DEVICES = 16,
    MAX_FAMILIES = 32
};

struct hearth_device
{
    void* library;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
#define MEMBER(name) PFN_##name name;
    INSTANCE_FUNCTIONS(MEMBER)
    DEVICE_FUNCTIONS(MEMBER)
#undef MEMBER
    VkInstance instance;
    VkPhysicalDevice physical_device; /* its queried properties follow */
    VkPhysicalDeviceProperties properties;
    uint32_t queue_family;
    int has_anisotropy; /* and enabled */
    int has_astc_hdr;   /* and enabled */
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    VkCommandBuffer commands;
    int is_recording;
    char last_error[512];
};

/* ---- Errors: the message goes to last_error ---- */

static hearth_result fail(hearth_device* device, hearth_result result, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(device->last_error, sizeof(device->last_error), format, arguments);
    va_end(arguments);
    return result;
}

static hearth_result misused(hearth_device* device, const char* function, const char* detail)
{
    return fail(device, HEARTH_ERROR_USAGE, "%s: error: %s [E1000] hint: see hearth_helpers.h", function,
                detail);
}

static hearth_result lacking(hearth_device* device, const char* detail)
{
    return fail(device, HEARTH_ERROR_DEVICE,
                "error: %s [E4002] hint: install a Vulkan driver (mesa-vulkan-drivers)", detail);
}

static hearth_result failed(hearth_device* device, VkResult result, const char* task)
{
    switch (result)
    {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return fail(device, HEARTH_ERROR_OUT_OF_MEMORY,
                    "error: cannot %s: no memory [E4005] hint: close programs", task);
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return fail(device, HEARTH_ERROR_OUT_OF_DEVICE_MEMORY,
                    "error: cannot %s: no device memory [E4009] hint: close other programs", task);
    case VK_ERROR_DEVICE_LOST:
        return fail(device, HEARTH_ERROR_DEVICE_LOST,
                    "error: cannot %s: the device was lost [E4010] hint: make all again on a new device",
                    task);
    default:
        return fail(
            device, HEARTH_ERROR_DEVICE_FAILED,
            "error: cannot %s (VkResult %d) [E4003] hint: close other programs, or choose another device",
            task, (int)result);
    }
}

/* ---- Creation ---- */

static hearth_result open_loader(hearth_device* device)
{
    void* symbol;
    device->library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (device->library == NULL)
        device->library = dlopen("libvulkan.so", RTLD_NOW | RTLD_LOCAL); /* Android */
    if (device->library == NULL)
        return lacking(device, "there is no Vulkan loader (libvulkan.so.1)");
    symbol = dlsym(device->library, "vkGetInstanceProcAddr");
    if (symbol == NULL)
        return lacking(device, "libvulkan.so.1 is not a Vulkan loader");
    /* ISO C converts no object pointer to a function pointer */
    memcpy(&device->get_instance_proc_addr, &symbol, sizeof(symbol));
    return HEARTH_OK;
}

static hearth_result create_instance(hearth_device* device)
{
    VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO};
    VkInstanceCreateInfo info = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    const PFN_vkCreateInstance create =
        (PFN_vkCreateInstance)device->get_instance_proc_addr(VK_NULL_HANDLE, "vkCreateInstance");
    application.apiVersion = VK_API_VERSION_1_1;
    info.pApplicationInfo = &application;
    if (create(&info, NULL, &device->instance) != VK_SUCCESS)
        return lacking(device, "no Vulkan driver could be started");
#define LOAD(name) device->name = (PFN_##name)device->get_instance_proc_addr(device->instance, #name);
    INSTANCE_FUNCTIONS(LOAD)
#undef LOAD
    return HEARTH_OK;
}

/* True if `text` contains `part`, in any case. */
static int contains(const char* text, const char* part)
{
    for (;; ++text)
    {
        size_t i = 0;
        while (part[i] != '\0' && tolower((unsigned char)text[i]) == tolower((unsigned char)part[i]))
            ++i;
        if (part[i] == '\0')
            return 1;
        if (*text == '\0')
            return 0;
    }
}

/* Rank of a device type by likely speed; 0 is the slowest. */
static int rank(VkPhysicalDeviceType type)
{
    switch (type)
    {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 1;
    default:
        return 0;
    }
}

/* Find a queue family for graphics and compute; returns 0 if there is none. */
static int find_family(const hearth_device* device, VkPhysicalDevice physical_device, uint32_t* family)
{
    const VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    VkQueueFamilyProperties families[MAX_FAMILIES];
    uint32_t count = MAX_FAMILIES;
    device->vkGetPhysicalDeviceQueueFamilyProperties(physical_device, &count, families);
    for (*family = 0; *family < count; ++*family)
        if ((families[*family].queueFlags & needed) == needed)
            return 1;
    return 0;
}

static hearth_result choose_physical_device(hearth_device* device, const char* name)
{
    VkPhysicalDevice found[MAX_DEVICES];
    VkPhysicalDeviceProperties properties;
    char detail[256];
    uint32_t count = MAX_DEVICES, family, i;
    if (device->vkEnumeratePhysicalDevices(device->instance, &count, found) < 0)
        count = 0;
    for (i = 0; i < count; ++i)
    {
        device->vkGetPhysicalDeviceProperties(found[i], &properties);
        if (properties.apiVersion < VK_API_VERSION_1_1 || !contains(properties.deviceName, name) ||
            !find_family(device, found[i], &family) ||
            (device->physical_device != VK_NULL_HANDLE &&
             rank(properties.deviceType) <= rank(device->properties.deviceType)))
            continue;
        device->physical_device = found[i];
        device->properties = properties;
        device->queue_family = family;
    }
    if (device->physical_device != VK_NULL_HANDLE)
        return HEARTH_OK;
    snprintf(detail, sizeof(detail), "none of the %u devices has Vulkan 1.1 and \"%s\" in its name",
             (unsigned)count, name);
    return lacking(device, name[0] == '\0' ? "no device has Vulkan 1.1" : detail);
}

/* True if the physical device has an extension. */
static int has_extension(const hearth_device* device, const char* name)
{
    VkExtensionProperties* extensions;
    uint32_t count = 0, i;
    int found = 0;
    device->vkEnumerateDeviceExtensionProperties(device->physical_device, NULL, &count, NULL);
    extensions = calloc(count + 1, sizeof(*extensions));
    if (extensions == NULL)
        return 0;
    device->vkEnumerateDeviceExtensionProperties(device->physical_device, NULL, &count, extensions);
    for (i = 0; i < count && !found; ++i)
        found = strcmp(extensions[i].extensionName, name) == 0;
    free(extensions);
    return found;
}

static hearth_result create_device(hearth_device* device)
{
    const float priority = 1;
    const char* const astc_hdr = VK_EXT_TEXTURE_COMPRESSION_ASTC_HDR_EXTENSION_NAME;
    VkPhysicalDeviceTextureCompressionASTCHDRFeaturesEXT astc_hdr_feature = {
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TEXTURE_COMPRESSION_ASTC_HDR_FEATURES_EXT, NULL, VK_TRUE};
    VkPhysicalDeviceFeatures supported, enabled = {0};
    VkDeviceQueueCreateInfo queue = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    VkDeviceCreateInfo info = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    VkResult result;
    device->vkGetPhysicalDeviceFeatures(device->physical_device, &supported);
    /* lavapipe's anisotropic filter is slow, and wrong where a 2x2 block sees two triangles */
    device->has_anisotropy =
        supported.samplerAnisotropy && device->properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU;
    enabled.samplerAnisotropy = device->has_anisotropy ? VK_TRUE : VK_FALSE;
    queue.queueFamilyIndex = device->queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &enabled;
    /* devices with the extension have its feature (Vulkan, "Feature Requirements") */
    device->has_astc_hdr = has_extension(device, astc_hdr);
    if (device->has_astc_hdr)
    {
        info.pNext = &astc_hdr_feature;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &astc_hdr;
    }
    result = device->vkCreateDevice(device->physical_device, &info, NULL, &device->device);
    if (result != VK_SUCCESS)
        return failed(device, result, "create a device");
#define LOAD(name) device->name = (PFN_##name)device->vkGetDeviceProcAddr(device->device, #name);
    DEVICE_FUNCTIONS(LOAD)
#undef LOAD
    device->vkGetDeviceQueue(device->device, device->queue_family, 0, &device->queue);
    return HEARTH_OK;
}

static hearth_result create_commands(hearth_device* device)
{
    VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkCommandBufferAllocateInfo allocate = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    VkResult result;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = device->queue_family;
    result = device->vkCreateCommandPool(device->device, &pool, NULL, &device->pool);
    if (result != VK_SUCCESS)
        return failed(device, result, "create a command pool");
    allocate.commandPool = device->pool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    result = device->vkAllocateCommandBuffers(device->device, &allocate, &device->commands);
    return result == VK_SUCCESS ? HEARTH_OK : failed(device, result, "allocate a command buffer");
}

static hearth_result check_options(hearth_device* device, const hearth_device_options* options)
{
    if (options == NULL)
        return misused(device, "hearth_device_create", "options is NULL");
    if (options->struct_size != sizeof(*options) || options->reserved != 0)
        return misused(device, "hearth_device_create",
                       "options does not begin with HEARTH_DEVICE_OPTIONS_INIT of this version");
    return HEARTH_OK;
}

hearth_result hearth_device_create(const hearth_device_options* options, hearth_device** device,
                                   char* message, size_t message_size)
{
    hearth_device* made;
    hearth_result result;
    if (device == NULL)
        return HEARTH_ERROR_USAGE;
    made = calloc(1, sizeof(*made));
    if (made == NULL)
        return HEARTH_ERROR_OUT_OF_MEMORY;
    result = check_options(made, options);
    if (result == HEARTH_OK)
        result = open_loader(made);
    if (result == HEARTH_OK)
        result = create_instance(made);
    if (result == HEARTH_OK)
        result = choose_physical_device(made, options->name == NULL ? "" : options->name);
    if (result == HEARTH_OK)
        result = create_device(made);
    if (result == HEARTH_OK)
        result = create_commands(made);
    if (result == HEARTH_OK)
    {
        *device = made;
        return HEARTH_OK;
    }
    if (message != NULL && message_size > 0)
        snprintf(message, message_size, "%s", made->last_error);
    hearth_device_destroy(made);
    return result;
}

hearth_result hearth_device_destroy(hearth_device* device)
{
    if (device == NULL)
        return HEARTH_OK;
    if (device->pool != VK_NULL_HANDLE)
        device->vkDestroyCommandPool(device->device, device->pool, NULL);
    if (device->device != VK_NULL_HANDLE)
        device->vkDestroyDevice(device->device, NULL);
    if (device->instance != VK_NULL_HANDLE)
        device->vkDestroyInstance(device->instance, NULL);
    if (device->library != NULL)
        dlclose(device->library);
    free(device);
    return HEARTH_OK;
}

const char* hearth_device_last_error(const hearth_device* device)
{
    return device == NULL ? "" : device->last_error;
}

hearth_result hearth_device_get_info(hearth_device* device, hearth_device_info* info)
{
    if (device == NULL)
        return HEARTH_ERROR_USAGE;
    if (info == NULL || info->struct_size != sizeof(*info))
        return misused(device, "hearth_device_get_info",
                       "info does not begin with HEARTH_DEVICE_INFO_INIT of this version");
    info->queue_family = device->queue_family;
    info->queue = device->queue;
    info->physical_device = device->physical_device;
    info->name = device->properties.deviceName;
    info->is_software = device->properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU ? 1 : 0;
    info->reserved = 0;
    return HEARTH_OK;
}

hearth_result hearth_device_describe(hearth_device* device, hearth_renderer_description* description)
{
    if (device == NULL)
        return HEARTH_ERROR_USAGE;
    if (description == NULL || description->struct_size != sizeof(*description))
        return misused(device, "hearth_device_describe",
                       "description does not begin with HEARTH_RENDERER_DESCRIPTION_INIT of this version");
    description->get_instance_proc_addr = device->get_instance_proc_addr;
    description->instance = device->instance;
    description->physical_device = device->physical_device;
    description->device = device->device;
    if (device->has_anisotropy)
        description->features |= HEARTH_FEATURE_SAMPLER_ANISOTROPY;
    if (device->has_astc_hdr)
        description->features |= HEARTH_FEATURE_ASTC_HDR;
    return HEARTH_OK;
}

/* ---- Commands that run at once ---- */

hearth_result hearth_device_begin(hearth_device* device, VkCommandBuffer* commands)
{
    VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VkResult result;
    if (device == NULL)
        return HEARTH_ERROR_USAGE;
    if (commands == NULL)
        return misused(device, "hearth_device_begin", "commands is NULL");
    if (device->is_recording)
        return misused(device, "hearth_device_begin", "what was begun before has not been submitted");
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    result = device->vkBeginCommandBuffer(device->commands, &begin);
    if (result != VK_SUCCESS)
        return failed(device, result, "begin a command buffer");
    device->is_recording = 1;
    *commands = device->commands;
    return HEARTH_OK;
}

hearth_result hearth_device_submit(hearth_device* device)
{
    VkSubmitInfo submit = {VK_STRUCTURE_TYPE_SUBMIT_INFO};
    VkResult result;
    if (device == NULL)
        return HEARTH_ERROR_USAGE;
    if (!device->is_recording)
        return misused(device, "hearth_device_submit", "hearth_device_begin has not been called");
    device->is_recording = 0;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &device->commands;
    result = device->vkEndCommandBuffer(device->commands);
    if (result == VK_SUCCESS)
        result = device->vkQueueSubmit(device->queue, 1, &submit, VK_NULL_HANDLE);
    if (result == VK_SUCCESS)
        result = device->vkQueueWaitIdle(device->queue);
    return result == VK_SUCCESS ? HEARTH_OK : failed(device, result, "run a command buffer");
}

hearth_result hearth_device_discard(hearth_device* device)
{
    VkResult result;
    if (device == NULL)
        return HEARTH_ERROR_USAGE;
    if (!device->is_recording)
        return misused(device, "hearth_device_discard", "hearth_device_begin has not been called");
    device->is_recording = 0;
    result = device->vkResetCommandBuffer(device->commands, 0);
    return result == VK_SUCCESS ? HEARTH_OK : failed(device, result, "reset a command buffer");
}

/* ---- Images and cameras ---- */

/* Readback memory: the device copies to it, the CPU reads it. */
typedef struct readback
{
    VkBuffer buffer;
    VkDeviceMemory memory;
    const void* mapped;
} readback;

/* Find a memory type with these properties; returns 0 if there is none. */
static int find_memory_type(const hearth_device* device, uint32_t allowed, VkMemoryPropertyFlags wanted,
                            uint32_t* type)
{
    VkPhysicalDeviceMemoryProperties memory;
    device->vkGetPhysicalDeviceMemoryProperties(device->physical_device, &memory);
    for (*type = 0; *type < memory.memoryTypeCount; ++*type)
        if ((allowed >> *type & 1) != 0 && (memory.memoryTypes[*type].propertyFlags & wanted) == wanted)
            return 1;
    return 0;
}

static hearth_result create_readback(hearth_device* device, VkDeviceSize size, readback* made)
{
    const VkMemoryPropertyFlags mapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkBufferCreateInfo info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    VkMemoryAllocateInfo allocate = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    VkMemoryRequirements needs;
    void* bytes = NULL;
    VkResult result;
    info.size = size;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    result = device->vkCreateBuffer(device->device, &info, NULL, &made->buffer);
    if (result != VK_SUCCESS)
        return failed(device, result, "create a buffer");
    device->vkGetBufferMemoryRequirements(device->device, made->buffer, &needs);
    if (!find_memory_type(device, needs.memoryTypeBits, mapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
                          &allocate.memoryTypeIndex) &&
        !find_memory_type(device, needs.memoryTypeBits, mapped, &allocate.memoryTypeIndex))
        return lacking(device, "the device has no memory that the CPU can read");
    allocate.allocationSize = needs.size;
    result = device->vkAllocateMemory(device->device, &allocate, NULL, &made->memory);
    if (result == VK_SUCCESS)
        result = device->vkBindBufferMemory(device->device, made->buffer, made->memory, 0);
    if (result == VK_SUCCESS)
        result = device->vkMapMemory(device->device, made->memory, 0, VK_WHOLE_SIZE, 0, &bytes);
    made->mapped = bytes;
    return result == VK_SUCCESS ? HEARTH_OK : failed(device, result, "allocate memory");
}

static void destroy_readback(hearth_device* device, readback* made)
{
    device->vkDestroyBuffer(device->device, made->buffer, NULL);
    device->vkFreeMemory(device->device, made->memory, NULL);
}

static void record_copy(const hearth_device* device, const hearth_image* image, uint32_t width,
                        uint32_t height, VkBuffer buffer)
{
    VkImageMemoryBarrier before = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    VkMemoryBarrier after = {VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    VkBufferImageCopy region = {0};
    before.srcAccessMask = image->after.access;
    before.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    before.oldLayout = image->after.layout;
    before.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    before.srcQueueFamilyIndex = before.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    before.image = image->image;
    before.subresourceRange.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
    before.subresourceRange.levelCount = before.subresourceRange.layerCount = 1;
    device->vkCmdPipelineBarrier(device->commands, image->after.stages, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                                 NULL, 0, NULL, 1, &before);
    region.imageSubresource.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
    region.imageSubresource.layerCount = 1;
    region.imageExtent.width = width;
    region.imageExtent.height = height;
    region.imageExtent.depth = 1;
    device->vkCmdCopyImageToBuffer(device->commands, image->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                   buffer, 1, &region);
    after.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    after.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    device->vkCmdPipelineBarrier(device->commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                                 0, 1, &after, 0, NULL, 0, NULL);
}

hearth_result hearth_device_read_image(hearth_device* device, const hearth_image* image, uint32_t width,
                                       uint32_t height, void* texels, size_t size)
{
    readback memory = {VK_NULL_HANDLE, VK_NULL_HANDLE, NULL};
    const uint64_t bytes = (uint64_t)width * height * 4;
    VkCommandBuffer commands;
    hearth_result result;
    if (device == NULL)
        return HEARTH_ERROR_USAGE;
    if (image == NULL || image->image == VK_NULL_HANDLE || texels == NULL)
        return misused(device, "hearth_device_read_image", "image or texels is NULL");
    if (bytes == 0 || bytes > size)
        return misused(device, "hearth_device_read_image", "size is not that of width * height texels");
    result = hearth_device_begin(device, &commands);
    if (result != HEARTH_OK)
        return result;
    result = create_readback(device, bytes, &memory);
    if (result == HEARTH_OK)
    {
        record_copy(device, image, width, height, memory.buffer);
        result = hearth_device_submit(device);
    }
    else
        hearth_device_discard(device);
    if (result == HEARTH_OK)
        memcpy(texels, memory.mapped, (size_t)bytes);
    destroy_readback(device, &memory);
    return result;
}

hearth_camera hearth_fit_camera(const float box_min[3], const float box_max[3], float aspect)
{
    const float margin = 1.05f, near_part = 1e-3f; /* of the radius; of the distance */
    const float from[3] = {0.52f, 0.40f, 0.75f};   /* about 1 long */
    const int is_empty = box_min[0] > box_max[0] || box_min[1] > box_max[1] || box_min[2] > box_max[2];
    hearth_camera camera = {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, 0.6f, 0};
    const float tan_y = tanf(0.5f * camera.y_fov_rad);
    const float half_angle = atanf(aspect < 1 ? tan_y * aspect : tan_y);
    float square = 0, distance;
    int axis;
    for (axis = 0; axis < 3; ++axis)
    {
        const float half = is_empty ? 1 : 0.5f * (box_max[axis] - box_min[axis]);
        camera.target[axis] = is_empty ? 0 : box_min[axis] + half;
        square += half * half;
    }
    /* the bounding sphere of the box touches the sides of the frame; the minimum covers a box without
     * extent */
    distance = margin * sqrtf(square) / sinf(half_angle);
    distance = distance > 1e-6f ? distance : 1e-6f;
    for (axis = 0; axis < 3; ++axis)
        camera.position[axis] = camera.target[axis] + from[axis] * distance;
    camera.z_near = near_part * distance;
    return camera;
}
