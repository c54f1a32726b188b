// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/gpu_fixture.h"

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <string_view>

// The layer keeps what it allocated when it is unloaded.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:libVkLayer_khronos_validation.so\n";
}

namespace hearth::test
{

namespace
{

/// The leak checker cannot name what an unloaded module allocated, so these two stay.
void keepDriverLoaded()
{
    ::dlopen("libvulkan_lvp.so", RTLD_LAZY | RTLD_NODELETE);
    ::dlopen("libVkLayer_khronos_validation.so", RTLD_LAZY | RTLD_NODELETE);
}

/// Value of an option by which the tests run: its index among the names, 0 if it is not set.
size_t testOption(const char* variable, std::initializer_list<std::string_view> names)
{
    const char* value = std::getenv(variable);
    if (value == nullptr)
        return 0;
    const auto found = std::find(names.begin(), names.end(), std::string_view(value));
    HEARTH_ASSERT(found != names.end());
    return static_cast<size_t>(found - names.begin());
}

std::vector<uint32_t> toWords(const std::vector<std::byte>& bytes)
{
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words;
}

} // namespace

std::unique_ptr<viewer::VulkanHost> GpuTest::host_;
std::unique_ptr<gpu::Renderer> GpuTest::renderer_;
std::string GpuTest::no_device_;

gpu::RendererOptions testRendererOptions()
{
    return {
        .way = static_cast<gpu::FrameWay>(testOption("HEARTH_TEST_FRAME", {"merged", "separate", "one-set"})),
        .materials = static_cast<gpu::MaterialTest>(testOption("HEARTH_TEST_MATERIALS", {"depth", "id"}))};
}

std::vector<std::array<uint32_t, 3>> Image::seen() const
{
    std::vector<std::array<uint32_t, 3>> result;
    for (const uint32_t id : visibility)
        if (id == shared::kVisibilitySky)
            result.push_back({id, id, id});
        else
        {
            const shared::VisibleCluster& slot = list.slots.at(id >> shared::kTriangleBits);
            result.push_back({slot.instance, slot.cluster, id & ((1u << shared::kTriangleBits) - 1)});
        }
    return result;
}

void GpuTest::SetUpTestSuite()
{
    keepDriverLoaded();
    auto host = viewer::VulkanHost::create({.device_name = "", .validate = true});
    if (!host.ok())
    {
        no_device_ = formatMessage(host.error());
        return;
    }
    host_ = std::move(*host);
    replaceRenderer(testRendererOptions());
}

void GpuTest::replaceRenderer(const gpu::RendererOptions& options, const VkAllocationCallbacks* allocator)
{
    renderer_.reset();
    if (host_ == nullptr)
        return;
    gpu::DeviceDescription description = host_->description();
    description.allocator = allocator;
    auto renderer = gpu::Renderer::create(description, options);
    ASSERT_TRUE(renderer.ok()) << formatMessage(renderer.error());
    renderer_ = std::move(*renderer);
}

void GpuTest::TearDownTestSuite()
{
    renderer_.reset();
    if (host_ != nullptr)
    {
        EXPECT_EQ(host_->messages(), std::vector<std::string>{});
    }
    host_.reset();
}

void GpuTest::SetUp()
{
    // a software driver suffices, and the set-up installs one: without a device these tests would prove
    // nothing
    ASSERT_NE(host_, nullptr) << no_device_;
}

void GpuTest::TearDown()
{
    if (host_ == nullptr)
        return;
    EXPECT_EQ(host_->messages(), std::vector<std::string>{});
    host_->clearMessages();
}

std::unique_ptr<gpu::Scene> GpuTest::upload(const formats::PackView& pack, const gpu::SceneOptions& options)
{
    std::unique_ptr<gpu::Scene> scene;
    gpu::SceneOptions decoding = options; // a software driver lacks the formats of phones
    decoding.decode_textures = true;
    const Status status = host().run(
        [&](VkCommandBuffer commands) -> Status
        {
            HEARTH_ASSIGN_OR_RETURN(scene, renderer().upload(pack, commands, decoding));
            return success();
        });
    EXPECT_TRUE(status.ok()) << (status.ok() ? "" : formatMessage(status.error()));
    scene->staging.reset();
    return scene;
}

gpu::FrameTargets GpuTest::makeTargets(uint32_t width, uint32_t height)
{
    auto targets = renderer().createTargets(
        {width, height},
        {.keeps_visibility = true,
         .light_paths = renderer().supports(gpu::LightMethod::deferred) ? gpu::kAllLightPaths : 0u});
    HEARTH_ASSERT(targets.ok());
    return std::move(*targets);
}

shared::FrameView GpuTest::makeView(const gpu::Scene& scene, const shared::Camera& camera,
                                    const DrawOptions& options)
{
    shared::FrameView view = shared::makeFrameView(camera, options.width, options.height,
                                                   options.error_pixels, scene.instance_count, options.flags);
    const Status curve = shared::setLodCurve(view, options.lod_curve);
    HEARTH_ASSERT(curve.ok());
    return view;
}

Image GpuTest::draw(const gpu::Scene& scene, const shared::Camera& camera, const DrawOptions& options)
{
    gpu::FrameTargets targets = makeTargets(options.width, options.height);
    return draw(scene, targets, camera, options);
}

Image GpuTest::draw(const gpu::Scene& scene, gpu::FrameTargets& targets, const shared::Camera& camera,
                    const DrawOptions& options)
{
    if (options.debug_view == shared::kViewOverdraw)
        HEARTH_ASSERT(renderer().prepareOverdraw().ok());
    const gpu::FrameInput input{.view = makeView(scene, camera, options),
                                .shading = {.debug_view = options.debug_view,
                                            .area = options.area,
                                            .ambient_occlusion = options.ambient_occlusion,
                                            .specular_occlusion = options.specular_occlusion,
                                            .gi = options.gi,
                                            .light_method = options.light_method,
                                            .light_lister = options.light_lister},
                                .moves = options.moves,
                                .poses = options.poses,
                                .shadow_spheres = options.shadow_spheres,
                                .lights = options.lights,
                                .daylight = options.daylight,
                                .lamp_weights = options.lamp_weights,
                                .emission = options.emission};
    const Status status = host().run(
        [&](VkCommandBuffer commands)
        {
            renderer().record(commands, scene, targets, input);
            return success();
        });
    HEARTH_ASSERT(status.ok());
    return readImage(scene, targets);
}

Image GpuTest::readImage(const gpu::Scene& scene, const gpu::FrameTargets& targets)
{
    auto color = host().read(renderer().device(), targets.color(), 4);
    auto visibility = host().read(renderer().device(), targets.visibility(), 4);
    auto list = viewer::readVisibleList(host(), renderer(), scene);
    HEARTH_ASSERT(color.ok() && visibility.ok() && list.ok());
    const auto [width, height] = targets.extent();
    return {width, height, toWords(*color), toWords(*visibility), std::move(*list)};
}

} // namespace hearth::test
