// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/shapes/glb_animations.h"

#include "formats/base/assert.h"

namespace hearth::samples
{

namespace
{

int addTrackValues(Glb& glb, const Track& track)
{
    const size_t values_per_key = track.kind == TrackKind::cubic_spline ? 3 : 1;
    HEARTH_ASSERT(track.values.size() == track.times.size() * values_per_key);
    if (track.path == TrackPath::rotation)
        return glb.addAccessor<Float4>(track.values, kComponentF32, "VEC4", 0);
    std::vector<Float3> xyz;
    for (const Float4 value : track.values)
        xyz.push_back({value.x, value.y, value.z});
    return glb.addAccessor<Float3>(xyz, kComponentF32, "VEC3", 0);
}

int addTrackValues(Glb& glb, const LightTrack& track)
{
    HEARTH_ASSERT(track.values.size() == track.times.size() && track.kind != TrackKind::cubic_spline);
    if (track.property == LightProperty::color)
        return glb.addAccessor<Float3>(track.values, kComponentF32, "VEC3", 0);
    std::vector<float> intensities;
    for (const Float3 value : track.values)
        intensities.push_back(value.x);
    return glb.addAccessor<float>(intensities, kComponentF32, "SCALAR", 0);
}

/// Samplers and channels of an animation under construction.
struct AnimationJson
{
    Json channels = Json::array();
    Json samplers = Json::array();

    void add(Glb& glb, const auto& track, Json target)
    {
        constexpr const char* kNames[] = {"LINEAR", "CUBICSPLINE", "STEP"};
        HEARTH_ASSERT(!track.times.empty());
        const Json bounds{{"min", Json::array({track.times.front()})},
                          {"max", Json::array({track.times.back()})}};
        const int input = glb.addAccessor<float>(track.times, kComponentF32, "SCALAR", 0, bounds);
        channels.push_back({{"sampler", samplers.size()}, {"target", std::move(target)}});
        samplers.push_back({{"input", input},
                            {"output", addTrackValues(glb, track)},
                            {"interpolation", kNames[static_cast<int>(track.kind)]}});
    }
};

/// Return the target of a channel that changes a light (KHR_animation_pointer).
Json lightTarget(Glb& glb, const LightTrack& track)
{
    const std::string light = "/extensions/KHR_lights_punctual/lights/" + std::to_string(track.light);
    Json target{{"path", "pointer"}};
    glb.use(target, "KHR_animation_pointer",
            {{"pointer", light + (track.property == LightProperty::color ? "/color" : "/intensity")}});
    return target;
}

} // namespace

void addAnimations(Glb& glb, const Document& document)
{
    for (const Animation& animation : document.animations)
    {
        AnimationJson json;
        for (const Track& track : animation.tracks)
            json.add(glb, track,
                     {{"node", track.node},
                      {"path", track.path == TrackPath::rotation ? "rotation" : "translation"}});
        for (const LightTrack& track : animation.light_tracks)
            json.add(glb, track, lightTarget(glb, track));
        glb.json["animations"].push_back({{"name", animation.name},
                                          {"channels", std::move(json.channels)},
                                          {"samplers", std::move(json.samplers)}});
    }
}

} // namespace hearth::samples
