// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/pose_regions.h"

#include "cook/animation_bounds/quaternion.h"
#include "formats/codecs/channel_keys.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace hearth::animation_bounds
{

using namespace formats;

namespace
{

// Maximum number of spans of a clip, and approximate number of all clips together.
constexpr uint32_t kMaxLeaves = 128;
constexpr uint32_t kLeavesOfAllClips = 2048;
constexpr uint32_t kMinLeaves = 8;

// Smallest range of weights that blends are split into.
constexpr double kMinWeightRange = 1.0 / 64;

// Remainder, as an angle between quaternions in radians, that an unknown rotation counts as.
constexpr double kAnyRotation = std::numbers::pi / 2;

// Error of polynomials for a rotation by x radians in all, as a share of x, divided by x^2. Measured: with a
// value a hundred times larger, boxes of the fox are 1.9 times the tightest, with this one 1.6, for the same
// work.
constexpr double kCurvatureError = 0.005;

double angleBetween(const Quaternion& a, const Quaternion& b)
{
    return std::acos(std::min(1.0, std::abs(dot(a, b))));
}

/// Return the times at which a channel has a key, seconds, sorted.
std::vector<double> keyTimes(const AnimationTables& tables, const AnimationRecord& animation)
{
    std::vector<double> times;
    for (const AnimationChannelRecord& channel :
         tables.channels.subspan(animation.channels.first, animation.channels.count))
    {
        const ChannelKeys keys(tables.keys, tables.key_bits, channel);
        for (uint32_t key = 0; key < keys.count(); ++key)
            times.push_back(keys.time(key));
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

/// Return the key time nearest to the middle of a span, or the middle if no key is in the middle half.
double splitTime(TimeSpan span, std::span<const double> key_times)
{
    const double middle = 0.5 * (span.from + span.to), quarter = 0.25 * (span.to - span.from);
    const auto later = std::lower_bound(key_times.begin(), key_times.end(), middle);
    double cut = middle, distance = quarter;
    const auto propose = [&](double time)
    {
        if (std::abs(time - middle) < distance)
        {
            distance = std::abs(time - middle);
            cut = time;
        }
    };
    if (later != key_times.begin())
        propose(*std::prev(later));
    if (later != key_times.end())
        propose(*later);
    return cut;
}

/// Amount of motion of a node in a time span: size of the polynomials' motion, and of their remainders.
struct SpanMotion
{
    double smooth = 0;
    double rough = 0;
};

void addMotion(const NodeSpan& span, SpanMotion& motion)
{
    const auto add = [&](const TimeCurve& curve, double share)
    {
        motion.smooth += share * (length(curve.terms[1]) + length(curve.terms[2]));
        motion.rough += share * std::min(curve.remainder, kAnyRotation);
    };
    add(span.rotation, 2);
    add(span.scale, 1);
    const double size = length(span.translation.terms[0]) + length(span.translation.terms[1]) +
                        length(span.translation.terms[2]) + span.translation.remainder;
    add(span.translation, 1 / (size + 1e-30));
}

bool isConstant(const TimeCurve& curve)
{
    constexpr ChannelValue kNone{};
    return curve.terms[1] == kNone && curve.terms[2] == kNone && curve.remainder == 0;
}

/// Compute (1 - w) from + w to.
void setBlend(const TimeCurve& from, const TimeCurve& to, Interval weights, VectorModel& model)
{
    const double weight = weights.middle(), half = weights.half();
    if (isConstant(from) && isConstant(to) && from.terms[0] == to.terms[0])
    {
        const auto& value = from.terms[0];
        model = {};
        model.terms[0] = {value[0], value[1], value[2]};
        return;
    }
    for (size_t i = 0; i < 3; ++i)
    {
        const double a[3] = {from.terms[0][i], from.terms[1][i], from.terms[2][i]};
        const double b[3] = {to.terms[0][i], to.terms[1][i], to.terms[2][i]};
        const auto term = [&](size_t at) -> double& { return model.terms[at][i]; };
        term(0) = (1 - weight) * a[0] + weight * b[0];
        term(kFirstLinear) = (1 - weight) * a[1];
        term(kFirstLinear + 1) = weight * b[1];
        term(kFirstLinear + 2) = half * (b[0] - a[0]);
        term(termIndex(0, 0)) = (1 - weight) * a[2];
        term(termIndex(1, 1)) = weight * b[2];
        term(termIndex(2, 2)) = 0;
        term(termIndex(0, 1)) = 0;
        term(termIndex(0, 2)) = -half * a[1];
        term(termIndex(1, 2)) = half * b[1];
    }
    model.remainder = half * (length(from.terms[2]) + length(to.terms[2])) +
                      std::max(std::lerp(from.remainder, to.remainder, weights.low),
                               std::lerp(from.remainder, to.remainder, weights.high));
}

ChannelValue vectorValue(Double3 v)
{
    return {v.x, v.y, v.z, 0};
}

} // namespace

PoseRegions::PoseRegions(const AnimationTables& tables, std::span<const NodeMotion> nodes)
    : tables_(tables), nodes_(nodes)
{
    for (const NodePose& pose : restPose(tables).nodes)
        rest_.push_back({constantCurve(vectorValue(pose.translation)), constantCurve(pose.rotation),
                         constantCurve(vectorValue(pose.scale))});
    Clip rest;
    rest.times.resize(2);
    rest.parts = std::make_unique<Part[]>(2);
    clips_.push_back(std::move(rest));
    for (const AnimationRecord& animation : tables.animations)
        clips_.push_back(makeClip(animation));
}

PoseRegions::Clip PoseRegions::makeClip(const AnimationRecord& animation) const
{
    Clip clip;
    clip.animation = &animation;
    const auto share = static_cast<uint32_t>(kLeavesOfAllClips / tables_.animations.size());
    clip.leaves = std::bit_floor(std::clamp(share, kMinLeaves, kMaxLeaves));
    clip.times.resize(2 * clip.leaves);
    clip.parts = std::make_unique<Part[]>(2 * clip.leaves);
    const std::vector<double> key_times = keyTimes(tables_, animation);
    clip.times[1] = {0, animation.duration, true};
    for (uint32_t part = 1; part < clip.leaves; ++part)
    {
        const TimeSpan& time = clip.times[part];
        const double cut = splitTime(time, key_times);
        clip.times[2 * part] = {time.from, cut, false};
        clip.times[2 * part + 1] = {cut, time.to, time.last};
    }
    return clip;
}

std::vector<NodeSpan> PoseRegions::computeSpans(const Clip& clip, uint32_t part) const
{
    std::vector<NodeSpan> spans = rest_;
    if (clip.animation == nullptr)
        return spans;
    const Range channels = clip.animation->channels;
    for (const AnimationChannelRecord& channel : tables_.channels.subspan(channels.first, channels.count))
    {
        NodeSpan& span = spans[channel.target];
        switch (static_cast<AnimationPath>(channel.path))
        {
        case AnimationPath::translation:
            span.translation = fitVectorCurve(clip.times[part], tables_, channel);
            break;
        case AnimationPath::rotation:
            span.rotation = fitRotationCurve(clip.times[part], tables_, channel);
            break;
        case AnimationPath::scale:
            span.scale = fitVectorCurve(clip.times[part], tables_, channel);
            break;
        default:
            break;
        }
    }
    return spans;
}

const NodeSpan& PoseRegions::span(uint32_t clip, uint32_t part, uint32_t node) const
{
    Part& found = clips_[clip].parts[part];
    std::call_once(found.once, [&] { found.spans = computeSpans(clips_[clip], part); });
    return found.spans[node];
}

std::vector<PoseRegion> PoseRegions::all() const
{
    std::vector<PoseRegion> regions;
    for (uint32_t from = 0; from < clips_.size(); ++from)
        for (uint32_t to = from; to < clips_.size(); ++to)
            regions.push_back({from, 1, to, 1, 0, 1});
    return regions;
}

PoseRegion PoseRegions::sample(size_t number) const
{
    // sequence of the plastic number, evenly spread in four dimensions (M. Roberts, 2018)
    const auto share = [&](double step)
    {
        const double at = 0.5 + step * static_cast<double>(number);
        return at - std::floor(at);
    };
    const auto leaf = [&](uint32_t clip, double at)
    { return clips_[clip].leaves + static_cast<uint32_t>(at * clips_[clip].leaves); };
    const auto count = static_cast<double>(clips_.size());
    const auto from = static_cast<uint32_t>(number % clips_.size());
    const auto to = static_cast<uint32_t>(share(0.856674884) * count);
    // half of the samples are in one clip alone
    const double weight = number % 2 == 0 ? 0.0 : share(0.733891856);
    return {from, leaf(from, share(0.628706728)), to, leaf(to, share(0.538597197)), weight, weight};
}

std::optional<std::array<PoseRegion, 2>> PoseRegions::split(const PoseRegion& region,
                                                            std::span<const uint32_t> nodes) const
{
    const double weights = region.high_weight - region.low_weight;
    const bool can_cut_from = region.from_span < clips_[region.from_clip].leaves && region.low_weight < 1;
    const bool can_cut_to = region.to_span < clips_[region.to_clip].leaves && region.high_weight > 0;
    double between = 0;
    SpanMotion from_motion, to_motion;
    for (const uint32_t node : nodes)
    {
        const NodeSpan& from = span(region.from_clip, region.from_span, node);
        const NodeSpan& to = span(region.to_clip, region.to_span, node);
        between += 2 * angleBetween(from.rotation.terms[0], to.rotation.terms[0]);
        addMotion(from, from_motion);
        addMotion(to, to_motion);
    }
    const double from_share = 1 - region.low_weight, to_share = region.high_weight;
    const double along_weights = 0.5 * (between + from_motion.smooth + to_motion.smooth) * weights;
    const double all = from_motion.smooth * from_share + to_motion.smooth * to_share + along_weights;
    // the error of polynomials grows with the third power
    const double bend = std::min(1.0, kCurvatureError * all * all);
    const double of_from = can_cut_from ? (from_motion.rough + from_motion.smooth * bend) * from_share : -1;
    const double of_to = can_cut_to ? (to_motion.rough + to_motion.smooth * bend) * to_share : -1;
    const double of_weights = weights > kMinWeightRange ? along_weights * bend : -1;
    std::array<PoseRegion, 2> split{region, region};
    if (of_from < 0 && of_to < 0 && of_weights < 0)
        return std::nullopt;
    if (of_weights >= of_from && of_weights >= of_to)
        split[0].high_weight = split[1].low_weight = 0.5 * (region.low_weight + region.high_weight);
    else if (of_from >= of_to)
    {
        split[0].from_span = 2 * region.from_span;
        split[1].from_span = 2 * region.from_span + 1;
    }
    else
    {
        split[0].to_span = 2 * region.to_span;
        split[1].to_span = 2 * region.to_span + 1;
    }
    return split;
}

void PoseRegions::setNodeModel(const PoseRegion& region, uint32_t node, BlendWeights& weights,
                               NodeModel& model) const
{
    const NodeSpan& from = span(region.from_clip, region.from_span, node);
    const NodeSpan& to = span(region.to_clip, region.to_span, node);
    setBlend(from.translation, to.translation, weights.range, model.translation);
    slerpModel(from.rotation, to.rotation, weights, model.rotation);
    if (!(model.rotation.remainder < 1))
        model.rotation = anyRotation();
    setBlend(from.scale, to.scale, weights.range, model.scale);
}

NodePose PoseRegions::middlePose(const PoseRegion& region, uint32_t node) const
{
    const NodeSpan& from = span(region.from_clip, region.from_span, node);
    const NodeSpan& to = span(region.to_clip, region.to_span, node);
    const double weight = 0.5 * (region.low_weight + region.high_weight);
    const auto between = [&](const TimeCurve& a, const TimeCurve& b)
    {
        return Double3{std::lerp(a.terms[0][0], b.terms[0][0], weight),
                       std::lerp(a.terms[0][1], b.terms[0][1], weight),
                       std::lerp(a.terms[0][2], b.terms[0][2], weight)};
    };
    return {between(from.translation, to.translation),
            slerp(normalizedOrNone(from.rotation.terms[0]), normalizedOrNone(to.rotation.terms[0]), weight),
            between(from.scale, to.scale)};
}

} // namespace hearth::animation_bounds
