// The renderer: pipelines made once, scenes uploaded, frames recorded into the caller's command buffer.
// It never submits, waits, or allocates while recording a frame; it has no globals. README.md says what it requires.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame_parts.h"
#include "runtime/gpu/passes/bin_pass.h"
#include "runtime/gpu/passes/brick_light_pass.h"
#include "runtime/gpu/passes/cull_pass.h"
#include "runtime/gpu/passes/gather_pass.h"
#include "runtime/gpu/passes/material_depth_pass.h"
#include "runtime/gpu/passes/material_tiles_pass.h"
#include "runtime/gpu/passes/page_request_pass.h"
#include "runtime/gpu/passes/pyramid_pass.h"
#include "runtime/gpu/passes/shading_pass.h"
#include "runtime/gpu/passes/shadow_pass.h"
#include "runtime/gpu/passes/skinning_pass.h"
#include "runtime/gpu/scene/light_change.h"

#include <memory>
#include <optional>

namespace hearth::gpu
{

/// Where the time of a frame goes: a timestamp is written at the begin and after each pass.
enum FrameTimestamp : uint32_t
{
    kTimestampBegin,
    kTimestampShadows,         ///< with the light of bricks' faces; no time without both
    kTimestampCull,            ///< with the skinning of what is found, as the late one
    kTimestampEarlyVisibility, ///< this one and the two after it take no time without occlusion culling
    kTimestampPyramid,
    kTimestampLateCull,
    kTimestampVisibility,
    kTimestampMaterialTiles, ///< with the gathering of bricks' light; no time without both
    kTimestampMaterialDepth,
    kTimestampShading,
    kTimestampCount,
};

struct FrameInput
{
    shared::FrameView view; ///< from shared::makeFrameView, with the size of the targets
    ShadingView shading{};
    std::span<const InstanceMove> moves{}; ///< from this frame on; read while recording
    /// Of deformed instances, which start at rest: from this frame on; read while recording. What checkPose refuses is left
    /// out.
    std::span<const InstancePose> poses{};
    /// Of a scene with shadows, where they are finer, beside the spheres of its pack: all of this frame, read while
    /// recording.
    std::span<const ShadowSphere> shadow_spheres{};
    /// From this frame on; read while recording.
    std::span<const LightChange> lights{};
    /// Of a scene with bricks, what their faces send out: all of this frame, read while recording.
    std::span<const EmissionScale> emission{};
    VkQueryPool timestamps = VK_NULL_HANDLE; ///< kTimestampCount queries, reset by the frame; or none
};

class Renderer
{
public:
    /// The described objects outlive the renderer, which outlives its scenes and targets.
    /// errors: device, device_failed.
    static Result<std::unique_ptr<Renderer>> create(const DeviceDescription& description);

    const Device& device() const { return device_; }

    /// errors: device_limit, device_failed.
    Result<FrameTargets> createTargets(VkExtent2D extent) const;

    /// See uploadScene. Also makes the pipelines that the scene's materials and shadows need and no scene before had.
    Result<std::unique_ptr<Scene>> upload(const formats::PackView& pack, VkCommandBuffer commands,
                                          const SceneOptions& options = {});

    /// The pipelines of the overdraw view, to be made before a frame that shows it. errors: device_failed.
    Status prepareOverdraw();

    /// Record culling and drawing of one frame, outside a render pass. Clobbers compute and graphics state.
    /// Afterwards targets.visibility() and targets.color() can be copied from. Frames with occlusion culling leave
    /// their depth pyramid to the next one with these targets, which must be submitted after them. A frame of a streamed
    /// scene is that which SceneStream::beginFrame began; its threshold is scaled as the stream says.
    void record(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                const FrameInput& input) const;

    /// The same in parts, for callers that put something between them: all three in this order, with the same arguments,
    /// each outside a render pass. imagesOf (frame_parts.h) says how they find and leave the images. With few materials `record`
    /// draws in one render pass what these draw in two: on a tile-based GPU the visibility buffer leaves the tile once more.
    void recordCull(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                    const FrameInput& input) const;
    void recordVisibility(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                          const FrameInput& input) const;
    void recordMaterials(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                         const FrameInput& input) const;

    /// The same without drawing: asks for what a frame with this view asks for. For a streamed scene, in place of record.
    /// Clobbers compute state, and leaves the depth pyramid as it is.
    void recordPrefetch(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                        const shared::FrameView& view, std::span<const InstanceMove> moves = {},
                        std::span<const InstancePose> poses = {}) const;

private:
    Renderer() = default;
    Status prepareDeformed();
    void recordSkinning(VkCommandBuffer commands, const Scene& scene, uint32_t phase) const;
    void recordShadows(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                       const shared::FrameView& view, std::span<const ShadowSphere> spheres) const;
    void recordRequests(VkCommandBuffer commands, const Scene& scene) const;
    void recordBrickLight(VkCommandBuffer commands, const Scene& scene, const FrameInput& input) const;
    void recordEarly(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                     const FrameInput& input) const;
    void drawVisibility(VkCommandBuffer commands, const Scene& scene, const FrameInput& input) const;
    void endAtVisibility(VkCommandBuffer commands) const;
    void recordPicture(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                       const FrameInput& input) const;
    void recordOverdraw(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets) const;
    void beginPass(VkCommandBuffer commands, const FrameTargets& targets, VkRenderPass render_pass) const;

    Device device_;
    DrawLayouts layouts_;
    FramePasses passes_;
    CullPass cull_;
    PageRequestPass page_requests_;
    PyramidPass pyramid_;
    std::optional<ShadowPass> shadows_;         ///< once a scene has them
    std::optional<BrickLightPass> brick_light_; ///< once a scene has bricks
    std::optional<GatherPass> gather_;          ///< the same
    std::optional<SkinningPass> skinning_;      ///< once a scene has deformed meshes
    BinPass visibility_;
    std::optional<BinPass> overdraw_;
    MaterialTilesPass material_tiles_;
    MaterialDepthPass material_depth_;
    ShadingPass shading_;
};

} // namespace hearth::gpu
