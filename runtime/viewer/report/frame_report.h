// Frame statistics: counts from the GPU's own buffers, times of the passes, and the files for tools.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/lights/light_method.h"
#include "runtime/viewer/contact_sheet.h"
#include "runtime/viewer/report/cull_report.h"
#include "runtime/viewer/report/memory_report.h"
#include "runtime/viewer/report/shadow_report.h"
#include "runtime/viewer/report/stream_report.h"
#include "runtime/viewer/vulkan_host.h"

#include <array>
#include <optional>

namespace hearth::viewer
{

/// Visible list of the last frame of a scene.
struct VisibleList
{
    shared::FrameCounters counters{};
    std::vector<shared::VisibleCluster> slots; ///< slots that were drawn
};
Result<VisibleList> readVisibleList(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene);

/// Return the area that the last frame of a scene drew to shade it, in pixels: each material, and the sky, in
/// all of its tiles or in the whole frame.
Result<uint64_t> readShadedArea(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene,
                                VkExtent2D extent, gpu::ShadedArea area);

/// Deformed clusters drawn by the last frame of a scene with characters.
struct SkinningCounts
{
    uint32_t clusters = 0;
    uint32_t in_scratch = 0; ///< of these, pre-skinned once; the others were skinned on demand
};
Result<SkinningCounts> readSkinning(VulkanHost& host, const gpu::Renderer& renderer, const gpu::Scene& scene);

/// Brick statistics (GI) of the last frame of a scene with bricks.
struct BrickCounts
{
    uint64_t bytes = 0; ///< of the bricks' buffers on the device
    uint32_t bricks = 0, faces = 0;
    uint32_t lit_faces = 0; ///< faces lit by the frame
    uint32_t period = 0;    ///< frames that light all faces once
    uint32_t rays = 0;      ///< per face that is lit
    uint32_t tiles = 0;     ///< tiles for which light was gathered
};
BrickCounts countBricks(const gpu::Scene& scene, const gpu::FrameTargets& targets);

/// Baked light of a scene with receivers in the last frame.
struct ReceiverCounts
{
    uint64_t texels = 0;          ///< of the atlas that have light
    uint64_t faces = 0;           ///< of bricks that have light
    uint32_t groups = 0;          ///< of four, that the frame updated
    pack::ReceiverCost cost;      ///< of the update of texels
    pack::ReceiverCost face_cost; ///< of that of faces
};
ReceiverCounts countReceivers(const gpu::Scene& scene);

struct FrameCounts
{
    uint64_t drawn_clusters = 0, early_clusters = 0, dropped_clusters = 0, drawn_triangles = 0;
    uint64_t missing_clusters = 0; ///< hidden by the last frame's depth, and not by this one's
    uint64_t shaded_area = 0;      ///< as readShadedArea
    CullReport culling;
};

/// Lights of the last frame, and what its pixels evaluate.
struct LightCounts
{
    gpu::LightMethod method = gpu::LightMethod::practical;
    shared::LightListCounts counts{};
    uint32_t shadowed = 0;   ///< lights with shadow maps
    uint32_t unshadowed = 0; ///< lights that are on, without
};

/// Gather the counts of a frame whose statistics have been recorded and executed.
LightCounts countLights(const gpu::Scene& scene, gpu::LightMethod method);

struct FrameReport
{
    std::string device;
    uint32_t width = 0, height = 0; ///< of a frame; on a sheet, of a cell's image
    std::optional<Sheet> sheet;
    float error_pixels = 0;
    uint64_t scene_bytes = 0, target_bytes = 0;
    MemoryCounts memory;
    uint32_t dropped_lights = 0;
    std::vector<FrameCounts> frames;         ///< at least one
    std::vector<StreamCounts> streaming;     ///< per frame; empty if all geometry is resident
    std::vector<ShadowCounts> shadows;       ///< per frame; empty without shadows
    std::optional<SkinningCounts> skinning;  ///< of the last frame; none without characters
    std::optional<BrickCounts> bricks;       ///< of the last frame; none without bricks
    std::optional<ReceiverCounts> receivers; ///< of the last frame; none without receivers
    LightCounts lights;
    /// Time of the pass that ends with the timestamp; [0] is the whole frame.
    std::array<double, gpu::kTimestampCount> milliseconds{};
};

/// Medians over frames of the times between timestamps.
std::array<double, gpu::kTimestampCount> medianPassTimes(const std::vector<std::vector<double>>& frames);

uint64_t countTriangles(const formats::PackView& pack, std::span<const shared::VisibleCluster> slots);

/// Format as JSON text; "schema" names the version of its form.
std::string formatReport(const FrameReport& report, const formats::PackView& pack);

/// Format in the layout that hearth-render --help describes.
std::vector<std::byte> formatVisibility(const VisibleList& list, std::span<const std::byte> pixels,
                                        uint32_t width, uint32_t height);

} // namespace hearth::viewer
