// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_compression/fitted_clip.h"

#include "cook/animation_bounds/quaternion.h"
#include "formats/base/assert.h"
#include "formats/pack/pack_view.h"

#include <algorithm>
#include <cmath>

namespace hearth::animation_compression
{

using namespace formats;

namespace
{

// Minimum reach of a node, as a share of the model's size: games attach objects to nodes.
constexpr double kMinReach = 0.01;

// Maximum error of a channel with a small reach, as a chord of a rotation or as a share of the node's scale:
// bounds of larger errors carry no information.
constexpr double kMaxChord = 0.1;

// Chord between quaternions that are equal up to the rounding of normalization.
constexpr double kSameChord = 1e-15;

// Margin for rounding in sums and products of the bounds.
constexpr double kSpentMargin = 1 + 1e-9;

// Share of a spline's tolerance for its approximation by linear pieces.
constexpr double kSplineShare = 0.25;

AnimationPath channelPath(const AnimationChannelRecord& channel)
{
    return static_cast<AnimationPath>(channel.path);
}

bool isSpline(const AnimationChannelRecord& channel)
{
    return channel.interpolation == static_cast<uint32_t>(Interpolation::cubic_spline);
}

std::vector<float> toFloats(const KeyValue& value, uint32_t components)
{
    std::vector<float> floats;
    for (uint32_t i = 0; i < components; ++i)
        floats.push_back(static_cast<float>(value[i]));
    return floats;
}

FittedChannel copyChannel(const AnimationTables& tables, const AnimationChannelRecord& channel)
{
    HEARTH_ASSERT(!isPacked(channel));
    const size_t rows = isSpline(channel) ? 3 : 1;
    const auto values =
        tables.keys.subspan(channel.first_value, channel.key_count * rows * size_t{channel.components});
    const auto times = tables.keys.subspan(channel.first_time, channel.key_count);
    FittedChannel fitted;
    fitted.record = channel;
    fitted.times.assign(times.begin(), times.end());
    fitted.values.assign(values.begin(), values.end());
    return fitted;
}

void copyChannels(const AnimationTables& tables, Range channels, FittedClip& clip)
{
    for (const AnimationChannelRecord& channel : recordsInRange(tables.channels, channels))
        clip.channels.push_back(copyChannel(tables, channel));
}

/// Return a channel with one value at all times.
FittedChannel constantChannel(const AnimationChannelRecord& channel, std::vector<float> value)
{
    FittedChannel fitted;
    fitted.record = channel;
    fitted.record.key_count = 1;
    fitted.record.interpolation = static_cast<uint32_t>(Interpolation::step);
    fitted.times = {0};
    fitted.values = std::move(value);
    return fitted;
}

/// Return the weights of a channel if they never change.
std::optional<std::vector<float>> constantWeights(const AnimationTables& tables,
                                                  const AnimationChannelRecord& channel)
{
    const bool spline = isSpline(channel);
    const size_t count = channel.components;
    const auto row = [&](size_t number)
    { return tables.keys.subspan(channel.first_value + number * count, count); };
    const std::span<const float> first = row(spline ? 1 : 0);
    for (size_t i = 0; i < channel.key_count * size_t{spline ? 3u : 1u}; ++i)
    {
        const bool tangent = spline && i % 3 != 1;
        const std::span<const float> other = row(i);
        if (tangent ? std::any_of(other.begin(), other.end(), [](float slope) { return slope != 0; })
                    : !std::equal(other.begin(), other.end(), first.begin()))
            return std::nullopt;
    }
    return std::vector<float>(first.begin(), first.end());
}

FittedChannel packed(const AnimationChannelRecord& channel, const Curve& curve, PackedCurve keys)
{
    FittedChannel fitted;
    fitted.record = channel;
    fitted.record.key_count = static_cast<uint32_t>(keys.keys.size());
    fitted.record.interpolation =
        static_cast<uint32_t>(curve.steps ? Interpolation::step : Interpolation::linear);
    fitted.record.encoding = static_cast<uint32_t>(KeyEncoding::packed);
    std::copy(keys.bits.begin(), keys.bits.end(), fitted.record.value_bits);
    for (const PackedCurve::Key& key : keys.keys)
        fitted.times.push_back(curve.times[key.curve_key]);
    fitted.packed = std::move(keys);
    return fitted;
}

/// Return the approximate size of a packed channel's values, with indices of its times if it does not have
/// all of them.
size_t sizeBits(const PackedCurve& packed, const AnimationChannelRecord& channel, const Curve& curve)
{
    constexpr size_t kOfOneTime = 8, kOfBaseAndStep = 128;
    const bool all_times = packed.keys.size() == curve.times.size() && !isSpline(channel);
    return packed.keys.size() * (packed.keyBits(curve.path) + (all_times ? 0 : kOfOneTime)) + kOfBaseAndStep;
}

KeyValue restValue(const NodePose& rest, AnimationPath path)
{
    const Double3 vector = path == AnimationPath::scale ? rest.scale : rest.translation;
    return path == AnimationPath::rotation ? rest.rotation : KeyValue{vector.x, vector.y, vector.z, 0};
}

/// Error budget of a node.
struct NodeState
{
    uint32_t chain = 0; ///< channels that need a share of the error, on the longest chain from the node down
    double model_size = 0; ///< metres; size of the model that the node belongs to
    /// metres of error that remain for the node and its descendants; below 0: no animated node up to here
    double remaining = -1;
    double used = 0;    ///< metres of error that descendant vertices may already have
    double stretch = 1; ///< upper bound for the largest singular value of the product of all ancestors
    double scale = 1;   ///< upper bound for the largest singular value of the node itself
};

class ClipFitter
{
public:
    ClipFitter(const AnimationTables& tables, const AnimationRecord& animation, const SceneReach& scene,
               const StatedError& stated)
        : tables_(tables),
          scene_(scene),
          stated_(stated),
          reach_(computeClipReach(tables, animation, scene)),
          rest_(restPose(tables)),
          channels_of_node_(tables.nodes.size()),
          states_(tables.nodes.size())
    {
        for (const AnimationChannelRecord& channel : recordsInRange(tables.channels, animation.channels))
            addChannel(channel);
        countChains();
    }

    FittedClip fit()
    {
        for (const uint32_t node : scene_.parents_first)
            fitNode(node);
        for (size_t node = 0; node < states_.size(); ++node)
            if (scene_.own[node] >= 0)
                clip_.proven_error = std::max(clip_.proven_error, states_[node].used);
        return std::move(clip_);
    }

private:
    struct Channel
    {
        AnimationChannelRecord record;
        KeyValue middle{};
        double from_middle = 0; ///< maximum distance of the channel from `middle`
    };

    /// True if the channel can be approximated: not for morph weights, nor for a node with a matrix, which
    /// does not move.
    bool isMeasured(const AnimationChannelRecord& channel) const
    {
        return channelPath(channel) != AnimationPath::weights && tables_.nodes[channel.target].has_trs != 0;
    }

    /// Add a channel. It replaces an earlier channel for the same property.
    void addChannel(const AnimationChannelRecord& record)
    {
        std::vector<Channel>& channels = channels_of_node_[record.target];
        std::erase_if(channels, [&](const Channel& other) { return other.record.path == record.path; });
        Channel channel{record, {}, 0};
        if (isMeasured(record))
        {
            channel.middle = middleValue(tables_, record);
            const bool rotation = channelPath(record) == AnimationPath::rotation;
            channel.from_middle = constantDeviation(
                tables_, record,
                rotation ? animation_bounds::normalizedOrNone(channel.middle) : channel.middle);
        }
        channels.push_back(channel);
    }

    void countChains()
    {
        for (auto at = scene_.parents_first.rbegin(); at != scene_.parents_first.rend(); ++at)
        {
            for (const Channel& channel : channels_of_node_[*at])
                states_[*at].chain += channel.from_middle > 0 ? 1 : 0;
            if (const uint32_t parent = tables_.nodes[*at].parent; parent != kInvalidIndex)
                states_[parent].chain = std::max(states_[parent].chain, states_[*at].chain);
        }
    }

    void fitNode(uint32_t node)
    {
        NodeState& state = states_[node];
        state.scale = reach_.scale[node];
        if (const uint32_t parent = tables_.nodes[node].parent; parent != kInvalidIndex)
        {
            const NodeState& above = states_[parent];
            state.model_size = above.model_size;
            state.remaining = above.remaining;
            state.used = above.used;
            state.stretch = above.stretch * above.scale;
        }
        if (state.remaining < 0 && !channels_of_node_[node].empty())
            beginModel(node);
        uint32_t remaining_channels = state.chain;
        for (const Channel& channel : channels_of_node_[node])
        {
            if (!isMeasured(channel.record))
            {
                fitUnmeasured(channel.record);
                continue;
            }
            const double share = channel.from_middle > 0 ? state.remaining / remaining_channels-- : 0;
            fitMeasured(channel, share, state);
        }
    }

    void beginModel(uint32_t node)
    {
        NodeState& state = states_[node];
        state.model_size = scene_.size[node] > 0 ? scene_.size[node] : scene_.scene_size;
        state.remaining = stated_.metres + stated_.share_of_size * state.model_size;
        if (!std::isfinite(state.remaining))
            state.remaining = 0;
        clip_.stated_error = std::max(clip_.stated_error, state.remaining);
    }

    /// Return the error in metres in world space for a deviation of 1.
    double metresPerUnit(const AnimationChannelRecord& channel, const NodeState& state) const
    {
        const double farthest = reach_.farthest[channel.target];
        const double least = farthest < 0 ? state.model_size : kMinReach * state.model_size;
        switch (channelPath(channel))
        {
        case AnimationPath::rotation:
            return 2 * std::max(state.stretch * reach_.scale[channel.target] * farthest, least);
        case AnimationPath::scale:
            return std::max(state.stretch * farthest, least / std::max(reach_.scale[channel.target], 1e-30));
        default:
            break;
        }
        return state.stretch;
    }

    void fitMeasured(const Channel& channel, double share, NodeState& state)
    {
        const double metres = metresPerUnit(channel.record, state);
        if (!std::isfinite(metres))
        {
            clip_.channels.push_back(copyChannel(tables_, channel.record));
            return;
        }
        double tolerance = share > 0 ? share / metres : 0;
        if (channelPath(channel.record) == AnimationPath::rotation)
            tolerance = std::clamp(tolerance, kSameChord, kMaxChord);
        if (channelPath(channel.record) == AnimationPath::scale)
            tolerance = std::min(tolerance, kMaxChord * reach_.scale[channel.record.target]);
        const double deviation = fitChannel(channel, tolerance);
        if (channelPath(channel.record) == AnimationPath::scale)
            state.scale += deviation;
        state.used += deviation * metres * kSpentMargin;
        state.remaining = std::max(state.remaining - deviation * metres * kSpentMargin, 0.0);
    }

    /// Fit a channel and add it to the clip.
    /// returns  upper bound for the distance of the result from the channel
    double fitChannel(const Channel& channel, double tolerance)
    {
        const AnimationChannelRecord& record = channel.record;
        const KeyValue rest = restValue(rest_.nodes[record.target], channelPath(record));
        if (const double off = constantDeviation(tables_, record, rest); off <= tolerance)
            return off;
        if (channel.from_middle <= tolerance)
        {
            clip_.channels.push_back(constantChannel(record, toFloats(channel.middle, record.components)));
            return channel.from_middle;
        }
        clip_.channels.push_back(copyChannel(tables_, record));
        if (!(channel.from_middle > 0 && tolerance > 0))
            return 0;
        const std::optional<Curve> curve = makeCurve(tables_, record, kSplineShare * tolerance);
        if (!curve)
            return 0;
        std::optional<PackedCurve> smaller = packCurve(*curve, tolerance);
        if (!smaller || sizeBits(*smaller, record, *curve) >= 32 * clip_.channels.back().values.size())
            return 0;
        const double deviation = smaller->deviation;
        clip_.channels.back() = packed(record, *curve, std::move(*smaller));
        return deviation;
    }

    void fitUnmeasured(const AnimationChannelRecord& channel)
    {
        if (channelPath(channel) != AnimationPath::weights)
        {
            clip_.channels.push_back(copyChannel(tables_, channel));
            return;
        }
        const std::optional<std::vector<float>> weights = constantWeights(tables_, channel);
        const std::span<const float> rest =
            recordsInRange(tables_.morph_weights, tables_.nodes[channel.target].morph_weights);
        if (!weights)
            clip_.channels.push_back(copyChannel(tables_, channel));
        else if (!std::equal(rest.begin(),
                             rest.begin() +
                                 static_cast<std::ptrdiff_t>(std::min(rest.size(), weights->size())),
                             weights->begin()))
            clip_.channels.push_back(constantChannel(channel, *weights));
    }

    const AnimationTables& tables_;
    const SceneReach& scene_;
    const StatedError& stated_;
    ClipReach reach_;
    ScenePose rest_;
    std::vector<std::vector<Channel>> channels_of_node_;
    std::vector<NodeState> states_;
    FittedClip clip_;
};

} // namespace

FittedClip fitClip(const AnimationTables& tables, const AnimationRecord& animation, const SceneReach& scene,
                   const StatedError& stated)
{
    FittedClip clip = ClipFitter(tables, animation, scene, stated).fit();
    copyChannels(tables, animation.light_channels, clip);
    return clip;
}

FittedClip sourceClip(const AnimationTables& tables, const AnimationRecord& animation)
{
    FittedClip clip;
    copyChannels(tables, animation.channels, clip);
    copyChannels(tables, animation.light_channels, clip);
    return clip;
}

} // namespace hearth::animation_compression
