// The descriptor sets that the drawing passes share: set 0 the scene, set 1 a material, set 2 the visibility buffer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/pipelines.h"

namespace hearth::gpu
{

/// Bindings of set 0, as runtime/shaders/scene.glsl has them. Eight storage buffers in the vertex stage, seven in the
/// fragment stage.
enum SceneBinding : uint32_t
{
    kSceneFrame = 0,
    kSceneInstances = 1,
    kSceneVisible = 2,
    kSceneDraws = 3,
    kScenePool = 4, ///< and the three after it
    kSceneBinDraws = 8,
    kSceneLighting = 9,
    kSceneBindingCount = 10,
};

/// Bindings of the set that the culling passes have as set 1 and the pyramid pass as set 0.
enum OcclusionBinding : uint32_t
{
    kOcclusionViews = 0,
    kOcclusionPyramid = 1,
    kOcclusionDepth = 2,
};

/// Push constants of all drawing pipelines; the visibility pass reads only the bin.
struct DrawPush
{
    union
    {
        float depth;  ///< full-screen passes: material number / 65535
        uint32_t bin; ///< visibility pass
    };
    uint32_t shown_view = 0;
    float depth_scale = 1;
};

inline constexpr VkShaderStageFlags kDrawPushStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

struct DrawLayouts
{
    UniqueSetLayout scene;
    UniqueSetLayout material;
    UniqueSetLayout attachments;
    UniqueSetLayout occlusion;     ///< of the culling and pyramid passes, bindings OcclusionBinding
    UniquePipelineLayout pipeline; ///< of all drawing pipelines

    static Result<DrawLayouts> create(const Device& device);
};

} // namespace hearth::gpu
