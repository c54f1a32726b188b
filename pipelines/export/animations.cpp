// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/animations.h"

#include "formats/codecs/channel_keys.h"
#include "formats/records/animation_paths.h"
#include "pipelines/export/accessors.h"

#include <fmt/format.h>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

std::string interpolationName(Interpolation interpolation)
{
    switch (interpolation)
    {
    case Interpolation::step:
        return "STEP";
    case Interpolation::cubic_spline:
        return "CUBICSPLINE";
    default:
        return "LINEAR";
    }
}

/// Times and values of a channel, decoded.
struct Curve
{
    std::vector<float> times;
    std::vector<float> values;
};

/// Append the numbers of a key, four at a time.
template <typename Read>
void appendValue(const AnimationChannelRecord& channel, const Read& read, std::vector<float>& values)
{
    for (uint32_t first = 0; first < channel.components; first += 4)
    {
        const uint32_t count = std::min(4u, channel.components - first);
        const KeyValue value = read(first, count);
        for (uint32_t i = 0; i < count; ++i)
            values.push_back(static_cast<float>(value[i]));
    }
}

/// Turn the signs of rotations so that each is on the side of the one before: some readers interpolate
/// without a look at the shorter arc.
void alignRotations(std::vector<float>& values)
{
    for (size_t key = 4; key < values.size(); key += 4)
    {
        double dot = 0;
        for (size_t i = 0; i < 4; ++i)
            dot += double{values[key + i]} * double{values[key - 4 + i]};
        for (size_t i = 0; i < 4 && dot < 0; ++i)
            values[key + i] = -values[key + i];
    }
}

Curve readCurve(const PackView& pack, const AnimationChannelRecord& channel)
{
    const ChannelKeys keys(pack.keys(), pack.keyBits(), channel);
    const bool is_spline = keys.interpolation() == Interpolation::cubic_spline;
    Curve curve;
    for (uint32_t key = 0; key < keys.count(); ++key)
    {
        curve.times.push_back(keys.time(key));
        if (is_spline)
            appendValue(
                channel, [&](uint32_t first, uint32_t count) { return keys.inTangent(key, first, count); },
                curve.values);
        appendValue(
            channel, [&](uint32_t first, uint32_t count) { return keys.value(key, first, count); },
            curve.values);
        if (is_spline)
            appendValue(
                channel, [&](uint32_t first, uint32_t count) { return keys.outTangent(key, first, count); },
                curve.values);
    }
    if (channel.path == static_cast<uint32_t>(AnimationPath::rotation) && !is_spline)
        alignRotations(curve.values);
    return curve;
}

/// Repeat the last key at a later time. The tangents between the two are 0.
void extendCurve(const AnimationChannelRecord& channel, float time, Curve& curve)
{
    const size_t components = channel.components;
    const std::vector<float> zeros(components);
    const bool is_spline = static_cast<Interpolation>(channel.interpolation) == Interpolation::cubic_spline;
    if (is_spline)
        std::copy(zeros.begin(), zeros.end(), curve.values.end() - static_cast<std::ptrdiff_t>(components));
    const size_t row = curve.values.size() - (is_spline ? 2 : 1) * components;
    const std::vector<float> last(curve.values.begin() + static_cast<std::ptrdiff_t>(row),
                                  curve.values.begin() + static_cast<std::ptrdiff_t>(row + components));
    if (is_spline)
        curve.values.insert(curve.values.end(), zeros.begin(), zeros.end());
    curve.values.insert(curve.values.end(), last.begin(), last.end());
    if (is_spline)
        curve.values.insert(curve.values.end(), zeros.begin(), zeros.end());
    curve.times.push_back(time);
}

/// Adds the channels of one clip. Channels with the same keys share their accessors.
class ClipWriter
{
public:
    ClipWriter(GltfDocument& document, const PackView& pack) : document_(document), pack_(pack) {}

    void add(const AnimationChannelRecord& record, std::optional<float> end);
    Animation result;

private:
    uint32_t addTimes(const std::vector<float>& times)
    {
        const auto [found, is_new] = inputs_.try_emplace(times, kInvalidIndex);
        if (is_new)
            found->second =
                addFloats(document_, times, ElementType::scalar, ViewTarget::none, Extremes::stated);
        return found->second;
    }

    GltfDocument& document_;
    const PackView& pack_;
    std::map<std::vector<float>, uint32_t> inputs_;
};

void ClipWriter::add(const AnimationChannelRecord& record, std::optional<float> end)
{
    const AnimationPathInfo& path = kAnimationPaths[record.path];
    Curve curve = readCurve(pack_, record);
    if (end)
        extendCurve(record, *end, curve);
    AnimationChannel channel;
    channel.input = addTimes(curve.times);
    const ElementType type = path.components == 3   ? ElementType::vec3
                             : path.components == 4 ? ElementType::vec4
                                                    : ElementType::scalar;
    channel.output = addFloats(document_, curve.values, type, ViewTarget::none);
    channel.interpolation = interpolationName(static_cast<Interpolation>(record.interpolation));
    if (path.of_light)
        channel.path = fmt::format("/extensions/KHR_lights_punctual/lights/{}/{}", record.target, path.name);
    else
    {
        channel.node = record.target;
        channel.path = path.name;
    }
    result.channels.push_back(std::move(channel));
}

/// True if a channel changes something that the document has.
bool isWritten(const GltfDocument& document, const PackView& pack, const AnimationChannelRecord& channel)
{
    const auto path = static_cast<AnimationPath>(channel.path);
    if (kAnimationPaths[channel.path].of_light)
        return channel.target < document.lights.size();
    if (path == AnimationPath::weights)
        return document.nodes[channel.target].mesh != kInvalidIndex;
    // a node that has a matrix keeps it whatever a clip says
    return pack.nodes()[channel.target].has_trs != 0;
}

} // namespace

std::vector<uint32_t> addAnimations(GltfDocument& document, const PackView& pack, Omissions& omissions)
{
    std::vector<uint32_t> clips;
    for (const AnimationRecord& record : pack.animations())
    {
        std::vector<const AnimationChannelRecord*> channels;
        float last_key = 0;
        for (const Range range : {record.channels, record.light_channels})
            for (const AnimationChannelRecord& channel : recordsInRange(pack.channels(), range))
            {
                if (!isWritten(document, pack, channel))
                    continue;
                const ChannelKeys keys(pack.keys(), pack.keyBits(), channel);
                last_key = std::max(last_key, keys.time(keys.count() - 1));
                channels.push_back(&channel);
            }
        ClipWriter writer(document, pack);
        writer.result.name = pack.text(record.name);
        for (const AnimationChannelRecord* const channel : channels)
            writer.add(*channel, channel == channels.front() && last_key < record.duration
                                     ? std::optional(record.duration)
                                     : std::nullopt);
        if (channels.empty())
        {
            omissions.add("clips that move nothing");
            clips.push_back(kInvalidIndex);
            continue;
        }
        clips.push_back(static_cast<uint32_t>(document.animations.size()));
        document.animations.push_back(std::move(writer.result));
    }
    return clips;
}

} // namespace hearth::gltf_export
