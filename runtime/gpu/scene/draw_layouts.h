// Descriptor set layouts that the drawing passes share: set 0 scene, set 1 material, set 2 input of the pass:
// bins, or the visibility buffer and its companions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/pipelines.h"

namespace hearth::gpu
{

/// Bindings of set 0, as in runtime/shaders/scene/scene.glsl. Seven storage buffers in the vertex stage, to
/// which each set 2 adds one, and eight in the fragment stage, which is the limit of the renderer.
enum SceneBinding : uint32_t
{
    kSceneFrame = 0,
    kSceneInstances = 1,
    kSceneVisible = 2,
    kSceneDraws = 3,
    /// First of four bindings; the last one holds the poses of deformed meshes.
    kScenePool = 4,
    kSceneLighting = 8,
    kSceneShadows = 9, ///< scenes with shadows only; so is the next one
    kSceneShadowMaps = 10,
    kSceneSpecularTable = 11, ///< one white texel in scenes without a table
    kSceneBindingCount = 12,
};

/// Bindings of set 2 of the shading pipelines.
enum AttachmentBinding : uint32_t
{
    kAttachmentVisibility = 0,
    kAttachmentTileLists = 1,
    kAttachmentGi = 2, ///< result of GatherPass, for frames with GI
};

/// Bindings of set 1 of the material-tiles pass.
enum TileBinding : uint32_t
{
    kTileVisibility = 0,
    kTileMaterials = 1,
    kTileLists = 2,
};

/// Bindings of set 0 of the cluster debug views; set 1 is the attachments set.
enum ClusterViewBinding : uint32_t
{
    kClusterViewFrame = 0,
    kClusterViewInstances = 1,
    kClusterViewVisible = 2,
    kClusterViewClusters = 3,
    kClusterViewGroups = 4,
};

/// Bindings of set 1 of the culling passes and set 0 of the pyramid pass.
enum OcclusionBinding : uint32_t
{
    kOcclusionViews = 0,
    kOcclusionPyramid = 1,
    kOcclusionDepth = 2,
};

/// Bindings of set 0 of the passes over bricks. Six storage buffers, which leaves two for each set 1.
enum BrickBinding : uint32_t
{
    kBrickFrame = 0, ///< shared::FrameView
    kBrickView = 1,  ///< shared::BrickView
    kBrickGroups = 2,
    kBrickBricks = 3,
    kBrickOpacity = 4,
    kBrickSurfaces = 5, ///< of the faces: albedo, emission, normals
    kBrickLighting = 6,
    kBrickLights = 7,
    kBrickBindingCount = 8,
};

/// Bindings of set 1 of the pass that chooses gather points; set 0 is the scene.
enum GatherPointBinding : uint32_t
{
    kGatherPointVisibility = 0,
    kGatherPointPoints = 1,
};

/// Bindings of set 1 of the gather passes; set 0 is the bricks.
enum GatherBinding : uint32_t
{
    kGatherView = 0,
    kGatherPoints = 1,
    kGatherHistory = 2, ///< points of the last frame
    kGatherTexels = 3,  ///< texels that shading reads
};

/// Push constants of all drawing pipelines; the visibility pass reads only the bin, shadow casters also the
/// next two.
struct DrawPush
{
    union
    {
        float depth = 0; ///< shading: material id / 65535
        uint32_t bin;    ///< visibility pass
    };
    uint32_t debug_view = 0;
    float depth_scale = 1;
    uint32_t light_row = 0; ///< casters: row of the ShadowBlock
    uint32_t map_index = 0;
    uint32_t sky_occlusion = 0; ///< shading: shared::skyOcclusionBits
};

/// Specialization constant 4 of the drawing pipelines: source of the vertices of deformed meshes
/// (runtime/shaders/scene/drawn_vertex.glsl).
enum DeformedVertices : uint32_t
{
    kRigid = 0,           ///< no deformed meshes
    kSkinnedOnDemand = 1, ///< skinned on demand by the shader that draws
    kPreSkinned = 2,      ///< pre-skinned as far as the scratch buffer has room
};

inline constexpr VkShaderStageFlags kDrawPushStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

struct DrawLayouts
{
    UniqueSetLayout scene;
    UniqueSetLayout material;
    UniqueSetLayout bins;         ///< one binding: draws of the bins, then draws of the late phase
    UniqueSetLayout attachments;  ///< bindings AttachmentBinding
    UniqueSetLayout occlusion;    ///< culling and pyramid passes, bindings OcclusionBinding
    UniqueSetLayout tiles;        ///< material-tiles pass, bindings TileBinding
    UniqueSetLayout cluster_view; ///< bindings ClusterViewBinding
    UniqueSetLayout bricks;       ///< bindings BrickBinding
    /// Two bindings: light of faces before the copy, positions of bricks.
    UniqueSetLayout fresh_light;
    UniqueSetLayout gather_point;     ///< bindings GatherPointBinding
    UniqueSetLayout gather;           ///< bindings GatherBinding
    UniquePipelineLayout visibility;  ///< sets scene, material, bins
    UniquePipelineLayout picture;     ///< sets scene, material, attachments
    UniquePipelineLayout clusters;    ///< debug views of clusters: their set, then attachments
    UniquePipelineLayout brick_views; ///< brick debug views: set bricks

    static Result<DrawLayouts> create(const Device& device);
};

} // namespace hearth::gpu
