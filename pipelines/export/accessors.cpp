// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/accessors.h"

#include "formats/base/assert.h"

#include <algorithm>

namespace hearth::gltf_export
{

namespace
{

constexpr size_t kComponents[] = {1, 2, 3, 4, 16};

uint32_t addAccessor(GltfDocument& document, Accessor accessor)
{
    document.accessors.push_back(std::move(accessor));
    return static_cast<uint32_t>(document.accessors.size() - 1);
}

} // namespace

uint32_t addView(GltfDocument& document, std::span<const std::byte> bytes, ViewTarget target)
{
    auto& binary = document.binary;
    binary.resize((binary.size() + 3) / 4 * 4);
    document.views.push_back({binary.size(), bytes.size(), target});
    const auto* const first = reinterpret_cast<const unsigned char*>(bytes.data());
    binary.insert(binary.end(), first, first + bytes.size());
    return static_cast<uint32_t>(document.views.size() - 1);
}

uint32_t addFloats(GltfDocument& document, std::span<const float> values, ElementType type, ViewTarget target,
                   Extremes extremes)
{
    const size_t components = kComponents[static_cast<size_t>(type)];
    HEARTH_ASSERT(values.size() % components == 0);
    Accessor accessor;
    accessor.type = type;
    accessor.count = values.size() / components;
    for (size_t c = 0; c < components && extremes == Extremes::stated; ++c)
    {
        float min = values[c], max = values[c];
        for (size_t i = c; i < values.size(); i += components)
        {
            min = std::min(min, values[i]);
            max = std::max(max, values[i]);
        }
        accessor.min.push_back(double{min});
        accessor.max.push_back(double{max});
    }
    const auto is_zero = [](float value) { return value == 0; };
    if (!std::all_of(values.begin(), values.end(), is_zero))
        accessor.view = addView(document, std::as_bytes(values), target);
    return addAccessor(document, std::move(accessor));
}

uint32_t addShorts(GltfDocument& document, std::span<const uint16_t> values, bool is_normalized)
{
    Accessor accessor;
    accessor.component = ComponentType::u16;
    accessor.type = ElementType::vec4;
    accessor.is_normalized = is_normalized;
    accessor.count = values.size() / 4;
    accessor.view = addView(document, std::as_bytes(values), ViewTarget::vertices);
    return addAccessor(document, std::move(accessor));
}

uint32_t addIndices(GltfDocument& document, std::span<const uint32_t> indices)
{
    // the largest number of a type restarts primitives
    constexpr uint32_t kMaxShort = 65534;
    Accessor accessor;
    accessor.count = indices.size();
    accessor.component = ComponentType::u32;
    if (*std::max_element(indices.begin(), indices.end()) > kMaxShort)
        accessor.view = addView(document, std::as_bytes(indices), ViewTarget::indices);
    else
    {
        const std::vector<uint16_t> narrow(indices.begin(), indices.end());
        accessor.component = ComponentType::u16;
        accessor.view = addView(document, std::as_bytes(std::span(narrow)), ViewTarget::indices);
    }
    return addAccessor(document, std::move(accessor));
}

} // namespace hearth::gltf_export
