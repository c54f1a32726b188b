// Tests that the renderer uses all that the caller provides: memory, allocation callbacks, pipeline cache,
// labels, messages.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/runtime/gpu/replace_function.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cstdlib>
#include <cstring>
#include <gmock/gmock.h>
#include <map>

namespace hearth::test
{

namespace
{

/// Intercepted Vulkan calls of the renderer, and the real functions.
struct Spy
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    PFN_vkGetDeviceProcAddr get_device_proc_addr = nullptr;
    PFN_vkAllocateMemory allocate_memory = nullptr;
    PFN_vkCreateComputePipelines create_compute_pipelines = nullptr;
    PFN_vkCreateGraphicsPipelines create_graphics_pipelines = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;
    PFN_vkGetPhysicalDeviceFormatProperties get_format_properties = nullptr;

    VkFormat missing_format = VK_FORMAT_UNDEFINED; ///< the device is said to have no use for it
    uint32_t allocations = 0;
    std::vector<VkPipelineCache> caches; ///< one for each pipeline
    std::vector<std::string> labels;
    uint32_t open_labels = 0;
};
Spy spy;

VKAPI_ATTR VkResult VKAPI_CALL allocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkDeviceMemory* memory)
{
    ++spy.allocations;
    return spy.allocate_memory(device, info, allocator, memory);
}

VKAPI_ATTR VkResult VKAPI_CALL createComputePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* allocator,
                                                      VkPipeline* pipelines)
{
    spy.caches.push_back(cache);
    return spy.create_compute_pipelines(device, cache, count, infos, allocator, pipelines);
}

VKAPI_ATTR VkResult VKAPI_CALL createGraphicsPipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                       const VkGraphicsPipelineCreateInfo* infos,
                                                       const VkAllocationCallbacks* allocator,
                                                       VkPipeline* pipelines)
{
    spy.caches.push_back(cache);
    return spy.create_graphics_pipelines(device, cache, count, infos, allocator, pipelines);
}

VKAPI_ATTR void VKAPI_CALL beginLabel(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label)
{
    spy.labels.emplace_back(label->pLabelName);
    ++spy.open_labels;
    spy.begin_label(commands, label);
}

VKAPI_ATTR void VKAPI_CALL endLabel(VkCommandBuffer commands)
{
    --spy.open_labels;
    spy.end_label(commands);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction function = spy.get_device_proc_addr(device, name);
    const std::string_view which = name;
    if (which == "vkAllocateMemory")
        return replaceFunction(function, spy.allocate_memory, allocateMemory);
    if (which == "vkCreateComputePipelines")
        return replaceFunction(function, spy.create_compute_pipelines, createComputePipelines);
    if (which == "vkCreateGraphicsPipelines")
        return replaceFunction(function, spy.create_graphics_pipelines, createGraphicsPipelines);
    return function;
}

VKAPI_ATTR void VKAPI_CALL getFormatProperties(VkPhysicalDevice device, VkFormat format,
                                               VkFormatProperties* properties)
{
    spy.get_format_properties(device, format, properties);
    if (format == spy.missing_format)
        *properties = {};
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction function = spy.get_instance_proc_addr(instance, name);
    const std::string_view which = name;
    if (which == "vkGetDeviceProcAddr")
        return replaceFunction(function, spy.get_device_proc_addr, getDeviceProcAddr);
    if (which == "vkGetPhysicalDeviceFormatProperties")
        return replaceFunction(function, spy.get_format_properties, getFormatProperties);
    if (which == "vkCmdBeginDebugUtilsLabelEXT")
        return replaceFunction(function, spy.begin_label, beginLabel);
    if (which == "vkCmdEndDebugUtilsLabelEXT")
        return replaceFunction(function, spy.end_label, endLabel);
    return function;
}

/// Allocator like a game's, which gives each resource memory of its own.
class Allocator
{
public:
    explicit Allocator(const gpu::Device& device) : device_(device) {}

    gpu::MemoryHooks hooks() { return {this, allocate, free}; }

    uint32_t requests = 0;
    uint32_t refused = UINT32_MAX; ///< index of the request that fails
    std::map<VkDeviceMemory, VkDeviceSize> live;

private:
    static VkResult allocate(void* user, const gpu::MemoryRequest& request, gpu::MemoryAllocation& piece)
    {
        return static_cast<Allocator*>(user)->give(request, piece);
    }

    static void free(void* user, const gpu::MemoryAllocation& piece)
    {
        auto* self = static_cast<Allocator*>(user);
        EXPECT_EQ(piece.allocation, user);
        EXPECT_EQ(self->live.erase(piece.memory), 1u);
        self->device_.vk.vkFreeMemory(self->device_.handle, piece.memory, nullptr);
    }

    VkResult give(const gpu::MemoryRequest& request, gpu::MemoryAllocation& piece)
    {
        if (requests++ == refused)
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        const bool mapped = request.kind != gpu::MemoryKind::device;
        const VkDeviceSize offset = request.needs.alignment; // not the start of the memory
        const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr,
                                        offset + request.needs.size, findType(request, mapped)};
        if (const VkResult result =
                device_.vk.vkAllocateMemory(device_.handle, &info, nullptr, &piece.memory);
            result != VK_SUCCESS)
            return result;
        live[piece.memory] = info.allocationSize;
        piece.offset = offset;
        piece.allocation = this;
        void* begin = nullptr;
        if (mapped)
        {
            device_.vk.vkMapMemory(device_.handle, piece.memory, 0, VK_WHOLE_SIZE, 0, &begin);
            piece.mapped = static_cast<std::byte*>(begin) + offset;
        }
        return VK_SUCCESS;
    }

    uint32_t findType(const gpu::MemoryRequest& request, bool mapped) const
    {
        constexpr VkMemoryPropertyFlags kMapped =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        for (uint32_t type = 0; type < device_.memory.memoryTypeCount; ++type)
            if ((request.needs.memoryTypeBits >> type & 1u) != 0 &&
                (!mapped || (device_.memory.memoryTypes[type].propertyFlags & kMapped) == kMapped))
                return type;
        ADD_FAILURE() << "no type";
        return 0;
    }

    const gpu::Device& device_;
};

/// Counts Vulkan's host memory allocations.
struct HostMemory
{
    size_t allocations = 0, live = 0;

    VkAllocationCallbacks callbacks()
    {
        return {.pUserData = this,
                .pfnAllocation = allocate,
                .pfnReallocation = reallocate,
                .pfnFree = release,
                .pfnInternalAllocation = nullptr,
                .pfnInternalFree = nullptr};
    }

private:
    static void* VKAPI_PTR allocate(void* user, size_t size, size_t alignment, VkSystemAllocationScope)
    {
        auto* self = static_cast<HostMemory*>(user);
        ++self->allocations;
        ++self->live;
        return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    }
    static void* VKAPI_PTR reallocate(void*, void*, size_t, size_t, VkSystemAllocationScope)
    {
        ADD_FAILURE() << "not expected of this driver";
        return nullptr;
    }
    static void VKAPI_PTR release(void* user, void* memory)
    {
        static_cast<HostMemory*>(user)->live -= memory == nullptr ? 0 : 1;
        std::free(memory);
    }
};

class CallerTest : public GpuTest
{
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        spy = {};
        spy.get_instance_proc_addr = host().description().get_instance_proc_addr;
        std::mt19937 random(5);
        const uint32_t mesh = test_.addMesh(withMaterial(shapes::rock(30, 0.2f), kInvalidIndex));
        for (int i = 0; i < 3; ++i)
            test_.addInstance(mesh, randomAffine(random, 2));
    }

    /// Description of the suite's device, with interception.
    gpu::DeviceDescription description() const
    {
        gpu::DeviceDescription description = host().description();
        description.get_instance_proc_addr = getInstanceProcAddr;
        description.debug_labels = false;
        return description;
    }

    /// Draw a frame with a renderer of its own, and destroy all of it afterwards. Returns the colours; none
    /// on failure.
    std::vector<std::byte> drawOnce(const gpu::DeviceDescription& description,
                                    const gpu::SceneOptions& options = {}, const DrawOptions& shown = {})
    {
        const Result<std::vector<std::byte>> pixels = tryToDraw(description, options, shown);
        EXPECT_TRUE(pixels.ok()) << (pixels.ok() ? "" : formatMessage(pixels.error()));
        return pixels.ok() ? *pixels : std::vector<std::byte>();
    }

    Result<std::vector<std::byte>> tryToDraw(const gpu::DeviceDescription& description,
                                             const gpu::SceneOptions& options, const DrawOptions& shown)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::unique_ptr<gpu::Renderer> renderer,
                                gpu::Renderer::create(description));
        return tryToDraw(*renderer, options, shown);
    }

    Result<std::vector<std::byte>> tryToDraw(gpu::Renderer& renderer, const gpu::SceneOptions& options,
                                             const DrawOptions& shown)
    {
        pack_ = test_.build();
        std::unique_ptr<gpu::Scene> scene;
        HEARTH_TRY(host().run(
            [&](VkCommandBuffer commands) -> Status
            {
                HEARTH_ASSIGN_OR_RETURN(scene, renderer.upload(*pack_, commands, options));
                return success();
            }));
        scene->staging.reset();
        HEARTH_ASSIGN_OR_RETURN(
            gpu::FrameTargets targets,
            renderer.createTargets({shown.width, shown.height}, {.keeps_visibility = true}));
        const shared::Camera camera{.position = {2, 2, 6}, .target = {}};
        for (uint64_t frame = 1; frame <= 3; ++frame)
        {
            if (scene->stream != nullptr)
                scene->stream->beginFrame(frame, frame - 1);
            HEARTH_TRY(host().run(
                [&](VkCommandBuffer commands)
                {
                    renderer.record(commands, *scene, targets,
                                    {.view = makeView(*scene, camera, shown),
                                     .shading = {.debug_view = shown.debug_view, .area = shown.area}});
                    return success();
                }));
        }
        return host().read(renderer.device(), targets.color(), 4);
    }

    /// Reader that completes at once; reading page `bad` fails.
    pack::PageReader reader(uint32_t bad = kInvalidIndex)
    {
        return [this, bad](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
        { done(page != bad && pack_->decodePage(page, destination).ok()); };
    }

    TestScene test_;
    std::optional<formats::PackView> pack_; ///< pack of the last drawing
};

} // namespace

TEST_F(CallerTest, itsMemoryIsUsedForEverythingAndGivenBack)
{
    const std::vector<std::byte> expected = drawOnce(description());
    EXPECT_GT(spy.allocations, 0u);
    spy.allocations = 0;
    Allocator allocator(renderer().device());
    gpu::DeviceDescription hooked = description();
    hooked.memory_hooks = allocator.hooks();
    EXPECT_EQ(drawOnce(hooked), expected);
    EXPECT_GT(allocator.requests, 20u);
    EXPECT_TRUE(allocator.live.empty());
    EXPECT_EQ(drawOnce(hooked, {.memory_budget = 8 << 20, .stream = {.read = reader()}}).size(),
              expected.size());
    EXPECT_TRUE(allocator.live.empty());
    EXPECT_EQ(spy.allocations, 0u) << "none beside the hooks";
}

TEST_F(CallerTest, itsMemoryIsGivenBackWhereThereIsNotEnough)
{
    Allocator allocator(renderer().device());
    gpu::DeviceDescription hooked = description();
    hooked.memory_hooks = allocator.hooks();
    const auto hooked_renderer = gpu::Renderer::create(hooked);
    ASSERT_TRUE(hooked_renderer.ok());
    ASSERT_TRUE(tryToDraw(**hooked_renderer, {}, {}).ok());
    const uint32_t requests = allocator.requests;
    for (uint32_t refused = 0; refused < requests; ++refused)
    {
        allocator.requests = 0;
        allocator.refused = refused;
        const Result<std::vector<std::byte>> pixels = tryToDraw(**hooked_renderer, {}, {});
        ASSERT_FALSE(pixels.ok()) << refused;
        EXPECT_EQ(pixels.error().issue, Issue::device_memory);
        EXPECT_TRUE(allocator.live.empty()) << refused;
    }
}

TEST_F(CallerTest, itsAllocationCallbacksAreUsedAndAllIsGivenBack)
{
    HostMemory memory;
    const VkAllocationCallbacks callbacks = memory.callbacks();
    gpu::DeviceDescription counted = description();
    counted.allocator = &callbacks;
    EXPECT_EQ(drawOnce(counted), drawOnce(description()));
    EXPECT_GT(memory.allocations, 50u);
    EXPECT_EQ(memory.live, 0u);
}

TEST_F(CallerTest, itsPipelineCacheIsUsedForEveryPipeline)
{
    const gpu::DeviceDescription plain = description();
    const auto create = reinterpret_cast<PFN_vkCreatePipelineCache>(
        spy.get_instance_proc_addr(plain.instance, "vkCreatePipelineCache"));
    const auto destroy = reinterpret_cast<PFN_vkDestroyPipelineCache>(
        spy.get_instance_proc_addr(plain.instance, "vkDestroyPipelineCache"));
    const VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO, nullptr, 0, 0,
                                         nullptr};
    VkPipelineCache cache = VK_NULL_HANDLE;
    ASSERT_EQ(create(plain.device, &info, nullptr, &cache), VK_SUCCESS);
    gpu::DeviceDescription cached = plain;
    cached.pipeline_cache = cache;
    (void)drawOnce(cached);
    EXPECT_GT(spy.caches.size(), 10u);
    EXPECT_THAT(spy.caches, testing::Each(cache));
    destroy(plain.device, cache, nullptr);
}

TEST_F(CallerTest, itsDebuggerSeesThePassesInOrder)
{
    gpu::DeviceDescription labelled = description();
    (void)drawOnce(labelled);
    EXPECT_TRUE(spy.labels.empty()) << "nobody asked";
    labelled.debug_labels = true;
    (void)drawOnce(labelled, {}, {.area = gpu::ShadedArea::tiles});
    const std::vector<std::string> frame{"cull",       "early visibility", "pyramid",        "late cull",
                                         "visibility", "material tiles",   "material marks", "shading"};
    ASSERT_EQ(spy.labels.size(), 3 * frame.size());
    for (size_t i = 0; i < spy.labels.size(); ++i)
        EXPECT_EQ(spy.labels[i], frame[i % frame.size()]);
    EXPECT_EQ(spy.open_labels, 0u);

    spy.labels.clear();
    (void)drawOnce(labelled, {}, {.flags = shared::kCullFrustum, .area = gpu::ShadedArea::wholeFrame});
    spy.labels.resize(4);
    EXPECT_EQ(spy.labels, (std::vector<std::string>{"cull", "visibility", "material marks", "shading"}));
}

TEST_F(CallerTest, itIsToldThatItsDeviceHasNoTexturesOfSixteenBits)
{
    // mips of 4 and 1 texels; the alpha of 65535 and the rest are 8 bits, too, so that nothing is lost
    std::vector<uint32_t> wide;
    for (uint32_t texel = 0; texel < 5; ++texel)
        wide.insert(wide.end(), {(40u * 257) << 16 | (20 * texel) * 257, 65535u << 16 | 200 * 257});
    formats::MaterialRecord material = plainMaterial();
    material.emissive = {1, 1, 1};
    material.emissive_texture =
        makeTextureRef(test_.addImage(formats::TexelFormat::rgba16_unorm, 2, 2, wide));
    material.emissive_texture.nearest = 1; // drivers filter 8 bits more coarsely
    test_.addInstance(test_.addMesh(withMaterial(makeQuad(4, 4), test_.addMaterial(material))), Affine3{});
    std::vector<std::string> messages;
    gpu::DeviceDescription device = description();
    device.message_hook = {&messages, [](void* user, const char* message)
                           { static_cast<std::vector<std::string>*>(user)->emplace_back(message); }};
    const std::vector<std::byte> expected = drawOnce(device);
    EXPECT_EQ(messages.empty(),
              renderer().device().texel_formats[static_cast<size_t>(formats::TexelFormat::rgba16_unorm)]);

    messages.clear();
    spy.missing_format = VK_FORMAT_R16G16B16A16_UNORM;
    EXPECT_EQ(drawOnce(device), expected);
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_THAT(messages[0],
                testing::HasSubstr("image 0: warning: its 16 bits a channel are reduced to 8: the "
                                   "device cannot filter R16G16B16A16_UNORM [W1401]"));
}

TEST_F(CallerTest, aColorFormatThatTheDeviceCannotDrawIsNamed)
{
    spy.missing_format = VK_FORMAT_B10G11R11_UFLOAT_PACK32;
    const auto renderer =
        gpu::Renderer::create(description(), {.color_format = VK_FORMAT_B10G11R11_UFLOAT_PACK32});
    ASSERT_FALSE(renderer.ok());
    EXPECT_EQ(renderer.error().issue, Issue::device);
    EXPECT_THAT(renderer.error().detail,
                testing::HasSubstr("cannot render to B10G11R11_UFLOAT_PACK32: images that frames show"));
    EXPECT_TRUE(gpu::Renderer::create(description()).ok());
}

TEST_F(CallerTest, itIsToldWhatIsDegraded)
{
    std::vector<std::string> messages;
    gpu::DeviceDescription device = description();
    device.message_hook = {&messages, [](void* user, const char* message)
                           { static_cast<std::vector<std::string>*>(user)->emplace_back(message); }};
    (void)drawOnce(device);
    EXPECT_TRUE(messages.empty());

    const auto page_count = static_cast<uint32_t>(pack_->pages().size());
    ASSERT_GT(page_count, 1u);
    // page 0 may be pinned from the start, and not read by the reader
    for (uint32_t page = 0; page < page_count && messages.empty(); ++page)
        (void)drawOnce(device, {.memory_budget = 8 << 20, .stream = {.read = reader(page)}},
                       {.error_pixels = 0});
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_THAT(messages[0], testing::HasSubstr("cannot be read"));

    messages.clear();
    for (uint32_t i = 0; i < shared::kMaxLights + 2; ++i)
        test_.addLight({});
    (void)drawOnce(device);
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_THAT(messages[0], testing::HasSubstr("2 lights are more than the 4096"));
}

} // namespace hearth::test
