// Reads skins and animations.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/model_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace hearth::import
{

namespace
{

constexpr Choice kInterpolations[] = {
    {"LINEAR", static_cast<uint32_t>(formats::Interpolation::linear)},
    {"STEP", static_cast<uint32_t>(formats::Interpolation::step)},
    {"CUBICSPLINE", static_cast<uint32_t>(formats::Interpolation::cubic_spline)},
};
constexpr Choice kPaths[] = {
    {"translation", static_cast<uint32_t>(formats::AnimationPath::translation)},
    {"rotation", static_cast<uint32_t>(formats::AnimationPath::rotation)},
    {"scale", static_cast<uint32_t>(formats::AnimationPath::scale)},
    {"weights", static_cast<uint32_t>(formats::AnimationPath::weights)},
};

/// Return the channel, or nullopt if it animates something that Hearth does not support.
std::optional<GltfAnimationChannel> readChannel(const GltfObject& object, size_t sampler_count,
                                                const GltfModel& model)
{
    GltfAnimationChannel channel;
    channel.sampler = object.index("sampler", sampler_count, Need::required);
    const auto target = object.object("target", Need::required);
    if (!target)
        return std::nullopt;
    channel.node = target->index("node", model.nodes.size());
    const std::string path = target->text("path", Need::required);
    const auto* known =
        std::find_if(std::begin(kPaths), std::end(kPaths), [&](const Choice& c) { return c.name == path; });
    if (known == std::end(kPaths))
    {
        object.problems().warn(Issue::dropped, object.json(),
                               fmt::format("animation of \"{}\" is not kept", path));
        return std::nullopt;
    }
    channel.path = static_cast<formats::AnimationPath>(known->value);
    // the specification allows a channel without a node, for extensions
    return channel.node == kInvalidIndex ? std::nullopt : std::optional(channel);
}

GltfAnimation readAnimation(const GltfObject& object, const GltfModel& model)
{
    GltfAnimation animation;
    animation.name = object.text("name");
    for (const GltfObject& sampler : object.objects("samplers", Need::required))
    {
        const uint32_t interpolation = sampler.choice("interpolation", kInterpolations,
                                                      static_cast<uint32_t>(formats::Interpolation::linear));
        animation.samplers.push_back({sampler.index("input", model.accessors.size(), Need::required),
                                      sampler.index("output", model.accessors.size(), Need::required),
                                      static_cast<formats::Interpolation>(interpolation)});
    }
    for (const GltfObject& channel : object.objects("channels", Need::required))
        if (const auto read = readChannel(channel, animation.samplers.size(), model))
            animation.channels.push_back(*read);
    return animation;
}

} // namespace

void readSkins(const GltfObject& root, GltfModel& model)
{
    for (const GltfObject& object : root.objects("skins"))
    {
        GltfSkin skin;
        skin.name = object.text("name");
        skin.inverse_bind_matrices = object.index("inverseBindMatrices", model.accessors.size());
        skin.skeleton = object.index("skeleton", model.nodes.size());
        skin.joints = object.indices("joints", model.nodes.size(), Need::required);
        if (skin.joints.empty())
            object.problems().fail(Issue::gltf_structure, object.json(), "the skin has no joints");
        model.skins.push_back(std::move(skin));
    }
}

void readAnimations(const GltfObject& root, GltfModel& model)
{
    for (const GltfObject& object : root.objects("animations"))
        model.animations.push_back(readAnimation(object, model));
}

} // namespace hearth::import
