// Playback in a window: one clip at a time, with a crossfade to a newly chosen clip, and the time of flicker.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/pose_player.h"

#include <optional>
#include <vector>

namespace hearth::viewer
{

/// Playback settings.
struct PlaybackSettings
{
    std::optional<uint32_t> clip{}; ///< animation of the pack; none: the scene is at rest
    bool playing = true;            ///< false: paused
    bool loop = true;               ///< false: stops at the end
    float speed = 1;                ///< seconds of clip and flicker per second; below 0 they run backwards
    float fade_seconds = 0.25f;     ///< duration of the crossfade to the next clip
    std::optional<double> go_to{};  ///< seconds of clip and flicker; applied once
};

class Playback
{
public:
    /// durations  of the animations of the pack, seconds
    /// start      initial clip, at any time
    /// seconds    initial time of flicker
    explicit Playback(std::vector<double> durations, std::optional<pack::ClipTime> start = std::nullopt,
                      double seconds = 0);

    /// Advance by a time step. A new clip begins at its start, or at its end if the speed is negative. It
    /// fades in unless it is paused or nothing was played before. Time continues from its present value: a
    /// clip that loops or stops is wrapped or clamped to its duration.
    void advance(PlaybackSettings& settings, double seconds);

    std::optional<pack::ClipTime> clip() const { return clip_; }
    /// Return the clip that is faded out; none: no crossfade.
    std::optional<pack::ClipTime> fadedClip() const { return faded_clip_; }
    double weight() const { return faded_clip_ ? weight_ : 1; } ///< of clip(), 0 to 1
    double duration(uint32_t clip) const { return durations_[clip]; }
    /// Return the time of flicker, which goes on where a clip loops, stops or gives way to another.
    double flickerSeconds() const { return flicker_seconds_; }

    /// Apply the current pose.
    void pose(pack::PosePlayer& player) const;

private:
    void choose(const PlaybackSettings& settings);
    void pass(const PlaybackSettings& settings, double seconds, std::optional<pack::ClipTime>& clip) const;

    std::vector<double> durations_;
    std::optional<pack::ClipTime> clip_;
    std::optional<pack::ClipTime> faded_clip_;
    double weight_ = 0;
    double flicker_seconds_ = 0;
};

/// Return the durations of all animations, as the constructor takes them.
std::vector<double> clipDurations(const formats::PackView& pack);

} // namespace hearth::viewer
