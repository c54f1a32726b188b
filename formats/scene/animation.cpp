// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/animation.h"

#include "formats/base/assert.h"
#include "formats/codecs/channel_keys.h"
#include "formats/pack/pack_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hearth::formats
{

namespace
{

double lerp(double from, double to, double weight)
{
    return from * (1 - weight) + to * weight;
}

Double3 lerp(Double3 from, Double3 to, double weight)
{
    return from * (1 - weight) + to * weight;
}

Quaternion normalizedOr(const Quaternion& q, const Quaternion& fallback)
{
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(length > 0) || !std::isfinite(length))
        return fallback;
    return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

NodePose nodePoseFromRecord(const NodeRecord& node)
{
    const Quaternion rotation{node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w};
    return {widen(node.translation), normalizedOr(rotation, {0, 0, 0, 1}), widen(node.scale)};
}

/// Keys of a channel around a time.
struct KeyInterval
{
    uint32_t first = 0;
    uint32_t second = 0;
    double fraction = 0; ///< 0 to 1
    double seconds = 0;  ///< from the first key to the second
};

KeyInterval findKeyInterval(const ChannelKeys& keys, double time)
{
    // of several keys at one time, which are a jump, the last one wins
    const uint32_t second = keys.firstKeyAfter(time);
    if (second == 0)
        return {};
    if (second == keys.count())
        return {second - 1, second - 1, 0, 0};
    const double start = keys.time(second - 1);
    const double seconds = keys.time(second) - start;
    return {second - 1, second, (time - start) / seconds, seconds};
}

/// Return components [first, first + count) in an interval. Rotations are not normalised.
KeyValue interpolateValue(const ChannelKeys& keys, const KeyInterval& interval, uint32_t first,
                          uint32_t count)
{
    const KeyValue start = keys.value(interval.first, first, count);
    if (keys.interpolation() == Interpolation::step)
        return start;
    const KeyValue end = keys.value(interval.second, first, count);
    const double t = interval.fraction;
    KeyValue value{};
    if (keys.interpolation() == Interpolation::linear)
    {
        for (size_t i = 0; i < value.size(); ++i)
            value[i] = lerp(start[i], end[i], t);
        return value;
    }
    const KeyValue out = keys.outTangent(interval.first, first, count);
    const KeyValue in = keys.inTangent(interval.second, first, count);
    // Hermite basis; out-tangent of the first key, in-tangent of the second, both per second
    const double t2 = t * t, t3 = t2 * t;
    for (size_t i = 0; i < value.size(); ++i)
        value[i] = (2 * t3 - 3 * t2 + 1) * start[i] + (t3 - 2 * t2 + t) * interval.seconds * out[i] +
                   (3 * t2 - 2 * t3) * end[i] + (t3 - t2) * interval.seconds * in[i];
    return value;
}

Quaternion rotationAt(const ChannelKeys& keys, const KeyInterval& interval)
{
    const Quaternion none{0, 0, 0, 1};
    const Quaternion start = normalizedOr(keys.value(interval.first, 0, 4), none);
    if (keys.interpolation() == Interpolation::linear && interval.seconds > 0)
        return slerp(start, normalizedOr(keys.value(interval.second, 0, 4), none), interval.fraction);
    return normalizedOr(interpolateValue(keys, interval, 0, 4), start);
}

void sampleChannel(const AnimationTables& tables, const AnimationChannelRecord& channel, double time,
                   ScenePose& pose)
{
    HEARTH_RUNTIME_ASSERT(channel.key_count > 0);
    const ChannelKeys keys(tables.keys, tables.key_bits, channel);
    const KeyInterval interval = findKeyInterval(keys, time);
    NodePose& node = pose.nodes[channel.target];
    const auto vector = [&]
    {
        const KeyValue value = interpolateValue(keys, interval, 0, 3);
        return Double3{value[0], value[1], value[2]};
    };
    switch (static_cast<AnimationPath>(channel.path))
    {
    case AnimationPath::translation:
        node.translation = vector();
        break;
    case AnimationPath::rotation:
        node.rotation = rotationAt(keys, interval);
        break;
    case AnimationPath::scale:
        node.scale = vector();
        break;
    case AnimationPath::weights:
    {
        const Range weights = tables.nodes[channel.target].morph_weights;
        for (uint32_t i = 0; i < std::min(weights.count, channel.components); ++i)
            pose.morph_weights[weights.first + i] = interpolateValue(keys, interval, i, 1)[0];
        break;
    }
    default: // of a light
        break;
    }
}

float toFloat(double value, double min, double max)
{
    return static_cast<float>(std::clamp(value, min, max));
}

void setLightProperty(LightRecord& light, AnimationPath path, const KeyValue& value)
{
    constexpr double kUnbounded = std::numeric_limits<float>::max();
    constexpr double kRightAngle = std::numbers::pi_v<float> / 2;
    switch (path)
    {
    case AnimationPath::light_color:
        light.color = {toFloat(value[0], 0, kUnbounded), toFloat(value[1], 0, kUnbounded),
                       toFloat(value[2], 0, kUnbounded)};
        break;
    case AnimationPath::light_intensity:
        light.intensity = toFloat(value[0], 0, kUnbounded);
        break;
    case AnimationPath::light_range:
        light.range = toFloat(value[0], double{kMinAnimatedRange}, kUnbounded);
        break;
    case AnimationPath::light_inner_cone:
        light.inner_cone_rad = toFloat(value[0], 0, kRightAngle);
        break;
    case AnimationPath::light_outer_cone:
        light.outer_cone_rad = toFloat(value[0], 0, kRightAngle);
        break;
    default: // of a node
        break;
    }
}

float lerpFloat(float from, float to, double weight)
{
    return static_cast<float>(lerp(double{from}, double{to}, weight));
}

float blendRanges(float from, float to, double weight)
{
    if (weight == 0 || weight == 1)
        return weight == 0 ? from : to;
    return from == 0 || to == 0 ? 0 : lerpFloat(from, to, weight);
}

} // namespace

AnimationTables animationTables(const PackView& pack)
{
    return {pack.nodes(),    pack.skins(), pack.joints(),       pack.animations(),
            pack.channels(), pack.keys(),  pack.morphWeights(), pack.keyBits()};
}

ScenePose restPose(const AnimationTables& tables)
{
    ScenePose pose;
    pose.nodes.reserve(tables.nodes.size());
    for (const NodeRecord& node : tables.nodes)
        pose.nodes.push_back(node.has_trs != 0 ? nodePoseFromRecord(node) : NodePose{});
    pose.morph_weights.assign(tables.morph_weights.begin(), tables.morph_weights.end());
    return pose;
}

void sampleAnimation(const AnimationTables& tables, const AnimationRecord& animation, double time,
                     ScenePose& pose)
{
    HEARTH_RUNTIME_ASSERT(pose.nodes.size() == tables.nodes.size());
    for (const AnimationChannelRecord& channel :
         tables.channels.subspan(animation.channels.first, animation.channels.count))
        sampleChannel(tables, channel, time, pose);
}

void sampleLights(const AnimationTables& tables, const AnimationRecord& animation, double time,
                  std::span<LightRecord> lights)
{
    const auto channels =
        tables.channels.subspan(animation.light_channels.first, animation.light_channels.count);
    for (const AnimationChannelRecord& channel : channels)
    {
        const ChannelKeys keys(tables.keys, tables.key_bits, channel);
        setLightProperty(lights[channel.target], static_cast<AnimationPath>(channel.path),
                         interpolateValue(keys, findKeyInterval(keys, time), 0, channel.components));
    }
    // one cone may be animated, or both, one after the other
    for (const AnimationChannelRecord& channel : channels)
    {
        LightRecord& light = lights[channel.target];
        light.inner_cone_rad = std::min(light.inner_cone_rad, light.outer_cone_rad);
    }
}

void blendLights(std::span<const LightRecord> from, std::span<const LightRecord> to, double weight,
                 std::span<LightRecord> result)
{
    HEARTH_RUNTIME_ASSERT(from.size() == to.size() && from.size() == result.size());
    for (size_t i = 0; i < from.size(); ++i)
    {
        const LightRecord &a = from[i], &b = to[i];
        LightRecord light = a;
        light.color = {lerpFloat(a.color.x, b.color.x, weight), lerpFloat(a.color.y, b.color.y, weight),
                       lerpFloat(a.color.z, b.color.z, weight)};
        light.intensity = lerpFloat(a.intensity, b.intensity, weight);
        light.range = blendRanges(a.range, b.range, weight);
        light.inner_cone_rad = lerpFloat(a.inner_cone_rad, b.inner_cone_rad, weight);
        light.outer_cone_rad = lerpFloat(a.outer_cone_rad, b.outer_cone_rad, weight);
        result[i] = light;
    }
}

Quaternion slerp(const Quaternion& from, const Quaternion& to, double weight)
{
    double cosine = from[0] * to[0] + from[1] * to[1] + from[2] * to[2] + from[3] * to[3];
    const double side = cosine < 0 ? -1 : 1;
    cosine = std::min(cosine * side, 1.0);
    double of_from = 1 - weight, of_to = weight;
    // on shorter arcs the chord equals the arc, and the quotient of sines loses digits
    constexpr double kShortArc = 1 - 1e-10;
    if (cosine < kShortArc)
    {
        const double angle = std::acos(cosine);
        of_from = std::sin((1 - weight) * angle);
        of_to = std::sin(weight * angle);
    }
    Quaternion blended;
    for (size_t i = 0; i < blended.size(); ++i)
        blended[i] = of_from * from[i] + side * of_to * to[i];
    return normalizedOr(blended, from);
}

void blendPoses(const ScenePose& from, const ScenePose& to, double weight, ScenePose& result)
{
    HEARTH_RUNTIME_ASSERT(from.nodes.size() == to.nodes.size() &&
                          from.morph_weights.size() == to.morph_weights.size());
    result.nodes.resize(from.nodes.size());
    result.morph_weights.resize(from.morph_weights.size());
    for (size_t i = 0; i < from.nodes.size(); ++i)
        result.nodes[i] = {lerp(from.nodes[i].translation, to.nodes[i].translation, weight),
                           slerp(from.nodes[i].rotation, to.nodes[i].rotation, weight),
                           lerp(from.nodes[i].scale, to.nodes[i].scale, weight)};
    for (size_t i = 0; i < from.morph_weights.size(); ++i)
        result.morph_weights[i] = lerp(from.morph_weights[i], to.morph_weights[i], weight);
}

std::vector<uint32_t> nodesParentsFirst(std::span<const NodeRecord> nodes)
{
    enum State : uint8_t
    {
        waiting,
        visited,
    };
    std::vector<State> states(nodes.size(), waiting);
    std::vector<uint32_t> order, chain;
    order.reserve(nodes.size());
    for (uint32_t node = 0; node < nodes.size(); ++node)
    {
        for (uint32_t up = node; up != kInvalidIndex && states[up] == waiting; up = nodes[up].parent)
        {
            states[up] = visited;
            chain.push_back(up);
        }
        order.insert(order.end(), chain.rbegin(), chain.rend());
        chain.clear();
    }
    return order;
}

std::vector<uint8_t> findAnimatedNodes(const AnimationTables& tables, std::span<const uint32_t> parents_first)
{
    std::vector<uint8_t> animated(tables.nodes.size(), 0);
    for (const AnimationRecord& animation : tables.animations)
        for (const AnimationChannelRecord& channel :
             tables.channels.subspan(animation.channels.first, animation.channels.count))
            if (channel.path != static_cast<uint32_t>(AnimationPath::weights))
                animated[channel.target] = 1;
    for (const uint32_t node : parents_first)
        if (const uint32_t parent = tables.nodes[node].parent;
            parent != kInvalidIndex && animated[parent] != 0)
            animated[node] = 1;
    return animated;
}

Affine3d nodeFromObject(const Affine3d& world_from_node, const Affine3& world_from_object)
{
    const auto narrow = narrowed(world_from_node);
    if (narrow && *narrow == world_from_object)
        return {};
    const auto node_from_world = inverted(world_from_node);
    return node_from_world ? *node_from_world * widened(world_from_object) : Affine3d{};
}

void poseNodes(const AnimationTables& tables, const ScenePose& pose, std::span<const uint32_t> parents_first,
               std::span<Affine3d> world_from_node)
{
    HEARTH_RUNTIME_ASSERT(pose.nodes.size() == tables.nodes.size() &&
                          world_from_node.size() == tables.nodes.size());
    for (const uint32_t i : parents_first)
    {
        const NodeRecord& node = tables.nodes[i];
        const NodePose& local = pose.nodes[i];
        const Affine3d parent_from_node =
            node.has_trs != 0 ? makeAffineFromTrs(local.translation, local.rotation, local.scale)
                              : widened(node.parent_from_node);
        world_from_node[i] =
            node.parent == kInvalidIndex ? parent_from_node : world_from_node[node.parent] * parent_from_node;
    }
}

Affine3d clusterFrame(std::span<const Affine3d> palette, const DeformedClusterRecord& cluster,
                      std::span<const uint32_t> joints)
{
    const Affine3d& main = palette[cluster.joint];
    Affine3d frame = main;
    for (const uint32_t entry : joints)
    {
        const double share = jointShare(entry) / static_cast<double>(kWholeShare);
        const Affine3d& joint = palette[jointIndex(entry)];
        for (size_t row = 0; row < 3; ++row)
            for (size_t column = 0; column < 4; ++column)
                frame.m[row][column] += share * (joint.m[row][column] - main.m[row][column]);
    }
    return frame;
}

void skinPalette(const AnimationTables& tables, const SkinRecord& skin,
                 std::span<const Affine3d> world_from_node, std::span<Affine3d> world_from_bind)
{
    HEARTH_RUNTIME_ASSERT(world_from_bind.size() == skin.joints.count);
    for (uint32_t i = 0; i < skin.joints.count; ++i)
    {
        const JointRecord& joint = tables.joints[skin.joints.first + i];
        world_from_bind[i] = world_from_node[joint.node] * widened(joint.joint_from_bind);
    }
}

} // namespace hearth::formats
