// View settings that do not depend on the camera.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "runtime/frame/lod_curve.h"
#include "runtime/gpu/renderer.h"

#include <optional>
#include <span>
#include <vector>

namespace hearth::viewer
{

struct FrameSettings
{
    float error_pixels = 1;                 ///< largest screen-space error; 0: the source triangles
    std::vector<shared::LodKnot> lod_curve; ///< valid for shared::setLodCurve
    uint32_t view = shared::kViewFinal;     ///< shared::kView*
    gpu::ShadedArea shaded_area = gpu::ShadedArea::automatic;
    uint32_t cull_flags = shared::kCullEverything;
    bool occludes_by_last_frame = false;                         ///< as gpu::FrameInput
    std::optional<gpu::FrameWay> way;                            ///< as gpu::RendererOptions
    std::optional<gpu::MaterialTest> material_test;              ///< none: rendererOptions chooses
    uint32_t ambient_occlusion = shared::kAmbientOcclusionExact; ///< shared::kAmbientOcclusion*
    uint32_t specular_occlusion = shared::kSpecularOcclusionFit; ///< shared::kSpecularOcclusion*
    bool gi = true;                                              ///< GI, for packs with bricks
    gpu::LightMethod light_method = gpu::LightMethod::practical;
    gpu::LightLister light_lister = gpu::LightLister::gpu;
    gpu::ReceiverUpdate receiver_update = gpu::ReceiverUpdate::compute;
    gpu::PostSettings post;
    std::optional<VkExtent2D> render_size; ///< pixels that are drawn; none: those of the image
    bool keeps_radiance = false;           ///< as gpu::TargetOptions; in half floats
    bool is_filtered = false;              ///< TargetOptions::has_temporal_filter
};

/// Value and its name for people.
template <typename T>
struct Named
{
    const char* name;
    T value;
};

/// Return all views, the final one first.
std::span<const Named<uint32_t>> viewNames();
std::span<const Named<gpu::ShadedArea>> shadedAreaNames();
/// Return the ways through a frame, the automatic choice first.
std::span<const Named<std::optional<gpu::FrameWay>>> frameWayNames();
std::span<const Named<gpu::MaterialTest>> materialTestNames();
/// Return all light methods, the default first.
std::span<const Named<gpu::LightMethod>> lightMethodNames();
std::span<const Named<gpu::LightLister>> lightListerNames();
std::span<const Named<gpu::ReceiverUpdate>> receiverUpdateNames();
std::span<const Named<uint32_t>> ambientOcclusionNames();
std::span<const Named<uint32_t>> specularOcclusionNames();
/// Return the culling tests, one per flag.
std::span<const Named<uint32_t>> cullTestNames();

/// True if frames of the settings need levels of bloom, which are images of their own.
bool needsBloomLevels(const FrameSettings& settings);

/// Method whose image shows how far one is off that approximates.
inline constexpr gpu::LightMethod kExactMethod = gpu::LightMethod::prepass;

/// Return what the light method needs of targets; of one that approximates, what kExactMethod needs as well.
uint32_t lightPaths(const FrameSettings& settings);

/// Return the options of a renderer for the settings. Materials are found by depth, unless something that
/// follows needs the depth.
gpu::RendererOptions rendererOptions(const FrameSettings& settings);

/// Return the demands of frames with the settings on their targets.
/// output            size of the image
/// keeps_visibility  as gpu::TargetOptions
gpu::TargetOptions targetOptions(const FrameSettings& settings, const gpu::Scene& scene, VkExtent2D output,
                                 bool keeps_visibility = false);

/// Make the input of a frame of the camera. The depth view shows the distance of the target as middle grey.
gpu::FrameInput makeFrame(const FrameSettings& settings, const shared::Camera& camera,
                          uint32_t instance_count, VkExtent2D extent);

} // namespace hearth::viewer
