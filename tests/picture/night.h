// Draws a pack by its lights alone, with the renderer and with rays: under a black sky, and without the light
// that surfaces give each other.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/renderer.h"
#include "runtime/viewer/vulkan_host.h"
#include "tests/reference/png_image.h"

#include <vector>

namespace hearth::picture
{

struct NightView
{
    shared::Camera camera;
    uint32_t width = 0, height = 0; ///< of the image; both sides draw kOversampling times as many
    double seconds = 0;             ///< of the lights' flicker
};

struct DrawnNight
{
    reference::Image image;
    std::vector<uint32_t> casting; ///< lights that have shadow maps, by number
};

/// Draw a pack without bricks and baked visibility.
///
/// shadows  of the scene; with max_maps 0 no light has any
/// errors: device_limit, device_failed; internal, with the messages of the validation layer.
Result<DrawnNight> drawNight(viewer::VulkanHost& host, gpu::Renderer& renderer, const formats::PackView& pack,
                             const NightView& view, const gpu::ShadowOptions& shadows);

/// Trace the same picture, by a ray through the centre of each oversampled pixel: lights cast exact shadows
/// if they are among `casting`. errors: as for reading the
/// pack's geometry and textures.
Result<reference::Image> traceNight(const formats::PackView& pack, const NightView& view,
                                    const std::vector<uint32_t>& casting);

} // namespace hearth::picture
