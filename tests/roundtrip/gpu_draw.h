// Draws packs with the runtime on the test device, validation on, and reads everything back.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/viewer/frame_report.h"
#include "tests/reference/pack_geometry.h"
#include "tests/reference/png_image.h"

#include <memory>
#include <string>
#include <vector>

namespace hearth::roundtrip
{

struct DrawnFrame
{
    std::vector<reference::DrawnCluster> slots; ///< in the GPU's order: slot numbers of the visibility buffer
    std::vector<uint32_t> ids;
    reference::Picture picture;

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

/// The one device of a test program.
class TestDevice
{
public:
    /// nullptr where there is none; `reason` says why.
    static std::unique_ptr<TestDevice> create(std::string& reason);

    GpuScene upload(const formats::PackView& pack);

    /// What the validation layers said since the last call.
    std::vector<std::string> takeMessages();
    const std::string& name() const { return host_->deviceName(); }

private:
    friend class GpuScene;
    std::unique_ptr<viewer::VulkanHost> host_;
    std::unique_ptr<gpu::Renderer> renderer_;
};

} // namespace hearth::roundtrip
