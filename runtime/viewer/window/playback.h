// Clips that play in a window: one at a time, and a clip that is chosen takes over from the one before little by little.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/pose_player.h"

#include <optional>
#include <vector>

namespace hearth::viewer
{

/// What a person sets about the clips.
struct PlaybackSettings
{
    std::optional<uint32_t> clip{}; ///< animation of the pack; none: the scene rests
    bool playing = true;            ///< false: it stands still
    bool loop = true;               ///< false: it rests at its end
    float speed = 1;                ///< seconds of the clip in a second; below 0 it runs backwards
    float fade_seconds = 0.25f;     ///< in which the next clip takes over
    std::optional<double> go_to{};  ///< seconds of the clip; taken once
};

class Playback
{
public:
    /// durations  of the animations of the pack, seconds
    /// start      the clip that is there at first, at any time
    explicit Playback(std::vector<double> durations, std::optional<pack::ClipTime> start = std::nullopt);

    /// Let so many seconds pass. A clip that is new begins where its speed leads away from, and fades in unless it stands still
    /// or nothing was played. Time goes on from wherever it is: a clip that loops or rests comes to within its duration.
    void advance(PlaybackSettings& settings, double seconds);

    std::optional<pack::ClipTime> clip() const { return clip_; }
    /// What it takes over from; none: it is there alone.
    std::optional<pack::ClipTime> leaving() const { return leaving_; }
    double weight() const { return leaving_ ? weight_ : 1; } ///< of clip(), 0 to 1
    double duration(uint32_t clip) const { return durations_[clip]; }

    /// The pose of now.
    void pose(pack::PosePlayer& player) const;

private:
    void choose(const PlaybackSettings& settings);
    void pass(const PlaybackSettings& settings, double seconds, std::optional<pack::ClipTime>& clip) const;

    std::vector<double> durations_;
    std::optional<pack::ClipTime> clip_;
    std::optional<pack::ClipTime> leaving_;
    double weight_ = 0;
};

/// Of all animations, as the constructor takes them.
std::vector<double> clipDurations(const formats::PackView& pack);

} // namespace hearth::viewer
