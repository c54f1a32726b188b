// Layouts that passes share, of descriptor sets and of drawing pipelines: formats/gpu_shared/bindings.h
// has the numbers of their sets and bindings.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/specialization.h"
#include "runtime/gpu/vulkan/pipelines.h"

#include <array>

namespace hearth::gpu
{

/// Tables that the debug views of clusters read.
inline constexpr uint32_t kClusterViewTables[] = {shared::kTableFrame, shared::kTableInstances,
                                                  shared::kTableVisible, shared::kTableClusters,
                                                  shared::kTableGroups};

/// Stages of shared::BinPush and shared::ShadingPush.
inline constexpr VkShaderStageFlags kBinPushStages = VK_SHADER_STAGE_VERTEX_BIT;
inline constexpr VkShaderStageFlags kShadingPushStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// Values of the specialization constants of drawing, by id: shared::kConstant*.
using DrawConstants = std::array<uint32_t, shared::kConstantCount>;

struct DrawLayouts
{
    UniqueSetLayout scene;            ///< shared::kScene*
    UniqueSetLayout material;         ///< shared::kMaterialBlock, kMaterialTextures, kMaterialLayers
    UniqueSetLayout bins;             ///< shared::kBinsDraws
    UniqueSetLayout attachments;      ///< shared::kAttachment*
    UniqueSetLayout occlusion;        ///< shared::kOcclusion*: culling and pyramid passes
    UniqueSetLayout tiles;            ///< shared::kTiles*: material-tiles pass
    UniqueSetLayout cluster_view;     ///< kClusterViewTables
    UniqueSetLayout bricks;           ///< shared::kBricks*
    UniqueSetLayout fresh_light;      ///< shared::kFreshLight*
    UniqueSetLayout gather_point;     ///< shared::kGatherPoint*
    UniqueSetLayout gather;           ///< shared::kGatherView to kGatherTexels
    UniquePipelineLayout visibility;  ///< scene, material, bins; shared::BinPush
    UniquePipelineLayout shading;     ///< scene, material, attachments; shared::ShadingPush, as the next two
    UniquePipelineLayout clusters;    ///< cluster_view, attachments: debug views of clusters
    UniquePipelineLayout brick_views; ///< bricks: debug views of bricks

    /// visibility  type of kAttachmentVisibility: an input attachment, or an image with its sampler
    static Result<DrawLayouts> create(const Device& device, VkDescriptorType visibility);

private:
    Status createSceneSets(const Device& device);
    Status createFrameSets(const Device& device, VkDescriptorType visibility_type);
    Status createBrickSets(const Device& device);
    Status createPipelineLayouts(const Device& device);
};

} // namespace hearth::gpu
