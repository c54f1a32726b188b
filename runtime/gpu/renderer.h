// Vulkan renderer: creates pipelines once, uploads scenes, records frames into the caller's command buffer.
// Never submits, waits, or allocates while recording a frame; has no globals. See README.md for its
// requirements.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/frame/frame_parts.h"
#include "runtime/gpu/light_passes/add_lights_pass.h"
#include "runtime/gpu/light_passes/light_lists_pass.h"
#include "runtime/gpu/light_passes/mark_lights_pass.h"
#include "runtime/gpu/materials/material_shaders.h"
#include "runtime/gpu/passes/bin_pass.h"
#include "runtime/gpu/passes/brick_light_pass.h"
#include "runtime/gpu/passes/cull_pass.h"
#include "runtime/gpu/passes/gather_pass.h"
#include "runtime/gpu/passes/material_marks_pass.h"
#include "runtime/gpu/passes/material_tiles_pass.h"
#include "runtime/gpu/passes/page_request_pass.h"
#include "runtime/gpu/passes/pass_recorder.h"
#include "runtime/gpu/passes/pyramid_pass.h"
#include "runtime/gpu/passes/shading_pass.h"
#include "runtime/gpu/passes/shadow_pass.h"
#include "runtime/gpu/passes/skinning_pass.h"
#include "runtime/gpu/passes/word_copy_pass.h"
#include "runtime/gpu/post/post_pass.h"
#include "runtime/gpu/receivers/receiver_pass.h"
#include "runtime/gpu/scene/instance_motion.h"
#include "runtime/gpu/scene/light_change.h"

#include <array>
#include <memory>
#include <optional>
#include <set>

namespace hearth::gpu
{

/// Timestamps of a frame: one at the beginning and one after each pass. None is within a render pass, where
/// it would say little on tile-based GPUs and may keep subpasses from being merged: if shading follows the
/// visibility buffer in one render pass, the pass counts as shading.
enum FrameTimestamp : uint32_t
{
    kTimestampBegin,
    kTimestampShadows,         ///< includes the update of brick faces (GI); no time without both
    kTimestampCull,            ///< includes the skinning of the clusters found; so does the late phase
    kTimestampEarlyVisibility, ///< this pass and the two after it take no time without occlusion culling
    kTimestampPyramid,
    kTimestampLateCull,
    kTimestampVisibility,
    kTimestampMaterialTiles, ///< includes gathering (GI) and lights listed for pixels; no time without these
    kTimestampShading,       ///< includes bloom and the final pass
    kTimestampCount,
};

struct FrameInput
{
    shared::FrameView view; ///< from shared::makeFrameView, with the size of the targets
    ShadingSettings shading{};
    /// With kCullOcclusion: cull against an earlier frame's depth alone (OcclusionCulling::last_frame).
    bool occludes_by_last_frame = false;
    std::span<const InstanceMove> moves{}; ///< valid from this frame on; read while recording
    /// Poses of deformed instances, which start at rest. Valid from this frame on; read while recording.
    /// Poses that checkPose rejects are ignored.
    std::span<const InstancePose> poses{};
    /// Spheres of finer shadows for a scene with shadows, beside the spheres of its pack. All spheres of this
    /// frame; read while recording.
    std::span<const ShadowSphere> shadow_spheres{};
    /// Valid from this frame on; read while recording.
    std::span<const LightChange> lights{};
    /// Sky and sun, before `lights`. Valid from this frame on; read while recording.
    const DaylightChange* daylight = nullptr;
    /// Weights of lamps, which stay until they are set anew. Valid from this frame on; read while recording.
    std::span<const LampWeight> lamp_weights{};
    /// Emission scales of brick faces for a scene with bricks. All scales of this frame; read while
    /// recording. None for bricks with receivers, which follow the weights of instances that emit (asserted).
    std::span<const EmissionScale> emission{};
    /// Times that the frame gathers the indirect light of its pixels, at least 1; for a scene with bricks.
    /// More of them take the noise out of an image that no frames before it prepare.
    uint32_t gathers = 1;
    uint32_t color_image = 0; ///< of TargetOptions::colors, that the frame draws; 0 if they have none
    VkQueryPool timestamps = VK_NULL_HANDLE; ///< kTimestampCount queries, reset by the frame; or none
};

/// Support of PostSettings: all others are neutral.
enum class PostSupport : uint8_t
{
    none,
    in_tile, ///< exposure in stops and photo filter, in the shaders of materials
    /// Bloom, automatic exposure and outputs of another size as well, for which frames have a final pass:
    /// all that is shaded has pipelines for those, too. Linear colours in B10G11R11_UFLOAT where the device
    /// can draw to it and blend, else as `half`.
    packed,
    half, ///< the same in R16G16B16A16_SFLOAT: twice the bytes, for callers that read linear colours
};

struct RendererOptions
{
    std::optional<FrameWay> way{}; ///< none: chooseFrameWay
    MaterialTest materials = MaterialTest::depth;
    PostSupport post = PostSupport::none;
    /// Light methods with any LightPath. Their frames have MaterialTest::id and PostSupport::half, which the
    /// renderer has then.
    bool deferred = false;
    /// Frames leave FrameTargets::depth() to the caller. They have MaterialTest::id, which the renderer has
    /// then.
    bool keeps_depth = false;
    ReceiverUpdate receiver_update = ReceiverUpdate::compute;
    /// Functions of the game; or null: materials are as the pack has them.
    const MaterialShaders* material_shaders = nullptr;
    VkFormat color_format = kColorFormat; ///< of the images that frames show: one of colorFormats()
};

class Renderer
{
public:
    /// The described objects outlive the renderer, which outlives its scenes and targets. errors: device,
    /// device_failed.
    static Result<std::unique_ptr<Renderer>> create(const DeviceDescription& description,
                                                    const RendererOptions& options = {});

    const Device& device() const { return device_; }
    const DrawLayouts& layouts() const { return layouts_; }

    /// errors: device_limit, device_failed.
    Result<FrameTargets> createTargets(VkExtent2D extent, const TargetOptions& options = {}) const;

    FrameWay way() const { return passes_.way(); }
    bool keepsDepth() const { return passes_.keepsDepth(); }
    const ColorFormat& colorFormat() const { return *findColorFormat(passes_.colorFormat()); }
    bool hasFinalPasses() const { return passes_.hasFinalPasses(); }
    PostSupport postSupport() const { return post_support_; }
    /// True if frames may have a light method.
    bool supports(LightMethod method) const;

    /// Return the passes of a frame as `record` records them, or the parts of it. Shadow maps are those that
    /// are stale by the view and its moves: what the frame changes else does not count.
    FrameDescription describe(const Scene& scene, const FrameTargets& targets, const FrameInput& input,
                              bool in_parts = false) const;

    /// Upload a scene, see uploadScene. Also creates the pipelines that its materials and shadows need and no
    /// scene before needed.
    Result<std::unique_ptr<Scene>> upload(const formats::PackView& pack, VkCommandBuffer commands,
                                          const SceneOptions& options = {});

    /// Create the pipelines of a scene's materials for a light method that the renderer supports. Call before
    /// a frame that uses it; upload does so for LightMethod::practical. errors: device_failed.
    Status prepareLightMethod(Scene& scene, LightMethod method);

    /// Create the pipelines of the overdraw view. Call before a frame that shows it. errors: device_failed.
    Status prepareOverdraw();

    /// Record culling and drawing of one frame, outside a render pass. Clobbers compute and graphics state.
    /// Afterwards targets.color() can be copied from, and targets.visibility() if it is kept. The frame asks
    /// for no more than the targets' options allow. A frame with occlusion culling
    /// leaves its depth pyramid to the next frame with these targets, which must be submitted after it. For a
    /// streamed scene the frame is the one that SceneStream::beginFrame began; the stream scales its
    /// threshold.
    void record(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                const FrameInput& input) const;

    /// Record a frame in parts, so that the caller can put work between them: all three in this order, with
    /// the same arguments, each outside a render pass. partImages (frame_parts.h) returns the image states
    /// before and after each part. With few materials `record` draws in one render pass, these functions draw
    /// in two: on a tile-based GPU the visibility buffer leaves the tile once more.
    void recordCull(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                    const FrameInput& input) const;
    void recordVisibility(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                          const FrameInput& input) const;
    void recordMaterials(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                         const FrameInput& input) const;

    /// Record a count of what a frame with occludes_by_last_frame left out, after it and before the scene's
    /// next frame: clusters that the earlier frame's depth hid and this one's does not. They follow in the
    /// visible list from FrameCounters::early_clusters on. Clobbers compute state. Needs
    /// TargetOptions::counts_missing.
    void recordMissing(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets) const;

    /// Record page requests for a view without drawing. For a streamed scene, in place of record. Clobbers
    /// compute state, and leaves the depth pyramid as it is.
    void recordPrefetch(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                        const shared::FrameView& view, std::span<const InstanceMove> moves = {},
                        std::span<const InstancePose> poses = {}) const;

private:
    Renderer() = default;

    /// Passes that draw to the visibility buffer and shade it: their render passes differ by what is shaded.
    struct DrawPasses
    {
        BinPass visibility;
        std::optional<BinPass> overdraw;
        MaterialMarksPass material_marks;
        std::optional<MaterialMarksPass> normal_marks; ///< of outputs that sum lights
        ShadingPass shading;
        std::optional<AddLightsPass> add_lights;   ///< of outputs that store surfaces or sum lights
        std::optional<MarkLightsPass> mark_lights; ///< of outputs with bits of lights
    };
    Result<DrawPasses> createDrawPasses(ShadedOutput output) const;
    /// Create the passes of outputs that frames with a light path may have, unless they are there.
    Status prepareDraws(LightPath path);
    /// Constants of what pipelines that draw to an output write.
    StoredColor storedColor(ShadedOutput output) const;
    const DrawPasses& drawPasses(const PassRecorder& passes) const;

    Status prepareDeformed();
    Status prepareMotion(uint32_t motion);
    Status createShadows(const formats::PackView& pack, const ShadowOptions& options,
                         VkCommandBuffer commands, Scene& scene);
    void recordSkinning(VkCommandBuffer commands, const Scene& scene, uint32_t phase) const;
    void recordLightLists(VkCommandBuffer commands, const Scene& scene, const shared::FrameView& view,
                          const ShadingSettings& shading, PassRecorder& passes) const;
    void recordSlotLights(VkCommandBuffer commands, const Scene& scene, const ShadingSettings& shading,
                          PassRecorder& passes) const;
    void recordVisibleLights(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                             const ShadingSettings& shading, PassRecorder& passes) const;
    const ShadowPass& shadowPass(const Scene& scene) const;
    void recordShadows(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                       const shared::FrameView& view, std::span<const ShadowSphere> spheres,
                       PassRecorder& passes) const;
    void recordShadowMap(VkCommandBuffer commands, const Scene& scene, const SceneView& view,
                         const ShadowCache::LayerUpdate& map, PassRecorder& passes) const;
    Status createReceivers(const formats::PackView& pack, Scene& scene);
    void recordReceivers(VkCommandBuffer commands, const Scene& scene, const FrameInput& input) const;
    void recordBrickLight(VkCommandBuffer commands, const Scene& scene, WordCopies& copies,
                          const FrameInput& input, PassRecorder& passes) const;
    const FramePlan& plan(const Scene& scene, const FrameTargets& targets, const FrameInput& input,
                          bool in_parts) const;
    void recordCulled(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                      const FrameInput& input, PassRecorder& passes) const;
    void recordEarly(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                     const FrameInput& input, PassRecorder& passes) const;
    void recordVisible(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                       const FrameInput& input, PassRecorder& passes) const;
    void recordAheadOfShading(VkCommandBuffer commands, const Scene& scene, const FrameTargets& targets,
                              const FrameInput& input, PassRecorder& passes) const;
    void recordShaded(VkCommandBuffer commands, const Scene& scene, FrameTargets& targets,
                      const FrameInput& input, PassRecorder& passes) const;
    void recordPyramid(VkCommandBuffer commands, FrameTargets& targets, const FrameInput& input) const;
    void recordLastPyramid(VkCommandBuffer commands, FrameTargets& targets, PassRecorder& passes) const;
    void recordFinal(VkCommandBuffer commands, FrameTargets& targets, const ShadingSettings& shading,
                     PassRecorder& passes) const;
    void recordOverdraw(VkCommandBuffer commands, const Scene& scene, const BinPass& overdraw) const;

    Device device_;
    PostSupport post_support_ = PostSupport::none;
    DrawLayouts layouts_;
    FramePasses passes_;
    LightListsPass light_lists_;
    CullPass cull_;
    WordCopyPass copy_words_;
    PageRequestPass page_requests_;
    PyramidPass pyramid_;
    std::optional<ShadowPass> shadows_[2];      ///< by ShadowDepth; set once a scene has such shadows
    std::optional<BrickLightPass> brick_light_; ///< set once a scene has bricks
    std::optional<GatherPass> gather_;          ///< set once a scene has bricks
    ReceiverUpdate receiver_update_ = ReceiverUpdate::compute;
    const MaterialShaders* material_shaders_ = nullptr;
    std::set<uint32_t> motions_;            ///< of the game, that scenes use
    std::optional<ReceiverPass> receivers_; ///< set once a scene has receivers
    std::optional<SkinningPass> skinning_;  ///< set once a scene has deformed meshes
    MaterialTilesPass material_tiles_;
    /// [ShadedOutput]; set once a scene has a light method with it.
    std::array<std::optional<DrawPasses>, kShadedOutputCount> draws_;
    std::optional<PostPass> post_; ///< with final passes
};

} // namespace hearth::gpu
