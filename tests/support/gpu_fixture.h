// Shared fixture of tests on a graphics device: device with validation, drawing, and reading back.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/lod_curve.h"
#include "runtime/viewer/report/frame_report.h"

#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hearth::test
{

/// Rendered frame.
struct Image
{
    uint32_t width = 0, height = 0;
    std::vector<uint32_t> color;      ///< RGBA8 sRGB, red in the low byte
    std::vector<uint32_t> visibility; ///< encoded as in records.h
    viewer::VisibleList list;

    uint32_t at(uint32_t x, uint32_t y) const { return color[y * width + x]; }
    /// Return (instance, cluster, triangle) of every pixel, which does not depend on the order of slots.
    std::vector<std::array<uint32_t, 3>> seen() const;
};

/// Channel 0, 1 or 2 of a colour, 0 to 255.
inline int channel(uint32_t color, int index)
{
    return static_cast<int>(color >> (8 * index) & 255u);
}

struct DrawOptions
{
    uint32_t width = 160;
    uint32_t height = 120;
    float error_pixels = 1;
    uint32_t flags = shared::kCullEverything;
    uint32_t debug_view = shared::kViewFinal;
    gpu::ShadedArea area = gpu::ShadedArea::automatic;
    uint32_t ambient_occlusion = shared::kAmbientOcclusionExact;
    uint32_t specular_occlusion = shared::kSpecularOcclusionFit;
    std::vector<shared::LodKnot> lod_curve{};
    std::span<const gpu::InstanceMove> moves{};
    std::span<const gpu::InstancePose> poses{};
    std::span<const gpu::ShadowSphere> shadow_spheres{};
    std::span<const gpu::LightChange> lights{};
    std::span<const gpu::LampWeight> lamp_weights{};
    const gpu::DaylightChange* daylight = nullptr;
    std::span<const gpu::EmissionScale> emission{};
    bool gi = true;
    gpu::LightMethod light_method = gpu::LightMethod::practical;
    gpu::LightLister light_lister = gpu::LightLister::gpu;
};

/// Options by which the tests run: HEARTH_TEST_MATERIALS=depth|id, HEARTH_TEST_FRAME=merged|separate|one-set.
gpu::RendererOptions testRendererOptions();

/// Skips tests without a device. Fails if the validation layers report anything in any test.
class GpuTest : public testing::Test
{
protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite();
    void SetUp() override;
    void TearDown() override;

    static viewer::VulkanHost& host() { return *host_; }
    static gpu::Renderer& renderer() { return *renderer_; }

    /// Use a renderer with other options from now on, before any scene is uploaded.
    /// allocator  of its Vulkan objects, or null
    static void replaceRenderer(const gpu::RendererOptions& options,
                                const VkAllocationCallbacks* allocator = nullptr);

    /// Draw on another device from now on, which gets the one before: exchange them back at the end.
    static void exchangeDevice(std::unique_ptr<viewer::VulkanHost>& host,
                               std::unique_ptr<gpu::Renderer>& renderer)
    {
        std::swap(host_, host);
        std::swap(renderer_, renderer);
    }

    std::unique_ptr<gpu::Scene> upload(const formats::PackView& pack, const gpu::SceneOptions& options = {});
    /// Draw with new targets: no data of an earlier frame.
    Image draw(const gpu::Scene& scene, const shared::Camera& camera, const DrawOptions& options = {});
    /// Draw with targets of the options' size, which keep data of the frame before.
    Image draw(const gpu::Scene& scene, gpu::FrameTargets& targets, const shared::Camera& camera,
               const DrawOptions& options);
    /// Read back the last frame, which has been executed.
    static Image readImage(const gpu::Scene& scene, const gpu::FrameTargets& targets);
    static shared::FrameView makeView(const gpu::Scene& scene, const shared::Camera& camera,
                                      const DrawOptions& options);
    gpu::FrameTargets makeTargets(uint32_t width, uint32_t height);

    template <typename T>
    std::vector<T> read(const gpu::Buffer& buffer, size_t count)
    {
        auto bytes = host().read(renderer().device(), buffer);
        HEARTH_ASSERT(bytes.ok() && bytes->size() >= count * sizeof(T));
        std::vector<T> values(count);
        if (count > 0)
            std::memcpy(static_cast<void*>(values.data()), bytes->data(), count * sizeof(T));
        return values;
    }

private:
    static std::unique_ptr<viewer::VulkanHost> host_;
    static std::unique_ptr<gpu::Renderer> renderer_;
    static std::string no_device_;
};

} // namespace hearth::test
