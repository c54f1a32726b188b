// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/playback.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hearth::viewer
{

namespace
{

/// Wrap into [0, duration), or clamp to [0, duration] if the clip does not loop.
double withinClip(double seconds, double duration, bool loop)
{
    if (!loop || duration <= 0)
        return std::clamp(seconds, 0.0, duration);
    const double rest = std::fmod(seconds, duration);
    return rest < 0 ? rest + duration : rest;
}

} // namespace

Playback::Playback(std::vector<double> durations, std::optional<pack::ClipTime> start, double seconds)
    : durations_(std::move(durations)), clip_(start), flicker_seconds_(seconds)
{
}

void Playback::advance(PlaybackSettings& settings, double seconds)
{
    const bool same = clip_ ? settings.clip == clip_->animation : !settings.clip;
    if (!same)
        choose(settings);
    if (clip_ && settings.go_to)
        clip_->seconds = flicker_seconds_ = *settings.go_to;
    settings.go_to.reset();
    if (!settings.playing)
        return;
    flicker_seconds_ += seconds * static_cast<double>(settings.speed);
    pass(settings, seconds, clip_);
    pass(settings, seconds, faded_clip_);
    if (!faded_clip_)
        return;
    weight_ += seconds / static_cast<double>(settings.fade_seconds);
    if (weight_ >= 1)
        faded_clip_.reset();
}

void Playback::choose(const PlaybackSettings& settings)
{
    faded_clip_.reset();
    const bool fades = settings.clip && clip_ && settings.playing && settings.fade_seconds > 0;
    if (fades)
        faded_clip_ = clip_;
    weight_ = 0;
    clip_.reset();
    if (settings.clip)
        clip_ = pack::ClipTime{*settings.clip, settings.speed < 0 ? durations_[*settings.clip] : 0};
}

void Playback::pass(const PlaybackSettings& settings, double seconds,
                    std::optional<pack::ClipTime>& clip) const
{
    if (clip)
        clip->seconds = withinClip(clip->seconds + seconds * static_cast<double>(settings.speed),
                                   durations_[clip->animation], settings.loop);
}

void Playback::pose(pack::PosePlayer& player) const
{
    if (!clip_)
        player.rest();
    else if (faded_clip_)
        player.blend(*faded_clip_, *clip_, weight_);
    else
        player.play(*clip_);
}

std::vector<double> clipDurations(const formats::PackView& pack)
{
    std::vector<double> durations;
    for (const formats::AnimationRecord& animation : pack.animations())
        durations.push_back(static_cast<double>(animation.duration));
    return durations;
}

} // namespace hearth::viewer
