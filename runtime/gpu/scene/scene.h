// Scene on the device: everything that drawing a pack needs and that does not change from frame to frame, and
// the work buffers of one frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "runtime/gpu/lights/light_method.h"
#include "runtime/gpu/lights/scene_lights.h"
#include "runtime/gpu/receivers/scene_receivers.h"
#include "runtime/gpu/scene/draw_layouts.h"
#include "runtime/gpu/scene/joined_sets.h"
#include "runtime/gpu/scene/pool_buffers.h"
#include "runtime/gpu/scene/scene_bricks.h"
#include "runtime/gpu/scene/scene_deformation.h"
#include "runtime/gpu/scene/scene_frames.h"
#include "runtime/gpu/scene/scene_layout.h"
#include "runtime/gpu/scene/scene_stream.h"
#include "runtime/gpu/scene/scene_surroundings.h"
#include "runtime/gpu/scene/shadow_plan.h"
#include "runtime/gpu/vulkan/mirrored_table.h"
#include "runtime/gpu/vulkan/uploader.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace hearth::gpu
{

struct SceneOptions
{
    /// Slots of the visible list, 8 bytes each. A frame with more clusters drops the last ones and counts
    /// them in FrameCounters::dropped_clusters. 4 Mi slots are half a gigatriangle, far above one per pixel.
    uint32_t max_visible_clusters = 1u << 22;

    /// Frames that are recorded before an earlier one has completed, 1 to kMaxFramesInFlight: everything that
    /// a frame changes exists once for each. A frame may be recorded once all but this many, less one, of the
    /// frames before it have completed.
    uint32_t frames_in_flight = 2;

    /// Bytes of geometry and textures on the device; `stream` loads pages and mips on demand, and
    /// memory moves between both (runtime/gpu/README.md, "Streaming"). 0: all is resident, geometry of
    /// at most 512 MiB.
    uint64_t memory_budget = 0;
    StreamOptions stream{};

    /// Slots of lights, up to shared::kMaxLights: the pack's, and more that frames fill. At least as many as
    /// the pack has.
    uint32_t max_lights = 128;

    ShadowOptions shadows{}; ///< none unless max_maps is set (runtime/gpu/README.md, "Shadows")

    DeformationOptions deformation{}; ///< for scenes with deformed meshes

    BrickOptions bricks{}; ///< for scenes with bricks

    /// Textures of compressed formats that the device cannot sample are decoded; else they are an error.
    bool decode_textures = false;

    const MaterialShaders* material_shaders = nullptr; ///< of the renderer, which sets it
    /// Transforms and poses of the step before are kept, for MotionPass: its tables take twice the memory.
    bool keeps_motion = false;
};

class SceneShadows;
class StreamedTextures;

/// Buffers of a scene that all frames share; the element types are in formats/gpu_shared.
struct SceneBuffers
{
    // constant
    Buffer materials, items, order, clusters, bins, group_items;
    // constant except for streaming
    Buffer groups;
    /// Mapped: rows of a page change while no frame draws it, or by a frame's commands.
    Buffer cluster_draws;
    PoolBuffers pool;
    Buffer proxies, proxy_positions, proxy_indices; ///< scenes whose proxies cast shadows only
    // rewritten by every culling phase, and read by compute shaders only
    Buffer states, results, totals;
};

/// Tables that a game changes from frame to frame.
struct SceneTables
{
    MirroredTable lighting, instances, inverses, bounds;
    uint32_t frame = 0;        ///< of Scene::frames: the one that is recorded, or was last
    bool keeps_motion = false; ///< as SceneOptions
    /// Number of the step, in which each camera with motion vectors has one frame at most: `instances` and
    /// the poses keep their state at the end of the step before.
    uint64_t step = 1;
};

/// Specialization of a material's shading pipeline: a scene has few different ones.
struct ShadingVariant
{
    uint32_t used_slices = shared::kPoolSlices; ///< of the geometry pool: 1 or all
    uint32_t textures = 0;                      ///< as shared::Material
    uint32_t uv_sets = 0;                       ///< as shared::Material
    uint32_t unlit = 0;
    uint32_t layers = 0;          ///< bits shared::kLayer*
    uint32_t deformed = 0;        ///< 1: used by deformed meshes
    uint32_t shadows = 0;         ///< 1: lights have shadow maps
    uint32_t filters_shadows = 0; ///< 1: the device filters their format
    uint32_t sky_visibility = 0;  ///< 1: used by meshes with sky visibility
    uint32_t bricks = 0;          ///< 1: the scene has bricks
    uint32_t receivers = 0;       ///< 1: the scene has receivers
    uint32_t local_probes = 0;    ///< 1: the scene has local probes
    uint32_t function = 0;        ///< MaterialBinding::function
    uint32_t motion = 0;          ///< MaterialBinding::motion
    uint32_t light_list = shared::kLightListCells;
    friend auto operator<=>(const ShadingVariant&, const ShadingVariant&) = default;
};

/// Pipelines of a variant; the shading pass owns them.
struct ShadingPipelines
{
    VkPipeline normals_pipeline = VK_NULL_HANDLE; ///< null: none are stored ahead of shading
    VkPipeline final_pipeline = VK_NULL_HANDLE;
    VkPipeline final_gi_pipeline =
        VK_NULL_HANDLE; ///< gathered light (GI) view; null in scenes without bricks
    VkPipeline debug_view_pipeline = VK_NULL_HANDLE;
};

/// Texture of a material.
struct SceneTexture
{
    uint32_t image; ///< of the pack, or behind them the white texel
    VkSampler sampler;
};

/// Row of the material table.
struct SceneMaterial
{
    /// One, or where textures are streamed one for each frame in flight: see materialSet().
    std::vector<VkDescriptorSet> sets;
    std::vector<SceneTexture> textures; ///< by slot: shared::kMaterialTextures
    ShadingVariant variant;
    /// [LightMethod][ShadedOutput]; empty unless the method is prepared.
    std::array<std::array<ShadingPipelines, kShadedOutputCount>, kLightMethodCount> pipelines;
};

/// Scene on the device. Submit its frames to one queue, in the order in which they were recorded.
struct Scene
{
    explicit Scene(const Device& device);
    ~Scene();

    MemoryArena arena;
    std::unique_ptr<Uploader> staging; ///< reset() after the upload commands have run
    SceneBuffers buffers;
    std::unique_ptr<SceneTables> tables;
    std::vector<SceneFrame> frames; ///< one for each frame in flight
    const SceneFrame& frame() const { return frames[tables->frame]; }
    std::unique_ptr<StreamedTextures> textures; ///< scenes with streamed textures only
    /// Per image of the pack, empty if no material uses it or it is streamed; then one white texel.
    std::vector<Image> images;
    bool decodes_textures = false; ///< as SceneOptions::decode_textures
    uint32_t decoded_textures = 0; ///< images that were decoded, since the device lacks their formats
    std::vector<UniqueSampler> samplers;
    UniqueDescriptorPool pool;
    std::vector<SceneMaterial> materials;    ///< rows of the material table
    std::unique_ptr<JoinedSets> joined_sets; ///< with ShadingDescriptors::one_set only
    std::unique_ptr<LitSets> lit_sets;       ///< once a method that stores surfaces is prepared

    std::unique_ptr<SceneStream> stream;             ///< streamed scenes only
    std::unique_ptr<SceneDeformation> deformation;   ///< scenes with deformed meshes only
    std::unique_ptr<SceneShadows> shadows;           ///< scenes with shadows only
    bool proxies_cast = false;                       ///< proxies of some meshes cast their shadows
    std::unique_ptr<SceneBricks> bricks;             ///< scenes with bricks only
    std::unique_ptr<SceneSurroundings> surroundings; ///< scenes with baked surroundings only
    std::unique_ptr<SceneReceivers> receivers;       ///< scenes with receivers only
    std::vector<SceneBin> bins;
    VertexMotions motions;                          ///< without the clusters
    std::vector<formats::InstanceRecord> instances; ///< as loaded
    uint32_t instance_count = 0;
    uint32_t item_count = 0;
    uint32_t group_item_count = 0; ///< streamed scenes only
    uint32_t slot_capacity = 0;
    uint32_t used_slices = shared::kPoolSlices; ///< 1 if the first slice holds all geometry
    Image shading_tables;                       ///< formats/gpu_shared/reflectance.h has their places
    Image sky_cube;                             ///< black if the sky has no image
    Image probe_atlas;                          ///< empty if the pack has no local probes
    Image specular_table;                       ///< empty if the pack has none, or has local probes
    uint32_t specular_spacing = 0;              ///< shared::kSpecularSpacing* of the table
    std::unique_ptr<SceneLights> lights;
    uint32_t dropped_lights = 0; ///< lights of the pack beyond shared::kMaxLights
    Box3 bounds;                 ///< world space, empty if there is nothing to draw
};

/// True if a mesh has sky visibility; otherwise the settings of sky occlusion have no effect.
inline bool hasSkyVisibility(const Scene& scene)
{
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const SceneMaterial& m) { return m.variant.sky_visibility != 0; });
}

/// Return the set of a material for the frame that is recorded.
inline VkDescriptorSet materialSet(const Scene& scene, size_t row)
{
    const std::vector<VkDescriptorSet>& sets = scene.materials[row].sets;
    return sets.size() == 1 ? sets.front() : sets[scene.tables->frame];
}

/// Call function(view) for each view of each frame.
template <typename Function>
void forEachView(Scene& scene, const Function& function)
{
    for (SceneFrame& frame : scene.frames)
    {
        function(frame.main);
        for (SceneView& view : frame.casters)
            function(view);
    }
}

/// Write the row of an instance, of a scene with receivers, to the buffer of lights.
inline void writeReceiverRow(const Scene& scene, uint32_t instance, const shared::ReceiverRow& row)
{
    scene.tables->lighting.write(scene.lights->layout().receivers + instance * VkDeviceSize{sizeof(row)},
                                 std::as_bytes(std::span(&row, 1)));
}

/// Number of work items of rigid instances, which come first.
inline uint32_t rigidItems(const Scene& scene)
{
    return scene.deformation == nullptr ? scene.item_count : scene.deformation->rigid_items;
}

/// Work items that one block of the scan covers.
inline uint32_t blockCount(const Scene& scene)
{
    return (scene.item_count + shared::kScanBlockItems - 1) / shared::kScanBlockItems;
}

/// Create and fill everything except objects that belong to a pass (descriptor sets, material pipelines).
/// Records copies into `commands`, which the caller submits and waits for before it resets `staging`. The
/// pack has been checked (pack::Pack); the pack of a streamed scene outlives it. errors: device_limit,
/// device_failed, streaming_budget, and the errors of reading pages and images.
Result<std::unique_ptr<Scene>> uploadScene(const Device& device, const DrawLayouts& layouts,
                                           const formats::PackView& pack, VkCommandBuffer commands,
                                           const SceneOptions& options);

/// Upload the images of the materials, and allocate one descriptor set per row of the material table. Needs
/// scene.pool and scene.used_slices.
/// bindings  of the pack's materials
Status uploadMaterials(const Device& device, const DrawLayouts& layouts, const formats::PackView& pack,
                       std::span<const MaterialBinding> bindings, Uploader& uploader, Scene& scene);

/// Write the textures of a material into a set of it.
void writeMaterialTextures(const Device& device, const Scene& scene, size_t row, VkDescriptorSet set);

/// Upload the tables that shading samples: specular reflectance, the sky, and specular occlusion of packs
/// that have it. Needs the draw sets.
Status uploadShadingTables(const Device& device, const formats::PackView& pack, Uploader& uploader,
                           Scene& scene);

} // namespace hearth::gpu
