// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/shadow_options.h"

#include "formats/base/text.h"
#include "runtime/gpu/scene/scene_shading.h"
#include "runtime/pack/scene_boxes.h"
#include "runtime/viewer/text.h"

#include <algorithm>
#include <bit>
#include <string>

namespace hearth::viewer
{

namespace
{

Error usage(std::string_view option, std::string_view text, std::string_view expected)
{
    std::string detail(option);
    detail.append(": \"").append(text).append("\" ").append(expected);
    return {Issue::usage, "", "", detail};
}

bool setCount(std::string_view text, uint32_t least, uint32_t most, uint32_t& count)
{
    const auto number = parseNumber<uint32_t>(text);
    if (!number || *number < least || *number > most)
        return false;
    count = *number;
    return true;
}

bool setLength(std::string_view text, float& length, bool& fit)
{
    const auto number = parseNumber<float>(text);
    if (!number || *number <= 0)
        return false;
    length = *number;
    fit = false;
    return true;
}

bool setBias(std::string_view text, float& bias)
{
    const auto number = parseNumber<float>(text);
    if (!number || *number < 1)
        return false;
    bias = *number;
    return true;
}

bool setDepth(std::string_view text, gpu::ShadowDepth& depth)
{
    depth = text == "16" ? gpu::ShadowDepth::d16 : gpu::ShadowDepth::d32;
    return text == "16" || text == "32";
}

/// Parse "texels=2048"; false if the name or the value is invalid.
bool setByName(std::string_view setting, ShadowSettings& settings)
{
    gpu::ShadowOptions& options = settings.options;
    const size_t equals = setting.find('=');
    if (equals == std::string_view::npos)
        return false;
    const std::string_view name = setting.substr(0, equals);
    const std::string_view value = setting.substr(equals + 1);
    if (name == "maps")
    {
        settings.fit_maps = false;
        return setCount(value, 1, shared::kMaxShadowMaps, options.max_maps);
    }
    if (name == "texels")
        return setCount(value, 16, 8192, options.texels) && std::has_single_bit(options.texels);
    if (name == "kernel")
        return setCount(value, 0, 3, options.kernel);
    if (name == "splits")
        return setCount(value, 0, gpu::kMaxSplits, options.splits);
    if (name == "depth")
        return setDepth(value, options.depth);
    if (name == "bias")
        return setBias(value, options.error_bias);
    if (name == "near")
        return setLength(value, options.split_range.near, settings.fit_near);
    return name == "far" && setLength(value, options.split_range.far, settings.fit_far);
}

/// Return the distances of a point to a box and to its farthest corner.
std::pair<float, float> boxDistances(const Box3& box, Float3 point)
{
    const auto nearest = [](float at, float low, float high) {
        return std::max({low - at, at - high, 0.0f});
    };
    const auto farthest = [](float at, float low, float high) { return std::max(high - at, at - low); };
    const auto over = [&](const auto& f)
    {
        return length(Float3{f(point.x, box.min.x, box.max.x), f(point.y, box.min.y, box.max.y),
                             f(point.z, box.min.z, box.max.z)});
    };
    return {over(nearest), over(farthest)};
}

} // namespace

Status parseShadows(std::string_view text, ShadowSettings& settings)
{
    settings.options.max_maps = text == "off" ? 0 : shared::kMaxShadowMaps;
    settings.fit_maps = true;
    if (text == "off" || text == "on")
        return success();
    for (const std::string_view setting : splitText(text, ','))
        if (!setByName(setting, settings))
            return usage("--shadows", setting,
                         "is neither off nor on nor one of maps=1 to 64, texels=16 to 8192 by powers of two, "
                         "kernel=0 to 3, depth=16 or 32, bias=1 and more, splits=0 to 8, near=METRES, "
                         "far=METRES");
    const shared::SplitRange& range = settings.options.split_range;
    if (!settings.fit_near && !settings.fit_far && range.near >= range.far)
        return usage("--shadows", text, "has near beyond far");
    return success();
}

Status parseShadowCasters(std::string_view text, ShadowSettings& settings)
{
    if (text != "clusters" && text != "proxies")
        return usage("--shadow-casters", text, "is neither clusters nor proxies");
    settings.options.casters = text == "proxies" ? gpu::Casters::proxies : gpu::Casters::clusters;
    return success();
}

Status parseShadowSphere(std::string_view text, ShadowSettings& settings)
{
    const auto parts = splitText(text, ',');
    std::vector<float> numbers;
    for (size_t i = 0; i < std::min<size_t>(parts.size(), 4); ++i)
        if (const auto number = parseNumber<float>(parts[i]))
            numbers.push_back(*number);
    const auto light = parts.size() == 5 ? parseNumber<uint32_t>(parts[4])
                                         : std::optional<uint32_t>(gpu::ShadowSphere::kAllLights);
    if (parts.size() > 5 || numbers.size() != 4 || numbers[3] <= 0 || !light)
        return usage("--shadow-sphere", text, "is not X,Y,Z,RADIUS or X,Y,Z,RADIUS,LIGHT");
    settings.spheres.push_back(
        {.center = {numbers[0], numbers[1], numbers[2]}, .radius = numbers[3], .light = *light});
    return success();
}

gpu::ShadowOptions fitShadows(const ShadowSettings& settings, const formats::PackView& pack,
                              std::span<const shared::Camera> cameras)
{
    gpu::ShadowOptions options = settings.options;
    options.moving_layers = false;
    if (settings.fit_maps && options.max_maps > 0)
        options.max_maps = gpu::countShadowMaps(gpu::makeLighting(pack), options.splits,
                                                pack.shadowSpheres().size() + settings.spheres.size());
    const Box3 bounds = pack::sceneBounds(pack);
    if (bounds.empty())
        return options;
    float near = HUGE_VALF;
    float far = 0;
    for (const shared::Camera& camera : cameras)
    {
        const auto [nearest, farthest] = boxDistances(bounds, camera.position);
        near = std::min(near, nearest);
        far = std::max(far, farthest);
    }
    shared::SplitRange& range = options.split_range;
    if (settings.fit_far)
        range.far = settings.fit_near ? far : std::max(far, 2 * range.near);
    if (settings.fit_near)
        range.near = std::clamp(near, range.far * 1e-3f, range.far * 0.5f);
    return options;
}

} // namespace hearth::viewer
