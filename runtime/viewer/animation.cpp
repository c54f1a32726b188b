// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/animation.h"

#include "runtime/viewer/command_line.h"
#include "runtime/viewer/text.h"

namespace hearth::viewer
{

namespace
{

/// Format a list of clips: "'Walk', 'Run', 2".
std::string listClips(const formats::PackView& pack)
{
    std::string text;
    for (size_t i = 0; i < pack.animations().size(); ++i)
    {
        const std::string_view name = pack.text(pack.animations()[i].name);
        text += (i > 0 ? ", " : "") + (name.empty() ? std::to_string(i) : quoted(name));
    }
    return text.empty() ? "none" : text;
}

Result<pack::ClipTime> findClipTime(const std::string& name, double seconds, const formats::PackView& pack)
{
    const auto animation = pack::findAnimation(pack, name);
    if (!animation)
        return Error{Issue::usage, pack.name(), "",
                     "no animation " + quoted(name) + "; the pack has " + listClips(pack)};
    return pack::ClipTime{*animation, seconds};
}

pack::ClipTime after(pack::ClipTime clip, double seconds)
{
    clip.seconds += seconds;
    return clip;
}

template <typename Seconds>
Status parseSeconds(const char* option, std::string_view text, Seconds& seconds)
{
    const auto number = parseNumber<double>(text);
    if (!number)
        return usageError(std::string(option) + ": " + quoted(text) + " is not a number of seconds");
    seconds = *number;
    return success();
}

/// Parse "NAME,SECONDS,WEIGHT".
Status parseBlend(std::string_view text, AnimationSettings& settings)
{
    const auto wrong = [&] {
        return usageError("--blend: " + quoted(text) + " is not NAME,SECONDS,WEIGHT with a weight of 0 to 1");
    };
    // names may contain commas
    const size_t second = text.rfind(',');
    const size_t first =
        second == std::string_view::npos || second == 0 ? second : text.rfind(',', second - 1);
    if (first == std::string_view::npos || first == 0)
        return wrong();
    const auto seconds = parseNumber<double>(text.substr(first + 1, second - first - 1));
    const auto weight = parseNumber<double>(text.substr(second + 1));
    if (!seconds || !weight || *weight < 0 || *weight > 1)
        return wrong();
    settings.blended = std::string(text.substr(0, first));
    settings.blended_seconds = *seconds;
    settings.weight = *weight;
    return success();
}

} // namespace

void addClipOptions(CommandLine& command_line, AnimationSettings& settings)
{
    command_line.addValue("--animation",
                          [&](std::string_view text)
                          {
                              settings.clip = std::string(text);
                              return success();
                          });
    command_line.addValue("--time", [&](std::string_view text)
                          { return parseSeconds("--time", text, settings.seconds); });
}

void addAnimationOptions(CommandLine& command_line, AnimationSettings& settings)
{
    addClipOptions(command_line, settings);
    command_line.addValue("--time-step", [&](std::string_view text)
                          { return parseSeconds("--time-step", text, settings.step_seconds); });
    command_line.addValue("--blend", [&](std::string_view text) { return parseBlend(text, settings); });
}

Result<std::optional<pack::ClipTime>> findClip(const AnimationSettings& settings,
                                               const formats::PackView& pack)
{
    if (!settings.clip)
        return std::optional<pack::ClipTime>{};
    HEARTH_ASSIGN_OR_RETURN(const pack::ClipTime clip,
                            findClipTime(*settings.clip, settings.seconds.value_or(0), pack));
    return std::optional(clip);
}

Status FramePose::take(const pack::PosePlayer& player, const gpu::Scene& scene)
{
    moves_.clear();
    poses_.clear();
    for (const pack::MovedInstance& moved : player.transforms())
    {
        HEARTH_ASSIGN_OR_RETURN(const gpu::InstanceMove move,
                                gpu::moveInstance(scene, moved.instance, moved.world_from_object));
        moves_.push_back(move);
    }
    for (const pack::PosedInstance& posed : player.posed())
        poses_.push_back({.instance = posed.instance,
                          .world_from_bind = posed.world_from_bind,
                          .morph_weights = posed.morph_weights});
    return success();
}

Status FrameLights::add(const pack::LightPlayer& player, const gpu::Scene& scene)
{
    for (const pack::PlayedLight& played : is_first_ ? player.lights() : player.changed())
    {
        if (played.light >= scene.lights->lights().size())
            break;
        HEARTH_ASSIGN_OR_RETURN(
            const gpu::LightChange change,
            gpu::changeLight(scene, played.light, played.record, played.steady_intensity));
        changes_.push_back(change);
    }
    is_first_ = false;
    return success();
}

Result<Animation> Animation::create(const AnimationSettings& settings, const formats::PackView& pack)
{
    Animation animation(pack);
    animation.weight_ = settings.weight;
    animation.flicker_seconds_ = settings.seconds.value_or(0);
    animation.step_seconds_ = settings.step_seconds;
    HEARTH_ASSIGN_OR_RETURN(animation.clip_, findClip(settings, pack));
    if (settings.blended)
    {
        HEARTH_ASSIGN_OR_RETURN(animation.blended_,
                                findClipTime(*settings.blended, settings.blended_seconds, pack));
    }
    return animation;
}

void Animation::goTo(size_t frame)
{
    const double seconds = static_cast<double>(frame) * step_seconds_;
    if (clip_ && blended_)
        player_.blend(after(*clip_, seconds), after(*blended_, seconds), weight_);
    else if (clip_)
        player_.play(after(*clip_, seconds));
    lights_.update(player_, flicker_seconds_ + seconds);
}

Status Animation::update(const gpu::Scene& scene)
{
    return clip_ ? pose_.take(player_, scene) : success();
}

} // namespace hearth::viewer
