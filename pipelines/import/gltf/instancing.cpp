// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/instancing.h"

#include "pipelines/import/part/limit_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hearth::import
{

namespace
{

constexpr std::string_view kNames[] = {"TRANSLATION", "ROTATION", "SCALE"};

Status checkAttribute(const GltfAttribute& attribute, uint64_t count, GltfAccessors& accessors)
{
    const GltfAccessor& accessor = accessors.accessor(attribute.accessor);
    const bool is_rotation = attribute.semantic == "ROTATION";
    const bool is_quantized = accessor.normalized && (accessor.component == ComponentType::i8 ||
                                                      accessor.component == ComponentType::i16);
    if (accessor.type != (is_rotation ? ElementType::vec4 : ElementType::vec3) ||
        !(accessor.component == ComponentType::f32 || (is_rotation && is_quantized)))
        return accessors.error(attribute.accessor, Issue::gltf_extension_value,
                               fmt::format("{} cannot be a {}", attribute.semantic, formatName(accessor)));
    if (accessor.count != count)
        return accessors.error(
            attribute.accessor, Issue::gltf_extension_value,
            fmt::format("{} has {} elements, others have {}", attribute.semantic, accessor.count, count));
    return success();
}

Result<std::vector<float>> readAttribute(const GltfAttributes& attributes, std::string_view name,
                                         GltfAccessors& accessors)
{
    const uint32_t index = findAttribute(attributes, name);
    if (index == kInvalidIndex)
        return std::vector<float>{};
    HEARTH_ASSIGN_OR_RETURN(std::vector<float> values, accessors.floats(index));
    if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }))
        return accessors.error(index, Issue::gltf_extension_value, fmt::format("{} is not finite", name));
    return values;
}

template <size_t N>
std::array<float, N> elementOr(const std::vector<float>& values, size_t i,
                               const std::array<float, N>& fallback)
{
    std::array<float, N> element = fallback;
    if (!values.empty())
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * N), N, element.begin());
    return element;
}

std::array<float, 4> unitOr(const std::array<float, 4>& rotation)
{
    double square = 0;
    for (const float v : rotation)
        square += double{v} * double{v};
    if (!(square > 0))
        return {0, 0, 0, 1};
    std::array<float, 4> unit;
    for (size_t i = 0; i < 4; ++i)
        unit[i] = static_cast<float>(double{rotation[i]} / std::sqrt(square));
    return unit;
}

} // namespace

Result<std::vector<Transform>> readInstancing(const GltfNode& node, uint32_t index, GltfAccessors& accessors,
                                              const GltfContext& context, GltfTally& tally)
{
    const std::string where = fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing", index);
    std::optional<uint64_t> count;
    for (const GltfAttribute& attribute : node.instancing)
    {
        if (std::find(std::begin(kNames), std::end(kNames), attribute.semantic) == std::end(kNames))
        {
            tally.dropped(fmt::format("instance attribute {} is not kept", attribute.semantic), where);
            continue;
        }
        count = count.value_or(accessors.accessor(attribute.accessor).count);
        HEARTH_TRY(checkAttribute(attribute, *count, accessors));
    }
    if (!count)
    {
        tally.repaired("instancing without attributes: one copy is drawn", where);
        return std::vector<Transform>(1);
    }
    if (*count > context.options.limits.max_instances)
        return context.error(Issue::input_too_large, where,
                             describeExcess(*count, "instances", context.options.limits.max_instances));

    HEARTH_ASSIGN_OR_RETURN(const std::vector<float> translations,
                            readAttribute(node.instancing, "TRANSLATION", accessors));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<float> rotations,
                            readAttribute(node.instancing, "ROTATION", accessors));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<float> scales,
                            readAttribute(node.instancing, "SCALE", accessors));
    std::vector<Transform> copies;
    copies.reserve(*count);
    for (size_t i = 0; i < *count; ++i)
        copies.push_back(transformFromTrs(elementOr<3>(translations, i, {0, 0, 0}),
                                          unitOr(elementOr<4>(rotations, i, {0, 0, 0, 1})),
                                          elementOr<3>(scales, i, {1, 1, 1})));
    return copies;
}

} // namespace hearth::import
