// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/link/rebase.h"

#include "formats/codecs/channel_keys.h"

namespace hearth::link
{

using namespace formats;

namespace
{

// Add an offset to an index. A damaged part can make these sums wrap. That is harmless: nothing is looked up
// with them before checkPack has checked the whole pack.
void shift(uint32_t& index, uint32_t by)
{
    if (index != kNone)
        index += by;
}

void shift(Range& range, uint32_t by)
{
    range.first += by;
}

void shift(StringRef& text, uint32_t by)
{
    if (text.length > 0)
        text.offset += by;
}

void shift(TextureRef& texture, uint32_t by)
{
    shift(texture.image, by);
}

} // namespace

void rebase(NodeRecord& node, const Offsets& offsets)
{
    shift(node.name, offsets.strings);
    shift(node.parent, offsets.nodes);
    shift(node.mesh, offsets.meshes);
    shift(node.skin, offsets.skins);
    shift(node.morph_weights, offsets.morph_weights);
}

void rebase(InstanceRecord& instance, const Offsets& offsets)
{
    shift(instance.mesh, offsets.meshes);
    shift(instance.node, offsets.nodes);
}

void rebase(CameraRecord& camera, const Offsets& offsets)
{
    shift(camera.name, offsets.strings);
    shift(camera.node, offsets.nodes);
}

void rebase(LightRecord& light, const Offsets& offsets)
{
    shift(light.name, offsets.strings);
    shift(light.node, offsets.nodes);
}

void rebase(ShadowSphereRecord& sphere, const Offsets& offsets)
{
    shift(sphere.node, offsets.nodes);
    shift(sphere.light, offsets.lights);
}

void rebase(MaterialRecord& material, const Offsets& offsets)
{
    shift(material.name, offsets.strings);
    shift(material.base_color_texture, offsets.images);
    shift(material.metallic_roughness_texture, offsets.images);
    shift(material.normal_texture, offsets.images);
    shift(material.occlusion_texture, offsets.images);
    shift(material.emissive_texture, offsets.images);
}

void rebase(ImageRecord& image, const Offsets& offsets)
{
    shift(image.name, offsets.strings);
}

void rebase(SkinRecord& skin, const Offsets& offsets)
{
    shift(skin.name, offsets.strings);
    shift(skin.skeleton_root, offsets.nodes);
    shift(skin.joints, offsets.joints);
}

void rebase(JointRecord& joint, const Offsets& offsets)
{
    shift(joint.node, offsets.nodes);
}

void rebase(AnimationRecord& animation, const Offsets& offsets)
{
    shift(animation.name, offsets.strings);
    shift(animation.channels, offsets.channels);
}

void rebase(AnimationChannelRecord& channel, const Offsets& offsets)
{
    shift(channel.node, offsets.nodes);
    shift(channel.first_time, offsets.keys);
    shift(channel.first_value, offsets.keys);
    if (isPacked(channel))
        shift(channel.first_word, offsets.key_words);
}

void rebase(MeshRecord& mesh, const Offsets& offsets)
{
    shift(mesh.name, offsets.mesh_strings);
    shift(mesh.levels, offsets.levels);
    shift(mesh.groups, offsets.groups);
    shift(mesh.clusters, offsets.clusters);
    shift(mesh.pages, offsets.pages);
}

void rebase(LevelRecord& level, const Offsets& offsets)
{
    shift(level.clusters, offsets.clusters);
}

void rebase(GroupRecord& group, const Offsets& offsets)
{
    shift(group.clusters, offsets.clusters);
    shift(group.page, offsets.pages);
}

void rebase(ClusterRecord& cluster, const Offsets& offsets)
{
    shift(cluster.material, offsets.materials);
    shift(cluster.page, offsets.pages);
    shift(cluster.group, offsets.groups);
    shift(cluster.refined_group, offsets.groups);
}

void rebase(PageRecord& page, const Offsets& offsets)
{
    page.offset += offsets.page_bytes;
    shift(page.mesh, offsets.meshes);
    shift(page.clusters, offsets.clusters);
    shift(page.parents, offsets.page_parents);
}

void rebase(AuthoredLevelRecord& level, const Offsets& offsets)
{
    shift(level.mesh, offsets.meshes);
    shift(level.name, offsets.mesh_strings);
}

void rebase(DeformedMeshRecord& mesh, const Offsets& offsets)
{
    shift(mesh.mesh, offsets.meshes);
    shift(mesh.skin, offsets.skins);
    shift(mesh.clusters, offsets.deformed_clusters);
}

void rebase(DeformedClusterRecord& cluster, const Offsets& offsets)
{
    shift(cluster.joints, offsets.cluster_joints);
}

void rebase(uint32_t& page_parent, const Offsets& offsets)
{
    shift(page_parent, offsets.pages);
}

} // namespace hearth::link
