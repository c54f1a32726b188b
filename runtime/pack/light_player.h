// Plays the lights of a pack: their clips, the nodes that move them, and flicker. Independent of Vulkan;
// formats/scene/animation.h and light_flicker.h define the results.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/pose_player.h"

#include <span>
#include <vector>

namespace hearth::pack
{

/// Light with the values that it has now.
struct PlayedLight
{
    uint32_t light = 0; ///< index in the pack
    formats::LightRecord record{};
    float steady_intensity = 0; ///< the record's, without flicker
};

/// Player of the lights of one checked pack, which must outlive it. Starts with the lights as the pack has
/// them, without flicker: a renderer draws them so without any change. Only the constructor allocates.
class LightPlayer
{
public:
    explicit LightPlayer(const formats::PackView& pack);

    /// Go to the lights of a pose, whose clips and node transforms are taken as they are.
    /// poses    player of the same pack
    /// seconds  time of the flicker, finite; it may run on where a clip loops
    void update(const PosePlayer& poses, double seconds);

    /// Return the lights that the last update changed, by rising index. Valid until the next one.
    std::span<const PlayedLight> changed() const { return {changed_.data(), changed_count_}; }

    /// Return all lights that clips or flicker may change, by rising index.
    std::span<const PlayedLight> lights() const { return current_; }

private:
    struct Source
    {
        bool is_moved;         ///< by clips, with its node
        Affine3d node_at_rest; ///< world_from_node
        Affine3d node_from_light;
    };
    void sampleClips(const PlayedClips& clips);
    PlayedLight lightNow(size_t i, std::span<const Affine3d> world_from_node, double seconds) const;

    formats::AnimationTables tables_;
    std::span<const formats::LightRecord> rest_;
    std::vector<formats::LightRecord> from_,
        to_;                      ///< of all lights; `from_` becomes what the clips make of them
    std::vector<Source> sources_; ///< for each of current_
    std::vector<PlayedLight> current_;
    std::vector<PlayedLight> changed_; ///< [current_.size()]
    size_t changed_count_ = 0;
};

} // namespace hearth::pack
