/* SPDX-License-Identifier: LicenseRef-Hearth-Undecided */
#define VK_NO_PROTOTYPES
#include "tests/runtime/c/c_caller.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define INSTANCE_FUNCTIONS(X)                                                                                \
    X(vkCreateDebugUtilsMessengerEXT)                                                                        \
    X(vkCreateDevice)                                                                                        \
    X(vkDestroyDebugUtilsMessengerEXT)                                                                       \
    X(vkDestroyInstance)                                                                                     \
    X(vkEnumeratePhysicalDevices)                                                                            \
    X(vkGetDeviceProcAddr)                                                                                   \
    X(vkGetPhysicalDeviceMemoryProperties)                                                                   \
    X(vkGetPhysicalDeviceProperties)

#define DEVICE_FUNCTIONS(X)                                                                                  \
    X(vkAllocateCommandBuffers)                                                                              \
    X(vkAllocateMemory)                                                                                      \
    X(vkBeginCommandBuffer)                                                                                  \
    X(vkBindBufferMemory)                                                                                    \
    X(vkCmdCopyImageToBuffer)                                                                                \
    X(vkCmdPipelineBarrier)                                                                                  \
    X(vkCreateBuffer)                                                                                        \
    X(vkCreateCommandPool)                                                                                   \
    X(vkCreateQueryPool)                                                                                     \
    X(vkDestroyBuffer)                                                                                       \
    X(vkDestroyCommandPool)                                                                                  \
    X(vkDestroyDevice)                                                                                       \
    X(vkDestroyQueryPool)                                                                                    \
    X(vkEndCommandBuffer)                                                                                    \
    X(vkResetCommandBuffer)                                                                                  \
    X(vkFreeMemory)                                                                                          \
    X(vkGetBufferMemoryRequirements)                                                                         \
    X(vkGetDeviceQueue)                                                                                      \
    X(vkGetQueryPoolResults)                                                                                 \
    X(vkMapMemory)                                                                                           \
    X(vkQueueSubmit)                                                                                         \
    X(vkQueueWaitIdle)

struct c_caller
{
    void* library;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
#define MEMBER(name) PFN_##name name;
    INSTANCE_FUNCTIONS(MEMBER)
    DEVICE_FUNCTIONS(MEMBER)
#undef MEMBER
    VkInstance instance;
    VkDebugUtilsMessengerEXT messenger;
    VkPhysicalDevice physical_device;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    VkCommandBuffer commands;
    unsigned message_count;
    char message[1024]; /* the first */
    unsigned live_pieces, all_pieces;
};

/* Memory that the device copies to and the test reads. */
typedef struct readback
{
    VkBuffer buffer;
    VkDeviceMemory memory;
    const unsigned char* mapped;
} readback;

static VKAPI_ATTR VkBool32 VKAPI_CALL listen(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                             VkDebugUtilsMessageTypeFlagsEXT type,
                                             const VkDebugUtilsMessengerCallbackDataEXT* data, void* user)
{
    c_caller* caller = user;
    (void)severity;
    (void)type;
    if (caller->message_count++ == 0)
        snprintf(caller->message, sizeof(caller->message), "%s", data->pMessage);
    return VK_FALSE;
}

static int open_loader(c_caller* caller)
{
    void* symbol;
    caller->library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    symbol = caller->library == NULL ? NULL : dlsym(caller->library, "vkGetInstanceProcAddr");
    /* ISO C converts no object pointer to a function pointer */
    memcpy(&caller->get_instance_proc_addr, &symbol, sizeof(symbol));
    return symbol != NULL;
}

static VkResult create_instance(c_caller* caller)
{
    const char* layer = "VK_LAYER_KHRONOS_validation";
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkDebugUtilsMessengerCreateInfoEXT messenger = {VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    VkValidationFeaturesEXT features = {VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO};
    VkInstanceCreateInfo info = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    const PFN_vkCreateInstance create =
        (PFN_vkCreateInstance)caller->get_instance_proc_addr(VK_NULL_HANDLE, "vkCreateInstance");
    VkResult result;
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType =
        VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = listen;
    messenger.pUserData = caller;
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
    application.apiVersion = VK_API_VERSION_1_1;
    info.pNext = &features;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
    result = create(&info, NULL, &caller->instance);
    if (result != VK_SUCCESS)
        return result;
#define LOAD(name) caller->name = (PFN_##name)caller->get_instance_proc_addr(caller->instance, #name);
    INSTANCE_FUNCTIONS(LOAD)
#undef LOAD
    return caller->vkCreateDebugUtilsMessengerEXT(caller->instance, &messenger, NULL, &caller->messenger);
}

static VkResult choose_device(c_caller* caller, const char* name)
{
    VkPhysicalDevice devices[8];
    VkPhysicalDeviceProperties properties;
    uint32_t count = 8, i;
    const VkResult result = caller->vkEnumeratePhysicalDevices(caller->instance, &count, devices);
    for (i = 0; result >= 0 && i < count; ++i)
    {
        caller->vkGetPhysicalDeviceProperties(devices[i], &properties);
        if (strcmp(properties.deviceName, name) == 0)
            caller->physical_device = devices[i];
    }
    return caller->physical_device == VK_NULL_HANDLE ? VK_ERROR_INITIALIZATION_FAILED : VK_SUCCESS;
}

/* Uses the first queue family, which supports graphics and compute on all devices that the tests run on. */
static VkResult create_device(c_caller* caller)
{
    const float priority = 1;
    VkDeviceQueueCreateInfo queue = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    VkDeviceCreateInfo info = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkCommandBufferAllocateInfo allocate = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    VkResult result;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    result = caller->vkCreateDevice(caller->physical_device, &info, NULL, &caller->device);
    if (result != VK_SUCCESS)
        return result;
#define LOAD(name) caller->name = (PFN_##name)caller->vkGetDeviceProcAddr(caller->device, #name);
    DEVICE_FUNCTIONS(LOAD)
#undef LOAD
    caller->vkGetDeviceQueue(caller->device, 0, 0, &caller->queue);
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    result = caller->vkCreateCommandPool(caller->device, &pool, NULL, &caller->pool);
    if (result != VK_SUCCESS)
        return result;
    allocate.commandPool = caller->pool;
    allocate.commandBufferCount = 1;
    return caller->vkAllocateCommandBuffers(caller->device, &allocate, &caller->commands);
}

c_caller* c_caller_create(const char* device_name)
{
    c_caller* caller = calloc(1, sizeof(*caller));
    if (caller != NULL && open_loader(caller) && create_instance(caller) == VK_SUCCESS &&
        choose_device(caller, device_name) == VK_SUCCESS && create_device(caller) == VK_SUCCESS)
        return caller;
    c_caller_destroy(caller);
    return NULL;
}

void c_caller_destroy(c_caller* caller)
{
    if (caller == NULL)
        return;
    if (caller->pool != VK_NULL_HANDLE)
        caller->vkDestroyCommandPool(caller->device, caller->pool, NULL);
    if (caller->device != VK_NULL_HANDLE)
        caller->vkDestroyDevice(caller->device, NULL);
    if (caller->messenger != VK_NULL_HANDLE)
        caller->vkDestroyDebugUtilsMessengerEXT(caller->instance, caller->messenger, NULL);
    if (caller->instance != VK_NULL_HANDLE)
        caller->vkDestroyInstance(caller->instance, NULL);
    if (caller->library != NULL)
        dlclose(caller->library);
    free(caller);
}

hearth_renderer_description c_caller_description(const c_caller* caller)
{
    hearth_renderer_description description = HEARTH_RENDERER_DESCRIPTION_INIT;
    description.get_instance_proc_addr = caller->get_instance_proc_addr;
    description.instance = caller->instance;
    description.physical_device = caller->physical_device;
    description.device = caller->device;
    return description;
}

unsigned c_caller_message_count(const c_caller* caller)
{
    return caller->message_count;
}

const char* c_caller_message(const c_caller* caller)
{
    return caller->message;
}

VkCommandBuffer c_caller_begin(c_caller* caller)
{
    VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    return caller->vkBeginCommandBuffer(caller->commands, &begin) == VK_SUCCESS ? caller->commands
                                                                                : VK_NULL_HANDLE;
}

VkResult c_caller_submit(c_caller* caller)
{
    VkSubmitInfo submit = {VK_STRUCTURE_TYPE_SUBMIT_INFO};
    VkResult result = caller->vkEndCommandBuffer(caller->commands);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &caller->commands;
    if (result == VK_SUCCESS)
        result = caller->vkQueueSubmit(caller->queue, 1, &submit, VK_NULL_HANDLE);
    return result == VK_SUCCESS ? caller->vkQueueWaitIdle(caller->queue) : result;
}

VkResult c_caller_discard(c_caller* caller)
{
    return caller->vkResetCommandBuffer(caller->commands, 0);
}

static uint32_t memory_type(const c_caller* caller, uint32_t allowed, VkMemoryPropertyFlags wanted)
{
    VkPhysicalDeviceMemoryProperties memory;
    uint32_t type;
    caller->vkGetPhysicalDeviceMemoryProperties(caller->physical_device, &memory);
    for (type = 0; type < memory.memoryTypeCount; ++type)
        if ((allowed >> type & 1) != 0 && (memory.memoryTypes[type].propertyFlags & wanted) == wanted)
            break;
    return type;
}

static const VkMemoryPropertyFlags mappable =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

static VkResult allocate_piece(void* user, const hearth_memory_request* request,
                               hearth_memory_allocation* piece)
{
    c_caller* caller = user;
    const int mapped = request->kind != HEARTH_MEMORY_DEVICE;
    VkMemoryAllocateInfo allocate = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    VkResult result;
    allocate.allocationSize = request->needs.size;
    allocate.memoryTypeIndex = memory_type(caller, request->needs.memoryTypeBits, mapped ? mappable : 0);
    result = caller->vkAllocateMemory(caller->device, &allocate, NULL, &piece->memory);
    if (result == VK_SUCCESS && mapped)
        result = caller->vkMapMemory(caller->device, piece->memory, 0, VK_WHOLE_SIZE, 0, &piece->mapped);
    piece->allocation = caller;
    caller->live_pieces += result == VK_SUCCESS ? 1 : 0;
    caller->all_pieces += result == VK_SUCCESS ? 1 : 0;
    return result;
}

static void free_piece(void* user, const hearth_memory_allocation* piece)
{
    c_caller* caller = user;
    if (piece->allocation != user)
        abort();
    caller->vkFreeMemory(caller->device, piece->memory, NULL);
    --caller->live_pieces;
}

hearth_memory_hooks c_caller_memory(c_caller* caller)
{
    hearth_memory_hooks hooks;
    hooks.user = caller;
    hooks.allocate = allocate_piece;
    hooks.free = free_piece;
    return hooks;
}

unsigned c_caller_live_pieces(const c_caller* caller)
{
    return caller->live_pieces;
}

unsigned c_caller_all_pieces(const c_caller* caller)
{
    return caller->all_pieces;
}

static VkResult create_readback(const c_caller* caller, VkDeviceSize size, readback* made)
{
    VkBufferCreateInfo info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    VkMemoryAllocateInfo allocate = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    VkMemoryRequirements needs;
    void* mapped = NULL;
    VkResult result;
    info.size = size;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    result = caller->vkCreateBuffer(caller->device, &info, NULL, &made->buffer);
    if (result != VK_SUCCESS)
        return result;
    caller->vkGetBufferMemoryRequirements(caller->device, made->buffer, &needs);
    allocate.allocationSize = needs.size;
    allocate.memoryTypeIndex = memory_type(caller, needs.memoryTypeBits, mappable);
    result = caller->vkAllocateMemory(caller->device, &allocate, NULL, &made->memory);
    if (result == VK_SUCCESS)
        result = caller->vkBindBufferMemory(caller->device, made->buffer, made->memory, 0);
    if (result == VK_SUCCESS)
        result = caller->vkMapMemory(caller->device, made->memory, 0, VK_WHOLE_SIZE, 0, &mapped);
    made->mapped = mapped;
    return result;
}

static void destroy_readback(const c_caller* caller, readback* made)
{
    caller->vkDestroyBuffer(caller->device, made->buffer, NULL);
    caller->vkFreeMemory(caller->device, made->memory, NULL);
}

/* The fields of hearth_image suffice to copy the image, or the depth and to give it back. */
static void copy_image(const c_caller* caller, const hearth_image* source, const c_image* image,
                       VkBuffer buffer, VkDeviceSize offset)
{
    const int is_depth = source->format == VK_FORMAT_D32_SFLOAT_S8_UINT;
    VkBufferImageCopy region = {0};
    VkImageMemoryBarrier barrier = {VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    region.bufferOffset = offset;
    region.imageSubresource.aspectMask = is_depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    region.imageSubresource.layerCount = 1;
    region.imageExtent.width = image->width;
    region.imageExtent.height = image->height;
    region.imageExtent.depth = 1;
    barrier.srcAccessMask = source->after.access;
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    barrier.oldLayout = source->after.layout;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = source->image;
    barrier.subresourceRange.aspectMask =
        is_depth ? VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    barrier.subresourceRange.levelCount = barrier.subresourceRange.layerCount = 1;
    caller->vkCmdPipelineBarrier(caller->commands, source->after.stages, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                                 NULL, 0, NULL, 1, &barrier);
    caller->vkCmdCopyImageToBuffer(caller->commands, source->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                   buffer, 1, &region);
    if (!is_depth)
        return;
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    barrier.dstAccessMask = source->before.access;
    barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    barrier.newLayout = source->before.layout;
    caller->vkCmdPipelineBarrier(caller->commands, VK_PIPELINE_STAGE_TRANSFER_BIT, source->before.stages, 0,
                                 0, NULL, 0, NULL, 1, &barrier);
}

static void show_host(const c_caller* caller)
{
    VkMemoryBarrier barrier = {VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    caller->vkCmdPipelineBarrier(caller->commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                                 0, 1, &barrier, 0, NULL, 0, NULL);
}

VkResult c_caller_read_color(c_caller* caller, const hearth_image* color, uint32_t width, uint32_t height,
                             uint32_t* pixels)
{
    const VkDeviceSize bytes = (VkDeviceSize)width * height * 4;
    readback memory = {VK_NULL_HANDLE, VK_NULL_HANDLE, NULL};
    c_image image = {0};
    VkResult result = create_readback(caller, bytes, &memory);
    image.width = width;
    image.height = height;
    if (result == VK_SUCCESS)
    {
        c_caller_begin(caller);
        copy_image(caller, color, &image, memory.buffer, 0);
        show_host(caller);
        result = c_caller_submit(caller);
    }
    if (result == VK_SUCCESS)
        memcpy(pixels, memory.mapped, (size_t)bytes);
    destroy_readback(caller, &memory);
    return result;
}

static hearth_result upload(c_caller* caller, hearth_renderer* renderer, hearth_pack* pack,
                            const c_image* image, hearth_scene** scene)
{
    const VkCommandBuffer commands = c_caller_begin(caller);
    const hearth_result result = hearth_scene_upload(renderer, pack, commands, &image->scene, scene);
    if ((result == HEARTH_OK ? c_caller_submit(caller) : c_caller_discard(caller)) != VK_SUCCESS)
        return HEARTH_ERROR_DEVICE_FAILED;
    return result == HEARTH_OK ? hearth_scene_release_staging(*scene) : result;
}

/* Prefetches until a frame has all that it requested, and begins the next frame. */
static hearth_result stream(c_caller* caller, hearth_scene* scene, hearth_targets* targets, c_image* image)
{
    const hearth_stream_counters none = HEARTH_STREAM_COUNTERS_INIT;
    const uint64_t most_frames = 500;
    uint64_t serial;
    image->streaming = none;
    for (serial = 1; image->streaming.settled_serial == 0 && serial <= most_frames; ++serial)
    {
        const VkCommandBuffer commands = c_caller_begin(caller);
        hearth_result result = hearth_scene_begin_frame(scene, serial, serial - 1);
        if (result == HEARTH_OK)
            result = hearth_record_prefetch(scene, targets, commands, &image->frame);
        if (c_caller_submit(caller) != VK_SUCCESS)
            return HEARTH_ERROR_DEVICE_FAILED;
        if (result == HEARTH_OK)
            result = hearth_scene_get_stream_counters(scene, &image->streaming);
        if (result != HEARTH_OK)
            return result;
    }
    return hearth_scene_begin_frame(scene, serial, serial - 1);
}

/* The readback has colour, visibility, counters, picks, depth and motion vectors. */
static VkDeviceSize pick_offset(const c_image* image)
{
    return (VkDeviceSize)image->width * image->height * 8 + sizeof(hearth_frame_counters);
}

static VkDeviceSize depth_offset(const c_image* image)
{
    return pick_offset(image) + (VkDeviceSize)image->width * image->height * sizeof(hearth_pick);
}

static VkDeviceSize motion_offset(const c_image* image)
{
    return depth_offset(image) + (VkDeviceSize)image->width * image->height * sizeof(float);
}

static VkDeviceSize readback_bytes(const c_image* image)
{
    return motion_offset(image) + (VkDeviceSize)image->width * image->height * 4;
}

static hearth_result record_frame(hearth_scene* scene, hearth_targets* targets, VkCommandBuffer commands,
                                  const c_image* image)
{
    hearth_result result;
    if (!image->in_parts)
        return hearth_record_frame(scene, targets, commands, &image->frame);
    result = hearth_record_cull(scene, targets, commands, &image->frame);
    if (result == HEARTH_OK)
        result = hearth_record_visibility(scene, targets, commands, &image->frame);
    if (result == HEARTH_OK)
        result = hearth_record_materials(scene, targets, commands, &image->frame);
    return result;
}

/* Records the picks of all pixels behind the images and the counters, in bands of rows. */
static hearth_result record_picks(hearth_scene* scene, hearth_targets* targets, VkCommandBuffer commands,
                                  const c_image* image, VkBuffer destination)
{
    const uint32_t rows = HEARTH_MAX_PICKS / image->width;
    hearth_pixels band = {0, 0, 0, 0};
    hearth_result result = hearth_scene_prepare_picks(scene);
    band.width = image->width;
    for (; result == HEARTH_OK && band.y < image->height; band.y += rows)
    {
        band.height = band.y + rows < image->height ? rows : image->height - band.y;
        result =
            hearth_record_picks(scene, targets, commands, &band, destination,
                                pick_offset(image) + (VkDeviceSize)band.y * band.width * sizeof(hearth_pick));
    }
    return result;
}

/* Records one frame and copies colour, visibility and counters to the readback. */
static hearth_result record(c_caller* caller, hearth_scene* scene, hearth_targets* targets,
                            const c_image* image, const readback* memory)
{
    const VkDeviceSize image_bytes = (VkDeviceSize)image->width * image->height * 4;
    hearth_targets_info images = HEARTH_TARGETS_INFO_INIT;
    hearth_result result = hearth_targets_get_info(targets, &images);
    const VkCommandBuffer commands = c_caller_begin(caller);
    if (result == HEARTH_OK && image->before != NULL)
        result = hearth_record_frame(scene, targets, commands, image->before);
    if (result == HEARTH_OK)
        result = record_frame(scene, targets, commands, image);
    if (result == HEARTH_OK)
        result = hearth_record_counters(scene, commands, memory->buffer, 2 * image_bytes);
    if (result == HEARTH_OK && image->picks != NULL)
        result = record_picks(scene, targets, commands, image, memory->buffer);
    if (result == HEARTH_OK && image->motion != NULL)
        result = hearth_record_motion(scene, targets, commands);
    if (result == HEARTH_OK)
    {
        copy_image(caller, &images.color, image, memory->buffer, 0);
        copy_image(caller, &images.visibility, image, memory->buffer, image_bytes);
        if (image->depth != NULL)
            copy_image(caller, &images.depth, image, memory->buffer, depth_offset(image));
        if (image->motion != NULL)
            copy_image(caller, &images.motion, image, memory->buffer, motion_offset(image));
        show_host(caller);
    }
    if (c_caller_submit(caller) != VK_SUCCESS)
        return HEARTH_ERROR_DEVICE_FAILED;
    return result;
}

static void take(const readback* memory, c_image* image)
{
    const size_t image_bytes = (size_t)image->width * image->height * 4;
    memcpy(image->color, memory->mapped, image_bytes);
    memcpy(image->visibility, memory->mapped + image_bytes, image_bytes);
    memcpy(&image->counters, memory->mapped + 2 * image_bytes, sizeof(image->counters));
    if (image->picks != NULL)
        memcpy(image->picks, memory->mapped + pick_offset(image), image_bytes / 4 * sizeof(hearth_pick));
    if (image->depth != NULL)
        memcpy(image->depth, memory->mapped + depth_offset(image), image_bytes / 4 * sizeof(float));
    if (image->motion != NULL)
        memcpy(image->motion, memory->mapped + motion_offset(image), image_bytes);
}

static hearth_result draw_scene(c_caller* caller, hearth_scene* scene, hearth_targets* targets,
                                c_image* image)
{
    VkQueryPoolCreateInfo queries = {VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    readback memory = {VK_NULL_HANDLE, VK_NULL_HANDLE, NULL};
    hearth_result result = HEARTH_OK;
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queries.queryCount = HEARTH_TIMESTAMP_COUNT;
    if (create_readback(caller, readback_bytes(image), &memory) < 0 ||
        caller->vkCreateQueryPool(caller->device, &queries, NULL, &image->frame.timestamps) < 0)
        result = HEARTH_ERROR_DEVICE_FAILED;
    if (result == HEARTH_OK && image->scene.memory_budget > 0)
        result = stream(caller, scene, targets, image);
    if (result == HEARTH_OK)
        result = record(caller, scene, targets, image, &memory);
    if (result == HEARTH_OK)
    {
        take(&memory, image);
        caller->vkGetQueryPoolResults(caller->device, image->frame.timestamps, 0, HEARTH_TIMESTAMP_COUNT,
                                      sizeof(image->ticks), image->ticks, sizeof(uint64_t),
                                      VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    }
    caller->vkDestroyQueryPool(caller->device, image->frame.timestamps, NULL);
    destroy_readback(caller, &memory);
    return result;
}

hearth_result c_caller_draw(c_caller* caller, hearth_renderer* renderer, hearth_pack* pack, c_image* image)
{
    hearth_targets* targets = NULL;
    hearth_scene* scene = NULL;
    hearth_targets_description description = HEARTH_TARGETS_DESCRIPTION_INIT;
    description.width = image->width;
    description.height = image->height;
    description.flags = HEARTH_TARGETS_KEEP_VISIBILITY | image->targets_flags;
    description.colors = image->colors;
    description.color_count = image->color_count;
    hearth_result result = hearth_targets_create(renderer, &description, &targets);
    if (result == HEARTH_OK)
        result = upload(caller, renderer, pack, image, &scene);
    if (result == HEARTH_OK && image->frame.light_method != HEARTH_LIGHTS_PRACTICAL)
        result = hearth_scene_prepare_lights(scene, image->frame.light_method);
    if (result == HEARTH_OK)
        result = draw_scene(caller, scene, targets, image);
    hearth_scene_destroy(scene);
    hearth_targets_destroy(targets);
    return result;
}
