// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/animations.h"

#include "formats/records/animation_paths.h"
#include "formats/scene/animation.h"
#include "pipelines/import/part/limit_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hearth::import
{

using namespace formats;

namespace
{

// chunk AKEY is addressed by 32 bits; this is 4 GiB of keys
constexpr size_t kMaxKeyFloats = size_t{1} << 30;

// quaternions whose length differs more from 1 get a warning
constexpr float kLengthRounding = 0.01f;

struct Curve
{
    std::vector<float> times;
    std::vector<float> values;
};

/// Location of a curve in the part.
struct CurveLocation
{
    uint32_t first_time = 0;
    uint32_t first_value = 0;
    uint32_t key_count = 0;
    float end_time = 0;
};

bool allFinite(const std::vector<float>& values)
{
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

/// Drop the keys whose time is not greater than the previous one. True if no key was dropped.
bool dropNonIncreasingKeys(Curve& curve)
{
    const size_t stride = curve.values.size() / curve.times.size();
    size_t kept = 0;
    for (size_t key = 0; key < curve.times.size(); ++key)
    {
        if (kept > 0 && curve.times[key] <= curve.times[kept - 1])
            continue;
        curve.times[kept] = curve.times[key];
        std::copy_n(curve.values.begin() + static_cast<std::ptrdiff_t>(key * stride), stride,
                    curve.values.begin() + static_cast<std::ptrdiff_t>(kept * stride));
        ++kept;
    }
    const bool all = kept == curve.times.size();
    curve.times.resize(kept);
    curve.values.resize(kept * stride);
    return all;
}

/// Normalise the quaternions at first, first + step, ... True if none had a length far from 1.
bool normalizeRotations(std::vector<float>& values, size_t first, size_t step)
{
    bool near = true;
    for (size_t i = first; i + 4 <= values.size(); i += step)
    {
        const auto q = std::span(values).subspan(i, 4);
        double square = 0;
        for (const float v : q)
            square += double{v} * double{v};
        const double length = std::sqrt(square);
        near = near && std::abs(length - 1) <= double{kLengthRounding};
        for (size_t k = 0; k < 4; ++k)
            q[k] = length > 0 ? static_cast<float>(double{q[k]} / length) : (k == 3 ? 1.0f : 0.0f);
    }
    return near;
}

/// Clamp the values of a light's property, at first, first + step, ..., as the reader of lights does. True if
/// all were in range.
bool clampLightValues(std::vector<float>& values, AnimationPath path, size_t first, size_t step)
{
    const bool is_cone = path == AnimationPath::light_inner_cone || path == AnimationPath::light_outer_cone;
    const float min = path == AnimationPath::light_range ? kMinAnimatedRange : 0;
    const float max = is_cone ? std::numbers::pi_v<float> / 2 : std::numeric_limits<float>::max();
    const size_t components = kAnimationPaths[static_cast<size_t>(path)].components;
    bool in_range = true;
    for (size_t i = first; i + components <= values.size(); i += step)
        for (float& value : std::span(values).subspan(i, components))
        {
            in_range = in_range && value >= min && value <= max;
            value = std::clamp(value, min, max);
        }
    return in_range;
}

class AnimationWriter
{
public:
    AnimationWriter(const GltfModel& model, GltfAccessors& accessors, const GltfContext& context,
                    GltfTally& tally)
        : model_(model), accessors_(accessors), context_(context), tally_(tally)
    {
    }

    Status write(uint32_t index);

private:
    Status checkSamplers() const;
    Status writeNodeChannel(const GltfAnimationChannel& channel);
    Status writeLightChannel(const GltfAnimationChannel& channel);
    Status writeChannel(const GltfAnimationChannel& channel, uint32_t target, size_t components);
    Status checkOutput(const GltfAnimationSampler& sampler, AnimationPath path) const;
    Result<CurveLocation> findOrWriteCurve(const GltfAnimationSampler& sampler, AnimationPath path,
                                           size_t components);
    Result<Curve> readCurve(const GltfAnimationSampler& sampler, AnimationPath path, size_t components);

    const GltfModel& model_;
    GltfAccessors& accessors_;
    const GltfContext& context_;
    GltfTally& tally_;
    const GltfAnimation* animation_ = nullptr;
    std::string where_;
    /// Location of the keys by sampler, path and component count: channels that share a sampler share its
    /// keys.
    std::map<std::tuple<uint32_t, AnimationPath, size_t>, CurveLocation> locations_;
};

bool isScalarFloat(const GltfAccessor& accessor)
{
    return accessor.type == ElementType::scalar && accessor.component == ComponentType::f32;
}

Status AnimationWriter::checkSamplers() const
{
    for (const GltfAnimationSampler& sampler : animation_->samplers)
        if (!isScalarFloat(accessors_.accessor(sampler.input)))
            return accessors_.error(
                sampler.input, Issue::gltf_value,
                fmt::format("times cannot be a {}", formatName(accessors_.accessor(sampler.input))));
    return success();
}

Status AnimationWriter::checkOutput(const GltfAnimationSampler& sampler, AnimationPath path) const
{
    const GltfAccessor& output = accessors_.accessor(sampler.output);
    const uint32_t components = kAnimationPaths[static_cast<size_t>(path)].components;
    const ElementType type = components == 3   ? ElementType::vec3
                             : components == 4 ? ElementType::vec4
                                               : ElementType::scalar;
    const bool is_float = output.component == ComponentType::f32;
    const bool is_length = path == AnimationPath::translation || path == AnimationPath::scale;
    if (output.type == type && (is_float || (!is_length && output.normalized)))
        return success();
    return accessors_.error(sampler.output, Issue::gltf_value,
                            fmt::format("animated values of this path cannot be a {}", formatName(output)));
}

Result<Curve> AnimationWriter::readCurve(const GltfAnimationSampler& sampler, AnimationPath path,
                                         size_t components)
{
    HEARTH_TRY(checkOutput(sampler, path));
    const GltfAccessor& input = accessors_.accessor(sampler.input);
    const GltfAccessor& output = accessors_.accessor(sampler.output);
    const uint64_t per_key = sampler.interpolation == Interpolation::cubic_spline ? 3 : 1;
    const uint64_t elements = path == AnimationPath::weights ? components : 1;
    if (output.count / per_key / elements != input.count || output.count % (per_key * elements) != 0)
        return accessors_.error(sampler.output, Issue::gltf_data,
                                fmt::format("{} values for {} keys", output.count, input.count));
    Curve curve;
    HEARTH_ASSIGN_OR_RETURN(curve.times, accessors_.floats(sampler.input));
    HEARTH_ASSIGN_OR_RETURN(curve.values, accessors_.floats(sampler.output));
    if (!allFinite(curve.times))
        return accessors_.error(sampler.input, Issue::gltf_data, "a time is not finite");
    if (std::any_of(curve.times.begin(), curve.times.end(), [](float time) { return time < 0; }))
        return accessors_.error(sampler.input, Issue::gltf_data, "a time is negative");
    if (!allFinite(curve.values))
        return accessors_.error(sampler.output, Issue::gltf_data, "an animated value is not finite");
    if (!dropNonIncreasingKeys(curve))
        tally_.repaired("animation keys whose time does not grow were left out", where_);
    if (path == AnimationPath::rotation &&
        !normalizeRotations(curve.values, per_key == 3 ? 4 : 0, 4 * per_key))
        tally_.repaired("animated rotations whose length is not 1 were scaled", where_);
    if (kAnimationPaths[static_cast<size_t>(path)].of_light &&
        !clampLightValues(curve.values, path, per_key == 3 ? components : 0, components * per_key))
        tally_.repaired("animated values of lights outside their range were clamped", where_);
    return curve;
}

Result<CurveLocation> AnimationWriter::findOrWriteCurve(const GltfAnimationSampler& sampler,
                                                        AnimationPath path, size_t components)
{
    const auto number = static_cast<uint32_t>(&sampler - animation_->samplers.data());
    const auto found = locations_.find({number, path, components});
    if (found != locations_.end())
        return found->second;
    HEARTH_ASSIGN_OR_RETURN(const Curve curve, readCurve(sampler, path, components));
    std::vector<float>& keys = context_.part.keys;
    if (const size_t floats = keys.size() + curve.times.size() + curve.values.size(); floats > kMaxKeyFloats)
        return context_.error(Issue::input_too_large, where_,
                              describeExcess(floats, "times and values of animations", kMaxKeyFloats));
    CurveLocation location;
    location.key_count = static_cast<uint32_t>(curve.times.size());
    location.first_time = static_cast<uint32_t>(keys.size());
    location.first_value = location.first_time + location.key_count;
    location.end_time = curve.times.back();
    keys.insert(keys.end(), curve.times.begin(), curve.times.end());
    keys.insert(keys.end(), curve.values.begin(), curve.values.end());
    locations_.emplace(std::tuple(number, path, components), location);
    return location;
}

Status AnimationWriter::writeChannel(const GltfAnimationChannel& channel, uint32_t target, size_t components)
{
    const GltfAnimationSampler& sampler = animation_->samplers[channel.sampler];
    HEARTH_ASSIGN_OR_RETURN(const CurveLocation curve, findOrWriteCurve(sampler, channel.path, components));

    AnimationChannelRecord record{};
    record.target = target;
    record.path = static_cast<uint32_t>(channel.path);
    record.interpolation = static_cast<uint32_t>(sampler.interpolation);
    record.components = static_cast<uint32_t>(components);
    record.key_count = curve.key_count;
    record.first_time = curve.first_time;
    record.first_value = curve.first_value;
    context_.part.channels.push_back(record);
    AnimationRecord& animation = context_.part.animations.back();
    animation.duration = std::max(animation.duration, curve.end_time);
    return success();
}

Status AnimationWriter::writeNodeChannel(const GltfAnimationChannel& channel)
{
    const uint32_t mesh = model_.nodes[channel.target].mesh;
    size_t components = kAnimationPaths[static_cast<size_t>(channel.path)].components;
    if (channel.path == AnimationPath::weights)
        components = mesh == kInvalidIndex ? 0 : morphTargetCount(model_.meshes[mesh]);
    if (components == 0)
    {
        tally_.dropped("animation of morph weights without morph targets is not kept", where_);
        return success();
    }
    if (!model_.nodes[channel.target].has_trs && channel.path != AnimationPath::weights)
        tally_.degraded("animation of a node that has a matrix", where_);
    return writeChannel(channel, channel.target, components);
}

/// Write a channel for each light of the part that the document's light has become.
Status AnimationWriter::writeLightChannel(const GltfAnimationChannel& channel)
{
    bool found = false;
    for (uint32_t light = 0; light < context_.part.lights.size(); ++light)
    {
        if (model_.nodes[context_.part.lights[light].node].light != channel.target)
            continue;
        found = true;
        HEARTH_TRY(
            writeChannel(channel, light, kAnimationPaths[static_cast<size_t>(channel.path)].components));
    }
    if (!found)
        tally_.dropped("animation of a light that no drawn node has is not kept", where_);
    return success();
}

Status AnimationWriter::write(uint32_t index)
{
    animation_ = &model_.animations[index];
    where_ = fmt::format("/animations/{}", index);
    locations_.clear();
    HEARTH_TRY(checkSamplers());
    const auto channelCount = [&] { return static_cast<uint32_t>(context_.part.channels.size()); };
    const auto isOfLight = [](const GltfAnimationChannel& channel)
    { return kAnimationPaths[static_cast<size_t>(channel.path)].of_light; };
    AnimationRecord record{};
    record.name = context_.part.intern(animation_->name);
    const uint32_t first = channelCount();
    context_.part.animations.push_back(record);
    for (const GltfAnimationChannel& channel : animation_->channels)
        if (!isOfLight(channel))
            HEARTH_TRY(writeNodeChannel(channel));
    const uint32_t first_of_lights = channelCount();
    for (const GltfAnimationChannel& channel : animation_->channels)
        if (isOfLight(channel))
            HEARTH_TRY(writeLightChannel(channel));
    AnimationRecord& written = context_.part.animations.back();
    written.channels = {first, first_of_lights - first};
    written.light_channels = {first_of_lights, channelCount() - first_of_lights};
    return success();
}

} // namespace

size_t morphTargetCount(const GltfMesh& mesh)
{
    size_t count = 0;
    for (const GltfPrimitive& primitive : mesh.primitives)
        count = std::max(count, primitive.targets.size());
    return count;
}

Status writeAnimations(const GltfModel& model, GltfAccessors& accessors, const GltfContext& context,
                       GltfTally& tally)
{
    AnimationWriter writer(model, accessors, context, tally);
    for (uint32_t animation = 0; animation < model.animations.size(); ++animation)
        HEARTH_TRY(writer.write(animation));
    context.part.counts.animations = model.animations.size();
    return success();
}

} // namespace hearth::import
