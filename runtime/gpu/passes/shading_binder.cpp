// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/passes/shading_binder.h"

namespace hearth::gpu
{

ShadingBinder::ShadingBinder(const Device& device, VkCommandBuffer commands, const DrawLayouts& layouts,
                             const Scene& scene, const FrameTargets& targets, LightPath path)
    : device_(device),
      commands_(commands),
      layouts_(layouts),
      scene_(scene),
      attachments_(targets.attachments(path))
{
    if (layouts.joinsSets())
        scene.joined_sets->setAttachments(device, scene.tables->frame, attachments_);
}

void ShadingBinder::bind(VkPipelineLayout layout, uint32_t number, VkDescriptorSet set) const
{
    device_.vk.vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, number, 1, &set, 0,
                                       nullptr);
}

void ShadingBinder::bindSurfaces() const
{
    // with joined sets any material's will do
    if (layouts_.joinsSets())
        return bindMaterial(0);
    bind(layout(), shared::kSetScene, scene_.frame().main.draw_set);
    bind(layout(), shared::kSetAttachments, attachments_.set);
}

void ShadingBinder::bindMaterial(size_t row) const
{
    if (layouts_.joinsSets())
        bind(layout(), kJoinedSet, scene_.joined_sets->material(scene_.tables->frame, row));
    else
        bind(layout(), shared::kSetMaterial, materialSet(scene_, row));
}

void ShadingBinder::bindClusters() const
{
    const VkPipelineLayout clusters = layouts_.clusters.get();
    if (layouts_.joinsSets())
        return bind(clusters, kJoinedSet, scene_.joined_sets->clusters(scene_.tables->frame));
    bind(clusters, shared::kSetTables, scene_.frame().cluster_view_set);
    bind(clusters, shared::kSetClusterAttachments, attachments_.set);
}

} // namespace hearth::gpu
