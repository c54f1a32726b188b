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

/// Values of the constants that say what an image holds of a colour.
struct StoredColor
{
    uint32_t stored = shared::kStoredDisplay; ///< shared::kConstantStored
    uint32_t encodes = 0;                     ///< shared::kConstantEncodes
};

/// Set the constants of pipelines that draw such colours.
inline void setStoredColor(DrawConstants& constants, const StoredColor& color)
{
    constants[shared::kConstantStored] = color.stored;
    constants[shared::kConstantEncodes] = color.encodes;
}

/// Descriptors by which shading gets what it reads.
struct ShadingDescriptors
{
    /// Type of kAttachmentVisibility: an input attachment, or an image with its sampler.
    VkDescriptorType visibility = VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT;
    /// The sets of a shading pipeline are joined to one: see joined_sets.h.
    bool one_set = false;
    /// Shading may read shared::kLightImages images that lights have been added to, or marked in.
    bool has_light_images = false;
};

/// Number of the set that shading has in place of all others, with ShadingDescriptors::one_set.
inline constexpr uint32_t kJoinedSet = 0;

/// Bindings of the sets of shading.
struct ShadingBindings
{
    std::vector<SetBinding> scene;         ///< shared::kScene*
    std::vector<SetBinding> material;      ///< shared::kMaterial*
    std::vector<SetBinding> attachments;   ///< shared::kAttachment*
    std::vector<SetBinding> cluster_views; ///< kClusterViewTables
    std::vector<SetBinding> visibility; ///< shared::kAttachmentVisibility, all that cluster views read beside
};
ShadingBindings shadingBindings(const ShadingDescriptors& descriptors);

/// Return the bindings of pipelines that light stored surfaces: some of the scene, then kLitImages images.
/// image  type of the stored surfaces; the depth is an input attachment
std::vector<SetBinding> litBindings(VkDescriptorType image);
inline constexpr size_t kLitImages = 2;

struct DrawLayouts
{
    UniqueSetLayout scene;             ///< shared::kScene*
    UniqueSetLayout material;          ///< shared::kMaterialBlock, kMaterialTextures, kMaterialLayers
    UniqueSetLayout bins;              ///< shared::kBinsDraws
    UniqueSetLayout attachments;       ///< shared::kAttachment*
    UniqueSetLayout occlusion;         ///< shared::kOcclusion*: culling and pyramid passes
    UniqueSetLayout tiles;             ///< shared::kTiles*: material-tiles pass
    UniqueSetLayout cluster_view;      ///< kClusterViewTables
    UniqueSetLayout joined_shading;    ///< scene, material, attachments; with ShadingDescriptors::one_set
    UniqueSetLayout joined_clusters;   ///< cluster_view and visibility buffer; with the same
    UniqueSetLayout lit;               ///< litBindings
    UniqueSetLayout lights;            ///< shared::kLights*: passes that list or count lights
    UniqueSetLayout pixels;            ///< shared::kPixels*: those of them that go over pixels, picks, motion
    UniqueSetLayout bricks;            ///< shared::kBricks*
    UniqueSetLayout fresh_light;       ///< shared::kFreshLight*
    UniqueSetLayout gather_point;      ///< shared::kGatherPoint*
    UniqueSetLayout gather;            ///< shared::kGatherView to kGatherTexels
    UniqueSetLayout post;              ///< shared::kPost*
    UniqueSetLayout post_input;        ///< shared::kPostRadiance as an input attachment
    UniqueSetLayout temporal;          ///< shared::kTemporal*
    UniquePipelineLayout visibility;   ///< scene, material, bins; shared::BinPush
    UniquePipelineLayout shading;      ///< scene, material, attachments; shared::ShadingPush, as the next two
    UniquePipelineLayout clusters;     ///< cluster_view, attachments: debug views of clusters
    UniquePipelineLayout brick_views;  ///< bricks: debug views of bricks
    UniquePipelineLayout lit_surfaces; ///< lit: lights of stored surfaces
    ShadingDescriptors descriptors;

    static Result<DrawLayouts> create(const Device& device, const ShadingDescriptors& descriptors);

    /// True with ShadingDescriptors::one_set.
    bool joinsSets() const { return joined_shading.get() != VK_NULL_HANDLE; }

private:
    Status createShadingSets(const Device& device);
    Status createFrameSets(const Device& device);
    Status createBrickSets(const Device& device);
    Status createPipelineLayouts(const Device& device);
};

} // namespace hearth::gpu
