// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/people/character.h"

#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/surface_nets.h"

#include <functional>
#include <span>

namespace hearth::samples
{

namespace
{

struct JointDefinition
{
    const char* name;
    int parent;
    Float3 offset; ///< from the parent joint, metres
};

constexpr std::array<JointDefinition, kJointCount> kSkeleton{{
    {"hips", -1, {0, 0, 0}},
    {"spine", kHips, {0, 0.10f, 0}},
    {"chest", kSpine, {0, 0.15f, 0}},
    {"neck", kChest, {0, 0.25f, 0}},
    {"head", kNeck, {0, 0.08f, 0.01f}},
    {"left_upper_arm", kChest, {0.19f, 0.19f, 0}},
    {"left_forearm", kLeftUpperArm, {0.28f, 0, 0}},
    {"left_hand", kLeftForearm, {0.25f, 0, 0}},
    {"right_upper_arm", kChest, {-0.19f, 0.19f, 0}},
    {"right_forearm", kRightUpperArm, {-0.28f, 0, 0}},
    {"right_hand", kRightForearm, {-0.25f, 0, 0}},
    {"left_thigh", kHips, {0.10f, -0.06f, 0}},
    {"left_shin", kLeftThigh, {0, -0.41f, 0}},
    {"left_foot", kLeftShin, {0, -0.40f, 0}},
    {"right_thigh", kHips, {-0.10f, -0.06f, 0}},
    {"right_shin", kRightThigh, {0, -0.41f, 0}},
    {"right_foot", kRightShin, {0, -0.40f, 0}},
}};

/// A tapered capsule that moves with a joint, in the joint's frame.
struct Limb
{
    Joint joint;
    Float3 from, to;
    float from_radius, to_radius;
    Float3 color; ///< linear
};

constexpr Float3 kSkinTone{0.46f, 0.26f, 0.17f}, kHair{0.035f, 0.020f, 0.012f}, kCoat{0.055f, 0.085f, 0.10f},
    kTrousers{0.035f, 0.032f, 0.035f}, kLeather{0.075f, 0.040f, 0.022f}, kScarf{0.34f, 0.045f, 0.03f};

constexpr std::array kLimbs{
    Limb{kHips, {-0.065f, -0.02f, 0}, {0.065f, -0.02f, 0}, 0.105f, 0.105f, kTrousers},
    Limb{kSpine, {0, -0.02f, 0}, {0, 0.12f, 0}, 0.130f, 0.125f, kCoat},
    Limb{kChest, {0, 0.00f, 0.005f}, {0, 0.16f, 0}, 0.135f, 0.125f, kCoat},
    Limb{kChest, {-0.13f, 0.17f, 0}, {0.13f, 0.17f, 0}, 0.080f, 0.080f, kCoat},
    Limb{kNeck, {0, -0.01f, 0}, {0, 0.07f, 0.01f}, 0.075f, 0.062f, kScarf},
    Limb{kHead, {0, 0.045f, 0.025f}, {0, 0.115f, 0.012f}, 0.072f, 0.095f, kSkinTone},
    Limb{kHead, {0, 0.10f, -0.012f}, {0, 0.135f, -0.012f}, 0.098f, 0.092f, kHair},
    Limb{kHead, {0, 0.065f, 0.098f}, {0, 0.045f, 0.108f}, 0.012f, 0.014f, kSkinTone},
    Limb{kLeftUpperArm, {0, 0, 0}, {0.27f, 0, 0}, 0.062f, 0.052f, kCoat},
    Limb{kLeftForearm, {0, 0, 0}, {0.23f, 0, 0}, 0.052f, 0.042f, kCoat},
    Limb{kLeftHand, {0.01f, 0, 0}, {0.12f, 0, 0.01f}, 0.030f, 0.028f, kSkinTone},
    Limb{kLeftHand, {0.03f, 0, 0.01f}, {0.07f, 0.0f, 0.055f}, 0.016f, 0.014f, kSkinTone},
    Limb{kRightUpperArm, {0, 0, 0}, {-0.27f, 0, 0}, 0.062f, 0.052f, kCoat},
    Limb{kRightForearm, {0, 0, 0}, {-0.23f, 0, 0}, 0.052f, 0.042f, kCoat},
    Limb{kRightHand, {-0.01f, 0, 0}, {-0.12f, 0, 0.01f}, 0.030f, 0.028f, kSkinTone},
    Limb{kRightHand, {-0.03f, 0, 0.01f}, {-0.07f, 0.0f, 0.055f}, 0.016f, 0.014f, kSkinTone},
    Limb{kLeftThigh, {0, 0, 0}, {0, -0.40f, 0}, 0.090f, 0.065f, kTrousers},
    Limb{kLeftShin, {0, 0, 0}, {0, -0.22f, -0.01f}, 0.065f, 0.060f, kTrousers},
    Limb{kLeftShin, {0, -0.22f, -0.005f}, {0, -0.40f, 0}, 0.066f, 0.056f, kLeather},
    Limb{kLeftFoot, {0, -0.035f, -0.02f}, {0, -0.045f, 0.15f}, 0.055f, 0.042f, kLeather},
    Limb{kRightThigh, {0, 0, 0}, {0, -0.40f, 0}, 0.090f, 0.065f, kTrousers},
    Limb{kRightShin, {0, 0, 0}, {0, -0.22f, -0.01f}, 0.065f, 0.060f, kTrousers},
    Limb{kRightShin, {0, -0.22f, -0.005f}, {0, -0.40f, 0}, 0.066f, 0.056f, kLeather},
    Limb{kRightFoot, {0, -0.035f, -0.02f}, {0, -0.045f, 0.15f}, 0.055f, 0.042f, kLeather},
};

/// Rigid transform: rotation, then translation.
struct Frame
{
    Float4 rotation{0, 0, 0, 1};
    Float3 origin;

    Float3 apply(Float3 p) const { return rotate(rotation, p) + origin; }
};

std::array<Frame, kJointCount> jointFrames(const Pose& pose)
{
    std::array<Frame, kJointCount> frames;
    for (size_t joint = 0; joint < kJointCount; ++joint)
    {
        const JointDefinition& definition = kSkeleton[joint];
        if (definition.parent < 0)
        {
            frames[joint] = {pose.rotations[joint], pose.hips};
            continue;
        }
        const Frame& parent = frames[static_cast<size_t>(definition.parent)];
        frames[joint] = {multiply(parent.rotation, pose.rotations[joint]), parent.apply(definition.offset)};
    }
    return frames;
}

/// Limbs of a pose in model space.
struct Body
{
    std::array<Limb, kLimbs.size()> limbs = kLimbs;

    explicit Body(const Pose& pose)
    {
        const std::array<Frame, kJointCount> frames = jointFrames(pose);
        for (Limb& limb : limbs)
        {
            limb.from = frames[limb.joint].apply(limb.from);
            limb.to = frames[limb.joint].apply(limb.to);
        }
    }
};

float distanceToLimb(const Limb& limb, Float3 p)
{
    const Float3 axis = limb.to - limb.from;
    const float t = clamp01(dot(p - limb.from, axis) / dot(axis, axis));
    return length(p - limb.from - axis * t) - lerp(limb.from_radius, limb.to_radius, t);
}

/// Return the signed distance to the skin: limbs of different parts blend over 3 cm.
float distanceToBody(const Body& body, Float3 p)
{
    float distance = 1e3f;
    for (const Limb& limb : body.limbs)
        distance = smoothMin(distance, distanceToLimb(limb, p), 0.03f);
    return distance;
}

/// Set the four nearest joints, weighted so that only limbs within 6 cm of the nearest count.
void setInfluences(const Body& body, TriangleMesh& mesh)
{
    for (const Float3& p : mesh.positions)
    {
        std::array<float, kJointCount> nearest;
        nearest.fill(1e3f);
        for (const Limb& limb : body.limbs)
            nearest[limb.joint] = std::min(nearest[limb.joint], distanceToLimb(limb, p));
        const float closest = *std::min_element(nearest.begin(), nearest.end());
        std::array<std::pair<float, uint16_t>, kJointCount> ranked;
        for (uint16_t joint = 0; joint < kJointCount; ++joint)
        {
            const float share = std::max(0.0f, 1 - (nearest[joint] - closest) / 0.06f);
            ranked[joint] = {-share * share, joint};
        }
        std::sort(ranked.begin(), ranked.end());
        const float sum = -(ranked[0].first + ranked[1].first + ranked[2].first + ranked[3].first);
        std::array<uint16_t, 4> joints{};
        std::array<float, 4> weights{};
        for (size_t i = 0; i < 4; ++i)
        {
            weights[i] = -ranked[i].first / sum;
            joints[i] = weights[i] > 0 ? ranked[i].second : uint16_t{0};
        }
        mesh.joints.push_back(joints);
        mesh.weights.push_back({weights[0], weights[1], weights[2], weights[3]});
    }
}

void setColors(const Body& body, TriangleMesh& mesh)
{
    for (const Float3& p : mesh.positions)
    {
        const auto nearest = std::min_element(body.limbs.begin(), body.limbs.end(),
                                              [&](const Limb& a, const Limb& b)
                                              { return distanceToLimb(a, p) < distanceToLimb(b, p); });
        mesh.colors.push_back({nearest->color.x, nearest->color.y, nearest->color.z, 1});
    }
}

TriangleMesh generateSkin(const Pose& pose, float cell)
{
    const Body body(pose);
    Box3 bounds;
    for (const Limb& limb : body.limbs)
        for (const Float3 end : {limb.from, limb.to})
        {
            bounds.add(end - Float3{0.2f, 0.2f, 0.2f});
            bounds.add(end + Float3{0.2f, 0.2f, 0.2f});
        }
    TriangleMesh skin = polygonise([&](Float3 p) { return distanceToBody(body, p); }, bounds, cell);
    setColors(body, skin);
    setInfluences(body, skin);
    return skin;
}

/// Return the inverse of model_from_joint, a rigid transform.
Affine3 jointFromModel(const Frame& frame)
{
    const Float4 inverse{-frame.rotation.x, -frame.rotation.y, -frame.rotation.z, frame.rotation.w};
    const Float3 columns[3] = {rotate(inverse, {1, 0, 0}), rotate(inverse, {0, 1, 0}),
                               rotate(inverse, {0, 0, 1})};
    const Float3 origin = -rotate(inverse, frame.origin);
    Affine3 result;
    for (int row = 0; row < 3; ++row)
    {
        for (int column = 0; column < 3; ++column)
            result.m[row][column] = columns[column][row];
        result.m[row][3] = origin[row];
    }
    return result;
}

Float4 rotationAboutX(float degrees)
{
    return rotationAbout({1, 0, 0}, degrees * (kPi / 180));
}
Float4 rotationAboutY(float degrees)
{
    return rotationAbout({0, 1, 0}, degrees * (kPi / 180));
}
Float4 rotationAboutZ(float degrees)
{
    return rotationAbout({0, 0, 1}, degrees * (kPi / 180));
}

Track rotationTrack(int node, const std::vector<float>& times, const std::vector<Float4>& rotations)
{
    return {node, TrackPath::rotation, TrackKind::linear, times, rotations};
}

/// Return keys of a loop with the tangents of a Catmull-Rom spline: in-tangent, value, out-tangent.
std::vector<Float4> withTangents(const std::vector<float>& times, const std::vector<Float4>& values)
{
    const size_t last = values.size() - 1; // equals the first value: the clip loops
    std::vector<Float4> keys;
    for (size_t i = 0; i < values.size(); ++i)
    {
        const Float4 before = values[i == 0 ? last - 1 : i - 1], after = values[i == last ? 1 : i + 1];
        const float span = 2 * (times[1] - times[0]);
        const Float4 tangent{(after.x - before.x) / span, (after.y - before.y) / span,
                             (after.z - before.z) / span, (after.w - before.w) / span};
        keys.insert(keys.end(), {tangent, values[i], tangent});
    }
    return keys;
}

std::vector<float> evenTimes(size_t count, float duration)
{
    std::vector<float> times;
    for (size_t i = 0; i < count; ++i)
        times.push_back(duration * static_cast<float>(i) / static_cast<float>(count - 1));
    return times;
}

/// Clip of a loop in which a character stays where it is.
struct Gait
{
    const char* name;
    float seconds;
    std::span<const Joint> moved; ///< joints that turn; the hips move, too
};

/// Add the clip of a gait: linear rotations, the path of the hips is a cubic spline.
/// pose_at  pose by the share of the loop, 0 to 1
void addGaitClip(Document& document, const CharacterNodes& nodes, const Gait& gait,
                 const std::function<Pose(float)>& pose_at)
{
    Animation clip;
    clip.name = gait.name;
    const std::vector<float> shares = evenTimes(9, 1.0f), times = evenTimes(9, gait.seconds);
    std::vector<Pose> poses;
    for (const float share : shares)
        poses.push_back(pose_at(share));
    for (const Joint joint : gait.moved)
    {
        std::vector<Float4> keys;
        for (const Pose& key : poses)
            keys.push_back(key.rotations[joint]);
        clip.tracks.push_back(rotationTrack(nodes.joints[joint], times, keys));
    }
    std::vector<Float4> way;
    for (const Pose& key : poses)
        way.push_back({key.hips.x, key.hips.y, key.hips.z, 0});
    clip.tracks.push_back({nodes.joints[kHips], TrackPath::translation, TrackKind::cubic_spline, times,
                           withTangents(times, way)});
    document.animations.push_back(clip);
}

/// Return a pose of standing still: the chest breathes, the head looks around a little.
Pose breathingPose(const Pose& standing, float cycle)
{
    Pose pose = standing;
    const float breath = sine(cycle * 4 * kPi), look = sine(cycle * 2 * kPi);
    const auto turn = [&](Joint joint, Float4 rotation)
    { pose.rotations[joint] = multiply(rotation, standing.rotations[joint]); };
    turn(kChest, rotationAboutX(1.2f * breath));
    turn(kHead, multiply(rotationAboutY(9 * look), rotationAboutX(-1.2f * breath)));
    turn(kLeftUpperArm, rotationAboutZ(1.2f * breath));
    turn(kRightUpperArm, rotationAboutZ(-1.2f * breath));
    pose.hips = standing.hips + Float3{0.008f * look, 0, 0};
    return pose;
}

/// Return a pose of running on the spot; share of the cycle: 0 to 1.
Pose runningPose(const Pose& standing, float cycle)
{
    Pose pose = standing;
    const float a = cycle * 2 * kPi;
    const auto swing = [&](Joint joint, Float4 rotation)
    { pose.rotations[joint] = multiply(rotation, standing.rotations[joint]); };
    for (const bool left : {true, false})
    {
        const float phase = left ? a : a + kPi, side = left ? -1.0f : 1.0f;
        swing(left ? kLeftThigh : kRightThigh, rotationAboutX(-40 * sine(phase) - 16));
        swing(left ? kLeftShin : kRightShin, rotationAboutX(52 + 42 * sine(phase + 2.3f)));
        swing(left ? kLeftFoot : kRightFoot, rotationAboutX(4 + 14 * sine(phase + 2.6f)));
        swing(left ? kLeftUpperArm : kRightUpperArm, rotationAboutX(36 * sine(phase) + 10));
        swing(left ? kLeftForearm : kRightForearm, rotationAboutY(side * 62));
    }
    swing(kSpine, rotationAboutX(9));
    swing(kChest, multiply(rotationAboutX(5), rotationAboutY(9 * sine(a))));
    pose.hips = standing.hips + Float3{0.02f * sine(a), -0.03f + 0.035f * cosine(2 * a), 0};
    return pose;
}

} // namespace

Pose standingPose()
{
    Pose pose;
    pose.rotations[kLeftUpperArm] = rotationAboutZ(-62);
    pose.rotations[kRightUpperArm] = rotationAboutZ(62);
    pose.rotations[kLeftForearm] = rotationAboutY(-18);
    pose.rotations[kRightForearm] = rotationAboutY(18);
    return pose;
}

Pose sittingPose()
{
    Pose pose;
    pose.hips = {0, 0.52f, 0};
    pose.rotations[kSpine] = rotationAboutX(9);
    pose.rotations[kChest] = rotationAboutX(12);
    pose.rotations[kNeck] = rotationAboutX(-4);
    pose.rotations[kLeftUpperArm] = multiply(rotationAboutX(-34), rotationAboutZ(-72));
    pose.rotations[kRightUpperArm] = multiply(rotationAboutX(-34), rotationAboutZ(72));
    pose.rotations[kLeftForearm] = rotationAboutY(-52);
    pose.rotations[kRightForearm] = rotationAboutY(52);
    pose.rotations[kLeftHand] = rotationAboutY(16);
    pose.rotations[kRightHand] = rotationAboutY(-16);
    pose.rotations[kLeftThigh] = multiply(rotationAboutY(12), rotationAboutX(-82));
    pose.rotations[kRightThigh] = multiply(rotationAboutY(-12), rotationAboutX(-82));
    pose.rotations[kLeftShin] = rotationAboutX(66);
    pose.rotations[kRightShin] = rotationAboutX(74);
    pose.rotations[kLeftFoot] = rotationAboutX(10);
    pose.rotations[kRightFoot] = rotationAboutX(6);
    return pose;
}

Pose blendPoses(const Pose& a, const Pose& b, float share)
{
    Pose blended;
    blended.hips = lerp(a.hips, b.hips, share);
    for (size_t joint = 0; joint < kJointCount; ++joint)
        blended.rotations[joint] = blendRotations(a.rotations[joint], b.rotations[joint], share);
    return blended;
}

Pose walkingPose(const Pose& standing, float cycle)
{
    Pose pose = standing;
    const float a = cycle * 2 * kPi;
    const auto swing = [&](Joint joint, Float4 rotation)
    { pose.rotations[joint] = multiply(rotation, standing.rotations[joint]); };
    for (const bool left : {true, false})
    {
        const float phase = left ? a : a + kPi;
        swing(left ? kLeftThigh : kRightThigh, rotationAboutX(-26 * sine(phase) - 4));
        swing(left ? kLeftShin : kRightShin, rotationAboutX(24 + 24 * sine(phase + 2.1f)));
        swing(left ? kLeftFoot : kRightFoot, rotationAboutX(-6 + 12 * sine(phase + 2.6f)));
        swing(left ? kLeftUpperArm : kRightUpperArm, rotationAboutX(20 * sine(phase)));
    }
    swing(kChest, rotationAboutY(5 * sine(a)));
    pose.hips = standing.hips + Float3{0.015f * sine(a), -0.012f + 0.018f * cosine(2 * a), 0};
    return pose;
}

CharacterNodes addCharacter(Document& document, const Pose& rest, const Pose& bind, float cell)
{
    CharacterNodes nodes{};
    const std::array<Frame, kJointCount> frames = jointFrames(bind);
    Skin skin;
    skin.name = "mannequin";
    for (size_t joint = 0; joint < kJointCount; ++joint)
    {
        Node node;
        node.name = kSkeleton[joint].name;
        node.placement.translation = joint == kHips ? rest.hips : kSkeleton[joint].offset;
        node.placement.rotation = rest.rotations[joint];
        nodes.joints[joint] = add(document.nodes, node);
        if (kSkeleton[joint].parent >= 0)
        {
            const int parent = nodes.joints[static_cast<size_t>(kSkeleton[joint].parent)];
            document.nodes[static_cast<size_t>(parent)].children.push_back(nodes.joints[joint]);
        }
        skin.joints.push_back(nodes.joints[joint]);
        skin.joint_from_bind.push_back(jointFromModel(frames[joint]));
    }
    skin.skeleton_root = nodes.joints[kHips];

    Material material;
    material.name = "mannequin";
    material.roughness = 0.75f;
    Node body;
    body.name = "mannequin_skin";
    body.mesh = add(document.meshes,
                    Mesh{"mannequin", {{generateSkin(bind, cell), add(document.materials, material)}}});
    body.skin = add(document.skins, skin);
    Node root;
    root.name = "character";
    root.children = {nodes.joints[kHips], add(document.nodes, body)};
    nodes.root = addRoot(document, root);
    return nodes;
}

void addWalkClip(Document& document, const CharacterNodes& nodes, const Pose& pose)
{
    constexpr std::array kMoved{kLeftThigh, kLeftShin,  kLeftFoot,      kLeftUpperArm, kRightThigh,
                                kRightShin, kRightFoot, kRightUpperArm, kChest};
    addGaitClip(document, nodes, {"walk", 1.0f, kMoved},
                [&](float cycle) { return walkingPose(pose, cycle); });
}

void addIdleClip(Document& document, const CharacterNodes& nodes, const Pose& pose)
{
    constexpr std::array kMoved{kChest, kHead, kLeftUpperArm, kRightUpperArm};
    addGaitClip(document, nodes, {"idle", 5.0f, kMoved},
                [&](float cycle) { return breathingPose(pose, cycle); });
}

void addRunClip(Document& document, const CharacterNodes& nodes, const Pose& pose)
{
    constexpr std::array kMoved{kLeftThigh,     kLeftShin,     kLeftFoot,  kLeftUpperArm,
                                kLeftForearm,   kRightThigh,   kRightShin, kRightFoot,
                                kRightUpperArm, kRightForearm, kSpine,     kChest};
    addGaitClip(document, nodes, {"run", 0.7f, kMoved},
                [&](float cycle) { return runningPose(pose, cycle); });
}

void addWaveClip(Document& document, const CharacterNodes& nodes, const Pose& pose)
{
    Animation wave;
    wave.name = "wave";
    const std::vector<float> times = evenTimes(9, 2.0f);
    std::vector<Float4> forearm, head;
    for (const float time : times)
    {
        forearm.push_back(multiply(rotationAboutZ(-58 + 24 * sine(time * 2 * kPi)), rotationAboutY(14)));
        head.push_back(multiply(rotationAboutZ(4 * sine(time * kPi)), pose.rotations[kHead]));
    }
    const Float4 raised = rotationAboutZ(-32);
    wave.tracks.push_back(rotationTrack(nodes.joints[kRightUpperArm], {0, 2}, {raised, raised}));
    wave.tracks.push_back({nodes.joints[kRightForearm], TrackPath::rotation, TrackKind::cubic_spline, times,
                           withTangents(times, forearm)});
    wave.tracks.push_back({nodes.joints[kHead], TrackPath::rotation, TrackKind::cubic_spline, times,
                           withTangents(times, head)});
    document.animations.push_back(wave);
}

} // namespace hearth::samples
