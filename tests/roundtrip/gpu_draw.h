// Draws packs with the runtime on the test device, with validation, and reads all results back.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/report/frame_report.h"
#include "tests/reference/pack_geometry.h"
#include "tests/reference/png_image.h"

#include <memory>
#include <string>
#include <vector>

namespace hearth::roundtrip
{

struct DrawnFrame
{
    /// in the GPU's order: index = slot number of the visibility buffer
    std::vector<reference::DrawnCluster> slots;
    std::vector<uint32_t> ids;
    reference::Image image;

    std::vector<reference::DrawnCluster> sortedSlots() const;
};

/// A pack on the device.
class GpuScene
{
public:
    DrawnFrame draw(const shared::FrameView& frame, uint32_t debug_view = shared::kViewFinal) const;

private:
    friend class TestDevice;
    class TestDevice* device_ = nullptr;
    std::unique_ptr<gpu::Scene> scene_;
};

/// The single device of a test program.
class TestDevice
{
public:
    /// Returns nullptr if there is no device; `reason` then has the reason.
    static std::unique_ptr<TestDevice> create(std::string& reason);

    GpuScene upload(const formats::PackView& pack);

    /// Messages of the validation layers since the last call.
    std::vector<std::string> takeMessages();
    const std::string& name() const { return host_->deviceName(); }

private:
    friend class GpuScene;
    std::unique_ptr<viewer::VulkanHost> host_;
    std::unique_ptr<gpu::Renderer> renderer_;
};

} // namespace hearth::roundtrip
