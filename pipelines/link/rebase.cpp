// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/link/rebase.h"

#include "formats/codecs/channel_keys.h"
#include "formats/records/animation_paths.h"

namespace hearth::link
{

using namespace formats;

namespace
{

// Add an offset to an index. A damaged part can make these sums wrap. That is harmless: nothing is looked up
// with them before checkPack has checked the whole pack.
void addOffset(uint32_t& index, uint32_t by)
{
    if (index != kInvalidIndex)
        index += by;
}

void addOffset(Range& range, uint32_t by)
{
    range.first += by;
}

void addOffset(StringRef& text, uint32_t by)
{
    if (text.length > 0)
        text.offset += by;
}

void addOffset(TextureRef& texture, uint32_t by)
{
    addOffset(texture.image, by);
}

/// Return the start of the table that objects of the kind are in; 0 for an unknown kind.
uint32_t findOffset(ExtrasOwner owner, const TableOffsets& offsets)
{
    switch (owner)
    {
    case ExtrasOwner::node:
        return offsets.nodes;
    case ExtrasOwner::mesh:
        return offsets.meshes;
    case ExtrasOwner::material:
        return offsets.materials;
    case ExtrasOwner::camera:
        return offsets.cameras;
    case ExtrasOwner::light:
        return offsets.lights;
    case ExtrasOwner::skin:
        return offsets.skins;
    case ExtrasOwner::animation:
        return offsets.animations;
    case ExtrasOwner::asset:
    case ExtrasOwner::scene:
    case ExtrasOwner::file:
        return offsets.assets;
    }
    return 0;
}

} // namespace

void rebase(NodeRecord& node, const TableOffsets& offsets)
{
    addOffset(node.name, offsets.strings);
    addOffset(node.parent, offsets.nodes);
    addOffset(node.mesh, offsets.meshes);
    addOffset(node.skin, offsets.skins);
    addOffset(node.morph_weights, offsets.morph_weights);
}

void rebase(InstanceRecord& instance, const TableOffsets& offsets)
{
    addOffset(instance.mesh, offsets.meshes);
    addOffset(instance.node, offsets.nodes);
}

void rebase(CameraRecord& camera, const TableOffsets& offsets)
{
    addOffset(camera.name, offsets.strings);
    addOffset(camera.node, offsets.nodes);
}

void rebase(LightRecord& light, const TableOffsets& offsets)
{
    addOffset(light.name, offsets.strings);
    addOffset(light.node, offsets.nodes);
}

void rebase(ShadowSphereRecord& sphere, const TableOffsets& offsets)
{
    addOffset(sphere.node, offsets.nodes);
    addOffset(sphere.light, offsets.lights);
}

void rebase(ExtrasRecord& extras, const TableOffsets& offsets)
{
    addOffset(extras.index, findOffset(static_cast<ExtrasOwner>(extras.owner), offsets));
    addOffset(extras.json, offsets.strings);
}

void rebase(MaterialRecord& material, const TableOffsets& offsets)
{
    addOffset(material.name, offsets.strings);
    addOffset(material.base_color_texture, offsets.images);
    addOffset(material.metallic_roughness_texture, offsets.images);
    addOffset(material.normal_texture, offsets.images);
    addOffset(material.occlusion_texture, offsets.images);
    addOffset(material.emissive_texture, offsets.images);
}

void rebase(MaterialLayersRecord& layers, const TableOffsets& offsets)
{
    addOffset(layers.material, offsets.materials);
    for (TextureRef MaterialLayersRecord::*const texture : kLayerTextures)
        addOffset(layers.*texture, offsets.images);
}

void rebase(ImageRecord& image, const TableOffsets& offsets)
{
    addOffset(image.name, offsets.strings);
}

void rebase(SkinRecord& skin, const TableOffsets& offsets)
{
    addOffset(skin.name, offsets.strings);
    addOffset(skin.skeleton_root, offsets.nodes);
    addOffset(skin.joints, offsets.joints);
}

void rebase(JointRecord& joint, const TableOffsets& offsets)
{
    addOffset(joint.node, offsets.nodes);
}

void rebase(AnimationRecord& animation, const TableOffsets& offsets)
{
    addOffset(animation.name, offsets.strings);
    addOffset(animation.channels, offsets.channels);
    addOffset(animation.light_channels, offsets.channels);
}

void rebase(AnimationChannelRecord& channel, const TableOffsets& offsets)
{
    const bool of_light = kAnimationPaths[channel.path].of_light;
    addOffset(channel.target, of_light ? offsets.lights : offsets.nodes);
    addOffset(channel.first_time, offsets.keys);
    addOffset(channel.first_value, offsets.keys);
    if (isPacked(channel))
        addOffset(channel.first_word, offsets.key_words);
}

void rebase(MeshRecord& mesh, const TableOffsets& offsets)
{
    addOffset(mesh.name, offsets.mesh_strings);
    addOffset(mesh.levels, offsets.levels);
    addOffset(mesh.groups, offsets.groups);
    addOffset(mesh.clusters, offsets.clusters);
    addOffset(mesh.pages, offsets.pages);
}

void rebase(LevelRecord& level, const TableOffsets& offsets)
{
    addOffset(level.clusters, offsets.clusters);
}

void rebase(GroupRecord& group, const TableOffsets& offsets)
{
    addOffset(group.clusters, offsets.clusters);
    addOffset(group.page, offsets.pages);
}

void rebase(ClusterRecord& cluster, const TableOffsets& offsets)
{
    addOffset(cluster.material, offsets.materials);
    addOffset(cluster.page, offsets.pages);
    addOffset(cluster.group, offsets.groups);
    addOffset(cluster.refined_group, offsets.groups);
}

void rebase(PageRecord& page, const TableOffsets& offsets)
{
    page.offset += offsets.page_bytes;
    addOffset(page.mesh, offsets.meshes);
    addOffset(page.clusters, offsets.clusters);
    addOffset(page.parents, offsets.page_parents);
}

void rebase(AuthoredLevelRecord& level, const TableOffsets& offsets)
{
    addOffset(level.mesh, offsets.meshes);
    addOffset(level.name, offsets.mesh_strings);
}

void rebase(DeformedMeshRecord& mesh, const TableOffsets& offsets)
{
    addOffset(mesh.mesh, offsets.meshes);
    addOffset(mesh.skin, offsets.skins);
    addOffset(mesh.clusters, offsets.deformed_clusters);
}

void rebase(DeformedClusterRecord& cluster, const TableOffsets& offsets)
{
    addOffset(cluster.joints, offsets.cluster_joints);
}

void rebase(ProxyRecord& proxy, const TableOffsets& offsets)
{
    addOffset(proxy.mesh, offsets.meshes);
    addOffset(proxy.positions, offsets.proxy_positions);
    addOffset(proxy.indices, offsets.proxy_indices);
    addOffset(proxy.sections, offsets.proxy_sections);
    addOffset(proxy.bindings, offsets.proxy_bindings);
}

void rebase(ProxySectionRecord& section, const TableOffsets& offsets)
{
    addOffset(section.material, offsets.materials);
}

void rebase(SurroundingsRecord& surroundings, const TableOffsets& offsets)
{
    addOffset(surroundings.transfer, offsets.radiance_transfers);
}

void rebase(uint32_t& page_parent, const TableOffsets& offsets)
{
    addOffset(page_parent, offsets.pages);
}

} // namespace hearth::link
