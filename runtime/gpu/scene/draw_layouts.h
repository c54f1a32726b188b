// The descriptor sets that the drawing passes share: set 0 the scene, set 1 a material, set 2 what is drawn: bins, or
// what the pixels of the visibility buffer show.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/vulkan/pipelines.h"

namespace hearth::gpu
{

/// Bindings of set 0, as runtime/shaders/scene/scene.glsl has them. Seven storage buffers in the vertex stage, to which each
/// set 2 adds one, and eight in the fragment stage: as many as the renderer may have.
enum SceneBinding : uint32_t
{
    kSceneFrame = 0,
    kSceneInstances = 1,
    kSceneVisible = 2,
    kSceneDraws = 3,
    kScenePool = 4, ///< and the three after it, of which the last holds the poses of deformed meshes
    kSceneLighting = 8,
    kSceneShadows = 9, ///< of scenes with shadows, as the next one
    kSceneShadowMaps = 10,
    kSceneSpecularTable = 11, ///< one white texel in scenes without a table
    kSceneBindingCount = 12,
};

/// Bindings of set 2 of the picture's pipelines.
enum AttachmentBinding : uint32_t
{
    kAttachmentVisibility = 0,
    kAttachmentTileLists = 1,
    kAttachmentGathered = 2, ///< what GatherPass left, for pictures with the light of bricks
};

/// Bindings of the set that the material-tiles pass has as set 1.
enum TileBinding : uint32_t
{
    kTileVisibility = 0,
    kTileMaterials = 1,
    kTileLists = 2,
};

/// Bindings of the set that the views of clusters have as set 0; set 1 is the attachments'.
enum InspectionBinding : uint32_t
{
    kInspectionFrame = 0,
    kInspectionInstances = 1,
    kInspectionVisible = 2,
    kInspectionClusters = 3,
    kInspectionGroups = 4,
};

/// Bindings of the set that the culling passes have as set 1 and the pyramid pass as set 0.
enum OcclusionBinding : uint32_t
{
    kOcclusionViews = 0,
    kOcclusionPyramid = 1,
    kOcclusionDepth = 2,
};

/// Bindings of the set of a scene with bricks, which the passes over them have as set 0. Six storage buffers: two are left
/// to each set 1.
enum BrickBinding : uint32_t
{
    kBrickFrame = 0, ///< the FrameView
    kBrickView = 1,  ///< shared::BrickView
    kBrickGroups = 2,
    kBrickBricks = 3,
    kBrickOpacity = 4,
    kBrickSurfaces = 5, ///< of the faces: albedo, emission, normals
    kBrickLighting = 6,
    kBrickLights = 7,
    kBrickBindingCount = 8,
};

/// Bindings of the set with which points for the gathering are found: set 1, behind the scene.
enum GatherPointBinding : uint32_t
{
    kGatherPointVisibility = 0,
    kGatherPointPoints = 1,
};

/// Bindings of the set with which light is gathered: set 1, behind the bricks.
enum GatherBinding : uint32_t
{
    kGatherView = 0,
    kGatherPoints = 1,
    kGatherBefore = 2, ///< those of the frame before
    kGatherTexels = 3, ///< what shading reads
};

/// Push constants of all drawing pipelines; the visibility pass reads only the bin, casters that and two more.
struct DrawPush
{
    union
    {
        float depth = 0; ///< picture: material number / 65535
        uint32_t bin;    ///< visibility pass
    };
    uint32_t shown_view = 0;
    float depth_scale = 1;
    uint32_t light_row = 0; ///< casters: of the ShadowBlock
    uint32_t map_index = 0;
    uint32_t sky_occlusion = 0; ///< picture: shared::skyOcclusionBits
};

/// Specialization constant 4 of the drawing pipelines: where the vertices of deformed meshes come from
/// (runtime/shaders/scene/drawn_vertex.glsl).
enum DeformedVertices : uint32_t
{
    kRigid = 0,             ///< there are none
    kDeformedHere = 1,      ///< skinned where they are drawn
    kDeformedInScratch = 2, ///< skinned before, as far as there was room
};

inline constexpr VkShaderStageFlags kDrawPushStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

struct DrawLayouts
{
    UniqueSetLayout scene;
    UniqueSetLayout material;
    UniqueSetLayout bins;        ///< one binding: the draws of the bins, behind them those of the late phase
    UniqueSetLayout attachments; ///< bindings AttachmentBinding
    UniqueSetLayout occlusion;   ///< of the culling and pyramid passes, bindings OcclusionBinding
    UniqueSetLayout tiles;       ///< of the material-tiles pass, bindings TileBinding
    UniqueSetLayout inspection;  ///< bindings InspectionBinding
    UniqueSetLayout bricks;      ///< bindings BrickBinding
    UniqueSetLayout
        fresh_light; ///< two bindings: light of faces before it is copied to where it is read, places of bricks
    UniqueSetLayout gather_point;     ///< bindings GatherPointBinding
    UniqueSetLayout gather;           ///< bindings GatherBinding
    UniquePipelineLayout visibility;  ///< sets scene, material, bins
    UniquePipelineLayout picture;     ///< sets scene, material, attachments
    UniquePipelineLayout clusters;    ///< of the views of clusters: sets inspection, attachments
    UniquePipelineLayout brick_views; ///< of the views of bricks: set bricks

    static Result<DrawLayouts> create(const Device& device);
};

} // namespace hearth::gpu
