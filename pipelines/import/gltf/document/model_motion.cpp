// Reads skins and animations.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/records/animation_paths.h"
#include "pipelines/import/gltf/document/model_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace hearth::import
{

namespace
{

constexpr Choice kInterpolations[] = {
    {"LINEAR", static_cast<uint32_t>(formats::Interpolation::linear)},
    {"STEP", static_cast<uint32_t>(formats::Interpolation::step)},
    {"CUBICSPLINE", static_cast<uint32_t>(formats::Interpolation::cubic_spline)},
};

constexpr std::string_view kLightPointer = "/extensions/KHR_lights_punctual/lights/";

/// Return the animated property of a node or of a light by its name; null if Hearth does not animate it.
const formats::AnimationPathInfo* findPath(std::string_view name, bool of_light)
{
    const auto* found = std::find_if(formats::kAnimationPaths.begin(), formats::kAnimationPaths.end(),
                                     [&](const formats::AnimationPathInfo& path)
                                     { return path.name == name && path.of_light == of_light; });
    return found == formats::kAnimationPaths.end() ? nullptr : found;
}

std::nullopt_t warnDropped(const GltfObject& object, std::string_view path)
{
    object.problems().warn(Issue::dropped, object.json(),
                           fmt::format("animation of \"{}\" is not kept", path));
    return std::nullopt;
}

/// Return the light that a JSON pointer names by its index; nullopt, and an error, if there is none.
std::optional<uint32_t> readLightIndex(const GltfObject& extension, std::string_view digits,
                                       size_t light_count)
{
    uint32_t light = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), light);
    const bool has_zeros = digits.size() > 1 && digits[0] == '0';
    if (error != std::errc() || end != digits.data() + digits.size() || has_zeros)
        extension.problems().fail(
            Issue::gltf_extension_value, extension.json(),
            fmt::format("the pointer has \"{}\" where the index of a light belongs", digits));
    else if (light >= light_count)
        extension.problems().fail(
            Issue::gltf_reference, extension.json(),
            fmt::format("the pointer names light {}, but there are {}", light, light_count));
    else
        return light;
    return std::nullopt;
}

/// Return a channel whose target is a pointer, or nullopt if it animates something else than a light.
/// channel  its sampler is set
std::optional<GltfAnimationChannel> readPointer(const GltfObject& object, const GltfObject& target,
                                                GltfAnimationChannel channel, const GltfModel& model)
{
    const auto extension = target.extension("KHR_animation_pointer");
    if (!extension)
        return warnDropped(object, "pointer");
    const std::string text = extension->text("pointer", Need::required);
    std::string_view pointer = text;
    if (!pointer.starts_with('/'))
    {
        object.problems().fail(Issue::gltf_extension_value, extension->json(),
                               fmt::format("\"{}\" is not a JSON pointer: it must begin with \"/\"", text));
        return std::nullopt;
    }
    if (!pointer.starts_with(kLightPointer))
        return warnDropped(object, text);
    pointer.remove_prefix(kLightPointer.size());
    const size_t slash = std::min(pointer.find('/'), pointer.size());
    const auto light = readLightIndex(*extension, pointer.substr(0, slash), model.lights.size());
    if (!light)
        return std::nullopt;
    const auto* path = findPath(pointer.substr(std::min(slash + 1, pointer.size())), true);
    const bool is_cone = path != nullptr && path->name.starts_with("spot/");
    if (path == nullptr || (is_cone && model.lights[*light].type != formats::LightType::spot))
        return warnDropped(object, text);
    channel.target = *light;
    channel.path = path->path;
    return channel;
}

/// Return the channel, or nullopt if it animates something that Hearth does not support.
std::optional<GltfAnimationChannel> readChannel(const GltfObject& object, size_t sampler_count,
                                                const GltfModel& model)
{
    GltfAnimationChannel channel;
    channel.sampler = object.index("sampler", sampler_count, Need::required);
    const auto target = object.object("target", Need::required);
    if (!target)
        return std::nullopt;
    const std::string path = target->text("path", Need::required);
    if (path == "pointer")
        return readPointer(object, *target, channel, model);
    channel.target = target->index("node", model.nodes.size());
    const formats::AnimationPathInfo* known = findPath(path, false);
    if (known == nullptr)
        return warnDropped(object, path);
    channel.path = known->path;
    // the specification allows a channel without a node, for extensions
    return channel.target == kInvalidIndex ? std::nullopt : std::optional(channel);
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
