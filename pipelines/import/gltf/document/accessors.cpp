// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/accessors.h"

#include <fmt/format.h>

#include <cstring>

namespace hearth::import
{

namespace
{

// Limit on the total of zero-filled accessors: an accessor without a buffer view costs the file nothing.
// Sparse morph targets use them: this is enough for 100 targets of 100 000 vertices.
constexpr uint64_t kMaxZeroBytes = uint64_t{128} << 20;

uint32_t columnCount(ElementType type)
{
    return type == ElementType::mat2 ? 2 : type == ElementType::mat3 ? 3 : type == ElementType::mat4 ? 4 : 1;
}

uint32_t columnSize(ComponentType component, ElementType type)
{
    const uint32_t columns = columnCount(type);
    const uint32_t size = componentCount(type) / columns * componentSize(component);
    return columns == 1 ? size : (size + 3) / 4 * 4;
}

template <typename T>
T load(const std::byte* from)
{
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

template <typename T>
float toFloat(const std::byte* from, bool normalized)
{
    const T value = load<T>(from);
    if constexpr (std::is_floating_point_v<T>)
        return value;
    else if (!normalized)
        return static_cast<float>(value);
    else
        return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
}

using Convert = float (*)(const std::byte*, bool);

Convert converter(ComponentType component)
{
    switch (component)
    {
    case ComponentType::i8:
        return toFloat<int8_t>;
    case ComponentType::u8:
        return toFloat<uint8_t>;
    case ComponentType::i16:
        return toFloat<int16_t>;
    case ComponentType::u16:
        return toFloat<uint16_t>;
    case ComponentType::u32:
        return toFloat<uint32_t>;
    case ComponentType::f32:
        return toFloat<float>;
    }
    return nullptr;
}

uint32_t loadUnsigned(const std::byte* from, ComponentType component)
{
    if (component == ComponentType::u8)
        return load<uint8_t>(from);
    if (component == ComponentType::u16)
        return load<uint16_t>(from);
    return load<uint32_t>(from);
}

/// Call visit(pointer) for every component of `count` contiguous elements.
template <typename Visit>
void forEachComponent(const std::vector<std::byte>& elements, const GltfAccessor& accessor, Visit visit)
{
    const uint32_t columns = columnCount(accessor.type);
    const uint32_t rows = componentCount(accessor.type) / columns;
    const uint32_t column_size = columnSize(accessor.component, accessor.type);
    const uint32_t size = componentSize(accessor.component);
    for (size_t column = 0; column < accessor.count * columns; ++column)
        for (uint32_t row = 0; row < rows; ++row)
            visit(elements.data() + column * column_size + row * size);
}

} // namespace

uint32_t componentCount(ElementType type)
{
    switch (type)
    {
    case ElementType::scalar:
        return 1;
    case ElementType::vec2:
        return 2;
    case ElementType::vec3:
        return 3;
    case ElementType::vec4:
    case ElementType::mat2:
        return 4;
    case ElementType::mat3:
        return 9;
    case ElementType::mat4:
        return 16;
    }
    return 0;
}

uint32_t componentSize(ComponentType type)
{
    switch (type)
    {
    case ComponentType::i8:
    case ComponentType::u8:
        return 1;
    case ComponentType::i16:
    case ComponentType::u16:
        return 2;
    case ComponentType::u32:
    case ComponentType::f32:
        return 4;
    }
    return 0;
}

uint32_t elementSize(ComponentType component, ElementType type)
{
    return columnCount(type) * columnSize(component, type);
}

std::string formatName(const GltfAccessor& accessor)
{
    constexpr std::string_view kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    constexpr std::string_view kComponents[] = {"BYTE", "UNSIGNED_BYTE", "SHORT", "UNSIGNED_SHORT",
                                                "",     "UNSIGNED_INT",  "FLOAT"};
    const auto component =
        static_cast<uint32_t>(accessor.component) - static_cast<uint32_t>(ComponentType::i8);
    return fmt::format("{} of {}{}", kTypes[static_cast<uint32_t>(accessor.type)],
                       accessor.normalized ? "normalized " : "", kComponents[component]);
}

Error GltfAccessors::error(uint32_t index, Issue issue, std::string detail) const
{
    return context_.error(issue, fmt::format("/accessors/{}", index), std::move(detail));
}

Result<std::vector<std::byte>> GltfAccessors::elements(uint32_t index)
{
    const GltfAccessor& accessor = model_.accessors[index];
    const uint32_t size = elementSize(accessor.component, accessor.type);
    if (accessor.buffer_view == kInvalidIndex)
    {
        // as they are decoded: each component becomes four bytes
        const uint64_t decoded_size = uint64_t{componentCount(accessor.type)} * sizeof(float);
        if (accessor.count > (kMaxZeroBytes - zero_bytes_) / decoded_size)
            return error(
                index, Issue::input_too_large,
                fmt::format("{} elements of {} bytes without data, at most {} bytes of such are read",
                            accessor.count, decoded_size, kMaxZeroBytes));
        zero_bytes_ += accessor.count * decoded_size;
    }
    std::vector<std::byte> elements(accessor.count * size);
    if (accessor.buffer_view != kInvalidIndex)
    {
        // the model has checked that the elements fit in the view, and the buffers that the view exists
        const std::byte* from = buffers_.view(accessor.buffer_view).data() + accessor.byte_offset;
        const uint64_t view_stride = model_.buffer_views[accessor.buffer_view].byte_stride;
        const uint64_t stride = view_stride == 0 ? size : view_stride;
        if (stride == size)
            std::memcpy(elements.data(), from, elements.size());
        else
            for (uint64_t i = 0; i < accessor.count; ++i)
                std::memcpy(elements.data() + i * size, from + i * stride, size);
    }
    HEARTH_TRY(replaceSparse(index, elements));
    return elements;
}

Status GltfAccessors::replaceSparse(uint32_t index, std::span<std::byte> elements) const
{
    const GltfAccessor& accessor = model_.accessors[index];
    if (!accessor.sparse)
        return success();
    const GltfSparse& sparse = *accessor.sparse;
    const uint32_t size = elementSize(accessor.component, accessor.type);
    const uint32_t index_size = componentSize(sparse.indices_type);
    const std::byte* indices = buffers_.view(sparse.indices_view).data() + sparse.indices_offset;
    const std::byte* values = buffers_.view(sparse.values_view).data() + sparse.values_offset;
    for (uint64_t i = 0; i < sparse.count; ++i)
    {
        const uint32_t target = loadUnsigned(indices + i * index_size, sparse.indices_type);
        if (target >= accessor.count)
            return error(index, Issue::gltf_data,
                         fmt::format("sparse index {} of {} elements", target, accessor.count));
        std::memcpy(elements.data() + uint64_t{target} * size, values + i * size, size);
    }
    return success();
}

Result<std::vector<float>> GltfAccessors::floats(uint32_t index)
{
    const GltfAccessor& accessor = model_.accessors[index];
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, elements(index));
    const Convert convert = converter(accessor.component);
    std::vector<float> values;
    values.reserve(accessor.count * componentCount(accessor.type));
    forEachComponent(bytes, accessor,
                     [&](const std::byte* from) { values.push_back(convert(from, accessor.normalized)); });
    return values;
}

Result<std::vector<uint32_t>> GltfAccessors::integers(uint32_t index)
{
    const GltfAccessor& accessor = model_.accessors[index];
    HEARTH_ASSERT(accessor.component == ComponentType::u8 || accessor.component == ComponentType::u16 ||
                  accessor.component == ComponentType::u32);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, elements(index));
    std::vector<uint32_t> values;
    values.reserve(accessor.count * componentCount(accessor.type));
    forEachComponent(bytes, accessor,
                     [&](const std::byte* from)
                     { values.push_back(loadUnsigned(from, accessor.component)); });
    return values;
}

} // namespace hearth::import
