// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/people/arrival.h"

#include "sample_assets/shapes/sample_math.h"

#include <vector>

namespace hearth::samples
{

namespace
{

constexpr size_t kKeys = 51; // ten a second
constexpr float kKeySeconds = 0.1f;

/// Seconds at which parts of the clip begin and end.
constexpr float kStopFrom = 1.7f, kStopTo = 2.1f, kTurnFrom = 1.9f, kTurnTo = 2.7f, kSitFrom = 2.7f,
                kSitTo = 3.9f;

Pose poseAt(float seconds)
{
    const Pose standing = standingPose();
    const float still = smoothstep(kStopFrom, kStopTo, seconds);
    const Pose upright = blendPoses(walkingPose(standing, seconds), standing, still);
    Pose pose = blendPoses(upright, sittingPose(), smoothstep(kSitFrom, kSitTo, seconds));
    // who sits down leans forwards on the way
    const float lean =
        30 * smoothstep(kSitFrom, kSitFrom + 0.5f, seconds) * smoothstep(kSitTo, kSitTo - 0.6f, seconds);
    pose.rotations[kSpine] = multiply(rotationAbout({1, 0, 0}, lean * kPi / 180), pose.rotations[kSpine]);
    return pose;
}

Placement placementAt(const Arrival& arrival, float seconds)
{
    const float way = clamp01(seconds / kStopTo);
    const Float3 walked = lerp(arrival.start, arrival.stop, way);
    const Float3 ahead = normalize(arrival.stop - arrival.start);
    const Float4 turned =
        blendRotations(rotationBetween({0, 0, 1}, ahead), rotationBetween({0, 0, 1}, arrival.direction),
                       smoothstep(kTurnFrom, kTurnTo, seconds));
    return {
        walked + (arrival.seat - arrival.stop) * smoothstep(kSitFrom, kSitTo, seconds), turned, {1, 1, 1}};
}

Float4 asKey(Float3 v)
{
    return {v.x, v.y, v.z, 0};
}

} // namespace

void addArriveClip(Document& document, const CharacterNodes& nodes, const Arrival& arrival)
{
    Animation arrive;
    arrive.name = "arrive";
    std::vector<float> times;
    std::vector<Float4> places, turns, hips;
    std::array<std::vector<Float4>, kJointCount> rotations;
    for (size_t key = 0; key < kKeys; ++key)
    {
        times.push_back(static_cast<float>(key) * kKeySeconds);
        const Pose pose = poseAt(times.back());
        const Placement placement = placementAt(arrival, times.back());
        places.push_back(asKey(placement.translation));
        turns.push_back(placement.rotation);
        hips.push_back(asKey(pose.hips));
        for (size_t joint = 0; joint < kJointCount; ++joint)
            rotations[joint].push_back(pose.rotations[joint]);
    }
    const auto addTrack = [&](int node, TrackPath path, const std::vector<Float4>& keys) {
        arrive.tracks.push_back({node, path, TrackKind::linear, times, keys});
    };
    addTrack(nodes.root, TrackPath::translation, places);
    addTrack(nodes.root, TrackPath::rotation, turns);
    addTrack(nodes.joints[kHips], TrackPath::translation, hips);
    for (size_t joint = 0; joint < kJointCount; ++joint)
        addTrack(nodes.joints[joint], TrackPath::rotation, rotations[joint]);
    document.animations.push_back(std::move(arrive));
}

} // namespace hearth::samples
