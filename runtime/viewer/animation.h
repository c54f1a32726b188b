// Clips as the command line asks for them, played frame by frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/instance_motion.h"
#include "runtime/pack/pose_player.h"
#include "runtime/viewer/command_line.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::viewer
{

struct AnimationSettings
{
    std::optional<std::string> clip; ///< by its name or number; none: the scene is at rest
    double seconds = 0;
    std::optional<std::string> blended; ///< a second one
    double blended_seconds = 0;
    double weight = 0;       ///< of the second clip, 0 to 1
    double step_seconds = 0; ///< that both go on by from frame to frame
};

/// The options --animation, --time, --time-step and --blend; the settings outlive the command line.
void addAnimationOptions(CommandLine& command_line, AnimationSettings& settings);

/// Plays what the settings say, of one pack, which outlives it.
class Animation
{
public:
    /// errors: usage, where the pack has no such clip.
    static Result<Animation> create(const AnimationSettings& settings, const formats::PackView& pack);

    /// Goes to the pose of a frame, counted from 0.
    void goTo(size_t frame);

    const pack::PosePlayer& player() const { return player_; }

    /// What the scene's next frame must be told to show the pose. Valid until the next call of either.
    /// errors: usage, where an instance turns into its mirror image.
    Status update(const gpu::Scene& scene);
    std::span<const gpu::InstanceMove> moves() const { return moves_; }
    std::span<const gpu::InstancePose> poses() const { return poses_; }

private:
    explicit Animation(const formats::PackView& pack) : player_(pack) {}

    std::optional<pack::ClipTime> clip_;
    std::optional<pack::ClipTime> blended_;
    double weight_ = 0;
    double step_seconds_ = 0;
    pack::PosePlayer player_;
    std::vector<gpu::InstanceMove> moves_;
    std::vector<gpu::InstancePose> poses_;
};

} // namespace hearth::viewer
