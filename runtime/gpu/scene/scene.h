// A scene on the device: everything that drawing a pack needs and that does not change from frame to frame, and the
// work buffers of one frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "runtime/gpu/scene/draw_layouts.h"
#include "runtime/gpu/scene/scene_bricks.h"
#include "runtime/gpu/scene/scene_deformation.h"
#include "runtime/gpu/scene/scene_layout.h"
#include "runtime/gpu/scene/scene_stream.h"
#include "runtime/gpu/scene/shadow_plan.h"
#include "runtime/gpu/vulkan/uploader.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace hearth::gpu
{

struct SceneOptions
{
    /// Slots of the visible list, 8 bytes each. A frame that finds more clusters leaves out the last ones and counts
    /// them in FrameCounters::dropped_clusters. 4 Mi slots are half a gigatriangle, far above one for every pixel.
    uint32_t max_visible_clusters = 1u << 22;

    /// Bytes of geometry that are on the device at once; more are streamed as `stream` says (runtime/gpu/README.md, "Streaming").
    /// 0: all of it, at most 512 MiB.
    uint64_t geometry_budget = 0;
    StreamOptions stream{};

    ShadowOptions shadows{}; ///< none unless max_maps is set (runtime/gpu/README.md, "Shadows")

    DeformationOptions deformation{}; ///< of a scene that has deformed meshes

    BrickOptions bricks{}; ///< of a scene that has them
};

class SceneShadows;

/// The types of the elements are those of formats/gpu_shared.
struct SceneBuffers
{
    // constant
    Buffer lighting, materials, instances, inverses, bounds, items, order, clusters, bins, group_items;
    // constant but for what is streamed
    Buffer groups, cluster_draws;
    std::array<Buffer, shared::kPoolSlices> pool;
    // rewritten by every frame
    Buffer frame, states, results, totals, counters, visible, bin_draws, material_draws, tile_draws,
        page_requests;
};

/// One descriptor set for each pipeline of the culling pass.
struct CullSets
{
    VkDescriptorSet instances, clusters, scan_blocks, scan_totals, emit_visible, emit_draws;
};

/// What of a material is compiled into its shading pipeline: a scene has few different ones.
struct ShadingVariant
{
    uint32_t used_slices = shared::kPoolSlices; ///< of the geometry pool: 1 or all
    uint32_t textures = 0;                      ///< as shared::Material
    uint32_t uv_sets = 0;                       ///< as shared::Material
    uint32_t unlit = 0;
    uint32_t deformed = 0;       ///< 1: it is on deformed meshes
    uint32_t shadows = 0;        ///< 1: lights have shadow maps
    uint32_t sky_visibility = 0; ///< 1: it is on meshes that say what they see of the sky
    uint32_t bricks = 0;         ///< 1: the scene has bricks
    friend auto operator<=>(const ShadingVariant&, const ShadingVariant&) = default;
};

/// Pipelines of the shading pass, which owns them.
struct ShadingPipelines
{
    VkPipeline final_view = VK_NULL_HANDLE;
    VkPipeline gathered_view = VK_NULL_HANDLE; ///< with the light of bricks, where the scene has them
    VkPipeline inspection = VK_NULL_HANDLE;
};

/// A row of the material table.
struct SceneMaterial
{
    VkDescriptorSet set = VK_NULL_HANDLE;
    ShadingVariant variant;
    ShadingPipelines pipelines;
};

/// Frames of one scene must not overlap on the GPU: submit them to one queue.
struct Scene
{
    explicit Scene(const Device& device);
    ~Scene();

    MemoryArena arena;
    std::unique_ptr<Uploader> staging; ///< reset() once the commands that loaded the scene have run
    SceneBuffers buffers;
    std::vector<Image>
        images; ///< for each image of the pack, empty where no material uses it; then one white texel
    std::vector<UniqueSampler> samplers;
    UniqueDescriptorPool pool;
    VkDescriptorSet draw_set = VK_NULL_HANDLE;
    VkDescriptorSet bins_set = VK_NULL_HANDLE;
    VkDescriptorSet inspection_set = VK_NULL_HANDLE;
    std::vector<SceneMaterial> materials; ///< the rows of the material table
    CullSets cull_sets{};
    VkDescriptorSet tile_set = VK_NULL_HANDLE;         ///< of the material-tiles pass
    VkDescriptorSet page_request_set = VK_NULL_HANDLE; ///< of a streamed scene

    std::unique_ptr<SceneStream> stream;           ///< of a streamed scene
    std::unique_ptr<SceneDeformation> deformation; ///< of a scene with deformed meshes
    std::unique_ptr<SceneShadows> shadows;         ///< of a scene with shadows
    std::unique_ptr<SceneBricks> bricks;           ///< of a scene that has them
    std::vector<SceneBin> bins;
    std::vector<formats::InstanceRecord> instances; ///< as they were loaded
    uint32_t instance_count = 0;
    uint32_t item_count = 0;
    uint32_t group_item_count = 0; ///< of a streamed scene
    uint32_t slot_capacity = 0;
    uint32_t used_slices = shared::kPoolSlices; ///< 1 where the first holds all geometry
    Image specular_table;                       ///< empty where the pack has none
    uint32_t specular_spacing = 0;              ///< shared::kSpecularSpacing* of the table
    std::vector<shared::Light> lights;          ///< those that are drawn, as they were loaded
    float exposure = 1;                         ///< of all lights
    uint32_t dropped_lights = 0;                ///< lights of the pack beyond shared::kMaxLights
    Box3 bounds;                                ///< world space, empty where there is nothing to draw
};

/// Whether a mesh says what it sees of the sky: else the settings of its occlusion do nothing.
inline bool hasSkyVisibility(const Scene& scene)
{
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const SceneMaterial& m) { return m.variant.sky_visibility != 0; });
}

/// The first ones of the work list.
inline uint32_t rigidItems(const Scene& scene)
{
    return scene.deformation == nullptr ? scene.item_count : scene.deformation->rigid_items;
}

/// Work items that the scan takes together.
inline uint32_t blockCount(const Scene& scene)
{
    return (scene.item_count + shared::kScanBlockItems - 1) / shared::kScanBlockItems;
}

/// Create and fill everything but what belongs to a pass (descriptor sets and the materials' pipelines); records copies
/// into `commands`, which the caller submits and waits for before it resets `staging`. The pack has been checked
/// (pack::Pack); that of a streamed scene outlives it.
/// errors: device_limit, device_failed, streaming_budget, those of reading pages and images.
Result<std::unique_ptr<Scene>> uploadScene(const Device& device, const DrawLayouts& layouts,
                                           const formats::PackView& pack, VkCommandBuffer commands,
                                           const SceneOptions& options);

/// The images of the materials, and one descriptor set for each row of the material table. Needs scene.pool and scene.used_slices.
Status uploadMaterials(const Device& device, const DrawLayouts& layouts, const formats::PackView& pack,
                       Uploader& uploader, Scene& scene);

/// Of packs that have one; needs scene.draw_set.
Status uploadSpecularTable(const Device& device, const formats::PackView& pack, Uploader& uploader,
                           Scene& scene);

} // namespace hearth::gpu
