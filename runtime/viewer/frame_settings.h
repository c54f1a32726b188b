// What a person sets about a picture, wherever the camera stands.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "runtime/frame/lod_curve.h"
#include "runtime/gpu/renderer.h"

#include <span>
#include <vector>

namespace hearth::viewer
{

struct FrameSettings
{
    float error_pixels = 1;                 ///< largest error on the screen; 0: the source triangles
    std::vector<shared::LodKnot> lod_curve; ///< one that shared::setLodCurve takes
    uint32_t view = shared::kViewFinal;     ///< shared::kView*
    gpu::ShadedArea shaded_area = gpu::ShadedArea::automatic;
    uint32_t cull_flags = shared::kCullEverything;
    uint32_t ambient_occlusion = shared::kAmbientOcclusionExact; ///< shared::kAmbientOcclusion*
    uint32_t specular_occlusion = shared::kSpecularOcclusionFit; ///< shared::kSpecularOcclusion*
    bool bricks_light = true;                                    ///< of packs with bricks
};

/// A value and what people call it.
template <typename T>
struct Named
{
    const char* name;
    T value;
};

/// All views, the picture first.
std::span<const Named<uint32_t>> viewNames();
std::span<const Named<gpu::ShadedArea>> shadedAreaNames();
std::span<const Named<uint32_t>> ambientOcclusionNames();
std::span<const Named<uint32_t>> specularOcclusionNames();
/// Flag by flag.
std::span<const Named<uint32_t>> cullTestNames();

/// A frame of the camera. The depth view shows what is as far away as the target in middle grey.
gpu::FrameInput makeFrame(const FrameSettings& settings, const shared::Camera& camera,
                          uint32_t instance_count, VkExtent2D extent);

} // namespace hearth::viewer
