// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/light_player.h"

#include "formats/base/assert.h"
#include "formats/scene/light_flicker.h"

#include <algorithm>
#include <cstring>

namespace hearth::pack
{

namespace
{

/// Return for each light 1 where a clip has a channel of it.
std::vector<uint8_t> findAnimatedLights(const formats::AnimationTables& tables, size_t light_count)
{
    std::vector<uint8_t> animated(light_count, 0);
    for (const formats::AnimationRecord& animation : tables.animations)
        for (const formats::AnimationChannelRecord& channel :
             tables.channels.subspan(animation.light_channels.first, animation.light_channels.count))
            animated[channel.target] = 1;
    return animated;
}

/// Compare all bytes: records have no padding.
bool equal(const formats::LightRecord& a, const formats::LightRecord& b)
{
    return std::memcmp(&a, &b, sizeof(a)) == 0;
}

} // namespace

LightPlayer::LightPlayer(const formats::PackView& pack)
    : tables_(formats::animationTables(pack)),
      rest_(pack.lights()),
      from_(rest_.begin(), rest_.end()),
      to_(from_)
{
    const std::vector<uint32_t> parents_first = formats::nodesParentsFirst(tables_.nodes);
    std::vector<Affine3d> world_from_node(tables_.nodes.size());
    formats::poseNodes(tables_, formats::restPose(tables_), parents_first, world_from_node);
    const std::vector<uint8_t> moved = formats::findAnimatedNodes(tables_, parents_first);
    const std::vector<uint8_t> animated = findAnimatedLights(tables_, rest_.size());
    for (uint32_t i = 0; i < rest_.size(); ++i)
    {
        const formats::LightRecord& light = rest_[i];
        const bool is_moved = moved[light.node] != 0;
        if (!is_moved && animated[i] == 0 && light.flicker_amplitude == 0)
            continue;
        const Affine3d& node_at_rest = world_from_node[light.node];
        sources_.push_back(
            {is_moved, node_at_rest, formats::nodeFromObject(node_at_rest, light.world_from_light)});
        current_.push_back({i, light, light.intensity});
    }
    changed_.resize(current_.size());
}

/// Write the lights that the clips make to from_.
void LightPlayer::sampleClips(const PlayedClips& clips)
{
    const auto sample = [&](const ClipTime& clip, std::vector<formats::LightRecord>& lights)
    { formats::sampleLights(tables_, tables_.animations[clip.animation], clip.seconds, lights); };
    std::copy(rest_.begin(), rest_.end(), from_.begin());
    if (clips.from)
        sample(*clips.from, from_);
    if (!clips.to)
        return;
    std::copy(rest_.begin(), rest_.end(), to_.begin());
    sample(*clips.to, to_);
    formats::blendLights(from_, to_, clips.weight, from_);
}

/// Return a light. If its transform does not fit into floats, it stays where it was. With its node at rest it
/// has the pack's transform to the bit: renderers may know what such a light's surroundings give back.
PlayedLight LightPlayer::lightNow(size_t i, std::span<const Affine3d> world_from_node, double seconds) const
{
    formats::LightRecord light = from_[current_[i].light];
    const float steady_intensity = light.intensity;
    const Source& source = sources_[i];
    if (source.is_moved && !(world_from_node[light.node] == source.node_at_rest))
    {
        const auto moved = narrowed(world_from_node[light.node] * source.node_from_light);
        light.world_from_light = moved ? *moved : current_[i].record.world_from_light;
    }
    light.intensity = static_cast<float>(double{light.intensity} * formats::flickerFactor(light, seconds));
    return {current_[i].light, light, steady_intensity};
}

void LightPlayer::update(const PosePlayer& poses, double seconds)
{
    HEARTH_RUNTIME_ASSERT(poses.worldFromNode().size() == tables_.nodes.size());
    sampleClips(poses.clips());
    changed_count_ = 0;
    for (size_t i = 0; i < current_.size(); ++i)
    {
        const PlayedLight light = lightNow(i, poses.worldFromNode(), seconds);
        if (equal(light.record, current_[i].record))
            continue;
        current_[i] = light;
        changed_[changed_count_++] = current_[i];
    }
}

} // namespace hearth::pack
