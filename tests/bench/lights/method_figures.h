// Measures all light methods in the same views: the table of M. Billeter, O. Olsson and U. Assarsson, "Tiled
// forward shading", 2013, and the bytes that a frame moves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "runtime/frame/frame.h"
#include "runtime/gpu/frame/frame_lint.h"
#include "runtime/viewer/vulkan_host.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::bench
{

/// Means over the views.
struct MethodFigures
{
    double evaluated = 0, reaching = 0; ///< lights a pixel with a surface
    double cells = 0, indices = 0;      ///< areas with lights, and their lights, a view
    double longest = 0, overflows = 0;  ///< most lights of a pixel; areas a view that found no room
    std::optional<double> cpu_ms;       ///< to list the lights of cells there; none: other areas
    double device_ms = 0;               ///< to list them on the device
    double frame_ms = 0;
    gpu::Traffic traffic; ///< bytes a pixel of the frame without occlusion culling
};

class MethodMeter
{
public:
    /// errors: those of VulkanHost and Renderer.
    static Result<MethodMeter> create();

    const viewer::VulkanHost& host() const { return *host_; }

    /// Draw views of a pack by each method. Times are the best of several frames.
    /// returns  [gpu::kLightMethodCount]
    Result<std::vector<MethodFigures>> measure(const formats::PackView& pack,
                                               std::span<const shared::Camera> views, VkExtent2D extent);

private:
    std::unique_ptr<viewer::VulkanHost> host_;
    std::unique_ptr<gpu::Renderer> renderer_;
    VkQueryPool timestamps_ = VK_NULL_HANDLE;
};

/// Print a row for each method, [gpu::kLightMethodCount].
void printMethods(std::span<const MethodFigures> methods);

} // namespace hearth::bench
