// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/joined_sets.h"

#include "runtime/gpu/scene/scene.h"

namespace hearth::gpu
{

namespace
{

/// Add the descriptors of `sets` sets with these bindings.
void addSizes(std::span<const SetBinding> bindings, uint32_t sets, DescriptorPoolSizes& sizes)
{
    for (const SetBinding& binding : bindings)
        (binding.type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER           ? sizes.uniforms
         : binding.type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER         ? sizes.storages
         : binding.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER ? sizes.textures
                                                                     : sizes.inputs) += sets;
}

} // namespace

Result<std::unique_ptr<JoinedSets>> JoinedSets::create(const Device& device, const DrawLayouts& layouts,
                                                       const Scene& scene)
{
    auto joined = std::make_unique<JoinedSets>();
    joined->bindings_ = shadingBindings(layouts.descriptors);
    const ShadingBindings& bindings = joined->bindings_;
    const auto frames = static_cast<uint32_t>(scene.frames.size());
    const uint32_t material_sets = frames * static_cast<uint32_t>(scene.materials.size());
    DescriptorPoolSizes sizes;
    addSizes(bindings.scene, material_sets, sizes);
    addSizes(bindings.material, material_sets, sizes);
    addSizes(bindings.attachments, material_sets, sizes);
    addSizes(bindings.cluster_views, frames, sizes);
    addSizes(bindings.visibility, frames, sizes);
    HEARTH_ASSIGN_OR_RETURN(joined->pool_, createDescriptorPool(device, material_sets + frames, sizes));

    DescriptorCopier copier;
    for (const SceneFrame& frame : scene.frames)
    {
        Frame sets;
        const size_t number = joined->frames_.size();
        for (const SceneMaterial& material : scene.materials)
        {
            HEARTH_ASSIGN_OR_RETURN(const VkDescriptorSet set,
                                    allocateSet(device, joined->pool_.get(), layouts.joined_shading.get()));
            copier.copy(frame.main.draw_set, set, bindings.scene);
            copier.copy(material.sets[std::min(number, material.sets.size() - 1)], set, bindings.material);
            sets.materials.push_back(set);
        }
        HEARTH_ASSIGN_OR_RETURN(sets.clusters,
                                allocateSet(device, joined->pool_.get(), layouts.joined_clusters.get()));
        copier.copy(frame.cluster_view_set, sets.clusters, bindings.cluster_views);
        joined->frames_.push_back(std::move(sets));
    }
    copier.write(device);
    return joined;
}

void JoinedSets::setMaterial(const Device& device, uint32_t frame, size_t row, VkDescriptorSet material)
{
    DescriptorCopier copier;
    copier.copy(material, frames_[frame].materials[row], bindings_.material);
    copier.write(device);
}

void JoinedSets::setScene(const Device& device, uint32_t frame, VkDescriptorSet scene)
{
    DescriptorCopier copier;
    for (const VkDescriptorSet set : frames_[frame].materials)
        copier.copy(scene, set, bindings_.scene);
    copier.write(device);
}

void JoinedSets::setAttachments(const Device& device, uint32_t frame, const AttachmentSet& attachments)
{
    Frame& sets = frames_[frame];
    if (sets.targets.lock() == attachments.targets)
        return;
    DescriptorCopier copier;
    for (const VkDescriptorSet set : sets.materials)
        copier.copy(attachments.set, set, bindings_.attachments);
    copier.copy(attachments.set, sets.clusters, bindings_.visibility);
    copier.write(device);
    sets.targets = attachments.targets;
}

Result<std::unique_ptr<LitSets>> LitSets::create(const Device& device, const DrawLayouts& layouts,
                                                 const Scene& scene)
{
    auto sets = std::make_unique<LitSets>();
    const VkDescriptorType image_type = layouts.descriptors.visibility;
    sets->has_subpasses_ = image_type == VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT;
    const std::vector<SetBinding> bindings = litBindings(image_type);
    const std::span copied = std::span(bindings).first(bindings.size() - kLitImages);
    const auto frames = static_cast<uint32_t>(scene.frames.size());
    DescriptorPoolSizes sizes;
    addSizes(bindings, frames, sizes);
    HEARTH_ASSIGN_OR_RETURN(sets->pool_, createDescriptorPool(device, frames, sizes));
    DescriptorCopier copier;
    for (const SceneFrame& frame : scene.frames)
    {
        Frame& added = sets->frames_.emplace_back();
        HEARTH_ASSIGN_OR_RETURN(added.set, allocateSet(device, sets->pool_.get(), layouts.lit.get()));
        copier.copy(frame.main.draw_set, added.set, copied);
    }
    copier.write(device);
    return sets;
}

void LitSets::setImages(const Device& device, uint32_t frame, const LitImages& images)
{
    Frame& held = frames_[frame];
    if (held.targets.lock() == images.targets)
        return;
    DescriptorWriter writer(held.set);
    writer.input(shared::kAttachmentDepth, images.depth, kReadOnlyDepth);
    if (has_subpasses_)
        writer.input(shared::kAttachmentSurfaces, images.surfaces);
    else
        writer.texture(shared::kAttachmentSurfaces, images.surfaces, images.sampler);
    writer.write(device);
    held.targets = images.targets;
}

} // namespace hearth::gpu
