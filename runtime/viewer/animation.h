// Clips chosen on the command line, and the lights' flicker, played frame by frame.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/gpu/scene/instance_motion.h"
#include "runtime/gpu/scene/light_change.h"
#include "runtime/pack/light_player.h"
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
    std::optional<std::string> clip{};    ///< name or index; none: the scene is at rest
    std::optional<double> seconds{};      ///< of the clip and of flicker; none: their start
    std::optional<std::string> blended{}; ///< second clip
    double blended_seconds = 0;
    double weight = 0;       ///< of the second clip, 0 to 1
    double step_seconds = 0; ///< step of the clips and of flicker from frame to frame
};

/// Add the options --animation and --time; the settings outlive the command line.
void addClipOptions(CommandLine& command_line, AnimationSettings& settings);
/// Add --animation, --time, --time-step and --blend.
void addAnimationOptions(CommandLine& command_line, AnimationSettings& settings);

/// Return the clip and time of --animation and --time; none if no clip is named. errors: usage if the pack
/// has no such clip.
Result<std::optional<pack::ClipTime>> findClip(const AnimationSettings& settings,
                                               const formats::PackView& pack);

/// Moves and poses that a scene's next frame needs to show the pose of a player.
class FramePose
{
public:
    /// Read the pose of a player. errors: same as gpu::moveInstance.
    Status take(const pack::PosePlayer& player, const gpu::Scene& scene);

    /// Valid until the next pose is taken; refers to the player's data until the player's next pose.
    std::span<const gpu::InstanceMove> moves() const { return moves_; }
    std::span<const gpu::InstancePose> poses() const { return poses_; }

private:
    std::vector<gpu::InstanceMove> moves_;
    std::vector<gpu::InstancePose> poses_;
};

/// Changes that the lights of one scene need to show those of a player, until a frame takes them.
class FrameLights
{
public:
    /// Add the changes of the player's last update; at first all its lights, since the scene has those of the
    /// pack. Lights that the scene does not draw are left out. errors: same as gpu::changeLight.
    Status add(const pack::LightPlayer& player, const gpu::Scene& scene);

    std::span<const gpu::LightChange> changes() const { return changes_; }

    /// Forget the changes, which a recorded frame has.
    void clear() { changes_.clear(); }

private:
    bool is_first_ = true;
    std::vector<gpu::LightChange> changes_;
};

/// Plays the clips of the settings and flicker, for one pack, which outlives it.
class Animation
{
public:
    /// errors: usage if the pack has no such clip.
    static Result<Animation> create(const AnimationSettings& settings, const formats::PackView& pack);

    /// Go to the pose and the lights of a frame, counted from 0.
    void goTo(size_t frame);

    const pack::PosePlayer& player() const { return player_; }
    const pack::LightPlayer& lights() const { return lights_; }

    /// Compute the moves and poses of the scene's next frame. Valid until the next call of goTo or update.
    /// errors: same as gpu::moveInstance.
    Status update(const gpu::Scene& scene);
    std::span<const gpu::InstanceMove> moves() const { return pose_.moves(); }
    std::span<const gpu::InstancePose> poses() const { return pose_.poses(); }

private:
    explicit Animation(const formats::PackView& pack) : player_(pack), lights_(pack) {}

    std::optional<pack::ClipTime> clip_;
    std::optional<pack::ClipTime> blended_;
    double weight_ = 0;
    double flicker_seconds_ = 0;
    double step_seconds_ = 0;
    pack::PosePlayer player_;
    pack::LightPlayer lights_;
    FramePose pose_;
};

} // namespace hearth::viewer
